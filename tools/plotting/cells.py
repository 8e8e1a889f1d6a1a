# SPDX-License-Identifier: BSD-3-Clause
"""Cross-sections of shells over the shape of a red blood cell and over a profile of the scene, and
the shape at the end."""

import matplotlib.pyplot as plt
import numpy as np

import sections
import style
import surfaces


def draw(run):
    """A picture for each shell, in its own axes: the rigid motion is removed."""
    return {
        f"cell_{body.name}": picture(run, body)
        for body in run.bodies
        if body.settings["shape"].endswith("_shell")
    }


def evans_fung(x):
    """Full thickness at r = 3.91 um x of a cell of 7.82 um (Evans and Fung 1972), in um."""
    return np.sqrt(np.maximum(0, 1 - x**2)) * (0.81 + 7.83 * x**2 - 4.39 * x**4)


class Meridian:
    """The reference plane y = centre, which contains the axis."""

    normal, axes = 1, [0, 2]

    def __init__(self, body):
        self.place = body.X[:, self.normal].mean()


def in_own_axes(body, x):
    """Places after the rotation and shift that bring them closest to the reference (Kabsch)."""
    weight = body.volume / body.volume.sum()
    centre, reference = weight @ x, weight @ body.X
    moment = (weight[:, None] * (x - centre)).T @ (body.X - reference)
    u, _, v = np.linalg.svd(moment)
    u[:, -1] *= np.linalg.det(u @ v)
    return (x - centre) @ u @ v


def outline(body, x):
    """Lines of the section through the axis, which the plane of a body of revolution shows."""
    return x[body.surface] if x.shape[1] == 2 else sections.outline(body, x, Meridian(body))


def picture(run, body):
    factor, unit = style.scale(run.length_unit, body.X)
    figure, (axis, beside) = plt.subplots(
        1, 2, figsize=(8.2, 2.9), width_ratios=[2, 1], layout="constrained"
    )
    frames = [0, len(run.frames) - 1]
    for frame, color, text in zip(frames, ("0.75", style.COLORS[0]), ("start", "end")):
        x = in_own_axes(body, run.points(frame, body))
        axis.add_collection(
            plt.matplotlib.collections.LineCollection(
                outline(body, x) * factor, colors=color, lw=1.6, zorder=2
            )
        )
        time_factor, time_unit = style.scale(run.time_unit, run.times)
        time = style.time_text(run.times[frame], time_unit, time_factor)
        axis.plot([], [], color=color, label=f"{text}, {time}")
    radius = factor * np.abs(x[:, 0]).max()  # radius in the last frame
    r = np.sin(np.linspace(-np.pi / 2, np.pi / 2, 401))  # dense where the curve is steep
    half = evans_fung(np.abs(r)) / 7.82 * radius
    for side in (1, -1):
        axis.plot(radius * r, side * half, color="black", lw=1, ls=(0, (5, 3)), zorder=3,
                  label="Evans and Fung 1972, scaled" if side > 0 else None)  # fmt: skip
    draw_profiles(run, body, axis, factor)
    axis.set_aspect("equal")
    axis.margins(0.04)
    axis.set_xlabel(style.label("$r$", unit))
    axis.set_ylabel(style.label("$z$", unit))
    axis.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=2)
    draw_solid(body, x, beside)
    return figure


class Revolved:
    """The surface of a body of revolution in space, from its section in the plane."""

    def __init__(self, body, x):
        self.settings, self.spacing = body.settings, body.spacing
        edges = body.surface[(x[body.surface][:, :, 0] >= 0).all(axis=1)]
        turns = np.linspace(0, 2 * np.pi, 49)
        self.X = np.concatenate(
            [np.stack([x[:, 0] * np.cos(t), x[:, 0] * np.sin(t), x[:, 1]], axis=1) for t in turns]
        )
        first = np.concatenate([edges[:, ::-1] + k * len(x) for k in range(len(turns) - 1)])
        self.surface = np.concatenate([first, first + len(x)], axis=1)


def draw_solid(body, x, axis):
    if x.shape[1] == 2:
        body = Revolved(body, x)
        x = body.X
    seen = x @ surfaces.view([body]).T
    axis.add_collection(surfaces.facets([body], [seen]))
    axis.set_aspect("equal")
    axis.autoscale_view()
    axis.axis("off")


def draw_profiles(run, body, axis, factor):
    for profile in run.input.get("profile", []):
        if profile["body"] != body.name:
            continue
        r, z = (factor * np.array(profile[key]) for key in ("r", "z"))
        axis.plot(np.concatenate([r, r, -r, -r]), np.concatenate([z, -z, z, -z]), ".", ms=3,
                  color=style.COLORS[1], zorder=4, label=profile["label"])  # fmt: skip
