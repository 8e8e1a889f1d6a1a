#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Names, titles and formulas made to do harm: each scene is refused by a short sentence or runs; nothing
commands the terminal, nothing is written outside of the results, no table gains or loses a column, no file
holds a number that is not finite. Usage: hostile_texts.py PROGRAM [N [SEED]]  (N texts, 60 by default)"""
import csv
import random
import re
import resource
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from program import ENVIRONMENT

COUNT, SEED, MEMORY, SECONDS, LENGTH = 60, 1, 2 << 30, 10, 5000
PIECES = ("../", "/etc/passwd", "\n", "\r", "\t", "\x1b[2J", "\x9b31m", "\u202e", "\u2066", "\ufeff", "\0", "=1+1",
          "@SUM(A1)", "-2", "+cmd|' /C calc'!A0", ",", ";", '"', "'", "`id`", "$(id)", "{}", "{0}", "%s%n", "<b>",
          "<script>alert(1)</script>", "]]>", "&amp;", "#", "[[body]]", "nan", "inf", "true", "drop", "wall.gap",
          "\U0001f4a7", "é", "e\u0301", "a" * 300, ".", "..", "CON", "~", "*", "?", "|", ":", "\\", "\u2028", "\x7f")
ATOMS = ("x", "y", "t", "0", "1", "2", "1e308", "1e-308", "0.1", "pi", "e", "x_", "z", "nan", "inf", "0x10", "1,5", "é",
         "_pi", "r1", "''", "x=1", "a", "99999999999999999999")
CALLS = ("sin", "sqrt", "log", "exp", "tan", "abs", "min", "max", "f", "if", "rint", "sum", "acos", "system", "g")
SIGNS = ("+", "-", "*", "/", "^", "==", "<", "&&", "||", "?", ":", ",", "**", "=", ";", "%")
SCENE = """
title = {title}
dimension = 2
time = {{ end = 0.004, step = 0.001 }}
output = {{ frames_every = 0.002, history_every = 0.001, fields = ["J"], measures = [{measure}] }}
[constants]
{constant} = 1
[functions]
"f(a)" = {function}
[[body]]
name = {body}
shape = "disk"
radius = 1
core = 3
rings = 2
initial_velocity = [{velocity}, 0]
material = {{ type = "neo_hookean", density = 1, mu = {modulus}, lambda = 1 }}
[[body_force]]
body = {body}
acceleration = [0, {force}]
[[contact]]
name = {contact}
bodies = [{body}]
adhesion = 0.01
[contact.partner]
type = "half_space"
point = [0, -1.2]
normal = [0, 1]
displacement = [0, {motion}]
[expect]
{expect} = {{ of = "kinetic_energy", value = 0, within = 1e9 }}
"""
PLAIN = dict(title='"a"', measure="", constant="c", function='"a"', body='"drop"', velocity="0", modulus="1",
             force="0", contact='"wall"', motion="0", expect="e")
FORMULAS = ("function", "velocity", "modulus", "force", "motion")


def quoted(text):
    """The text as a string of TOML."""
    escaped = "".join(f"\\u{ord(c):04x}" if ord(c) < 32 or c in '"\\\x7f' else c for c in text)
    return f'"{escaped}"'


def name_of(chosen):
    return "".join(chosen.choice(PIECES) for _ in range(chosen.choice((1, 1, 2, 3))))


def formula(chosen, depth=0):
    way = chosen.random()
    if depth > 4 or way < 0.3:
        return chosen.choice(ATOMS)
    if way < 0.6:
        return f"{formula(chosen, depth + 1)}{chosen.choice(SIGNS)}{formula(chosen, depth + 1)}"
    if way < 0.9:
        return f"{chosen.choice(CALLS)}({formula(chosen, depth + 1)})"
    if way < 0.93:
        return chosen.choice(("(", "-", "sin(")) * chosen.choice((3, 300, 30000)) + "x"
    if way < 0.96:
        return "+".join(["x"] * chosen.choice((10, 3000, 100000)))
    return f"({formula(chosen, depth + 1)}" + chosen.choice((")", "", "))"))


def texts(chosen):
    """The changed entries of a scene: one or two."""
    entries = {}
    for key in chosen.sample(list(PLAIN), chosen.choice((1, 1, 2))):
        if key in FORMULAS:
            entries[key] = quoted(formula(chosen))
        else:
            entries[key] = quoted(name := name_of(chosen))
            if key in ("body", "contact") and chosen.random() < 0.5:
                entries["measure"] = quoted(name + (".volume" if key == "body" else ".gap"))
    return entries


def terminal_commands(text):
    """The first character that commands a terminal or turns the direction of writing, if any."""
    return re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069\ufeff]", text)


def written(directory, number, entries):
    """What is wrong with the files of a run that ended, or None."""
    outside = [p for p in directory.parent.rglob("*") if p.is_file() and directory not in p.parents and
               not re.fullmatch(r"\d+", p.relative_to(directory.parent).parts[0])]
    if outside:
        return f"written outside: {outside}"
    text = (directory / "results/scene/history.csv").read_text(errors="strict")
    rows = list(csv.reader(text.split("\n")[:-1]))
    if len({len(row) for row in rows}) != 1:
        return f"rows of {sorted({len(row) for row in rows})} columns"
    for row in rows[2:]:
        for value in row:
            if not re.fullmatch(r"[-+]?\d[\d.]*(e[-+]?\d+)?", value):
                return f"history.csv has {value!r}"
    return None


def verdict(program, root, number, entries):
    """"refused", "run", "failed", or a description of what is wrong."""
    directory = root / str(number)
    directory.mkdir()
    text = SCENE.format(**PLAIN | entries)
    (directory / "scene.toml").write_text(text, newline="")

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    for command in (["check"], ["run"]):
        done = subprocess.run([program, *command, "scene.toml", "--threads", "1"], cwd=directory, text=True,
                              errors="surrogateescape", capture_output=True, env=ENVIRONMENT, timeout=20 * SECONDS,
                              preexec_fn=limit)
        printed = done.stdout + done.stderr
        if done.returncode not in (0, 3, 4):
            return f"{command[0]}: exit code {done.returncode}: {done.stderr[-300:]}"
        found = terminal_commands(printed)
        if found:
            return f"{command[0]}: prints {found.group()!r}"
        if len(done.stderr) > LENGTH:
            return f"{command[0]}: {len(done.stderr)} characters of messages: {done.stderr[:200]}"
        if done.returncode == 3:
            return ("refused" if "scene.toml" in done.stderr else f"no place: {done.stderr[:300]}")
    wrong = written(directory, number, entries)
    return wrong or ("run" if done.returncode == 0 else "failed")


def main():
    program = Path(sys.argv[1]).resolve()
    count, seed = (int(a) for a in sys.argv[2:] + [COUNT, SEED][len(sys.argv) - 2:])
    chosen = random.Random(seed)
    jobs = [{}] + [texts(chosen) for _ in range(count)]
    with tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(2) as pool:
        verdicts = list(pool.map(lambda job: verdict(program, Path(name), *job), enumerate(jobs)))
    plain = verdicts.pop(0)
    assert plain == "run", f"the plain scene: {plain}"
    wrong = [f"{ {k: v[:200] for k, v in job.items()} }: {found}" for job, found in zip(jobs[1:], verdicts)
             if found not in ("refused", "run", "failed")]
    print("\n".join(wrong))
    print(f"{count} texts, {verdicts.count('run')} run, {verdicts.count('failed')} failed, {len(wrong)} wrong")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
