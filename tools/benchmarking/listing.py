# SPDX-License-Identifier: BSD-3-Clause
"""Tables of benchmarks: as CSV, in Markdown, and that of inputs/benchmarks/README.md."""

import csv
import pathlib

import entries

BEGIN, END = "<!-- benchmarks: begin -->\n", "<!-- benchmarks: end -->"
HEADING = ("benchmark", "case", "result", "obtained", "published", "within", "off by", "error bar", "others", "s", "")
README = entries.FOLDER / "README.md"


def number(value, digits=5):
    return "" if value is None else f"{value:.{digits}g}"


def off(row):
    """Distance from the published value: relative, or absolute where that is 0."""
    if row["obtained"] is None:
        return ""
    if not row["published"]:
        return f"{row['obtained']:.2g}"
    return f"{100 * (row['obtained'] / row['published'] - 1):+.2g} %"


def cells(row):
    others = ", ".join(f"{name} {number(value)}" for name, value in row["others"].items())
    return (f"`{row['benchmark']}`", row["case"], row["result"], number(row["obtained"], 6), number(row["published"], 6),
            number(row["within"], 2), off(row), number(row["bar"], 2), others, number(row["seconds"], 2), row["verdict"])  # fmt: skip


def line(values):
    return f"| {' | '.join(values)} |\n"


def text(rows):
    """The table in Markdown, one for each field, and what is to be said of rows."""
    parts = []
    for field in dict.fromkeys(row["field"] for row in rows):
        here = [row for row in rows if row["field"] == field]
        compared = [row for row in here if row["verdict"] != "not expressed"]
        parts.append(f"\n**{field[0].upper()}{field[1:]}**\n\n")
        if compared:
            parts.append(line(HEADING) + "|---" * len(HEADING) + "|\n" + "".join(line(cells(row)) for row in compared))
        remarks = dict.fromkeys((row["benchmark"], row["remark"]) for row in here if row["remark"])
        if remarks:
            parts.append("\n" + "".join(f"- `{name}`: {remark}\n" for name, remark in remarks))
    return "".join(parts)


def summary(rows):
    """How many rows and benchmarks there are of each verdict."""
    kinds = ("met", "missed, see below", "MISSED", "failed", "not run", "not expressed")
    counts = {kind: [row for row in rows if row["verdict"] == kind] for kind in kinds}
    told = [f"{len(some)} {kind}" for kind, some in counts.items() if some]
    run = {row["benchmark"] for row in rows if row["verdict"] not in ("not run", "not expressed")}
    return f"\n{len(run)} benchmarks run; results: {', '.join(told)}"


def write(folder: pathlib.Path, rows):
    """Writes table.csv and table.md."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "table.md").write_text(text(rows) + summary(rows) + "\n", encoding="utf-8")
    with (folder / "table.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(("field", *(h or "verdict" for h in HEADING), "remark"))
        for row in rows:
            writer.writerow((row["field"], *(c.strip("`") for c in cells(row)), row["remark"]))


def write_readme(rows):
    """Replaces the table of the README. Raises ValueError if it has no place for it."""
    before, found, rest = README.read_text(encoding="utf-8").partition(BEGIN)
    if not found or END not in rest:
        raise ValueError(f"{README} has no lines {BEGIN.strip()} and {END}")
    README.write_text(before + BEGIN + text(rows) + summary(rows) + "\n" + END + rest.partition(END)[2], encoding="utf-8")
