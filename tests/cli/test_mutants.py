#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes with one line changed are in order or refused with a place, within ten seconds of processor
time, and which of them are in order is known: data/accepted_mutants.txt has been read line by line.
Usage: test_mutants.py PROGRAM            400 of the mutants, chosen by a seed
       test_mutants.py PROGRAM --all      every one
       test_mutants.py PROGRAM --pairs N  N scenes with two lines changed, chosen by a seed
       test_mutants.py PROGRAM --update   every one; rewrites the list, to be read as a difference
With --seed S at the end the choice is another one."""
import random
import re
import resource
import subprocess
import sys
import tempfile
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from program import DROP, ENVIRONMENT, RELAXING_SHEET

LIST = Path(__file__).resolve().parents[1] / "data/accepted_mutants.txt"
COUNT, SEED, LIMIT = 400, 5, 10

DROP = DROP.replace("core = 3", "core = 2").replace("layers = 2", "layers = 1") + """
[expect]
aspect = { of = "drop.aspect", at = "30 ps", value = 1.2, within = 1 }
"""

SHEET = RELAXING_SHEET.replace("cells = [5, 10]", "cells = [3, 6]\njitter = 0.1") + """
[[exact]]
body = "sheet"
displacement = ["x*cos(t)", 0]
velocity = ["-x*sin(t)", 0]
rate = 1
[expect.residual]
of = "force_residual"
value = 0
within = 1e-5
"""

# Two disks and a moving wall.
CONTACT = """
title = "disks"
dimension = 2
[units]
system = "nm-ps-ag"
[time]
end = 10
safety = 0.5
[output]
frames_every = 2
fields = ["velocity"]
precision = "float32"
compression = 4
[[body]]
name = "one"
shape = "disk"
radius = 1
core = 2
rings = 2
centre = [0, 0]
initial_velocity = ["0.01*x", 0]
[body.material]
type = "neo_hookean"
density = 1
mu = 1
lambda = 1
[[body]]
name = "two"
shape = "disk"
radius = 1
core = 2
rings = 2
centre = [2.6, 0]
integration = "gauss"
material = { type = "st_venant_kirchhoff", density = 1, mu = 1, lambda = 1 }
[[contact]]
bodies = ["one", "two"]
epsilon = 0.01
sigma0 = 0.5
beta = 1
[[contact]]
name = "wall"
bodies = ["one"]
epsilon = 0.01
sigma0 = 0.5
beta = 1
[contact.partner]
type = "half_space"
point = [-2, 0]
normal = [1, 0]
displacement = ["0.01*t", 0]
"""

# A shell around a shrinking volume.
SHELL = """
dimension = 3
[time]
end = 0.1
[output]
measures = ["cell.volume"]
[[body]]
name = "cell"
shape = "sphere_shell"
radius = 1
thickness = 0.5
layers = 4
spacing = 0.8
[body.material]
type = "mooney_rivlin"
density = 1
c1 = 1
c2 = 0.1
lambda = 20
[[cavity]]
body = "cell"
volume_target = 0.9
penalty = 10
ramp = [0, 0.05]
[[profile]]
body = "cell"
r = [0, 1]
z = [0.5, 0]
"""

# A block whose law depends on the position.
BLOCK = """
dimension = 3
[time]
end = "10 ms"
step = "0.1 ms"
[[body]]
name = "block"
shape = "box"
size = ["1 m", 1, 1]
cells = [2, 2, 2]
support_factor = 1.8
volumetric = "full"
[body.material]
type = "neo_hookean"
density = "1 g/cm^3"
mu = "1e5*(1 + x)"
lambda = 1e5
[[body_force]]
body = "block"
acceleration = ["20*sin(40*t)*(1 + z)", 0, 0]
"""

BASES = {"drop": DROP, "sheet": SHEET, "contact": CONTACT, "shell": SHELL, "block": BLOCK}

VALUES = {
    "true": "true", "text": '"banana"', "empty": '""', "array": "[]", "table": "{}",
    "minus": "-1", "zero": "0", "one": "1", "huge": "1e308", "tiny": "1e-308", "nan": "nan",
    "inf": "inf", "largest": "9223372036854775807", "ten digits": "9999999999",
    "length": '"1 m"', "x": '"x"', "t": '"t"', "1/0": '"1/0"', "root": '"sqrt(x - 9)"',
    "pole": '"1/(t - t)"', "date": "2026-01-01", "nul": '"a\\u0000b"', "unquoted": "10 ms",
    "list": "[1, 2, 3, 4]", "nested": "[[1]]",
}


def mutants_of(line):
    """{name: text that replaces the line}."""
    mutants = {"deleted": "", "twice": f"{line}\n{line}", "open": line.replace('"', "", 1) + "]"}
    key, equals, value = line.partition(" = ")
    if equals:
        mutants |= {name: f"{key} = {new}" for name, new in VALUES.items()}
        mutants |= {"misspelt": f"{key}x = {value}", "negative": re.sub(r"(\d)", r"-\1", line, 1),
                    "elements": re.sub(r"\[.*\]", "[true]", line)}
    else:
        name = line.strip("[]")
        mutants |= {"plain": f"[{name}]", "array": f"[[{name}]]", "misspelt": line.replace(name, name + "x"),
                    "value": f"{name} = 1", "deep": f"[{name}.a.b]", "empty": f"[{name}]\n[{name}y]"}
    return {name: text for name, text in mutants.items() if text != line}


def all_mutants():
    """(base, line, mutation, scene) of each mutant."""
    for base, text in BASES.items():
        lines = text.split("\n")
        for i, line in enumerate(lines):
            if line.strip():
                for name, new in mutants_of(line.strip()).items():
                    yield base, i, name, "\n".join(lines[:i] + [new] + lines[i + 1:])


def pair_mutants(count, seed):
    """(base, lines, mutations, scene) with two changes each."""
    chosen = random.Random(seed)
    for _ in range(count):
        base = chosen.choice(list(BASES))
        lines = BASES[base].split("\n")
        changed = chosen.sample([i for i, line in enumerate(lines) if line.strip()], 2)
        names = []
        for i in changed:
            name, lines[i] = chosen.choice(list(mutants_of(lines[i].strip()).items()))
            names.append(name)
        yield base, tuple(changed), tuple(names), "\n".join(lines)


def verdict(program, directory, number, scene):
    """"accepted", "refused", or a description of the error of the program."""
    file = directory / f"m{number}.toml"
    file.write_text(scene)
    done = subprocess.run([program, "check", file.name, "--threads", "1"], cwd=directory, text=True,
                          capture_output=True, env=ENVIRONMENT, timeout=20 * LIMIT,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT)))
    file.unlink()
    if done.returncode == 0:
        return "accepted"
    if done.returncode != 3:
        return f"exit code {done.returncode}: {done.stderr[-300:]}"
    for line in done.stderr.splitlines():
        if not re.match(rf"{file.name}:\d+:\d+: ", line) and not line.endswith("more problems"):
            return f"no place: {line}"
    return "refused"


def listed():
    """The list of accepted mutants, as {(base, line number): names of mutations}."""
    accepted = defaultdict(set)
    for entry in LIST.read_text().splitlines():
        if not entry.startswith("#"):
            place, names = entry.rsplit(": ", 1)
            base, number, _ = place.split(" ", 2)
            accepted[base, int(number)] = set(names.split(", "))
    return accepted


def is_known(known, base, lines, names):
    """True if each single change of a pair leaves the scene in order."""
    return all(name in known.get((base, i), ()) for i, name in zip(lines, names))


def check_pairs(program, count, seed):
    """A scene that is accepted with two changes is accepted with each of them: no mistake hides another."""
    known, mutants, wrong, in_order = listed(), list(pair_mutants(count, seed)), [], 0
    with tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(2) as pool:
        verdicts = pool.map(lambda m: verdict(program, Path(name), m[0], m[1][3]), enumerate(mutants))
        for (base, lines, names, _), found in zip(mutants, verdicts):
            in_order += found == "accepted"
            if found not in ("accepted", "refused") or found == "accepted" and not is_known(known, base, lines, names):
                wrong.append(f"{base} {lines} {names}: {found}")
    print("\n".join(wrong))
    print(f"{count} mutants with two changes, {in_order} in order, {len(wrong)} wrong")
    sys.exit(bool(wrong))


def write_list(accepted):
    with LIST.open("w") as out:
        out.write("# Scene, number and text of a line of test_mutants.py: changes that leave it in order.\n")
        for (base, i), names in sorted(accepted.items()):
            line = BASES[base].split("\n")[i].strip()
            out.write(f"{base} {i} {line}: {', '.join(sorted(names))}\n")


def main():
    seed = SEED
    if sys.argv[-2] == "--seed":
        seed = int(sys.argv[-1])
        del sys.argv[-2:]
    program, mode = Path(sys.argv[1]).resolve(), (sys.argv[2:] or [""])[0]
    if mode == "--pairs":
        check_pairs(program, int(sys.argv[3]), seed)
    mutants = list(all_mutants())
    if not mode:
        mutants = random.Random(seed).sample(mutants, COUNT)
    with tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(2) as pool:
        directory = Path(name)
        for base, scene in BASES.items():
            assert verdict(program, directory, base, scene) == "accepted", base
        verdicts = list(pool.map(lambda m: verdict(program, directory, m[0], m[1][3]),
                                 enumerate(mutants)))
    accepted, wrong = defaultdict(set), []
    known = {} if mode == "--update" else listed()
    for (base, i, name, scene), found in zip(mutants, verdicts):
        if found == "accepted":
            accepted[base, i].add(name)
        expected = "accepted" if name in known.get((base, i), ()) else "refused"
        if found != expected and not (mode == "--update" and found == "accepted"):
            wrong.append(f"{base} {i} '{BASES[base].split(chr(10))[i].strip()}' {name}: {found}, "
                         f"expected {expected}")
    if mode == "--update":
        write_list(accepted)
    print("\n".join(wrong))
    print(f"{len(mutants)} mutants, {sum(map(len, accepted.values()))} in order, {len(wrong)} wrong")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
