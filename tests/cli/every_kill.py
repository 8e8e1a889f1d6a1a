#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Opens run.h5 as a kill leaves it: after each single write of its writer, and within each write at
the ends of pages, where the system stops a killed process. Each time the file must open
with all frames written before, each once; also while a continued run drops frames.
Usage: every_kill.py WRITE_RECORDER FRAMES"""
import io
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py

PARTICLES, PAGE = 300, 4096


def events(record):
    """(verb, inode, number, bytes or name) of each change, see record_writes.cpp."""
    data, at = record.read_bytes(), 0
    while at < len(data):
        end = data.index(b"\n", at)
        verb, inode, *rest = data[at:end].split(b" ", 3)
        at = end + 1
        if verb == b"write":
            size = int(rest[1])
            yield "write", int(inode), int(rest[0]), data[at:at + size]
            at += size + 1
        elif verb == b"truncate":
            yield "truncate", int(inode), int(rest[0]), b""
        else:
            yield "rename", int(inode), 0, b" ".join(rest)


class Image:
    """The file run.h5 on the disk, from the moment at which it has this name."""

    def __init__(self):
        self.content = bytearray()
        self.named = False
        self.kept = self.frames = self.states = 0

    def apply(self, verb, number, data):
        if verb == "rename":
            self.named = True
            return self.check("rename")
        if verb == "truncate":
            self.content = self.content[:number].ljust(number, b"\0")
            return self.check(f"truncation to {number}")
        end, at = number + len(data), 0
        if end > len(self.content):
            self.content = self.content.ljust(end, b"\0")
        while at < len(data):
            until = min(len(data), ((number + at) // PAGE + 1) * PAGE - number)
            self.content[number + at:number + until] = data[at:until]
            at = until
            self.check(f"{at} of {len(data)} bytes at {number} ({data[:5]!r})")
        return None

    def check(self, what):
        if not self.named:
            return
        self.states += 1
        try:
            self.check_frames()
        except Exception as failure:
            sys.exit(f"after {what}, with {self.frames} frames before it: {failure!r}")

    def check_frames(self):
        with h5py.File(io.BytesIO(self.content)) as file:
            steps, names = file["steps"], sorted(map(int, file["steps"]))
            assert names == list(range(len(names))), names
            assert len(steps) == len(names) >= self.kept
            for k in {*names[-3:], *names[:1]}:
                assert steps[f"{k}"].attrs["step"] == 10 * k
                assert steps[f"{k}/position"][0, 0] == k
                assert steps[f"{k}/state/velocity"].shape == (3 * PARTICLES,)
            if "VTKHDF" in file:
                announced = file["VTKHDF/Steps"].attrs["NSteps"]
                assert announced <= len(names)
                assert len(file["VTKHDF/Points"]) >= announced * PARTICLES
        self.frames = len(names)


def recorded(recorder, directory, *arguments):
    record = directory / "record"
    subprocess.run([recorder, directory / "results", *arguments], check=True,
                   stdout=subprocess.DEVNULL, env={**os.environ, "RECORD_WRITES": str(record)})
    inode = (directory / "results/run.h5").stat().st_ino
    return [(verb, *rest) for verb, i, *rest in events(record) if i == inode]


def main():
    recorder, frames = sys.argv[1], int(sys.argv[2])
    with tempfile.TemporaryDirectory() as temporary:
        directory = Path(temporary)
        image = Image()
        for change in recorded(recorder, directory, f"{frames}", "float64", "1"):
            image.apply(*change)
            image.kept = max(image.kept, image.frames)  # no frame is lost
        assert image.frames == frames
        last = frames * 2 // 3
        changes = recorded(recorder, directory, f"{frames + 5}", "float64", "1", f"{last}")
        image.kept = last + 1
        for change in changes:
            image.apply(*change)
            if image.frames > frames:
                image.kept = image.frames
        assert image.frames == frames + 5
    print(f"{image.states} states of the file, each with all its frames")


if __name__ == "__main__":
    main()
