# SPDX-License-Identifier: BSD-3-Clause
"""Pictures and tables of several runs of a scene: of `meniscus converge` the error against spacing and time,
of `meniscus sweep` the results against each key."""

import csv
import io
import re

import matplotlib.pyplot as plt
import numpy as np

import studies
import style
from results import reader

REFINE = "refine "
MOST_PANELS, MOST_LINES = 12, 6


def is_series(folder):
    return any((folder / name).exists() for name in ("convergence.csv", "sweep.csv"))


def table_in(path):
    """The lines of a CSV file, of which all are as long as the first. Raises OSError or ValueError."""
    lines = list(csv.reader(io.StringIO(reader.text_of(path))))
    if len(lines) < 2 or any(len(line) != len(lines[0]) for line in lines):
        raise ValueError(f"{path} is no table with a heading and rows of its length")
    return lines


def number(text):
    """The number with which a text begins, such as 72 of "72 mN/m"; NaN if it begins with none."""
    match = re.match(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", text)
    return float(match.group()) if match else np.nan


class Convergence:
    """The table that `meniscus converge` has written, in the form in which studies.py draws one."""

    def __init__(self, folder):
        heading, *rows = table_in(folder / "convergence.csv")
        levels = [k for k, name in enumerate(heading) if name.startswith(REFINE)]
        column = {name: k for k, name in enumerate(heading)}
        if not levels or not {"limit", "expected"} <= set(column) or rows[-1][0] != "seconds":
            raise ValueError(f"{folder / 'convergence.csv'} is no table of meniscus converge")
        self.h_meaning = "size of cells relative to those of the scene"
        h = [1 / number(heading[k].removeprefix(REFINE)) for k in levels]
        times = [number(rows[-1][k]) for k in levels]
        self.relative, self.absolute = {}, {}  # results -> measurements
        for row in rows[:-1]:
            limit, zero = number(row[column["limit"]]), number(row[column["expected"]]) == 0
            errors = [abs(number(row[k]) - limit) / (1 if zero or limit == 0 else abs(limit)) for k in levels]
            if np.isfinite(errors).all():
                (self.absolute if zero else self.relative)[row[0]] = [
                    {"h": x, "time": t, "errors": {"error": e}} for x, t, e in zip(h, times, errors)
                ]

    def draw(self):
        titles = ("error relative to the limit", self.relative), ("error of what is expected to be 0", self.absolute)
        plots = [(title, lines, "error") for title, lines in titles
                 if any(studies.points(m, "error", "h") for m in lines.values())]  # fmt: skip
        return studies.pair(self, "error", plots, common_scale=False) if plots else {}


class Sweep:
    """The table that `meniscus sweep` has written."""

    def __init__(self, folder):
        path = folder / "sweep.csv"
        heading, units, *rows = table_in(path)
        if "exit_code" not in heading or not rows:
            raise ValueError(f"{path} is no table of meniscus sweep with a run")
        end = heading.index("exit_code")
        self.keys = heading[:end]
        self.values = [row[:end] for row in rows]
        self.units = dict(zip(heading, units))
        numbers = np.array([[number(cell) for cell in row[end + 1 :]] for row in rows])
        self.columns = {name: y for name, y in zip(heading[end + 1 :], numbers.T) if np.isfinite(y).any()}

    def results(self):
        """Expectations, or where the scene has none the measures."""
        names = [n for n in self.columns if n.startswith("expect.")] or [n for n in self.columns if "." in n]
        return (names or [n for n in self.columns if n not in ("time", "step", "seconds")])[:MOST_PANELS]

    def draw(self):
        """A picture for each key with different numbers."""
        pictures = {}
        for place, key in enumerate(self.keys):
            x = np.array([number(values[place]) for values in self.values])
            if len(set(x[np.isfinite(x)])) > 1 and self.results():
                pictures[f"against_{key.rpartition('.')[2]}"] = self.figure(place, x)
        return pictures

    def figure(self, place, x):
        """All results against the key: a line for each combination of the other keys, or points if there
        are many."""
        names = self.results()
        others = [tuple(v for k, v in enumerate(values) if k != place) for values in self.values]
        lines = list(dict.fromkeys(others))
        columns = min(3, len(names))
        picture, axes = plt.subplots(
            -(-len(names) // columns), columns, figsize=(3.1 * columns, 2.4 * -(-len(names) // columns)),
            squeeze=False, layout="constrained",
        )  # fmt: skip
        for axis in axes.flat[len(names) :]:
            axis.remove()
        for axis, name in zip(axes.flat, names):
            y = self.columns[name]
            if len(lines) > MOST_LINES:
                axis.plot(x, y, "o", ms=3)
            for line in lines if len(lines) <= MOST_LINES else ():
                here = [k for k, other in enumerate(others) if other == line]
                here.sort(key=lambda k: x[k])
                axis.plot(x[here], y[here], "o-", ms=3, label=", ".join(line))
            axis.set_title(name.removeprefix("expect."), fontsize=9, loc="left")
            axis.set_xlabel(self.label_of(place))
            axis.set_ylabel(style.pretty(self.units[name]) if self.units[name] not in ("", "1") else "")
        if 1 < len(lines) <= MOST_LINES:
            axes.flat[0].legend(title=", ".join(k for i, k in enumerate(self.keys) if i != place), fontsize=7, title_fontsize=7)
        return picture

    def label_of(self, place):
        """The key with the unit of its values, if they have one."""
        units = {re.sub(r"^[-+.\deE]*\s*", "", values[place]).strip(" '\"") for values in self.values}
        return style.label(self.keys[place], style.pretty(units.pop()) if len(units) == 1 else "")


def draw(folder):
    """Pictures by name. Raises OSError or ValueError if the tables cannot be read."""
    return (Convergence(folder) if (folder / "convergence.csv").exists() else Sweep(folder)).draw()


def tables(folder):
    """(title, lines) of the tables for people."""
    if not (folder / "convergence.csv").exists():
        return [("Runs", table_in(folder / "sweep.csv"))]
    found = [("Convergence", table_in(folder / "convergence.csv"))]
    if (folder / "budget.csv").exists():
        found.append(("Errors of the scene itself", table_in(folder / "budget.csv")))
    return found
