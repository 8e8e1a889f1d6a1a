# SPDX-License-Identifier: BSD-3-Clause
"""Cross-sections through time: the particles near a plane and the outline, coloured by a field,
with the directors of nematics."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection

import directors
import partners
import style

PANELS_IN_ROW = 6


def draw(run, name, count):
    name = run.field_of(name)
    frames = run.spread_frames(count)
    plane = Plane(run)
    cuts = [[Cut(run, body, plane, frame, name) for body in run.epochs[frame]] for frame in frames]
    return {f"sections_{name}": picture(run, plane, frames, cuts, name)}


class Plane:
    """The reference plane of the section through the centre. It is normal to the shortest extent (z if
    there is a choice) and contains the longest axis, but also the normals of walls and of
    ground. For shells it is normal to y and contains their axis. In 2D it contains the whole body."""

    def __init__(self, run):
        X = np.concatenate([body.X for body in run.bodies])
        low, high = X.min(axis=0), X.max(axis=0)
        self.normal = None
        self.axes = [0, 1]
        if X.shape[1] == 3:
            normals = np.array([*partners.normals(run)]).reshape(-1, 3)
            across = [k for k in range(3) if np.abs(normals[:, k]).max(initial=0) < 0.1] or [0, 1, 2]
            extent = high - low
            self.normal = max(k for k in across if extent[k] <= 1.001 * extent[across].min())
            if all(body.settings["shape"].endswith("_shell") for body in run.bodies):
                self.normal = 1
            self.place = (low + high)[self.normal] / 2
            self.axes = [k for k in range(3) if k != self.normal]


class Cut:
    """The part of a body in the plane. Its particles are chosen in the reference state: all frames
    show the same particles."""

    def __init__(self, run, body, plane, frame, name):
        x = run.points(frame, body)
        values = run.sizes(frame, name, body)
        near = np.ones(len(x), bool)
        if plane.normal is not None:
            beside = np.abs(body.X[:, plane.normal] - plane.place)
            # Flat cells of a wall are wider than its spacing: at least the nearest particles.
            near = beside < max(0.5 * body.spacing, 1.01 * beside.min())
        self.near = near
        self.x = x[near][:, plane.axes]
        self.values = values[near]
        self.size = 0.85 * body.volume[near] ** (1 / body.dimension)
        self.rods = directors.rods(run, frame, body, near, plane.axes)
        self.outline = outline(body, x, plane)


def outline(body, x, plane):
    """Segments [segment, end, i] of the current surface in the material plane of the section."""
    if plane.normal is None:
        return x[body.surface]
    # The plane is slightly off-centre, so that no corner lies on it.
    height = body.X[:, plane.normal] - plane.place - 1e-4 * body.spacing
    segments = []
    for quad in body.surface[:, [0, 1, 3, 2]]:
        ends = []
        for a, b in zip(quad, np.roll(quad, -1)):
            if height[a] * height[b] < 0:
                s = height[a] / (height[a] - height[b])
                ends.append((1 - s) * x[a] + s * x[b])
        segments += [ends[k : k + 2] for k in range(0, len(ends) - 1, 2)]
    return np.array(segments)[:, :, plane.axes] if segments else np.empty((0, 2, 2))


def show(axis, cut, values, length_factor, norm, colors="viridis"):
    """Dots of these values at the particles of a cut, with directors and outline. Returns the dots."""
    dots = EllipseCollection(
        cut.size * length_factor, cut.size * length_factor, 0, units="xy",
        offsets=cut.x * length_factor, transOffset=axis.transData, norm=norm,
        cmap=colors, linewidths=0,
    )  # fmt: skip
    dots.set_array(values)
    axis.add_collection(dots)
    directors.draw(axis, cut.rods, length_factor)
    axis.add_collection(LineCollection(cut.outline * length_factor, colors="0.2", lw=0.9))
    return dots


def picture(run, plane, frames, cuts, name):
    everything = [cut for cuts_of_frame in cuts for cut in cuts_of_frame]
    points = np.concatenate(
        [np.vstack([c.x, c.outline.reshape(-1, 2)]) for c in everything] + partners.outlines(run)
    )
    values = np.concatenate([c.values for c in everything])
    largest = max(cut.size.max(initial=0) for cut in everything)
    margin = 0.02 * np.ptp(points, axis=0).max() + largest / 2
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    length_factor, length_unit = style.scale(run.length_unit, points)
    factor, unit = style.scale(run.unit_of(name), values)
    norm = plt.Normalize(*(np.percentile(values, (0.5, 99.5)) * factor))
    time_factor, time_unit = style.scale(run.time_unit, run.times)

    panel = 1.75
    aspect = (high - low)[1] / (high - low)[0]
    rows = -(-len(frames) // PANELS_IN_ROW)
    columns = -(-len(frames) // rows)
    height = max(panel * aspect, 1.3) + 0.3
    figure, axes = plt.subplots(
        rows, columns, figsize=(panel * columns + 1.1, rows * height + 0.45),
        sharex=True, sharey=True, squeeze=False, layout="constrained",
    )  # fmt: skip
    for axis in axes.flat[len(frames) :]:
        axis.set_visible(False)
    for axis, frame, cuts_of_frame in zip(axes.flat, frames, cuts):
        for cut in cuts_of_frame:
            dots = show(axis, cut, cut.values * factor, length_factor, norm)
        partners.draw(axis, run, length_factor, frame, plane.axes)
        axis.set_title(style.time_text(run.times[frame], time_unit, time_factor), fontsize=10)
        axis.set_xlim(low[0] * length_factor, high[0] * length_factor)
        axis.set_ylim(low[1] * length_factor, high[1] * length_factor)
        axis.set_aspect("equal")
    for axis in axes[-1]:
        axis.set_xlabel(style.label(f"${'xyz'[plane.axes[0]]}$", length_unit))
    for axis in axes[:, 0]:
        axis.set_ylabel(style.label(f"${'xyz'[plane.axes[1]]}$", length_unit))
    bar = figure.colorbar(dots, ax=axes, shrink=0.9, pad=0.01, aspect=25)
    bar.set_label(style.label(run.field_in_words(name), unit))
    bar.outline.set_linewidth(0.5)
    return figure
