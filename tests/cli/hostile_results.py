#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Results that somebody else may have made to do harm, as tools/plot, tools/report and the package for Python
meet them: each is drawn or refused by one sentence with exit code 5. Nothing is run, nothing is written outside of the
folder or through a link, in little memory and time.
Usage: hostile_results.py PROGRAM [N [SEED]]  (a few of the kinds; with N: all of them, and as many more
results with several changes, chosen by a seed)"""
import contextlib
import io
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
import traceback
from pathlib import Path

import h5py
import numpy as np

from hostile_files import external, huge, many_names_of_one, outside_storage, virtual
from program import ENVIRONMENT

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools/plotting"))
import outside  # noqa: E402
import plot  # noqa: E402
import report  # noqa: E402
from results import reader  # noqa: E402

MEMORY, SECONDS = 2 << 30, 40

CHOSEN = ("code in generators", "import in a formula", "256 TiB", "places of another file", "contact outside",
          "commands of terminals", "seven dimensions", "history in a pipe", "run without end", "log of bytes",
          "study nested", "plots is a link", "report is a link", "a picture is a link")

SCENE = """
title = "a drop at a wall"
dimension = {dimension}
[time]
end = 0.02
[output]
frames_every = 0.01
fields = ["velocity", "pressure"]
measures = ["drop.area", "wall.gap"]
[[body]]
name = "drop"
{shape}
material = {{ type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.9 }}
[[surface_tension]]
body = "drop"
gamma = 1
[[contact]]
name = "wall"
bodies = ["drop"]
contact_angle = 80
points = 4
[contact.partner]
type = "half_space"
{place}
[[probe]]
name = "axis"
body = "drop"
points = 5
{line}
[expect]
area = {{ of = "drop.area", at = 0.01, value = 3, within = 20 }}
"""
SCENES = {
    2: SCENE.format(dimension=2, shape="shape = 'disk'\nradius = 1\ncore = 2\nrings = 1",
                    place="point = [0, -1.1]\nnormal = [0, 1]\ndisplacement = [0, '-0.1*t']",
                    line="from = [-0.8, 0]\nto = [0.8, 0]"),
    3: SCENE.format(dimension=3, shape="shape = 'ball'\nradius = 1\ncore = 2\nlayers = 1",
                    place="point = [0, 0, -1.1]\nnormal = [0, 0, 1]\ndisplacement = [0, 0, '-0.1*t']",
                    line="from = [0, 0, -0.8]\nto = [0, 0, 0.8]"),
}


def replace(group, name, data, **options):
    """Replaces an array by another one with the same unit."""
    units = group[name].attrs.get("units", np.bytes_("1")) if name in group else np.bytes_("1")
    if name in group:
        del group[name]
    group.create_dataset(name, data=data, **options).attrs["units"] = units


def rewrite_input(file, change):
    """Applies `change` to the text of the scene in a file."""
    replace(file["meta"], "input", np.bytes_(change(file["meta/input"][()].decode()).encode()))


def in_input(old, new):
    def change(file):
        rewrite_input(file, lambda text: re.sub(old, lambda _: new, text, count=1))
    return change


def code(text):
    """A formula that would leave a mark if it were executed."""
    return in_input(r'"-0\.1\*t"', json.dumps(text))


MARK = "HARMED"
GENERATOR = (f"[b for b in [(g.gi_frame.f_back.f_back.f_builtins for g in [(1,)])]] and "
             f"().__class__.__base__.__subclasses__() and open('{MARK}', 'w')")

# Changes of run.h5, by name.
FILE = {
    "code in a formula": code(f"open('{MARK}', 'w')"),
    "code in generators": code(GENERATOR),
    "import in a formula": code(f"__import__('os').system('touch {MARK}')"),
    "256 TiB": lambda f: huge(f["steps/0"], "position", (1 << 45, 1), chunks=(1 << 16, 1)),
    "256 TiB of cells": lambda f: huge(f["reference/drop"], "cells", (1 << 45, 8), "i4", chunks=(1 << 16, 8)),
    "places of another file": lambda f: external(f["steps/0"], "position", "/etc/passwd"),
    "places of another storage": lambda f: outside_storage(f["steps/0"], "position"),
    "virtual places": lambda f: virtual(f["steps/0"], "position"),
    "body in another file": lambda f: external(f["reference"], "drop", "other.h5"),
    "particles without end": lambda f: f["reference/drop"].attrs.modify("particles", 1 << 60),
    "particles before the first": lambda f: f["reference/drop"].attrs.modify("first_particle", -7),
    "texts for numbers": lambda f: replace(f["steps/0"], "position", np.array([b"abc"] * 30)),
    "places that are not numbers": lambda f: replace(f["steps/1"], "position", f["steps/1/position"][()] * np.nan),
    "places far away": lambda f: replace(f["steps/1"], "position", f["steps/1/position"][()] * [1, 1e300, 1]),
    "a needle": lambda f: [replace(f[f"steps/{k}"], "position", f[f"steps/{k}/position"][()] * [1e-9, 1, 1e-9])
                           for k in range(3)],
    "cells of no particles": lambda f: replace(f["reference/drop"], "cells", f["reference/drop/cells"][()] + 999),
    "facets before the first": lambda f: replace(f["reference/drop"], "surface", -f["reference/drop/surface"][()] - 99),
    "no volume": lambda f: replace(f["reference/drop"], "volume", 0 * f["reference/drop/volume"][()]),
    "no steps": lambda f: f.__delitem__("steps"),
    "steps by name": lambda f: f["steps"].create_group("latest"),
    "a frame in a loop": lambda f: f["steps/0"].__setitem__("velocity2", h5py.SoftLink("/steps/0/velocity2")),
    "no time": lambda f: f["steps/0"].attrs.__delitem__("time"),
    "no unit": lambda f: f["steps/0/position"].attrs.__delitem__("units"),
    "many names": lambda f: many_names_of_one(f["steps/0"], 20000),
    "no input": lambda f: f["meta"].__delitem__("input"),
    "input is no TOML": lambda f: rewrite_input(f, lambda text: text + "\n[[[["),
    "input nested": lambda f: rewrite_input(f, lambda text: text + "\na = " + "[" * 100000),
    "seven dimensions": in_input("dimension = .", "dimension = 7"),
    "no body": in_input(r"\[\[body\]\]", "[[bodies]]"),
    "another body": in_input('name = "drop"', 'name = "pond"'),
    "no shape": in_input("shape =", "shap ="),
    "radius of text": in_input(r"normal = \[.*\]", 'normal = ["x", "y", "z"]'),
    "no normal": in_input(r"normal = \[.*\]", "normal = [0.0, 0.0, 0.0]"),
    "probe outside": in_input('name = "axis"', 'name = "../../../../../../../../etc/passwd"'),
    "contact outside": in_input('name = "wall"', 'name = "../../outside"'),
    "commands of terminals": in_input('name = "axis"', 'name = "\\u009b2J\\u202e"'),
    "formula of TeX": in_input('title = ".*"', r'title = "$\\frac{"'),
    "expectation of text": in_input("value = 3.0", 'value = "three"'),
}


def text_of(name, content):
    """Changes of a text file in the folder, by name."""
    return lambda folder: (folder / name).write_bytes(content)


def in_place_of(name, make):
    def change(folder):
        path = folder / name
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        path.unlink(missing_ok=True)
        make(path)
    return change


def sparse(path):
    with open(path, "wb") as file:
        file.truncate(1 << 42)


# Changes of the folder of results, by name.
FOLDER = {
    "history in a pipe": in_place_of("history.csv", os.mkfifo),
    "history without end": in_place_of("history.csv", lambda path: path.symlink_to("/dev/zero")),
    "history of 4 TB": in_place_of("history.csv", sparse),
    "log in a pipe": in_place_of("run.log", os.mkfifo),
    "log of 4 TB": in_place_of("run.log", sparse),
    "log of bytes": text_of("run.log", bytes(range(256)) * 10),
    "run in a pipe": in_place_of("run.h5", os.mkfifo),
    "run without end": in_place_of("run.h5", lambda path: path.symlink_to("/dev/zero")),
    "run is a folder": in_place_of("run.h5", Path.mkdir),
    "partners in a pipe": in_place_of("partners.h5", os.mkfifo),
    "partners of bytes": text_of("partners.h5", b"\x89HDF\r\n\x1a\n" * 99),
    "ragged history": text_of("history.csv", b"# time,step\n# s,1\n0,1,2\n3\n"),
    "short history": text_of("history.csv", b"# time,kinetic_energy\n# s,J\n0,1\n"),
    "history of bytes": text_of("history.csv", bytes(range(256)) * 99),
    "field of a megabyte": text_of("history.csv", b"# time\n# s\n" + b"1" * 1000000 + b"\n"),
    "study nested": text_of("study.json", b"[" * 100000),
    "study of nothing": text_of("study.json", b"{}"),
    "study of texts": text_of("study.json", b'{"h": 1, "measurements": [{"method": 3, "errors": "abc"}]}'),
    "study without end": in_place_of("study.json", lambda path: path.symlink_to("/dev/zero")),
    "probe in a pipe": in_place_of("probe-axis.csv", os.mkfifo),
    "plots is a link": in_place_of("plots", lambda path: path.symlink_to(path.parents[1] / "precious")),
    "report is a link": in_place_of("report.html", lambda path: path.symlink_to(path.parents[1] / "precious/file")),
    "report is a folder": in_place_of("report.html", lambda path: (path / "x").mkdir(parents=True)),
    "a picture is a link": lambda folder: (
        (folder / "plots").mkdir(), (folder / "plots/energies.png").symlink_to(folder.parent / "precious/file")),
}


def draw(work, arguments):
    """Calls main() of a script in a process of its own, as the script itself does. Returns (exit code or
    -signal, printed text)."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        code = 99
        try:
            os.close(read)
            resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            sys.argv = ["plot", *map(str, arguments)]
            said = io.StringIO()
            with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
                try:
                    outside.call(work, "tools/plot")
                    code = 0
                except SystemExit as end:
                    code = end.code if isinstance(end.code, int) else 98
                except BaseException:
                    traceback.print_exc()
            os.write(write, said.getvalue().encode("utf-8", "surrogatepass")[-60000:])
        finally:
            os._exit(code)
    os.close(write)
    with os.fdopen(read, "rb") as pipe:
        printed = pipe.read().decode(errors="replace")
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return status, printed


