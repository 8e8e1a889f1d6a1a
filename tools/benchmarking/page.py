# SPDX-License-Identifier: BSD-3-Clause
"""One page about benchmarks: tables, results of Meniscus and of other codes beside the published values, published
curves, and pictures of the bodies."""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "plotting"))
import compare  # noqa: E402  pylint: disable=wrong-import-position
import report  # noqa: E402  pylint: disable=wrong-import-position
import sections  # noqa: E402  pylint: disable=wrong-import-position
import listing  # noqa: E402  pylint: disable=wrong-import-position
from results import Results  # noqa: E402  pylint: disable=wrong-import-position

MARKS = "sD^vP*"


def deviations(rows):
    """Figure of how far results are from published values, relative; grey bars are the tolerances. None without such rows."""
    rows = [row for row in rows if row["obtained"] is not None and row["published"]]
    if not rows:
        return None
    figure, axes = plt.subplots(figsize=(6.4, 0.7 + 0.22 * len(rows)))
    codes = list(dict.fromkeys(code for row in rows for code in row["others"]))
    for k, row in enumerate(rows):
        share = 100 / abs(row["published"])
        axes.barh(k, 2 * row["within"] * share, left=-row["within"] * share, color="0.92", height=0.9)
        bar = row["bar"] * share if row["bar"] is not None else None
        axes.errorbar((row["obtained"] - row["published"]) * share, k, xerr=bar, fmt="o", color="C0", capsize=2, ms=4)
        for code, value in row["others"].items():
            m = codes.index(code)
            axes.plot((value - row["published"]) * share, k, MARKS[m % len(MARKS)], color=f"C{m + 1}", mfc="none", ms=5)
    axes.errorbar([], [], xerr=[], fmt="o", color="C0", capsize=2, ms=4, label="Meniscus")
    for m, code in enumerate(codes):
        axes.plot([], [], MARKS[m % len(MARKS)], color=f"C{m + 1}", mfc="none", label=code)
    axes.axvline(0, color="0.5", lw=0.8)
    names = [f"{row['case']}: {row['result']}" if row["case"] else row["result"] for row in rows]
    axes.set_yticks(range(len(rows)), names, fontsize=7)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    widest = max(100 * row["within"] / abs(row["published"]) for row in rows)
    axes.set_xscale("symlog", linthresh=max(widest, 1e-3))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.set_xlabel("distance from the published value, %")
    axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1, 1))
    return figure


def curves(entry, options_output):
    """Figure of the published curves beside the history of the first case; None without curves."""
    wanted = entry.get("curve", ())
    folder = compare.folder_of(entry, entry["case"][0], options_output)
    if not wanted or not (folder / "history.csv").is_file():
        return None
    columns = compare.history(folder)
    figure, axes = plt.subplots(figsize=(5, 3.2))
    first = wanted[0]
    values = columns[first["of"]] ** first.get("power", 1) * first.get("factor", 1)
    axes.plot(columns["time"] * first.get("time_factor", 1), values, "C0", label="Meniscus")
    for m, curve in enumerate(wanted):
        axes.plot(*zip(*curve["points"]), MARKS[m % len(MARKS)], color=f"C{m + 1}", mfc="none", ms=3.5, label=curve["name"])
    axes.legend()
    return figure


def pictures(entry, rows, output):
    found = {"against published values": deviations(rows), "over time": curves(entry, output)}
    folder = compare.folder_of(entry, entry["case"][0], output)
    if (folder / "run.h5").is_file():
        run = Results(folder)
        found |= {f"first case, {name}": figure for name, figure in list(sections.draw(run, None, 2).items())[:1]}
    return {name: figure for name, figure in found.items() if figure is not None}


def part(entry, rows, output):
    """The part of the page about a benchmark."""
    about = [f"<h3>{report.escaped(entry['title'])}</h3>", f"<p>{report.escaped(entry['source'])}. {report.escaped(entry.get('note', ''))}</p>"]
    if "reason" in entry:
        return [*about, f'<p class="warning">{report.escaped(entry["reason"])}</p>']
    shown = [listing.cells(row)[1:] for row in rows]
    remarks = dict.fromkeys(row["remark"] for row in rows if row["remark"])
    figures = pictures(entry, rows, output)
    parts = [*about, report.table(shown, listing.HEADING[1:], numbers=range(2, 7)), report.items(remarks), report.figures(figures)]
    plt.close("all")
    return [*parts, f"<details><summary>scene</summary><pre>{report.escaped(entry['scene'].read_text(encoding='utf-8'))}</pre></details>"]


def write(output, benchmarks, rows):
    """Writes index.html."""
    parts = ["<h1>Benchmarks of others</h1>", f"<p>{report.escaped(listing.summary(rows).strip())}. Results of scenes that run as published.</p>"]
    for field in dict.fromkeys(entry["field"] for entry in benchmarks):
        parts.append(f"<h2>{report.escaped(field)}</h2>")
        for entry in (e for e in benchmarks if e["field"] == field):
            parts += part(entry, [row for row in rows if row["benchmark"] == entry["name"]], output)
    (output / "index.html").write_text(report.document("Benchmarks of others", parts), encoding="utf-8")
