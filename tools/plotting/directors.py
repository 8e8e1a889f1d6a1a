# SPDX-License-Identifier: BSD-3-Clause
"""Directors of nematics as rods, one at each particle in a picture."""

import numpy as np
from matplotlib.collections import LineCollection

LENGTH = 0.8  # length of the rod of a unit director, in spacings


def rods(run, frame, body, near, axes):
    """Segments [rod, end, i] along these axes at the particles `near`; None without the field
    `director`. A rod is shorter where it points out of the picture, and in the core of a defect."""
    if "director" not in run.fields:
        return np.empty((0, 2, 2))
    x = run.points(frame, body)[near][:, axes]
    half = 0.5 * LENGTH * body.spacing * np.nan_to_num(run.field(frame, "director", body)[near][:, axes])
    return np.stack([x - half, x + half], axis=1)


def draw(axis, segments, factor=1):
    """`factor`: the scale of lengths in the picture."""
    axis.add_collection(LineCollection(segments * factor, colors="k", linewidths=0.7))
