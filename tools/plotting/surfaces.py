# SPDX-License-Identifier: BSD-3-Clause
"""The surface in the first frame, halfway, and in the last: facets in parallel projection, lit."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

import style

# The eye looks along -EYE; up in the picture is z. Light comes from the upper left of the eye.
EYE = np.array([0.80, -0.48, 0.36])
EYE_OF_SHELLS = np.array([0.80, -0.48, 0.72])  # from higher up, into the dimple
KEY, KEY_STRENGTH = np.array([-0.45, 0.60, 0.66]), 0.60  # right, up, towards the eye
FILL, FILL_STRENGTH = np.array([0.80, 0.05, 0.60]), 0.16
AMBIENT, GLOSS, SHININESS = 0.40, 0.30, 40


def draw(run):
    bodies = [body for body in run.bodies if body.dimension == 3]
    if not bodies:
        return {}
    return {"surface": picture(run, bodies, run.spread_frames(3))}


def view(bodies):
    """Rows: right, up, towards the eye."""
    shells = all(body.settings["shape"].endswith("_shell") for body in bodies)
    eye = EYE_OF_SHELLS if shells else EYE
    eye = eye / np.linalg.norm(eye)
    right = np.cross([0, 0, 1], eye)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(eye, right), eye])


def picture(run, bodies, frames):
    axes_of_view = view(bodies)
    scenes = [[run.points(k, body) @ axes_of_view.T for body in bodies] for k in frames]
    points = np.concatenate([x for scene in scenes for x in scene])
    low, high = points.min(axis=0), points.max(axis=0)
    size = (high - low)[:2] * 1.04
    panel = 2.4
    figure, axes = plt.subplots(
        1, len(frames), figsize=(panel * len(frames), panel * size[1] / size[0] + 0.35),
        squeeze=False, gridspec_kw={"wspace": 0.02},
    )  # fmt: skip
    top = 1 - 0.3 / figure.get_figheight()
    figure.subplots_adjust(left=0.01, right=0.99, bottom=0.02, top=top)
    time_factor, time_unit = style.scale(run.time_unit, run.times)
    centre = (low + high)[:2] / 2
    for axis, frame, scene in zip(axes[0], frames, scenes):
        axis.add_collection(facets(bodies, scene))
        axis.set_xlim(centre[0] - size[0] / 2, centre[0] + size[0] / 2)
        axis.set_ylim(centre[1] - size[1] / 2, centre[1] + size[1] / 2)
        axis.set_aspect("equal")
        axis.axis("off")
        axis.set_title(style.time_text(run.times[frame], time_unit, time_factor), fontsize=10)
    scale_bar(axes[0, 0], run, centre - size / 2, size)
    return figure


def facets(bodies, scene):
    """Polygons from back to front. `scene`: positions of each body, seen."""
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
        # Before the neighbouring facets, too, which else would cover half of the line.
        add(outline, outline[:, :, 2].max(axis=1) + 0.5 * body.spacing, (0, 0, 0, 0), EDGE)
        color = plt.matplotlib.colors.to_rgb(style.COLORS[number % len(style.COLORS)])
        for patch, normal in divided(quads, normals):
            shaded = shade(normal, color)
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


def divided(quads, normals, parts=6):
    """Each facet (corners in tensor order) in parts^2 patches: their corners and normals."""
    ends = np.linspace(0, 1, parts + 1)

    def at(values, s, t):
        low = (1 - s) * values[:, 0] + s * values[:, 1]
        return (1 - t) * low + t * ((1 - s) * values[:, 2] + s * values[:, 3])

    for s0, s1 in zip(ends, ends[1:]):
        for t0, t1 in zip(ends, ends[1:]):
            around = [(s0, t0), (s1, t0), (s1, t1), (s0, t1)]
            patch = np.stack([at(quads, s, t) for s, t in around], axis=1)
            normal = at(normals, (s0 + s1) / 2, (t0 + t1) / 2)
            yield patch, normal / np.linalg.norm(normal, axis=1)[:, None]


def shade(normals, color):
    """Lambert's law for two lights, and a highlight of the first (Blinn)."""
    light = np.full(len(normals), AMBIENT)
    for direction, strength in ((KEY, KEY_STRENGTH), (FILL, FILL_STRENGTH)):
        light += strength * np.clip(normals @ (direction / np.linalg.norm(direction)), 0, None)
    halfway = KEY / np.linalg.norm(KEY) + [0, 0, 1]
    highlight = np.clip(normals @ (halfway / np.linalg.norm(halfway)), 0, None) ** SHININESS
    base = 0.62 * np.array(color) + 0.38
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
