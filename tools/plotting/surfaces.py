"""The surface in the first, middle and last frame: facets in parallel projection, lit."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

import style

# The eye looks along -EYE; up in the picture is z. Light comes from the upper left of the eye.
EYE = np.array([0.80, -0.48, 0.36])
KEY, KEY_STRENGTH = np.array([-0.45, 0.60, 0.66]), 0.62  # right, up, towards the eye
FILL, FILL_STRENGTH = np.array([0.80, 0.05, 0.60]), 0.16
AMBIENT, GLOSS, SHININESS = 0.34, 0.28, 28


def draw(run):
    bodies = [body for body in run.bodies if body.dimension == 3]
    if not bodies:
        return {}
    frames = sorted({0, (len(run.frames) - 1) // 2, len(run.frames) - 1})
    return {"surface": picture(run, bodies, frames)}


def view():
    """Rows: right, up, towards the eye."""
    eye = EYE / np.linalg.norm(EYE)
    right = np.cross([0, 0, 1], eye)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(eye, right), eye])


def picture(run, bodies, frames):
    axes_of_view = view()
    scenes = [[run.field(k, "position", body) @ axes_of_view.T for body in bodies] for k in frames]
    points = np.concatenate([x for scene in scenes for x in scene])
    low, high = points.min(axis=0), points.max(axis=0)
    size = (high - low)[:2] * 1.04
    panel = 2.4
    figure, axes = plt.subplots(
        1, len(frames), figsize=(panel * len(frames), panel * size[1] / size[0] + 0.35),
        squeeze=False, gridspec_kw={"wspace": 0.02},
    )  # fmt: skip
    figure.subplots_adjust(left=0.01, right=0.99, bottom=0.02, top=1 - 0.3 / figure.get_figheight())
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
    polygons, depths, colors = [], [], []
    for number, (body, x) in enumerate(zip(bodies, scene)):
        corners = x[body.surface[:, [0, 1, 3, 2]]]  # around the facet
        normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        seen = normals[:, 2] > 0
        polygons.append(corners[seen][:, :, :2])
        depths.append(corners[seen][:, :, 2].mean(axis=1))
        colors.append(shade(normals[seen], plt.matplotlib.colors.to_rgb(style.COLORS[number % 6])))
    order = np.argsort(np.concatenate(depths))
    colors = np.concatenate(colors)[order]
    return PolyCollection(
        np.concatenate(polygons)[order], facecolors=colors, edgecolors=0.82 * colors,
        linewidths=0.35, joinstyle="round",
    )  # fmt: skip


def shade(normals, color):
    """Lambert's law for two lights, and a highlight of the first (Blinn)."""
    light = np.full(len(normals), AMBIENT)
    for direction, strength in ((KEY, KEY_STRENGTH), (FILL, FILL_STRENGTH)):
        light += strength * np.clip(normals @ (direction / np.linalg.norm(direction)), 0, None)
    halfway = KEY / np.linalg.norm(KEY) + [0, 0, 1]
    highlight = np.clip(normals @ (halfway / np.linalg.norm(halfway)), 0, None) ** SHININESS
    base = 0.55 * np.array(color) + 0.45
    return np.clip(light[:, None] * base + GLOSS * highlight[:, None], 0, 1)


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
