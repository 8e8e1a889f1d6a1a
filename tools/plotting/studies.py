# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a convergence study from study.json: error against h with observed orders, and error
against time (work-precision), one line per method.

The name of a method is "panel: line". Without panels there is a picture with a small plot per error;
otherwise pictures per error with a small plot per panel. Panels "group, ..." of one group share a
picture, those that are alone in their group share another."""

import json

import matplotlib.pyplot as plt
import matplotlib.ticker
import numpy as np

import style
from results import reader

COLUMNS = 4
MARKERS = "osD^vPXd"
ROUND_OFF = 1e-13


class Study:
    """A study directory. Raises OSError or ValueError, with the reason, if it cannot be read."""

    def __init__(self, folder):
        path = folder / "study.json"
        content = json.loads(reader.text_of(path))
        self.h_meaning = content["h"]
        self.panels = {}  # panel -> line -> measurements, coarse to fine
        for m in content["measurements"]:
            panel, _, line = m["method"].rpartition(": ")
            self.panels.setdefault(panel, {}).setdefault(line, []).append(m)
        if not self.panels:
            raise ValueError(f"{path} has no measurements")
        self.errors = list(dict.fromkeys(e for m in content["measurements"] for e in m["errors"]))


def draw(study, error=None):
    """Pictures by name. `error` chooses among the errors when there are pictures for each; by
    default the first two are drawn."""
    if error is not None and error not in study.errors:
        raise style.UsageError(f"there is no error '{error}'; there are {', '.join(study.errors)}")
    if len(study.panels) == 1:
        lines = next(iter(study.panels.values()))
        plots = [(name, lines, name) for name in ([error] if error else study.errors)]
        return pair(study, "error", plots, common_scale=False)
    pictures = {}
    for name in [error] if error else study.errors[:2]:
        for group, panels in groups(study.panels).items():
            plots = [(title, short_names(title, study.panels[title]), name) for title in panels]
            file = "_".join(part.replace(" ", "_") for part in (name, group) if part)
            pictures |= pair(study, file, plots, common_scale=True)
    return pictures


def pair(study, name, plots, common_scale):
    return {
        f"{name}_against_h": figure(plots, "h", study.h_meaning, common_scale),
        f"{name}_against_time": figure(plots, "time", "time (s)", common_scale),
    }


def groups(panels):
    """Panels by what stands before their first comma; "" for those that are alone."""
    names = [panel.partition(", ")[0] for panel in panels]
    found = {}
    for panel, name in zip(panels, names):
        found.setdefault(name if names.count(name) > 1 else "", []).append(panel)
    return found


def short_names(panel, lines):
    """Lines without the parts of their names that the title of their panel already says."""
    said = set(panel.split(", "))
    short = {", ".join(p for p in name.split(", ") if p not in said): m for name, m in lines.items()}
    return short if len(short) == len(lines) else lines


def figure(plots, abscissa, label, common_scale):
    plots = [p for p in plots if any(points(m, p[2], abscissa) for m in p[1].values())]
    columns = min(COLUMNS, len(plots))
    rows = -(-len(plots) // columns)
    longest = max(len(lines) for _, lines, _ in plots)
    picture, axes = plt.subplots(
        rows, columns, figsize=(2.75 * columns, (2.35 + 0.13 * longest) * rows), squeeze=False,
        layout="constrained",
    )  # fmt: skip
    picture.get_layout_engine().set(h_pad=0.06, w_pad=0.06)
    for axis in axes.flat[len(plots) :]:
        axis.remove()
    for number, (axis, (title, lines, error)) in enumerate(zip(axes.flat, plots)):
        shown = plots if common_scale else [plots[number]]
        set_scales(axis, shown, abscissa)
        curves(axis, lines, error, abscissa)
        if abscissa == "h":
            slopes(axis, lines, error)
        axis.set_title(style.column_name(title), fontsize=9, loc="left")
        axis.set_xlabel(label, labelpad=1)
        if common_scale and number % columns == 0:
            axis.set_ylabel(f"error, {error}")
        axis.legend(
            loc="upper left", bbox_to_anchor=(-0.02, -0.19), fontsize=7, handlelength=1.8,
            labelspacing=0.2, borderaxespad=0, borderpad=0,
        )  # fmt: skip
    return picture


def set_scales(axis, plots, abscissa):
    """Logarithmic axes around all points of these plots."""
    found = [
        point for _, lines, error in plots for m in lines.values()
        for point in points(m, error, abscissa)
    ]  # fmt: skip
    x, e = np.array(found).T
    axis.set(xscale="log", yscale="log")
    axis.set(xlim=(x.min() / 1.2, x.max() * 1.2), ylim=(e.min() / 1.6, e.max() * 1.6))
    axis.tick_params(labelsize=8)
    axis.grid(True, which="major", color="0.92", lw=0.6)
    axis.set_axisbelow(True)
    if x.max() / x.min() < 30:
        axis.xaxis.set_major_locator(matplotlib.ticker.FixedLocator(ticks(*axis.get_xlim())))
        axis.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
        axis.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda v, _: f"{v:g}"))


def ticks(low, high):
    """At least three round numbers in a short range of a logarithmic axis."""
    exponents = np.arange(np.floor(np.log10(low)), np.ceil(np.log10(high)))
    for factors in ((1, 2, 5), (1, 1.5, 2, 3, 4, 6), np.arange(1, 10, 0.5)):
        found = np.outer(10.0**exponents, factors).ravel()
        found = found[(low <= found) & (found <= high)]
        if len(found) >= 3:
            break
    return found


def points(measurements, error, abscissa):
    """(x, error) of the measurements that have it, above round-off."""
    found = [(m[abscissa], m["errors"].get(error)) for m in measurements]
    return [(x, e) for x, e in found if e is not None and e > ROUND_OFF and x > 0]


def curves(axis, lines, error, abscissa):
    """One curve per method; against h its name is followed by the order."""
    for number, (name, measurements) in enumerate(lines.items()):
        found = points(measurements, error, abscissa)
        if not found:
            continue
        order = overall_order(found) if abscissa == "h" else None
        axis.plot(
            *np.array(found).T, label=name if order is None else f"{name}  ({order:.1f})",
            color=style.COLORS[number % len(style.COLORS)], marker=MARKERS[number % len(MARKERS)],
            ls="-" if number < len(style.COLORS) else (0, (4, 2)), ms=3, lw=1.1,
        )  # fmt: skip


def overall_order(found):
    """log(e1/e2) / log(h1/h2) of the first and the last point."""
    (h1, e1), (h2, e2) = found[0], found[-1]
    return np.log(e1 / e2) / np.log(h1 / h2) if h1 != h2 else None


def slopes(axis, lines, error):
    """Grey lines of slopes 1, 2, 3 from the middle of the errors on the coarsest clouds."""
    found = [one for m in lines.values() if (one := points(m, error, "h"))]
    start = np.exp(np.mean([np.log(one[0][1]) for one in found]))
    ends = np.array([max(one[0][0] for one in found), min(one[-1][0] for one in found)])
    low, _ = axis.get_ylim()
    for slope in (1, 2, 3):
        e = start * (ends / ends[0]) ** slope
        axis.plot(ends, e, color="0.75", lw=0.7, ls=(0, (2, 2)), zorder=0)
        if e[1] > low:
            axis.annotate(
                str(slope), (ends[1], e[1]), color="0.55", fontsize=6.5, ha="right", va="center",
                xytext=(-2, 0), textcoords="offset points",
            )  # fmt: skip
