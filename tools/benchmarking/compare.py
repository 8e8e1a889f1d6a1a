# SPDX-License-Identifier: BSD-3-Clause
"""Runs the scenes of benchmarks and makes rows that compare what they obtain with what was published."""

import csv
import hashlib
import json
import os
import pathlib
import resource
import subprocess
import sys

import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "plotting"))
import runlog  # noqa: E402  pylint: disable=wrong-import-position


def rows_of(benchmarks, options):
    """Rows of all cases of the benchmarks; see row()."""
    rows = []
    for entry in benchmarks:
        if "reason" in entry:
            rows.append(row(entry, {"name": ""}, "", verdict="not expressed", remark=entry["reason"]))
            continue
        for case in entry["case"]:
            rows += rows_of_case(entry, case, options)
    return rows


def row(entry, case, result, **values):
    """A row of the table: a result of a case of a benchmark."""
    label = entry.get("results", {}).get(result, result)
    empty = {"obtained": None, "published": None, "within": None, "others": {}, "bar": None, "seconds": None,
             "verdict": "", "remark": ""}  # fmt: skip
    return {"field": entry["field"], "benchmark": entry["name"], "case": case["name"], "result": label, **empty, **values}


def folder_of(entry, case, output):
    part = "".join(c if c.isalnum() or c in ".-" else "_" for c in case["name"])
    return output / entry["name"] / (part or "run")


def text_of(value):
    if isinstance(value, bool):
        return str(value).lower()
    return json.dumps(value) if isinstance(value, list) else str(value)


def settings(case):
    return [part for key, value in case.get("set", {}).items() for part in ("--set", f"{key}={text_of(value)}")]


def digest(entry, case, program):
    """Of all on which a run depends."""
    text = entry["scene"].read_bytes() + json.dumps(case.get("set", {}), sort_keys=True).encode()
    return hashlib.sha256(text + program.read_bytes()).hexdigest()


def call(arguments, threads):
    """Runs the program; its exit code, what it printed last, and the seconds of processors that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    environment = {**os.environ, "OMP_NUM_THREADS": str(threads), "OMP_WAIT_POLICY": "passive"}
    done = subprocess.run([str(a) for a in arguments], text=True, capture_output=True, check=False, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done.returncode, (done.stderr.strip().splitlines() or [""])[-1], seconds


def run(entry, case, options):
    """Runs a case unless it is there already. Returns the folder, and {"code", "said", "seconds"}; None in their place
    with --finished if the case is not there."""
    folder = folder_of(entry, case, options.output)
    summary = folder / "benchmark.json"
    mark = digest(entry, case, options.program)
    if summary.is_file():
        known = json.loads(summary.read_text(encoding="utf-8"))
        if known["digest"] == mark:
            return folder, known
    if options.finished:
        return folder, None
    print(f"{entry['name']} {case['name']}".strip(), flush=True)
    arguments = [options.program, "run", entry["scene"], "--output", folder, "--overwrite", "--quiet", *settings(case)]
    code, said, seconds = call(arguments, options.threads)
    known = {"digest": mark, "code": code, "said": said, "seconds": seconds}
    if folder.is_dir():
        summary.write_text(json.dumps(known), encoding="utf-8")
    return folder, known


def error_bars(entry, case, options):
    """Error bars of the results of a case by name. Without --converge those of a series that is there already."""
    folder = options.output / entry["name"] / (folder_of(entry, case, options.output).name + "-convergence")
    mark = digest(entry, case, options.program) + json.dumps(entry.get("converge", {}), sort_keys=True)
    known = folder / "benchmark.txt"
    there = known.is_file() and known.read_text(encoding="utf-8") == mark
    if options.converge and not there and not entry.get("converge", {}).get("none"):
        print(f"{entry['name']} {case['name']}, error bars".replace(" ,", ","), flush=True)
        ways = [part for key, value in entry.get("converge", {}).items() for part in (f"--{key}", value)]
        arguments = [options.program, "converge", entry["scene"], "--output", folder, *ways, *settings(case)]
        if folder.is_dir():
            arguments.append("--overwrite")
        call(arguments, options.threads)
        there = (folder / "convergence.csv").is_file()
        if there:
            known.write_text(mark, encoding="utf-8")
    if not there:
        return {}
    with (folder / "convergence.csv").open(newline="", encoding="utf-8") as file:
        return {line["result"]: float(line["error bar"]) for line in csv.DictReader(file)
                if line.get("error bar") and line.get("expected")}  # fmt: skip


def history(folder):
    """Columns of the history of a run by name."""
    lines = (folder / "history.csv").read_text(encoding="utf-8").splitlines()
    values = np.loadtxt(lines, delimiter=",", ndmin=2)
    return dict(zip(lines[0].removeprefix("# ").split(","), values.T))


def pulsation(time, values):
    """Angular frequency by the first and the last crossing of the mean, each interpolated. Raises ValueError if there
    are fewer than three crossings."""
    about = values - (values.max() + values.min()) / 2
    k = np.flatnonzero(about[1:] * about[:-1] < 0)
    if len(k) < 3:
        raise ValueError(f"the history crosses its mean {len(k)} times; expected are 3 or more")
    at = time[k] + (time[k + 1] - time[k]) * about[k] / (about[k] - about[k + 1])
    return float(np.pi * (len(at) - 1) / (at[-1] - at[0]))


def distance(columns, curve):
    """The largest distance of a column of the history from a published curve, where both are known."""
    x, y = np.array(curve["points"]).T
    time = columns["time"] * curve.get("time_factor", 1)
    values = columns[curve["of"]] ** curve.get("power", 1) * curve.get("factor", 1)
    inside = (x >= max(time[0], curve.get("from", time[0]))) & (x <= min(time[-1], curve.get("to", time[-1])))
    return float(np.abs(np.interp(x[inside], time, values) - y[inside]).max())


def verdict(obtained, published, within, explained):
    if abs(obtained - published) <= within:
        return "met"
    return "missed, see below" if explained else "MISSED"


def rows_of_case(entry, case, options):
    folder, known = run(entry, case, options)
    if known is None:
        return [row(entry, case, "", verdict="not run")]
    explained, others = case.get("explained", {}), case.get("others", {})
    if known["code"] not in (0, 7):
        remark = explained.get("run", known["said"])
        return [row(entry, case, "", verdict="missed, see below" if "run" in explained else "failed", remark=remark)]
    bars = error_bars(entry, case, options)
    found = []
    for name, obtained, published, within, _ in runlog.Log(folder / "run.log").expected:
        numbers = float(obtained), float(published), float(within)
        found.append((name, *numbers, bars.get(name)))
    if "pulsation" in entry:
        columns, wanted = history(folder), entry["pulsation"]
        obtained = wanted["times"] * pulsation(columns["time"], columns[wanted["of"]])
        found.append(("pulsation", obtained, wanted["value"], wanted["within_relative"] * wanted["value"], None))
    for curve in entry.get("curve", ()):
        if "within" in curve:
            found.append((curve["name"], distance(history(folder), curve), 0.0, curve["within"], None))
    return [row(entry, case, name, obtained=obtained, published=published, within=within, bar=bar, seconds=known["seconds"],
                others=others.get(name, {}), verdict=verdict(obtained, published, within, name in explained),
                remark=explained.get(name, "")) for name, obtained, published, within, bar in found]  # fmt: skip
