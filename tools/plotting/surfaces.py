# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces: facets in parallel projection, lit, with the colour of the body or of a field, and the
walls that they touch."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

import partners
import style

# The eye looks along -EYE; up in the picture is z. Light comes from the upper left of the eye.
EYE = np.array([0.80, -0.48, 0.36])
EYE_OF_SHELLS = np.array([0.80, -0.48, 0.72])  # higher up, to look into the dimple
KEY, KEY_STRENGTH = np.array([-0.45, 0.60, 0.66]), 0.60  # right, up, towards the eye
FILL, FILL_STRENGTH = np.array([0.80, 0.05, 0.60]), 0.16
AMBIENT, GLOSS, SHININESS = 0.40, 0.30, 40


def draw(run, field=None, count=3):
    """The surface in the first, some intermediate and the last frame; with a field also coloured
    by it."""
    if run.dimension == 2:
        return {}
    frames = run.spread_frames(count)
    pictures = {"surface": picture(run, frames)}
    if field:
        name = run.field_of(field)
        pictures[f"surface_{name}"] = picture(run, frames, Coloring(run, name, frames))
    return pictures


class Coloring:
    """Colours of the values of a field at the particles; all frames have the same colour map."""

    def __init__(self, run, name, frames):
        self.run, self.name = run, name
        inside_too = run.dimension == 2
        seen = [
            run.sizes(k, name, body)[... if inside_too else np.unique(body.surface)]
            for k in frames
            for body in run.epochs[k]
        ]
        values = np.concatenate(seen)
        self.factor, self.unit = style.scale(run.unit_of(name), values)
        self.norm = plt.Normalize(*(np.percentile(values, (0.5, 99.5)) * self.factor))

    def __call__(self, values):
        return plt.get_cmap("viridis")(self.norm(values * self.factor))[..., :3]

    def values(self, frame, body):
        return self.run.sizes(frame, self.name, body)

    def bar(self, figure, axes):
        mappable = plt.matplotlib.cm.ScalarMappable(self.norm, "viridis")
        bar = figure.colorbar(mappable, ax=axes, shrink=0.8, pad=0.02, aspect=25)
        bar.set_label(style.label(self.run.field_in_words(self.name), self.unit))
        bar.outline.set_linewidth(0.5)


def view(bodies):
    """Rows: right, up, towards the eye."""
    shells = all(body.settings["shape"].endswith("_shell") for body in bodies)
    eye = EYE_OF_SHELLS if shells else EYE
    eye = eye / np.linalg.norm(eye)
    right = np.cross([0, 0, 1], eye)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(eye, right), eye])


def window(run, frames, axes_of_view):
    """Lower corner and size (right, up) of the view of all bodies in the given frames."""
    seen = []
    for k in frames:
        points = np.concatenate([run.points(k, body) for body in run.epochs[k]])
        seen += [points @ axes_of_view.T, partners.near_walls(run, k, points) @ axes_of_view.T]
    points = np.concatenate(seen)
    low, high = points.min(axis=0)[:2], points.max(axis=0)[:2]
    size = (high - low) * 1.04
    return (low + high) / 2 - size / 2, size


def picture(run, frames, coloring=None):
    axes_of_view = view(run.bodies)
    corner, size = window(run, frames, axes_of_view)
    panel, bar = 2.4, 0.9 if coloring else 0
    figure, axes = plt.subplots(
        1, len(frames), figsize=(panel * len(frames) + bar, panel * size[1] / size[0] + 0.35),
        squeeze=False, gridspec_kw={"wspace": 0.02},
    )  # fmt: skip
    top = 1 - 0.3 / figure.get_figheight()
    figure.subplots_adjust(left=0.01, right=0.99, bottom=0.02, top=top)
    time_factor, time_unit = style.scale(run.time_unit, run.times)
    for axis, frame in zip(axes[0], frames):
        panel_of(axis, run, frame, axes_of_view, (corner, size), coloring)
        axis.set_title(style.time_text(run.times[frame], time_unit, time_factor), fontsize=10)
    scale_bar(axes[0, 0], run, corner, size)
    if coloring:
        coloring.bar(figure, axes)
    return figure


def panel_of(axis, run, frame, axes_of_view, seen, coloring=None, parts=6):
    """One frame: bodies, and the walls behind or in front of them."""
    corner, size = seen
    bodies = run.epochs[frame]
    scene = [run.points(frame, body) @ axes_of_view.T for body in bodies]
    colors = coloring and [coloring(coloring.values(frame, body)) for body in bodies]
    middle = np.mean([x.mean(axis=0) for x in scene], axis=0) @ axes_of_view
    for wall, before in partners.walls(run, frame, axes_of_view, middle, 1.2 * size.max()):
        wall.set_zorder(2 if before else 0)
        axis.add_collection(wall)
    axis.add_collection(facets(bodies, scene, colors, parts))
    axis.set_xlim(corner[0], corner[0] + size[0])
    axis.set_ylim(corner[1], corner[1] + size[1])
    axis.set_aspect("equal")
    axis.axis("off")


