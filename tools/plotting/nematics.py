# SPDX-License-Identifier: BSD-3-Clause
"""Force dipole m = h x s and tilt of the directors inside nematic drops, in sections through time:
the size of m, its component out of the picture (the only one in an axisymmetric flow), and P2 of
the angle between the director and the initial director."""

import matplotlib.pyplot as plt
import numpy as np

import partners
import sections
import style
from histories import time_axis

DECADES = 3  # decades of the size of the dipole that are shown


def draw(run, count):
    """A picture of each nematic body of a run that has the field director_couple."""
    if "director_couple" not in run.fields:
        return {}
    frames = run.spread_frames(count)
    plane = sections.Plane(run)
    return {
        f"{body.name}_director": picture(run, body.name, plane, frames)
        for body in run.bodies
        if body.settings["material"]["type"] == "nematic"
    }


class Row:
    """One quantity in all frames: values [frame][particle of the cut], and their colours."""

    def __init__(self, values, norm, colors, text):
        self.values, self.norm, self.colors, self.text = values, norm, colors, text


def out_of_picture(plane):
    """Unit vector towards the eye."""
    first, second = np.eye(3)[plane.axes]
    return np.cross(first, second)


def rows(run, bodies, cuts, plane, frames):
    couples = [
        run.field(frame, "director_couple", body)[cut.near]
        for frame, body, cut in zip(frames, bodies, cuts)
    ]
    sizes = [np.linalg.norm(m, axis=1) for m in couples]
    everything = np.concatenate(sizes)
    factor, unit = style.scale(run.unit_of("director_couple"), everything)
    top = np.percentile(everything, 99.5) * factor
    found = []
    if top > 0:
        signed = [m @ out_of_picture(plane) * factor for m in couples]
        least = top / 10**DECADES
        shown = [np.maximum(size * factor, least) for size in sizes]
        found += [
            Row(shown, plt.matplotlib.colors.LogNorm(least, top), "viridis", style.label("|m|\n", unit)),
            Row(signed, plt.Normalize(-top, top), "RdBu_r", style.label("m out of the\npicture", unit)),
        ]
    if "director_tilt" in run.fields:
        tilts = [
            run.field(frame, "director_tilt", body)[cut.near]
            for frame, body, cut in zip(frames, bodies, cuts)
        ]
        least = -1 if run.dimension == 2 else -0.5
        found.append(Row(tilts, plt.Normalize(least, 1), "cividis", "$P_2$ of the tilt"))
    return found


def picture(run, name, plane, frames):
    bodies = [run.body(name, frame) for frame in frames]
    cuts = [
        sections.Cut(run, body, plane, frame, "director_couple") for frame, body in zip(frames, bodies)
    ]
    drawn = rows(run, bodies, cuts, plane, frames)
    over_time = f"{name}.director_couple" in run.history
    points = np.concatenate([np.vstack([cut.x, cut.outline.reshape(-1, 2)]) for cut in cuts])
    margin = 0.04 * np.ptp(points, axis=0).max()
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    factor, unit = style.scale(run.length_unit, points)
    time_factor, time_unit = style.scale(run.time_unit, run.times)

    panel = 1.75
    height = max(panel * (high - low)[1] / (high - low)[0], 0.8) + 0.1
    figure = plt.figure(
        figsize=(panel * len(frames) + 1.2, height * len(drawn) + (1.9 if over_time else 0.6)),
        layout="constrained",
    )
    grid = figure.add_gridspec(
        len(drawn) + over_time, len(frames), height_ratios=[height] * len(drawn) + [1.4] * over_time
    )
    for number, row in enumerate(drawn):
        axes = [figure.add_subplot(grid[number, k]) for k in range(len(frames))]
        for axis, frame, cut, values in zip(axes, frames, cuts, row.values):
            dots = sections.show(axis, cut, values, factor, row.norm, row.colors)
            partners.draw(axis, run, factor, frame, plane.axes)
            axis.set_xlim(low[0] * factor, high[0] * factor)
            axis.set_ylim(low[1] * factor, high[1] * factor)
            axis.set_aspect("equal")
            last = number == len(drawn) - 1
            axis.tick_params(labelbottom=last, labelleft=axis is axes[0])
            if number == 0:
                axis.set_title(style.time_text(run.times[frame], time_unit, time_factor), fontsize=10)
            if last:
                axis.set_xlabel(style.label(f"${'xyz'[plane.axes[0]]}$", unit))
        axes[0].set_ylabel(style.label(f"${'xyz'[plane.axes[1]]}$", unit))
        bar = figure.colorbar(dots, ax=axes, shrink=0.95, pad=0.01, aspect=14)
        bar.set_label(row.text)
        bar.outline.set_linewidth(0.5)
    if over_time:
        size_over_time(run, name, figure.add_subplot(grid[-1, :]), frames)
    return figure


def size_over_time(run, name, axis, frames):
    """rms of the dipole, with the times of the sections."""
    column = f"{name}.director_couple"
    size = run.history[column]
    factor, unit = style.scale(run.units[column], size)
    time, time_factor = time_axis(run, axis)
    axis.semilogy(time, np.where(size > 0, size, np.nan) * factor)
    for frame in frames:
        axis.axvline(run.times[frame] * time_factor, color="0.75", lw=0.7, zorder=0)
    axis.set_ylabel(style.label("rms of |m|\n", unit))
