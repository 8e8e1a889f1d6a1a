#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Renews the table of results in inputs/README.md from finished runs of scenes of inputs/: the
expectations of each scene, and the results of the run, rounded to a hundredth of the tolerance.
"""

import argparse
import math
import pathlib
import re
import sys
import tomllib

import shipped

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path.append(str(ROOT / "tools" / "plotting"))
from runlog import Log  # noqa: E402  pylint: disable=wrong-import-position

BEGIN, END = "<!-- results: begin -->\n", "<!-- results: end -->"
HEAD = "| scene | expectation | expected | within | obtained |\n|---|---|---|---|---|\n"


def rounded(obtained, within):
    """The number as text, rounded to a hundredth of `within`, with at most seven digits."""
    size, finest = abs(float(obtained)), float(within) / 100
    if size == 0 or finest == 0:
        return f"{float(obtained):.7g}"
    digits = math.floor(math.log10(size)) - math.floor(math.log10(finest)) + 1
    return f"{float(obtained):.{min(max(digits, 1), 7)}g}"


def gallery(text):
    """Names of the scenes in the order of the gallery."""
    heads = re.findall(r"^\| (`\w+`(?:, `\w+`)*) \|", text.split(BEGIN)[0], re.MULTILINE)
    return [name for head in heads for name in re.findall(r"\w+", head)]


def rows_of_table(text):
    """Rows of the table [scene, expectation, expected, within, obtained]."""
    block = text.split(BEGIN)[1].split(END)[0]
    return [[cell.strip(" `") for cell in line.strip("|").split("|")] for line in block.splitlines()[2:]]


def asked(scene):
    """The expectations of a scene and of its stages by name: the texts (expected, within) as a run
    prints them; None if they have units."""
    texts = {}
    tables = tomllib.loads(scene.read_text(encoding="utf-8"))
    for name, e in (item for t in (tables, *tables.get("stage", [])) for item in t.get("expect", {}).items()):
        if "within" not in e and "within_relative" not in e:  # it is reported only
            continue
        value, within, relative = e["value"], e.get("within", 0), e.get("within_relative", 0)
        plain = not any(isinstance(x, str) for x in (value, within, relative))
        texts[name] = (f"{value:.7g}", f"{max(within, relative * abs(value)):.3g}") if plain else None
    return texts


def call_of(log):
    return next(iter(log.calls[-1:]), "")


def scene_of(log, folder):
    """File of the scene of a run. Raises ValueError if it is not in inputs/."""
    named = re.search(r"(\w+)\.toml", call_of(log))
    try:
        return shipped.scene(named.group(1) if named else folder.name)
    except ValueError as error:
        raise ValueError(f"{folder} is no run of a scene of inputs/") from error


def rows_of_run(folder):
    """The scene of a run, and rows of the table. Raises ValueError if the run changed the scene."""
    log = Log(folder / "run.log")
    if "--set" in call_of(log):
        raise ValueError(f"{folder} is a run of a scene that was changed by --set")
    scene = scene_of(log, folder)
    if not log.expected:
        raise ValueError(f"{folder} has not been compared with what {scene.name} expects")
    wanted, rows = asked(scene), []
    for name, obtained, expected, within, verdict in log.expected:
        if verdict == "reported":
            continue
        if name not in wanted or wanted[name] not in (None, (expected, within)):
            raise ValueError(f"{folder}: {scene.name} expects something else of '{name}'")
        if verdict != "not reached":
            rows.append([scene.stem, name, expected, within, rounded(obtained, within)])
    return scene.stem, rows


def main():
    parser = argparse.ArgumentParser(prog="results_table.py", description=__doc__)
    parser.add_argument("folders", type=pathlib.Path, nargs="*", metavar="DIR", help="of a finished run")
    parser.add_argument("--write", action="store_true", help="into the file, instead of printing it")
    parser.add_argument("--file", type=pathlib.Path, default=ROOT / "inputs" / "README.md",
                        help="with a gallery and a table; inputs/README.md if not given")  # fmt: skip
    arguments = parser.parse_args()
    text = arguments.file.read_text(encoding="utf-8")
    scenes, rows = gallery(text), rows_of_table(text)
    try:
        for folder in arguments.folders:
            scene, renewed = rows_of_run(folder)
            if scene not in scenes:
                raise ValueError(f"the gallery of {arguments.file} does not have '{scene}'")
            names = [row[1] for row in renewed]
            rows = [row for row in rows if row[0] != scene or row[1] not in names] + renewed
    except (OSError, ValueError) as error:
        sys.exit(f"results_table.py: {error}")
    wanted = {scene: list(asked(shipped.scene(scene))) for scene in scenes}
    rows = [row for row in rows if row[1] in wanted[row[0]]]
    rows.sort(key=lambda row: (scenes.index(row[0]), wanted[row[0]].index(row[1])))
    lines = [f"| `{scene}` | `{name}` | {' | '.join(numbers)} |\n" for scene, name, *numbers in rows]
    table = HEAD + "".join(lines)
    if arguments.write:
        before, after = text.split(BEGIN)[0], text.split(END)[1]
        arguments.file.write_text(before + BEGIN + table + END + after, encoding="utf-8")
    else:
        print(table, end="")


if __name__ == "__main__":
    main()
