#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Damaged mesh files: each is refused by one sentence, or read as the body that another program (meshio)
reads from it, whose cells do not overlap; without a signal, in little memory and time.
Usage: hostile_meshes.py PROGRAM [N [SEED]]  (N damaged files, 60 by default, chosen by a seed)"""
import contextlib
import io
import random
import re
import resource
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import meshio
import numpy as np

from program import ENVIRONMENT

COUNT, SEED, MEMORY, SECONDS = 60, 1, 2 << 30, 10
SCENE = """
dimension = {dimension}
time.end = 1e-9
time.step = 1e-9
output.measures = ["body.volume"]
[[body]]
name = "body"
shape = "mesh"
file = "{file}"
facets = "flat"
material = {{ type = "neo_hookean", density = 1, mu = 1, lambda = 1 }}
"""
# Corners of the pieces of a square and of a cube.
TRIANGLES = ((0, 1, 3), (0, 3, 2))
TETRAHEDRA = ((0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7))
KINDS = {"triangle": (2, TRIANGLES), "quad": (2, ((0, 1, 3, 2),)), "tetra": (3, TETRAHEDRA),
         "hexahedron": (3, ((0, 1, 3, 2, 4, 5, 7, 6),))}
FORMATS = {
    "gmsh22.msh": dict(file_format="gmsh22", binary=False),
    "gmsh22_binary.msh": dict(file_format="gmsh22", binary=True),
    "gmsh41.msh": dict(file_format="gmsh", binary=False),
    "gmsh41_binary.msh": dict(file_format="gmsh", binary=True),
    "ascii.vtu": dict(file_format="vtu", binary=False),
    "zlib.vtu": dict(file_format="vtu", binary=True, compression="zlib"),
    "plain.vtu": dict(file_format="vtu", binary=True, compression=None),
}
NUMBERS = (b"-1", b"0", b"nan", b"inf", b"1e308", b"-1e-300", b"2147483648", b"99999999999999999999", b"0.5",
           b"1e", b"0x10", b"7", b"--3", b"1,5")


def block(kind, n=3):
    """A block of n cells (pieces of squares or cubes) along each edge, a little longer than wide."""
    dimension, pieces = KINDS[kind]
    axes = [np.linspace(0, 1 + 0.1 * d, n + 1) for d in range(dimension)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, dimension)
    stride = (n + 1) ** np.arange(dimension - 1, -1, -1)
    corner = np.array([[k >> d & 1 for d in range(dimension)] for k in range(2**dimension)]) @ stride
    first = np.stack(np.meshgrid(*[range(n)] * dimension, indexing="ij"), -1).reshape(-1, dimension) @ stride
    cells = np.concatenate([first[:, None] + corner[list(piece)] for piece in pieces])
    padded = np.zeros((len(points), 3))
    padded[:, :dimension] = points
    return meshio.Mesh(padded, [(kind, cells)])


def damaged(content, chosen):
    """The content with one or two things done to it."""
    for _ in range(chosen.choice((1, 1, 2))):
        way = chosen.choice(("bits", "cut", "line gone", "line twice", "lines swapped", "number", "number",
                             "number", "piece gone", "piece twice"))
        lines = content.split(b"\n")
        place = chosen.randrange(max(len(content), 1))
        if way == "bits":
            changed = bytearray(content)
            for _ in range(chosen.choice((1, 3, 20))):
                changed[chosen.randrange(len(changed))] ^= 1 << chosen.randrange(8)
            content = bytes(changed)
        elif way == "cut":
            content = content[:place]
        elif way == "number":
            found = list(re.finditer(rb"(?<![\w.+-])-?\d[\d.]*(e[+-]?\d+)?(?![\w.])", content))
            if found:
                where = chosen.choice(found)
                content = content[:where.start()] + chosen.choice(NUMBERS) + content[where.end():]
        elif way.startswith("piece"):
            end = min(len(content), place + chosen.choice((1, 8, 64)))
            content = content[:place] + (content[place:end] * 2 if way == "piece twice" else b"") + content[end:]
        elif len(lines) > 2:
            i, j = chosen.sample(range(len(lines)), 2)
            if way == "line gone":
                del lines[i]
            elif way == "line twice":
                lines.insert(i, lines[i])
            else:
                lines[i], lines[j] = lines[j], lines[i]
            content = b"\n".join(lines)
        if not content:
            return b"\n"
    return content


def simplices(path, flipped=0):
    """(corners of simplices, dimension) of all cells of the highest dimension, as meshio reads them.
    `flipped`: bits of the directions in which the pieces of cells are mirrored."""
    mesh = meshio.read(path)
    dimension = max(KINDS[c.type][0] for c in mesh.cells if c.type in KINDS)
    corners = []
    for cells in mesh.cells:
        if cells.type in KINDS and KINDS[cells.type][0] == dimension:
            # Cells are numbered around their sides, pieces by rows; each order leads to the other.
            order = {"quad": (0, 1, 3, 2), "hexahedron": (0, 1, 3, 2, 4, 5, 7, 6)}.get(cells.type)
            pieces = [tuple(range(dimension + 1))] if order is None else [
                [order[k ^ flipped] for k in piece] for piece in (TRIANGLES if dimension == 2 else TETRAHEDRA)]
            corners += [mesh.points[cells.data[:, list(piece)], :dimension] for piece in pieces]
    return np.concatenate(corners), dimension


def volume_and_overlap(path):
    """Volume of the cells that meshio reads, and the share of random points that are within two of them.
    Sides that are not plane are those of a bilinear map: the mean of all ways to divide them."""
    ways = [simplices(path, flipped) for flipped in (0, 1, 2, 4)]
    corners, dimension = ways[0]
    edges = corners[:, 1:] - corners[:, :1]
    volume = np.mean([np.abs(np.linalg.det(c[:, 1:] - c[:, :1])).sum() for c, _ in ways])
    volume /= 2 if dimension == 2 else 6
    lowest, highest = corners.min((0, 1)), corners.max((0, 1))
    points = lowest + (highest - lowest) * np.random.default_rng(0).random((4000, dimension))
    weights = np.linalg.solve(np.swapaxes(edges, 1, 2)[:, None],
                              (points[None] - corners[:, None, 0])[..., None])[..., 0]
    within = (weights.min(-1) > 1e-9) & (weights.sum(-1) < 1 - 1e-9)
    return volume, (within.sum(0) > 1).mean()


def verdict(program, directory, number, name, kind, content, original):
    """"refused", "read", or a description of what is wrong."""
    path = directory / f"{number}_{name}"
    path.write_bytes(content)
    (directory / f"{number}.toml").write_text(SCENE.format(dimension=KINDS[kind][0], file=path.name))

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    done = subprocess.run([program, "run", f"{number}.toml", "--overwrite", "--threads", "1"], cwd=directory, text=True,
                          errors="replace", capture_output=True, env=ENVIRONMENT, timeout=20 * SECONDS,
                          preexec_fn=limit)
    if done.returncode == 3:
        message = done.stderr.strip()
        # nan and inf may stand in a message as words of the file, but not as results.
        if f"{number}.toml:" not in message or len(message) > 2000 or "= -nan" in message or "= nan" in message:
            return f"message: {message[:300]}"
        return "refused"
    if done.returncode != 0:
        return f"exit code {done.returncode}: {done.stderr[-300:]}"
    rows = (directory / f"results/{number}/history.csv").read_text().splitlines()
    volume = float(rows[-1].split(",")[rows[0].split(",").index("body.volume")])
    try:
        expected, overlap = volume_and_overlap(path)
    except BaseException as error:  # meshio ends by sys.exit where it cannot read
        expected, overlap = original, 0
        if abs(volume - original) > 1e-6 * original:
            return f"volume {volume} of a file that meshio does not read ({type(error).__name__}), was {original}"
    if not abs(volume - expected) <= 1e-6 * abs(expected):
        return f"volume {volume}, and {expected} by meshio"
    return "read" if overlap < 1e-3 else f"read, though {overlap:.0%} of the points are in two cells"


def main():
    program = Path(sys.argv[1]).resolve()
    count, seed = (int(a) for a in sys.argv[2:] + [COUNT, SEED][len(sys.argv) - 2:])
    chosen = random.Random(seed)
    with (tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(2) as pool,
          contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO())):  # of meshio
        directory, bases, jobs = Path(name), [], []
        for kind in KINDS:
            for file, options in FORMATS.items():
                meshio.write(directory / file, block(kind), **options)
                bases.append((file, kind, (directory / file).read_bytes()))
                volume = 1.1 if KINDS[kind][0] == 2 else 1.1 * 1.2
                found = verdict(program, directory, f"base_{kind}", *bases[-1], volume)
                assert found == "read", f"{kind} {file}: {found}"
        for k in range(count):
            file, kind, content = chosen.choice(bases)
            jobs.append((k, file, kind, damaged(content, chosen), 1.1 if KINDS[kind][0] == 2 else 1.1 * 1.2))
        verdicts = list(pool.map(lambda job: verdict(program, directory, *job), jobs))
        wrong = [f"{job[0]} {job[2]} {job[1]}: {found}" for job, found in zip(jobs, verdicts)
                 if found not in ("read", "refused")]
    print("\n".join(wrong))
    print(f"{count} damaged meshes, {verdicts.count('read')} read, {len(wrong)} wrong")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