def facets(bodies, scene, colors=None, parts=6):
    """Polygons from back to front. `scene`: positions of each body in the view; `colors`: [body][particle],
    by default the colours of the bodies."""
    polygons, depths, faces, edges = [], [], [], []

    def add(corners, depth, face, edge):
        polygons.append(corners[..., :2])
        depths.append(depth)
        faces.append(np.broadcast_to(face, (len(corners), 4)))
        edges.append(np.broadcast_to(edge, (len(corners), 4)))

    for number, (body, x) in enumerate(zip(bodies, scene)):
        quads, normals = x[body.surface], corner_normals(body, x)
        seen = normals[:, :, 2].max(axis=1) > 0
        quads, normals = quads[seen], normals[seen]
        outline = quads[:, [0, 1, 3, 2]]
        # Draw the line in front of the neighbouring facets, which would otherwise cover half of it.
        add(outline, outline[:, :, 2].max(axis=1) + 0.5 * body.spacing, (0, 0, 0, 0), EDGE)
        color = np.array(plt.matplotlib.colors.to_rgb(style.COLORS[number % len(style.COLORS)]))
        corner_colors = np.broadcast_to(color, (*quads.shape[:2], 3))
        if colors:
            corner_colors = colors[number][body.surface[seen]]
        for patch, normal, of_patch in divided(quads, normals, corner_colors, parts):
            shaded = shade(normal, of_patch, bool(colors))
            add(patch, patch[:, :, 2].mean(axis=1), shaded, shaded)
    order = np.argsort(np.concatenate(depths), kind="stable")
    return PolyCollection(
        np.concatenate(polygons)[order], facecolors=np.concatenate(faces)[order],
        edgecolors=np.concatenate(edges)[order], linewidths=0.3, joinstyle="round",
    )  # fmt: skip


EDGE = (0.05, 0.10, 0.15, 0.22)
SHARP = np.cos(np.radians(35))  # facets that meet at a sharper angle keep their own normals


def corner_normals(body, x):
    """[facet, corner, i]: means over the facets at a corner, for smooth shading."""
    corners = x[body.surface]
    facet = np.cross(corners[:, 3] - corners[:, 0], corners[:, 2] - corners[:, 1])
    mean = np.zeros_like(x)
    for corner in range(4):
        np.add.at(mean, body.surface[:, corner], facet)
    unit = facet / np.linalg.norm(facet, axis=1)[:, None]
    mean /= np.maximum(np.linalg.norm(mean, axis=1), 1e-300)[:, None]
    normals = mean[body.surface]
    sharp = np.einsum("fci,fi->fc", normals, unit) < SHARP
    normals[sharp] = np.repeat(unit[:, None], 4, axis=1)[sharp]
    return normals


def divided(quads, normals, colors, parts):
    """Each facet (corners in tensor order) in parts^2 patches: their corners, normals and colours."""
    ends = np.linspace(0, 1, parts + 1)

    def at(values, s, t):
        low = (1 - s) * values[:, 0] + s * values[:, 1]
        return (1 - t) * low + t * ((1 - s) * values[:, 2] + s * values[:, 3])

    for s0, s1 in zip(ends, ends[1:]):
        for t0, t1 in zip(ends, ends[1:]):
            around = [(s0, t0), (s1, t0), (s1, t1), (s0, t1)]
            patch = np.stack([at(quads, s, t) for s, t in around], axis=1)
            middle = ((s0 + s1) / 2, (t0 + t1) / 2)
            normal = at(normals, *middle)
            yield patch, normal / np.linalg.norm(normal, axis=1)[:, None], at(colors, *middle)


def shade(normals, colors, of_field):
    """Lambert's law for two lights, and a highlight of the first (Blinn); [patch, i]. Colours of a field
    match its colour bar, apart from a little shade."""
    light = np.full(len(normals), AMBIENT)
    for direction, strength in ((KEY, KEY_STRENGTH), (FILL, FILL_STRENGTH)):
        light += strength * np.clip(normals @ (direction / np.linalg.norm(direction)), 0, None)
    halfway = KEY / np.linalg.norm(KEY) + [0, 0, 1]
    highlight = np.clip(normals @ (halfway / np.linalg.norm(halfway)), 0, None) ** SHININESS
    if of_field:
        rgb = (0.55 + 0.45 * np.clip(light, 0, 1))[:, None] * colors + 0.5 * GLOSS * highlight[:, None]
        rgb = np.clip(rgb, 0, 1)
    else:
        base = 0.62 * colors + 0.38
        rgb = np.clip(light[:, None] * base + GLOSS * highlight[:, None], 0, 1)
    return np.hstack([rgb, np.ones((len(rgb), 1))])


def scale_bar(axis, run, corner, size):
    """A bar of a round length, about a quarter of the picture."""
    factor, unit = style.scale(run.length_unit, size)
    longest = 0.3 * size[0] * factor
    power = 10.0 ** np.floor(np.log10(longest))
    length = max(step for step in (1, 2, 5) if step * power <= longest) * power
    x, y = corner + 0.03 * size
    axis.plot([x, x + length / factor], [y, y], color="black", lw=2, solid_capstyle="butt")
    axis.annotate(
        f"{length:g} {unit}", (x + length / factor / 2, y), xytext=(0, 4),
        textcoords="offset points", ha="center", fontsize=9,
    )  # fmt: skip
