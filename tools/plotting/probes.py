# SPDX-License-Identifier: BSD-3-Clause
"""Fields along the line of a [[probe]], from the first frame to the last."""

import matplotlib.pyplot as plt
import numpy as np

import style

BEGIN, END = 0.05, 0.85  # used part of the colour map: the lightest yellow is hard to see


def draw(run, count):
    lines = [probe["name"] for probe in run.input.get("probe", []) if probe.get("from")]
    return {f"{name}_line": picture(run, name, count) for name in lines}


def picture(run, name, count):
    """A panel for each column over the distance along the line, a curve for each of `count` frames."""
    columns, units = run.line(name)
    shown = [n for n in columns if n not in ("time", "step", "distance") and not n.startswith("position")]
    times = np.unique(columns["time"])
    frames = [k for k in run.spread_frames(count) if k < len(times)]
    factor, unit = style.scale(units["distance"], columns["distance"])
    time_factor, time_unit = style.scale(run.time_unit, run.times)
    figure, axes = plt.subplots(
        len(shown), 1, figsize=(4.6, 2.0 * len(shown) + 0.6), sharex=True, squeeze=False, layout="constrained"
    )
    colors = plt.get_cmap("viridis")(np.linspace(END, BEGIN, len(frames)))
    for axis, column in zip(axes[:, 0], shown):
        value_factor, value_unit = style.scale(units[column], columns[column])
        for frame, color in zip(frames, colors):
            now = columns["time"] == times[frame]
            axis.plot(columns["distance"][now] * factor, columns[column][now] * value_factor, color=color,
                      label=style.time_text(times[frame], time_unit, time_factor))  # fmt: skip
        axis.set_ylabel(style.label(style.column_name(column), value_unit))
    axes[-1, 0].set_xlabel(style.label(f"distance along {name}", unit))
    axes[0, 0].legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=3)
    return figure
