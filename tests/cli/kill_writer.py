#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Kills result_writer with SIGKILL at 100 random times, most of them early. Each time run.h5 must
open with every announced frame, the views must agree with the frames, and the checkpoints
must be complete.
Usage: kill_writer.py RESULT_WRITER"""
import random
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np

PARTICLES, TRIALS = 300, 100


def run_and_kill(writer, directory, delay):
    """Number of frames announced before the kill. The delay counts from the first frame."""
    with subprocess.Popen([writer, directory, "1000000", "float64", "1"], text=True,
                          stdout=subprocess.PIPE) as process:
        first = process.stdout.readline()
        time.sleep(delay)
        process.kill()
        rest = process.stdout.read()
    complete = (first + rest).count("\n")
    return complete


def check(directory, announced):
    with h5py.File(directory / "run.h5") as file:
        frames = len(file["steps"])
        assert frames >= announced, f"{announced} frames announced, {frames} found"
        particle = np.arange(PARTICLES)[:, None]
        for k in range(frames):
            frame = file[f"steps/{k}"]
            expected = k + particle / 512 + np.arange(3)[None, :] / 8
            assert np.array_equal(frame["position"][:], expected), f"frame {k}"
            assert np.array_equal(frame["state/velocity"][:], expected.ravel()), f"state {k}"
            assert frame["stress"].shape == (PARTICLES, 9)
        view = file["VTKHDF"]
        steps = view["Steps"].attrs["NSteps"]
        assert announced <= steps <= frames
        assert len(view["Points"]) == frames * PARTICLES
        assert np.array_equal(view["Steps/PointOffsets"][:steps], PARTICLES * np.arange(steps))
    grids = ElementTree.parse(directory / "run.xdmf").getroot().findall("./Domain/Grid/Grid")
    assert announced <= len(grids) <= frames
    rows = (directory / "history.csv").read_text().count("\n") - 2
    assert rows >= announced
    serials = []
    for name in ("checkpoint-a.h5", "checkpoint-b.h5"):
        if (directory / name).exists():
            with h5py.File(directory / name) as file:
                k = file.attrs["step"] // 10
                assert file["state/velocity"][0] == k
                serials.append((k + 1) // 4)
    assert max(serials, default=0) >= announced // 4
    return frames


def main():
    writer = sys.argv[1]
    random.seed(1)
    total = 0
    for trial in range(TRIALS):
        delay = 0.4 * random.random() ** 3
        with tempfile.TemporaryDirectory() as temporary:
            directory = Path(temporary) / "results"
            announced = run_and_kill(writer, directory, delay)
            try:
                total += check(directory, announced)
            except Exception as failure:
                sys.exit(f"trial {trial}, killed after {delay:.4f} s: {failure}")
    print(f"{TRIALS} kills, {total} frames, none lost")


if __name__ == "__main__":
    main()
