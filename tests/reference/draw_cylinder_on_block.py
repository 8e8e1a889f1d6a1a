#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a run of inputs/contact/cylinder_indentation.toml over the output of cylinder_on_block.py (with
--pressure 0.4): force and gap against depth, and the pressure along the block at the depth 0.4 with
Hertz's pressure.

Usage: draw_cylinder_on_block.py RUN PRINTED PICTURE
"""

import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/plotting"))
import style  # pylint: disable=wrong-import-position
from results import Results  # pylint: disable=wrong-import-position

DEPTH, RADIUS, STIFFNESS = 0.4, 1.0, 1 / (2 * 0.96)


def main(run, printed, picture):
    plt = style.plt
    results = Results(pathlib.Path(run))
    lines = [line.split() for line in open(printed, encoding="utf-8") if line[0] != "#"]
    curve = np.array([line for line in lines if line[0] != "pressure"], float)
    profile = np.array([line[1:] for line in lines if line[0] == "pressure"], float)
    # Plots the mean over each element, since contact pressures oscillate from point to point.
    profile = profile[profile[:, 0] == DEPTH]
    cut = len(profile) % 5 // 2  # parts of elements at both ends
    profile = profile[cut : len(profile) - cut].reshape(-1, 5, 3).mean(1)
    history = results.history
    depth = 0.8 - np.abs(history["time"] - 0.8)
    loading = history["time"] <= 0.8 + 1e-9

    figure, axes = plt.subplots(1, 3, figsize=(10, 3.2), layout="constrained")
    for axis, values, column, name in (
        (axes[0], -1e3 * history["cylinder.force_y"], 1e3 * curve[:, 1], "force (10$^{-3}$ E R)"),
        (axes[1], history["faces.gap"], curve[:, 2], "least gap (R)"),
    ):
        axis.plot(depth[loading], values[loading], label="loading")
        axis.plot(depth[~loading], values[~loading], "--", label="unloading")
        axis.plot(curve[:, 0], column, "ko", ms=3.5, label="finite elements")
        axis.set_xlabel("depth (R)")
        axis.set_ylabel(name)
    axes[0].legend()
    zoom = axes[0].inset_axes([0.12, 0.42, 0.4, 0.28])
    near = depth <= 0.16
    zoom.plot(depth[near], -1e3 * history["cylinder.force_y"][near])
    few = curve[:, 0] <= 0.16
    zoom.plot(curve[few, 0], 1e3 * curve[few, 1], "ko", ms=3)
    zoom.tick_params(labelsize=7)

    block = next(body for body in results.bodies if body.name == "block")
    frame = int(np.argmin(np.abs(results.times - DEPTH)))
    top = np.flatnonzero(np.abs(block.X[:, 1] - block.X[:, 1].max()) < 1e-9)
    x = results.points(frame, block)[top, 0]
    pressure = -results.field(frame, "cauchy_stress", block)[top].reshape(len(top), -1)
    across = pressure[:, 4 if pressure.shape[1] == 9 else 3 if pressure.shape[1] == 4 else 1]
    order = np.argsort(x)
    axes[2].plot(profile[:, 1], profile[:, 2], "ks", ms=3, label="contact, finite elements")
    axes[2].plot(x[order], across[order], "o-", ms=3, label="$-\\sigma_{yy}$ of the run")
    force = np.interp(DEPTH, curve[:, 0][: np.argmax(curve[:, 0]) + 1],
                      curve[:, 1][: np.argmax(curve[:, 0]) + 1])  # fmt: skip
    a = np.sqrt(4 * force * RADIUS / (np.pi * STIFFNESS))
    s = np.linspace(-a, a, 201)
    axes[2].plot(s, 2 * force / (np.pi * a) * np.sqrt(1 - (s / a) ** 2), "k:", label="Hertz")
    axes[2].set_xlim(-1.2, 1.2)
    axes[2].set_xlabel("place (R)")
    axes[2].set_ylabel(f"pressure at depth {DEPTH} (E)")
    axes[2].set_ylim(top=0.17)
    axes[2].legend(loc="upper left", fontsize=8)
    figure.savefig(picture, dpi=120)


if __name__ == "__main__":
    main(*sys.argv[1:])
