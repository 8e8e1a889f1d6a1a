#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints a table of what series of `meniscus converge --budget` found: limit and error bar by resolution, the
value of the scene itself with the parts of its error in %, their sum, and how far the value is from what the
scene expects. Results that are expected to be 0, and those without an expected value, are left out."""

import argparse
import csv
import pathlib
import sys

PARTS = ("resolution", "range", "compressibility", "step", "equilibrium")
HEAD = f"| scene | result | limit | error bar | value | expected | {' | '.join(PARTS)} | sum | off by |\n|{'---|' * (len(PARTS) + 8)}\n"


def rows_of(path):
    """The rows of a table by result. Raises OSError or ValueError."""
    with path.open(newline="", encoding="utf-8") as file:
        rows = {row["result"]: row for row in csv.DictReader(file)}
    if not rows:
        raise ValueError(f"{path} is empty")
    return rows


def share(cell):
    """A part of the error in %; None if it is not known."""
    return float(cell.removesuffix("%")) if cell.endswith("%") else None


def lines_of(folder):
    """Lines of the table, and of how many results the error is within the sum of its parts."""
    found, budget = rows_of(folder / "convergence.csv"), rows_of(folder / "budget.csv")
    lines, within = [], 0
    for name, row in budget.items():
        expected = float(found[name]["expected"] or 0)
        cells = {part: row[part] for part in PARTS if part in row}
        parts = [share(cell) for cell in cells.values()]
        if expected == 0 or None in parts:
            continue
        value, total = float(row["value"]), sum(parts)
        off = 100 * abs(value / expected - 1)
        within += off <= total
        numbers = [cells[part].removesuffix(" %") if part in cells else "" for part in PARTS]
        scene = folder.resolve().name.removesuffix("-convergence")
        shown = " | ".join([f"`{scene}`", f"`{name}`", f"{float(found[name]['limit']):.6g}", found[name]["error bar"], f"{value:.6g}", f"{expected:.6g}", *numbers])
        lines.append(f"| {shown} | {total:.2g} | {off:.2g}{'' if off <= total else ' (more)'} |\n")
    return lines, within


def main():
    parser = argparse.ArgumentParser(prog="convergence_table.py", description=__doc__)
    parser.add_argument("folders", type=pathlib.Path, nargs="+", metavar="DIR", help="of a convergence series")
    try:
        tables = [lines_of(folder) for folder in parser.parse_args().folders]
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"convergence_table.py: {error}")
    print(HEAD + "".join(line for lines, _ in tables for line in lines), end="")
    print(f"\n{sum(within for _, within in tables)} of {sum(len(lines) for lines, _ in tables)} within the sum")


if __name__ == "__main__":
    main()