class Package:
    """The functions of the package, called as if they were a script."""

    __name__ = "package"

    @staticmethod
    def main():
        results = reader.Results(sys.argv[1])
        frame = results.frame(-1)
        frame.to_meshio()
        frame.plot()
        results.plot("time")
        print(results, frame, results._repr_html_())  # pylint: disable=protected-access


PACKAGE = Package()
# What the package meets in the short form, too.
FOR_PACKAGE = ("256 TiB", "places of another file", "seven dimensions", "history in a pipe")


class Results:
    """Damaged copies of runs, and the answers of the scripts."""

    def __init__(self, program, directory):
        self.directory, self.count, self.drawn, self.slowest = directory, 0, 0, 0.0
        (directory / "precious").mkdir()
        (directory / "precious/file").write_text("precious")
        for dimension, scene in SCENES.items():
            (directory / f"{dimension}.toml").write_text(scene)
            subprocess.run([program, "run", "-q", f"{dimension}.toml", "--output", f"run{dimension}"],
                           cwd=directory, env=ENVIRONMENT, check=True, stdout=subprocess.DEVNULL)

    def harm(self, what, dimension, to_file=None, to_folder=None, flips=(), scripts=(plot, report)):
        folder = self.directory / "harmed"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.directory / f"run{dimension}", folder)
        shutil.copy(folder / "run.h5", folder / "other.h5")
        if to_file:
            with h5py.File(folder / "run.h5", "r+") as file:
                to_file(file)
        for name, place in flips:
            content = bytearray((folder / name).read_bytes())
            content[int(place * len(content))] ^= 1 << int(place * 1e6) % 8
            (folder / name).write_bytes(content)
        if to_folder:
            to_folder(folder)
        for script in scripts:
            self.require_answer(f"{what}, {dimension}D, {script.__name__}", script, folder)

    def require_answer(self, what, script, folder):
        os.chdir(self.directory)
        begin = time.monotonic()
        code, printed = draw(script.main, [folder, "--frames", "2"])
        self.slowest = max(self.slowest, time.monotonic() - begin)
        self.count += 1
        self.drawn += code == 0
        assert code in (0, 5), f"{what}: exit code {code}\n{printed[-2000:]}"
        last = printed.strip().splitlines()[-1:]
        assert code == 0 or last and last[0].startswith("tools/plot: ") and len(last[0]) < 700, f"{what}: {printed}"
        assert printed.isprintable() or all(c.isprintable() or c == "\n" for c in printed), f"{what}: {printed!r}"
        assert (self.directory / "precious/file").read_text() == "precious", what
        assert [path.name for path in (self.directory / "precious").iterdir()] == ["file"], what
        assert not list(self.directory.glob(f"**/{MARK}")), f"{what}: code was run"
        known = {"precious", "harmed", *(f"run{d}" for d in SCENES), *(f"{d}.toml" for d in SCENES)}
        assert {path.name for path in self.directory.iterdir()} == known, what
        assert not list(folder.glob("**/.new-*")), what


