#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs 3D scenes and their twins in the half plane (`meniscus revolve`) on one thread, and
prints a table of both: particles, times, how many expectations are met, and the largest
difference of a result between the two, as a part of what its expectation allows.

DIRECTORY gets the twins and all results; runs that are there are not repeated. Scenes are names of
inputs/; without them all scenes that have a twin. With --levels three scenes are run at several
spacings instead, and their errors against time are drawn, twins.png: differences from the finest
run in the half plane.
"""

import argparse
import os
import re
import subprocess
import time
from pathlib import Path

import shipped

ROW = re.compile(r"^(\S+) +(\S+) +(\S+) +(\S+)  (met|MISSED)$", re.MULTILINE)


def call(*arguments):
    return subprocess.run([*map(str, arguments)], capture_output=True, text=True, check=False,
                          env={**os.environ, "OMP_NUM_THREADS": "1"})


# Scenes at several spacings: a result, the keys of a level in 3D and in the half plane, the levels,
# and the finest level in the half plane.
LEVELS = {
    "ellipsoid_drop": ("aspect_51ps", ("body.drop.core={0}", "body.drop.layers={1}"),
                       ("body.drop.core={0}", "body.drop.rings={1}"), [(4, 2), (6, 3), (8, 4), (10, 5), (14, 7)], (40, 20)),
    "droplet_spreading": ("base_6", ("body.drop.core={0}", "body.drop.layers={1}"),
                          ("body.drop.core={0}", "body.drop.rings={1}"), [(6, 3), (8, 4), (10, 5), (12, 6)], (28, 14)),
    "rbc_deflate": ("largest_thickness", ("body.cell.spacing={0}", "body.cell.layers={1}"),
                    ("body.cell.spacing={0}", "body.cell.layers={1}"), [(0.6, 4), (0.4, 4), (0.3, 4), (0.3, 6)], (0.05, 12)),
}


def run(program, scene, output, *settings):
    """What a run printed, with its seconds, of this call or of an earlier one."""
    said = output.with_name(output.name + ".txt")
    if not said.exists():
        begin = time.perf_counter()
        done = call(program, "run", scene, "--output", output, "--overwrite", "--threads", "1",
                    *(word for setting in settings for word in ("--set", setting)))
        seconds = time.perf_counter() - begin
        said.write_text(f"{seconds:.3f}\n{done.stdout}\n{done.stderr}", encoding="utf-8")
    seconds, text = said.read_text(encoding="utf-8").split("\n", 1)
    results = {name: (float(value), float(within), mark) for name, value, _, within, mark in ROW.findall(text)}
    return float(seconds), results


def difference(space, plane):
    """The expectation in which two runs differ most, as a part of its tolerance."""
    most = ("", 0.0)
    for name in space.keys() & plane.keys():
        (a, within, _), (b, _, _) = space[name], plane[name]
        share = abs(a - b) / within if within > 0 else float(a != b)
        most = max(most, (name, share), key=lambda pair: pair[1])
    return most


def twin_of(program, name, directory):
    """The file of the twin of a scene; None if it has none."""
    twin = directory / f"{name}.toml"
    if not twin.exists():
        done = call(program, "revolve", shipped.scene(name), twin)
        if done.returncode != 0:
            return None
        twin.with_suffix(".said").write_text(done.stdout, encoding="utf-8")
    return twin


def row_of(program, name, directory):
    """The row of a scene in the table; None if it has no twin."""
    twin = twin_of(program, name, directory)
    if twin is None:
        return None
    plane, space = re.search(r"has (\d+) particles instead of (\d+)", twin.with_suffix(".said").read_text()).groups()
    (seconds, results), (less, of_twin) = (run(program, shipped.scene(name), directory / f"{name}-space"),
                                           run(program, twin, directory / f"{name}-plane"))
    met = ["{} of {}".format(sum(mark == "met" for *_, mark in r.values()), len(r)) for r in (results, of_twin)]
    where, most = difference(results, of_twin)
    return (f"| `{name}` | {space}, {plane} | {seconds:.3g}, {less:.2g} | {seconds / less:.0f} | {met[0]} | {met[1]} "
            f"| {most:.2g} in `{where}` |")


def draw_levels(program, directory):
    """Prints the errors and times of LEVELS, and draws them."""
    import matplotlib  # pylint: disable=import-outside-toplevel

    matplotlib.use("Agg")
    from matplotlib import pyplot  # pylint: disable=import-outside-toplevel

    figure, axes = pyplot.subplots(1, len(LEVELS), figsize=(4 * len(LEVELS), 3.4), layout="constrained")
    print("| scene | result | level | space: error, time (s) | half plane: error, time (s) |\n|---|---|---|---|---|")
    for axis, (name, (result, in_space, in_plane, levels, finest)) in zip(axes, LEVELS.items()):
        twin = twin_of(program, name, directory)

        def at(scene, keys, level, folder):
            label = "-".join(map(str, level))
            seconds, results = run(program, scene, directory / f"{name}-{folder}-{label}", *(key.format(*level) for key in keys))
            return seconds, results[result][0]

        limit = at(twin, in_plane, finest, "plane")[1]
        curves = {"in space": [], "in the half plane": []}
        for level in levels:
            for where, (scene, keys) in zip(curves, ((shipped.scene(name), in_space), (twin, in_plane))):
                seconds, value = at(scene, keys, level, where.split()[-1])
                curves[where].append((seconds, abs(value / limit - 1)))
            (space, plane) = (curve[-1] for curve in curves.values())
            print(f"| `{name}` | `{result}` | {level[0]}, {level[1]} | {space[1]:.1e}, {space[0]:.3g} | {plane[1]:.1e}, {plane[0]:.2g} |", flush=True)
        for (where, curve), marker in zip(curves.items(), "so"):
            axis.loglog(*zip(*curve), marker + "-", label=where)
        axis.set(title=name, xlabel="time (s)", ylabel=f"error of {result}")
    axes[0].legend()
    figure.savefig(directory / "twins.png", dpi=120)


def main():
    arguments = argparse.ArgumentParser(prog="twins.py", description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program", type=Path, metavar="PROGRAM", help="meniscus")
    arguments.add_argument("directory", type=Path, metavar="DIRECTORY", help="of twins and results")
    arguments.add_argument("scenes", nargs="*", metavar="SCENE")
    arguments.add_argument("--levels", action="store_true", help="three scenes at several spacings")
    given = arguments.parse_args()
    program, directory = given.program.resolve(), given.directory.resolve()
    directory.mkdir(parents=True, exist_ok=True)
    if given.levels:
        draw_levels(program, directory)
        return
    scenes = given.scenes or (
        path.stem for path in shipped.scenes() if re.search(r"^dimension = 3", path.read_text(), re.MULTILINE))
    print("| scene | particles | time (s) | ratio | met in 3D | in the half plane | largest difference / allowed |\n"
          "|---|---|---|---|---|---|---|", flush=True)
    for name in scenes:
        row = row_of(program, name, directory)
        if row:
            print(row, flush=True)


if __name__ == "__main__":
    main()
