#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Result files and checkpoints made to do harm: each is refused by a sentence or read as what it
is, without a signal, in little memory and time. Usage: hostile_files.py RESULT_WRITER RESULT_READER
[sanitized | N [SEED]]  (the address sanitizer reserves more address space than any limit allows; N: as
many more files with two or three things done to each, chosen by a seed)"""
import random
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

MEMORY, SECONDS = 1 << 30, 20
STACK = resource.getrlimit(resource.RLIMIT_STACK)


def fnv(data, value=0xCBF29CE484222325):
    for byte in data:
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return value


def state_hash(state):
    """The right hash of a group of numeric arrays."""
    value, arrays = 0xCBF29CE484222325, {}
    state.visititems(lambda name, item: arrays.update({name: item[()]} if isinstance(item, h5py.Dataset) else {}))
    for name, array in sorted(arrays.items()):
        kind = 0 if array.dtype.kind == "f" else 1
        value = fnv(struct.pack("<3Q", len(name), kind, array.nbytes), value)
        value = fnv(array.tobytes(), fnv(name.encode(), value))
    return f"{value:016x}"


def sign(holder):
    """Gives the state of a frame or checkpoint the hash of its present contents."""
    set_text(holder["state"], "hash", state_hash(holder["state"]))


def set_text(group, name, text, size=None):
    group.attrs.create(name, np.bytes_(text), dtype=f"S{size or max(len(text), 1)}")


def replace(group, name, data, **options):
    if name in group:
        del group[name]
    group.create_dataset(name, data=data, **options).attrs["units"] = np.bytes_("1")


def huge(group, name, shape, dtype="f8", **options):
    """An array that claims to be large but contains no bytes."""
    if name in group:
        del group[name]
    group.create_dataset(name, shape, dtype, **options)


def nested(group, depth):
    for _ in range(depth):
        group = group.create_group("g")


def many_names_of_one(group, count):
    for k in range(count):
        group[f"alias{k}"] = group["velocity"]


def tree_of_links(group, levels, width):
    """A few objects that can be reached by width^levels paths."""
    for level in range(levels):
        below = group.file.create_group(f"level{level}")
        for k in range(width):
            group[f"l{k}"] = below
        group = below


def external(group, name, target):
    if name in group:
        del group[name]
    group[name] = h5py.ExternalLink(target, "/steps/0/state/velocity")


def outside_storage(group, name):
    """An array whose bytes are stored in another file."""
    if name in group:
        del group[name]
    group.create_dataset(name, (64,), "f8", external=[("/etc/passwd", 0, 512)])


def virtual(group, name):
    if name in group:
        del group[name]
    layout = h5py.VirtualLayout((10,), "f8")
    layout[:] = h5py.VirtualSource("elsewhere.h5", "x", (10,))
    group.create_virtual_dataset(name, layout)


# Changes of the state in a file, by name.
STATE = {
    "variable text": lambda s: replace(s, "velocity", "text", dtype=h5py.string_dtype()),
    "texts": lambda s: replace(s, "velocity", np.array([b"abc"] * 100000)),
    "text of a gigabyte": lambda s: huge(s, "velocity", (), f"S{1 << 30}"),
    "texts of a gigabyte": lambda s: huge(s, "velocity", (1000,), f"S{1 << 30}"),
    "huge": lambda s: huge(s, "velocity", (1 << 40,)),
    "huge integers": lambda s: huge(s, "step", (1 << 40,), "i8"),
    "huge chunks": lambda s: huge(s, "velocity", (1 << 40,), chunks=(1 << 20,), compression=9),
    "overflow": lambda s: huge(s, "velocity", ((1 << 61) + 1,), chunks=(1024,)),
    "many columns": lambda s: huge(s, "velocity", (2, 1 << 40), chunks=(1, 1024)),
    "many dimensions": lambda s: huge(s, "velocity", (1,) * 32),
    "compressed": lambda s: replace(s, "velocity", np.zeros(10000000), compression=9),
    "single precision": lambda s: replace(s, "velocity", np.zeros(900, "f4")),
    "big endian": lambda s: replace(s, "velocity", np.zeros(900, ">f8")),
    "small integers": lambda s: replace(s, "velocity", np.zeros(900, "i2")),
    "complex": lambda s: replace(s, "velocity", np.zeros(900, "c16")),
    "no array": lambda s: huge(s, "velocity", None, "f8"),
    "references": lambda s: replace(s, "velocity", s.ref, dtype=h5py.ref_dtype),
    "type": lambda s: s.file.__setitem__("steps/0/state/type", np.dtype("f8")),
    "deep": lambda s: nested(s, 20000),
    "five levels": lambda s: nested(s, 5),
    "loop": lambda s: s.__setitem__("loop", s),
    "loop by name": lambda s: s.__setitem__("loop", h5py.SoftLink(s.name)),
    "nowhere": lambda s: s.__setitem__("nowhere", h5py.SoftLink("/nowhere")),
    "other file": lambda s: external(s, "velocity", "other.h5"),
    "other storage": lambda s: outside_storage(s, "velocity"),
    "virtual": lambda s: virtual(s, "velocity"),
    "aliases": lambda s: many_names_of_one(s, 20000),
    "tree": lambda s: tree_of_links(s, 4, 100),
    "hash of texts": lambda s: s.attrs.create("hash", np.array([b"0" * 16] * 4000)),
    "long hash": lambda s: set_text(s, "hash", "0" * 60000),
    "variable hash": lambda s: s.attrs.__setitem__("hash", "abc"),
    "hash of numbers": lambda s: s.attrs.create("hash", np.zeros(8000)),
    "no hash": lambda s: s.attrs.__delitem__("hash"),
    "empty hash": lambda s: s.attrs.create("hash", h5py.Empty("S16")),
    "other hash": lambda s: set_text(s, "hash", "0" * 16),
}
# Changes of the state with a corrected hash: only the numbers are wrong.
SIGNED = {
    "not a number": lambda s: replace(s, "velocity", np.full(900, np.nan)),
    "infinite": lambda s: replace(s, "velocity", np.full(900, np.inf)),
}
HOLDER = {
    "negative step": lambda f: f.attrs.create("step", -1, dtype="i8"),
    "steps": lambda f: f.attrs.create("step", np.arange(8000)),
    "real step": lambda f: f.attrs.create("step", 1.5),
    "text step": lambda f: set_text(f, "step", "one"),
    "short step": lambda f: f.attrs.create("step", 1, dtype="i2"),
    "time not a number": lambda f: f.attrs.create("time", np.nan),
    "infinite time": lambda f: f.attrs.create("time", np.inf),
    "negative time": lambda f: f.attrs.create("time", -1.0),
    "integer time": lambda f: f.attrs.create("time", 1, dtype="i8"),
    "no state": lambda f: f.__delitem__("state"),
    "state is an array": lambda f: (f.__delitem__("state"), f.create_dataset("state", data=[1.0])),
    "state elsewhere": lambda f: (f.__delitem__("state"), external(f, "state", "other.h5")),
}
META = {
    "input of texts": lambda m: replace(m, "input", np.array([b"abc"] * 100000)),
    "variable input": lambda m: replace(m, "input", "text", dtype=h5py.string_dtype()),
    "input of numbers": lambda m: replace(m, "input", np.zeros(10)),
    "input of a gigabyte": lambda m: huge(m, "input", (), f"S{1 << 30}"),
    "other input": lambda m: replace(m, "input", np.bytes_("dimension = 2")),
    "linked input": lambda m: external(m, "input", "other.h5"),
    "no sum": lambda m: m.attrs.__delitem__("input_sha256"),
    "sums": lambda m: m.attrs.create("input_sha256", np.array([b"0" * 64] * 900)),
}
PROGRAM = {  # changes that `meniscus info` also reads
    "versions": lambda m: m.attrs.create("version", np.array([b"abc"] * 9000)),
    "version of a number": lambda m: m.attrs.create("version", 1.0),
    "variable compiler": lambda m: m.attrs.__setitem__("compiler", "g++"),
    "dirty text": lambda m: set_text(m, "git_dirty", "yes"),
}
INFO = {
    "bodies nowhere": lambda f: f["reference"].__setitem__("x", h5py.SoftLink("/nowhere")),
    "no particles": lambda f: f["reference/drop"].attrs.__delitem__("particles"),
    "particles of a text": lambda f: set_text(f["reference/drop"], "particles", "300"),
    "reference is an array": lambda f: replace(f, "reference", np.zeros(3)),
    "no meta": lambda f: f.__delitem__("meta"),
    "units of texts": lambda f: f["steps/0/position"].attrs.create("units", np.array([b"m"] * 9000)),
    "frame is an array": lambda f: replace(f, "steps/0", np.zeros(3)),
    "frames elsewhere": lambda f: (f.__delitem__("steps"), external(f, "steps", "other.h5")),
    "field in a loop": lambda f: f["steps/0"].__setitem__("a", h5py.SoftLink("/steps/0/a")),
}


class Files:
    """Damaged copies of a run, and the answers of the reader."""

    def __init__(self, writer, reader, directory, limited):
        self.reader, self.directory, self.limited = reader, directory, limited
        subprocess.run([writer, directory / "run", "4", "float64", "0"], check=True,
                       stdout=subprocess.DEVNULL)
        self.count = 0

    def harm(self, what, source, change, *refusing, flips=()):
        """Applies `change` to a copy of `source`, which the readers in `refusing` must refuse. `flips`:
        positions in the file, from 0 to 1, at which bytes are changed afterwards."""
        path = self.directory / "harmed.h5"
        shutil.copy(self.directory / "run" / source, path)
        with h5py.File(path, "r+") as file:
            change(file)
        if source.startswith("checkpoint"):
            content = path.read_bytes()
            head = content[:512].split(b"checksum ")[0] + b"checksum %016x\n" % fnv(content[512:])
            path.write_bytes(head.ljust(512, b"\0") + content[512:])
        if flips:
            content = bytearray(path.read_bytes())
            for place in flips:
                content[int(place * len(content))] ^= 1 << int(place * 1e6) % 8
            path.write_bytes(content)
        self.read(what, path, *refusing)

    def read(self, what, path, *refusing):
        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
            resource.setrlimit(resource.RLIMIT_STACK, STACK)
            if self.limited:
                resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        done = subprocess.run([self.reader, path], capture_output=True, text=True, preexec_fn=limit)
        assert done.returncode == 0, f"{what}: exit code {done.returncode}\n{done.stderr[-2000:]}"
        ways = dict(line.split(": ", 1) for line in done.stdout.splitlines())
        for way in refusing:
            assert ways[way].startswith("refused: "), f"{what}: {way} {ways[way]}"
        self.count += 1


def combinations(files, count, seed=3):
    """Several changes to one file. Any answer is right, but there must be one."""
    chosen = random.Random(seed)
    kinds = {"steps/0/state": STATE | SIGNED, "steps/0": HOLDER, "meta": META | PROGRAM, "/": INFO}
    for k in range(count):
        changes = []
        for _ in range(chosen.randint(2, 3)):
            path = chosen.choice(list(kinds))
            changes.append((path, chosen.choice(list(kinds[path]))))
        flips = [chosen.random() for _ in range(chosen.choice((0, 0, 1, 20)))]

        def change(file):
            for path, name in changes:
                try:
                    kinds[path][name](file[path])
                except (KeyError, ValueError, TypeError, RuntimeError, OSError, AttributeError):
                    pass  # an earlier change has removed the target of this one

        files.harm(f"{k}: {changes}", "run.h5", change, flips=flips)


def main():
    writer, reader, *options = sys.argv[1:]
    # HDF5 needs a deep stack to delete nested groups, which it does by recursion.
    resource.setrlimit(resource.RLIMIT_STACK, (STACK[1], STACK[1]))
    sanitized, more = options == ["sanitized"], [int(option) for option in options if option.isdigit()]
    with tempfile.TemporaryDirectory() as name:
        files = Files(writer, reader, Path(name), not sanitized)
        with h5py.File(Path(name) / "run/run.h5") as file:
            assert file["steps/0/state"].attrs["hash"].decode() == state_hash(file["steps/0/state"])
        files.read("a good result file", Path(name) / "run/run.h5", "checkpoint")
        files.read("a good checkpoint", Path(name) / "run/checkpoint-a.h5", "frame")
        shutil.copy(Path(name) / "run/run.h5", Path(name) / "other.h5")
        for what, change in STATE.items():
            files.harm(what, "run.h5", lambda f: change(f["steps/0/state"]), "frame")
        for what, change in SIGNED.items():
            files.harm(what, "run.h5",
                       lambda f: (change(f["steps/0/state"]), sign(f["steps/0"])), "frame")
        for what, change in HOLDER.items():
            files.harm(what, "run.h5", lambda f: change(f["steps/0"]), "frame")
        for what, change in (META | PROGRAM).items():
            files.harm(what, "run.h5", lambda f: change(f["meta"]), "frame")
        for what, change in PROGRAM.items():
            files.harm(what, "run.h5", lambda f: change(f["meta"]), "info", "frame")
        for what, change in INFO.items():
            files.harm(what, "run.h5", change, "info")
        files.harm("signed", "checkpoint-a.h5", lambda f: None, "frame")
        for what in ("huge", "deep", "aliases", "other storage", "variable text"):
            files.harm(what, "checkpoint-a.h5", lambda f: STATE[what](f["state"]), "checkpoint")
        for number, content in enumerate((b"", b"meniscus checkpoint 1\n", b"\x89HDF\r\n\x1a\n" * 99)):
            path = Path(name) / "garbage.h5"
            path.write_bytes(content)
            files.read(f"garbage {number}", path, "info", "checkpoint", "frame")
        if more:
            combinations(files, *more)
        print(f"{files.count} files")


if __name__ == "__main__":
    main()