def combinations(results, count, seed):
    """Several changes and flipped bytes in one result."""
    chosen = random.Random(seed)
    for k in range(count):
        names = chosen.sample(list(FILE), chosen.choice((0, 1, 1, 2)))
        about_folder = chosen.choice((None, None, None, *FOLDER))
        flipped = chosen.choice(("run.h5", "run.h5", "partners.h5", "history.csv", "run.log"))
        flips = [(flipped, chosen.random()) for _ in range(chosen.choice((0, 1, 5, 50)))]

        def change(file):
            for name in names:
                try:
                    FILE[name](file)
                except (KeyError, ValueError, TypeError, RuntimeError, OSError, AttributeError):
                    pass  # an earlier change has removed the target of this one

        results.harm(f"{k} of seed {seed}: {names}, {about_folder}, {flips}", chosen.choice((2, 3)), change,
                     FOLDER.get(about_folder), flips, [chosen.choice((plot, report, PACKAGE))])


def main():
    program, *more = sys.argv[1:]
    count, seed = [*map(int, more), 0, 4][0], int(more[1]) if len(more) > 1 else 4
    with tempfile.TemporaryDirectory() as name:
        results = Results(Path(program).resolve(), Path(name).resolve())
        for number, (what, change) in enumerate((FILE | FOLDER).items()):
            if not count and what not in CHOSEN:
                continue
            script = report if "report" in what or "log" in what else plot
            how = {"to_file": change} if what in FILE else {"to_folder": change}
            scripts = [script, PACKAGE] if count or what in FOR_PACKAGE else [script]
            results.harm(what, 2 + number % 2, scripts=scripts, **how)
        combinations(results, count, seed)
        os.chdir("/")
        print(f"{results.count} results, {results.drawn} drawn, the slowest in {results.slowest:.1f} s")


if __name__ == "__main__":
    main()
