# SPDX-License-Identifier: BSD-3-Clause
"""Drops on rigid walls: meridian profiles with the fitted circle and the wedge of the
contact angle, base radius and angle over time, and the wetted patch from below."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

import style
from histories import panels

FREE_ABOVE = 0.35  # fraction of the height above which the wall does not bend the surface


def draw(run, count):
    pictures = {}
    for wall in walls(run):
        frames = run.spread_frames(count)
        pictures[f"{wall.name}_profile"] = profiles(run, wall, frames)
        if run.input["dimension"] == 3:
            pictures[f"{wall.name}_patch"] = patches(run, wall, frames)
        if figure := fronts(run, wall):
            pictures[f"{wall.name}_front"] = figure
    return pictures


class Wall:
    """A half space at rest, and the drop on it."""

    def __init__(self, contact):
        self.name, self.body = contact["name"], contact["bodies"][0]
        self.point = np.array(contact["partner"]["point"], float)
        normal = np.array(contact["partner"]["normal"], float)
        self.normal = normal / np.linalg.norm(normal)
        given = contact.get("contact_angle")
        changed = contact.get("actin", 0) != 0 or not isinstance(given, (int, float))
        self.angle = None if changed else np.radians(given)
        # By default the surface of the wall is where the drop has its angle.
        by_range = contact.get("interaction", "smooth_young") == "smooth_young"
        self.has_angle = by_range and "offset" not in contact

    def heights(self, x):
        return (x - self.point) @ self.normal

    def along(self, x):
        """Coordinates in the wall: one fewer than those of x."""
        return (x - self.point) @ np.linalg.svd(self.normal[None])[2][1:].T


def walls(run):
    drops = {tension["body"] for tension in run.input.get("surface_tension", [])}
    for contact in run.input.get("contact", []):
        partner = contact.get("partner")
        if not partner or partner["type"] != "half_space" or partner.get("displacement"):
            continue
        if contact["bodies"][0] in drops:
            yield Wall(contact)


def body_of(run, wall, frame):
    return next(body for body in run.epochs[frame] if body.name == wall.body)


class Profile:
    """Places (r, z) of the surface particles about the middle of the drop, and the circle
    through the particles of the free surface."""

    def __init__(self, run, wall, frame):
        body = body_of(run, wall, frame)
        x = run.points(frame, body)
        nodes = np.unique(body.surface)
        along = wall.along(x)
        middle = (along * body.volume[:, None]).sum(axis=0) / body.volume.sum()
        beside = along[nodes] - middle
        if body.dimension == 3:
            self.r, self.z = np.linalg.norm(beside, axis=1), wall.heights(x)[nodes]
        else:
            self.r, self.z = beside[:, 0], wall.heights(x)[nodes]
        top, low = self.z.max(), self.z.min()
        self.film = self.z[self.z < low + 0.04 * (top - low)].mean()
        free = self.z > self.film + FREE_ABOVE * (top - self.film)
        rows = np.column_stack([2 * self.z[free], np.ones(free.sum())])
        square = self.r[free] ** 2 + self.z[free] ** 2
        self.centre, rest = np.linalg.lstsq(rows, square, rcond=None)[0]
        self.radius = np.sqrt(rest + self.centre**2)
        self.level = 0 if wall.has_angle else self.film
        above = self.centre - self.level
        self.base = np.sqrt(self.radius**2 - above**2) if abs(above) < self.radius else None


def profiles(run, wall, frames):
    found = [Profile(run, wall, frame) for frame in frames]
    factor, unit = style.scale(run.length_unit, found[-1].r)
    time_factor, time_unit = style.scale(run.time_unit, run.times)
    figure, axis = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    for number, (frame, p) in enumerate(zip(frames, found)):
        color = plt.get_cmap("viridis")(0.9 * number / max(len(frames) - 1, 1))
        label = style.time_text(run.times[frame], time_unit, time_factor)
        axis.plot(p.r * factor, p.z * factor, ".", ms=3, color=color, label=label)
        polar = np.linspace(-np.pi / 2, np.pi / 2, 300)
        r, z = p.radius * np.cos(polar), p.centre + p.radius * np.sin(polar)
        seen = z > max(p.film, p.level)
        for side in (1, -1) if p.r.min() < 0 else (1,):
            axis.plot(side * r[seen] * factor, z[seen] * factor, lw=0.8, color=color)
    last = found[-1]
    if wall.angle is not None and last.base:
        size = 0.6 * last.radius
        corner = np.array([last.base, last.level])
        ray = corner + size * np.array([-np.cos(wall.angle), np.sin(wall.angle)])
        wedge = np.array([corner - [size, 0], corner, ray]) * factor
        name = f"{np.degrees(wall.angle):.3g}° at the base of the circle"
        axis.plot(*wedge.T, color="black", lw=1, ls=(0, (4, 2)), label=name, zorder=4)
    axis.axhline(0, color="0.45", lw=1.2, zorder=0)
    axis.set_aspect("equal")
    axis.set_xlabel(style.label("distance from the middle of the drop", unit))
    axis.set_ylabel(style.label("height", unit))
    axis.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    return figure


def patches(run, wall, frames):
    """Facets that face the wall, coloured by their gap."""
    seen = []
    for frame in frames:
        body = body_of(run, wall, frame)
        x = run.points(frame, body)
        quads = body.surface[:, [0, 1, 3, 2]]
        place, gap = wall.along(x)[quads], wall.heights(x)[quads].mean(axis=1)
        a, b = x[quads[:, 2]] - x[quads[:, 0]], x[quads[:, 3]] - x[quads[:, 1]]
        outward = x[quads].mean(axis=1) - x.mean(axis=0)
        area = np.cross(a, b)
        area *= np.sign((area * outward).sum(axis=1))[:, None]
        below = area @ wall.normal < 0
        order = np.argsort(-gap[below])
        seen.append((place[below][order], gap[below][order]))
    factor, unit = style.scale(run.length_unit, seen[-1][0])
    film = min(gap.min() for _, gap in seen)
    most = max(gap.max() for _, gap in seen)
    shade = plt.Normalize(film * factor, (film + 0.3 * (most - film)) * factor)
    time_factor, time_unit = style.scale(run.time_unit, run.times)
    figure, axes = plt.subplots(
        1, len(frames), figsize=(1.75 * len(frames) + 1.1, 2.2), sharex=True, sharey=True,
        squeeze=False, layout="constrained",
    )  # fmt: skip
    reach = 1.03 * max(np.abs(place).max() for place, _ in seen) * factor
    for axis, frame, (place, gap) in zip(axes[0], frames, seen):
        facets = PolyCollection(
            place * factor, array=gap * factor, norm=shade, cmap="viridis", edgecolors="0.3", lw=0.2
        )
        axis.add_collection(facets)
        axis.set_title(style.time_text(run.times[frame], time_unit, time_factor), fontsize=10)
        axis.set_xlim(-reach, reach)
        axis.set_ylim(-reach, reach)
        axis.set_aspect("equal")
        axis.set_xlabel(style.label("along the wall", unit))
    bar = figure.colorbar(facets, ax=axes, shrink=0.9, pad=0.01, aspect=20, extend="max")
    bar.set_label(style.label("gap", unit))
    return figure


def fronts(run, wall):
    """Base and angles over time, with the expectations of the scene."""
    angles = [f"{wall.name}.contact_angle", f"{wall.name}.contact_angle_vh"]
    drawn = panels(run, ([f"{wall.name}.base_radius"], angles))
    if not drawn:
        return None
    figure, axes = drawn
    for axis, names in axes:
        if "angle" in names[0]:
            axis.set_ylabel("contact angle (degrees)")
            if wall.angle is not None:
                axis.axhline(np.degrees(wall.angle), color="0.6", lw=0.8, zorder=0)
    return figure
