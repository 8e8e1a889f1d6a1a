# SPDX-License-Identifier: BSD-3-Clause
"""Drops on soft ground: outlines through time with the path of the centre, and the height of the
face of the ground below."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

import sections
import style

WIDTH = 4.6  # width of the ground, in inches


def draw(run, count):
    return {
        f"{contact['name']}_ground": picture(run, contact, run.spread_frames(count))
        for contact in run.input.get("contact", [])
        if contact.get("up") and not contact.get("partner")
    }


def middle(run, frame, name):
    """The centre of the volume."""
    body = run.body(name, frame)
    return body.volume @ run.points(frame, body) / body.volume.sum()


class Face:
    """Particles of the face of the ground in the section, from one side to the other."""

    def __init__(self, run, name, up, plane):
        self.run, self.name, self.up = run, name, up
        X = run.body(name).X
        height = X @ up
        chosen = height > height.max() - 0.01 * run.body(name).spacing
        if plane.normal is not None:
            beside = np.abs(X[:, plane.normal] - plane.place)
            chosen &= beside < max(0.5 * run.body(name).spacing, 1.01 * beside[chosen].min())
        self.chosen = np.flatnonzero(chosen)
        self.along = next(k for k in plane.axes if abs(up[k]) < 0.5)
        self.chosen = self.chosen[np.argsort(X[self.chosen, self.along])]

    def __call__(self, frame):
        """Places along the face and heights above the first ones."""
        body = self.run.body(self.name, frame)
        x, start = (self.run.points(k, body)[self.chosen] for k in (frame, 0))
        return x[:, self.along], (x - start) @ self.up


def picture(run, contact, frames):
    drop, ground = contact["bodies"]
    up = np.array(contact["up"], dtype=float)
    up /= np.linalg.norm(up)
    plane = sections.Plane(run)
    face = Face(run, ground, up, plane)
    every = range(len(run.frames))
    way = np.array([middle(run, frame, drop)[plane.axes] for frame in every])
    factor, unit = style.scale(run.length_unit, way)
    time_factor, time_unit = style.scale(run.time_unit, run.times)
    shown = np.concatenate([run.points(frames[0], body)[:, plane.axes] for body in run.epochs[frames[0]]])
    width, height = np.ptp(shown, axis=0)
    height *= 1.2 * WIDTH / width  # so that the width fits the panel below
    figure, (top, below) = plt.subplots(
        2, 1, figsize=(WIDTH + 1.9, height + 2), sharex=True, height_ratios=(height, 1.3), layout="constrained"
    )
    heights = [face(frame) for frame in frames]
    rise, rise_unit = style.scale(run.length_unit, np.array([h for _, h in heights]))
    for number, (frame, (along, height)) in enumerate(zip(frames, heights)):
        color = plt.get_cmap("viridis")(0.9 * number / max(len(frames) - 1, 1))
        for name, width in ((drop, 1.2), (ground, 0.6)):
            body = run.body(name, frame)
            lines = sections.outline(body, run.points(frame, body), plane) * factor
            top.add_collection(LineCollection(lines, colors=[color], lw=width))
        label = style.time_text(run.times[frame], time_unit, time_factor)
        top.plot(*(way[frame] * factor), "o", ms=4, color=color, label=label, zorder=3)
        below.plot(along * factor, height * rise, lw=1, color=color)
    top.plot(*(way * factor).T, lw=0.8, color="black", zorder=2)
    top.set_aspect("equal")
    top.autoscale_view()
    top.set_ylabel(style.label(f"${'xyz'[plane.axes[1]]}$", unit))
    top.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), title=f"middle of {drop}")
    below.axhline(0, color="0.7", lw=0.6, zorder=0)
    below.set_xlabel(style.label(f"${'xyz'[face.along]}$", unit))
    below.set_ylabel(style.label("rise of the face", rise_unit))
    return figure
