#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every scene of inputs/, in the form of its test, ends with the same state hash in one process,
on 2, 3 and 4 ranks, and stopped half-way on 3 ranks and continued on 2.
Usage: ranks_of_scenes.py PROGRAM [SCENE...]"""
import csv
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

from program import ENVIRONMENT, shipped
from test_ranks import MPIRUN, RANKS_ENVIRONMENT

SINGLE = {**ENVIRONMENT, "OMP_NUM_THREADS": "1"}
# Allowed exit codes: a shortened run may miss an expectation (7).
ENDS = (0, 7)


def options_of(scene):
    """Options of `meniscus run`; None if the scene is not a test."""
    with scene.open() as lines:
        form = re.match(r"# test: (full|short (.*))$", lines.readline().strip())
    return form and shlex.split(form[2] or "")


def state(program, ranks, *arguments):
    launch = [*MPIRUN, str(ranks)] if ranks > 1 else []
    done = subprocess.run([*launch, program, "run", *map(str, arguments)], text=True,
                          capture_output=True, env=RANKS_ENVIRONMENT if ranks > 1 else SINGLE,
                          timeout=3600)
    found = re.search(r"state ([0-9a-f]{16})", done.stdout)
    if done.returncode not in ENDS or not found:
        return f"exit code {done.returncode}: {done.stderr.strip().splitlines()[-1:]}"
    return found[1]


def middle(output):
    """A time half-way through a run, from the rows of its history; None if there is no row in between."""
    with (output / "history.csv").open() as file:
        times = [row[0] for row in csv.reader(line for line in file if line[0] not in "#\"t")]
    return times[len(times) // 2] if len(times) > 2 else None


def differences(program, scene, options, directory):
    """Differences from a run in one process."""
    expected = state(program, 1, scene, *options, "--output", directory / "alone")
    found = {f"{ranks} ranks": state(program, ranks, scene, *options, "--output", directory / str(ranks))
             for ranks in (2, 3, 4)}
    half = middle(directory / "alone")
    if half:
        without_end = [o for k, o in enumerate(options) if "--until" not in (o, options[k - 1])]
        state(program, 3, scene, *without_end, "--until", half, "--output", directory / "part")
        found["continued"] = state(program, 2, scene, *options, "--restart", directory / "part")
    return expected, {name: what for name, what in found.items() if what != expected}, bool(half)


def main():
    program, names = sys.argv[1], sys.argv[2:]
    scenes = [shipped.scene(name) for name in names] or shipped.scenes()
    failed = 0
    for scene in scenes:
        options = options_of(scene)
        if options is None:
            continue
        with tempfile.TemporaryDirectory() as directory:
            expected, wrong, restarted = differences(program, scene, options, Path(directory))
        failed += bool(wrong)
        same = "same on 2, 3 and 4 ranks" + (" and continued" if restarted else "")
        print(f"{scene.stem}: {expected} {wrong or same}", flush=True)
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
