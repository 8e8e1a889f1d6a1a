# SPDX-License-Identifier: BSD-3-Clause
"""Contacts of a run: gap and force over time, and force against gap or, if the partner is moved,
against its displacement."""

import matplotlib.pyplot as plt
import numpy as np

import style
from histories import time_axis


def draw(run):
    bodies = {body.name for body in run.bodies}
    names = [name.removesuffix(".gap") for name in run.history if name.endswith(".gap")]
    found = {name: picture(run, name) for name in names if name not in bodies}
    return {f"{name}_contact": figure for name, figure in found.items() if figure}


def main_component(run, vector):
    """The component that changes most; None if the history has no component of this vector."""
    columns = [f"{vector}_{i}" for i in "xyz" if f"{vector}_{i}" in run.history]
    return max(columns, key=lambda column: np.ptp(run.history[column]), default=None)


def picture(run, name):
    force = main_component(run, f"{name}.force")
    if force is None:
        return None
    gap_factor, gap_unit = style.scale(run.length_unit, run.history[f"{name}.gap"])
    force_factor, force_unit = style.scale(run.units[force], run.history[force])
    gap, push = run.history[f"{name}.gap"] * gap_factor, run.history[force] * force_factor
    gap_label = style.label("gap", gap_unit)
    force_label = style.label(f"force ${force[-1]}$", force_unit)

    figure = plt.figure(figsize=(7.4, 3.3), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=(1, 1.1))
    top = figure.add_subplot(grid[0, 0])
    bottom = figure.add_subplot(grid[1, 0], sharex=top)
    time, _ = time_axis(run, bottom)
    for axis, values, label in ((top, gap, gap_label), (bottom, push, force_label)):
        axis.plot(time, values, color=style.COLORS[0], lw=0.9)
        axis.set_ylabel(label)
    top.tick_params(labelbottom=False)
    axis = figure.add_subplot(grid[:, 1])
    if displacement := main_component(run, f"{name}.displacement"):
        factor, unit = style.scale(run.length_unit, run.history[displacement])
        moved = run.history[displacement] * factor
        away = np.diff(np.abs(moved - moved[0]), prepend=0) >= 0
        curve(axis, moved, push, away, ("on the way out", "on the way back"))
        axis.set_xlabel(style.label(f"displacement ${displacement[-1]}$", unit))
    else:
        before = np.arange(len(gap)) <= np.argmin(gap)
        curve(axis, gap, push, before, ("approach", "after the least gap"))
        axis.set_xlabel(gap_label)
    axis.set_ylabel(force_label)
    return figure


def curve(axis, x, push, first, labels):
    """Force over x: one colour for steps that end at a record marked in `first`, another for the
    other steps."""
    for number, (shown, label) in enumerate(zip((first, ~first), labels)):
        joined = shown | np.append(shown[1:], False)  # each piece begins where the last one ended
        axis.plot(x, np.where(joined, push, np.nan), color=style.COLORS[number], lw=0.9, label=label)
    axis.axhline(0, color="0.7", lw=0.6, zorder=0)
    axis.legend()
