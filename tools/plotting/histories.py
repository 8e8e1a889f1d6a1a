# SPDX-License-Identifier: BSD-3-Clause
"""Curves over time from history.csv: energies with their audit, and the shape of each body."""

import matplotlib.pyplot as plt
import numpy as np

import style


def draw(run):
    pictures = {"energies": energies(run)}
    for body in run.bodies:
        if figure := shape(run, body):
            pictures[f"{body.name}_shape"] = figure
        if figure := measures(run, body.name):
            pictures[f"{body.name}_measures"] = figure
    for probe in run.input.get("probe", []):
        if figure := measures(run, probe["name"]):
            pictures[f"{probe['name']}_point"] = figure
    return pictures


def time_axis(run, axis):
    """Times in a readable unit; labels the axis."""
    factor, unit = style.scale(run.time_unit, run.history["time"])
    axis.set_xlabel(style.label("time", unit))
    axis.set_xlim(0, run.history["time"][-1] * factor)
    return run.history["time"] * factor, factor


def energies(run):
    """Kinetic energy, changes of the other energies since the start, the sum of all minus external work
    and the changes by remaps, and below these the error of the balance."""
    columns = {"kinetic": run.history["kinetic_energy"]}
    for name, values in run.history.items():
        if name.endswith("_energy") and name != "kinetic_energy":
            columns[f"{name[:-7].replace('_', ' ')}, change"] = values - values[0]
    for name in ("dissipated", "external_work", "remapped"):
        if np.any(run.history.get(name, 0)):
            columns[name.replace("_", " ")] = run.history[name]
    figure, (top, bottom) = plt.subplots(
        2, 1, figsize=(4.6, 4.6), sharex=True, height_ratios=(3, 1.2), layout="constrained"
    )
    time, _ = time_axis(run, bottom)
    factor, unit = style.scale(run.units["kinetic_energy"], np.array(list(columns.values())))
    for name, values in columns.items():
        top.plot(time, values * factor, label=name)
    balance = run.history["energy_balance"]
    sum_all = columns["kinetic"][0] + balance - balance[0]
    top.plot(time, sum_all * factor, color="black", lw=0.9, ls=(0, (4, 3)), label="sum")
    top.set_ylabel(style.label("energy", unit))
    top.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3)
    bottom.plot(time, run.history["energy_balance_error"], color="black")
    bottom.set_ylabel("error of the\nenergy balance")
    bottom.axhline(0, color="0.7", lw=0.6, zorder=0)
    if "remaps" in run.history:
        for when in time[1:][np.diff(run.history["remaps"]) > 0]:
            for axis in (top, bottom):
                axis.axvline(when, color="0.6", lw=0.7, ls=(0, (1, 2)), zorder=0)
            bottom.annotate("remap", (when, 1), xycoords=("data", "axes fraction"), fontsize=7,
                            rotation=90, ha="right", va="top", color="0.4")  # fmt: skip
    return figure


def column(name):
    return style.column_name(name.rsplit(".", 1)[-1])


def panels(run, groups, height=2.3):
    """A panel with curves for each group of columns in the run: figure and axes with
    their names, or None."""
    groups = [[name for name in names if name in run.history] for names in groups]
    groups = [names for names in groups if names]
    if not groups:
        return None
    figure, axes = plt.subplots(
        len(groups), 1, figsize=(4.2, height * len(groups) + 0.3), sharex=True, squeeze=False,
        layout="constrained",
    )  # fmt: skip
    time_axis(run, axes[-1, 0])
    for axis, names in zip(axes[:, 0], groups):
        curves(run, axis, names)
    return figure, list(zip(axes[:, 0], groups))


def shape(run, body):
    """Aspect and extents of a body with the expectations of the scene."""
    extents = [f"{body.name}.extent_{i}" for i in "xyz"[: body.dimension]]
    drawn = panels(run, ([f"{body.name}.aspect"], extents))
    return drawn and drawn[0]


def measures(run, name):
    """A panel for each other measure of the body or probe of that name."""
    elsewhere = {"aspect", "p2", *(f"extent_{i}" for i in "xyz")}
    names = [n for n in run.history if n.startswith(f"{name}.")]
    names = [n for n in names if n.split(".", 1)[1] not in elsewhere]
    drawn = panels(run, [[name] for name in names], 2.0)
    return drawn and drawn[0]


# Curves may coincide (two extents of a round body); line styles keep them all visible.
LINES = ["-", (0, (5, 3)), (0, (1.5, 2.5))]


def curves(run, axis, names):
    """Columns of one unit in one panel; expectations as points with their tolerances."""
    times, time_factor = run.history["time"], style.scale(run.time_unit, run.history["time"])[0]
    factor, unit = style.scale(run.units[names[0]], np.array([run.history[n] for n in names]))
    expected = [point for name in names for point in run.expectations(name)]
    for name, line in zip(names, LINES):
        axis.plot(times * time_factor, run.history[name] * factor, ls=line, label=column(name))
    if expected:
        time, value, tolerance = np.array(expected).T
        axis.errorbar(
            time * time_factor, value * factor, tolerance * factor, fmt="o", ms=4.5, mfc="white",
            color="black", capsize=2.5, lw=0.9, label="expected", clip_on=False, zorder=3,
        )  # fmt: skip
    text = column(names[0] if len(names) == 1 else names[0].rpartition("_")[0] or names[0])
    axis.set_ylabel(style.label(text, unit))
    if len(names) > 1 or expected:
        axis.legend()
