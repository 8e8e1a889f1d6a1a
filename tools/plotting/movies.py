# SPDX-License-Identifier: BSD-3-Clause
"""A movie of a run: surfaces in space, cells in the plane, coloured by a field, with the walls that
they touch. All frames show the same part of space, that in which anything ever is."""

import pathlib

import matplotlib.pyplot as plt
import numpy as np
from matplotlib import animation
from matplotlib.collections import PolyCollection

import directors
import outside
import partners
import style
import surfaces

SECONDS = 8  # longest duration of a movie
FORMATS = ("mp4", "gif")


def file_format(wanted):
    """That one, or where nobody says: mp4 where ffmpeg is installed, else gif. Raises style.UsageError if
    it cannot be written here."""
    has_ffmpeg = animation.writers.is_available("ffmpeg")
    if wanted == "mp4" and not has_ffmpeg:
        raise style.UsageError("mp4 is written by ffmpeg, which is not installed; gif needs nothing more")
    return wanted if wanted in FORMATS else "mp4" if has_ffmpeg else "gif"


def write(run, folder, wanted="best", field=None, count=None):
    """Writes folder/movie.mp4 or .gif of `count` frames (all if not given), evenly in time."""
    ending = file_format(wanted)
    every = np.arange(len(run.frames))
    frames = every if not count else np.unique(np.linspace(0, len(every) - 1, count).round().astype(int))
    figure, draw = (in_the_plane if run.dimension == 2 else in_space)(run, frames, run.field_of(field))
    per_second = int(np.clip(len(frames) / SECONDS, 5, 25))
    writer = animation.FFMpegWriter(per_second) if ending == "mp4" else animation.PillowWriter(per_second)
    path = pathlib.Path(folder) / f"movie.{ending}"
    outside.require_reasonable(figure)
    with outside.new_file(path) as made, writer.saving(figure, made, dpi=120):
        for frame in frames:
            draw(frame)
            writer.grab_frame()
    plt.close(figure)
    return path


def title(run, axis, frame):
    factor, unit = style.scale(run.time_unit, run.times)
    axis.set_title(style.time_text(run.times[frame], unit, factor), fontsize=10)


def figure_of(aspect):
    """A figure for a picture of that height over width, with even numbers of pixels, as mp4 needs."""
    width = 4.6 if aspect < 1.4 else 4.6 * 1.4 / aspect
    height = max(width * aspect, 1.6) + 0.5
    figure, axis = plt.subplots(figsize=(round(60 * (width + 1.2)) / 60, round(60 * height) / 60))
    figure.subplots_adjust(left=0.02, right=1 - 0.3 / figure.get_figwidth(), bottom=0.03,
                           top=1 - 0.35 / figure.get_figheight())  # fmt: skip
    return figure, axis


def in_space(run, frames, field):
    axes_of_view = surfaces.view(run.bodies)
    corner, size = surfaces.window(run, frames, axes_of_view)
    figure, axis = figure_of(size[1] / size[0])
    coloring = surfaces.Coloring(run, field, frames)
    coloring.bar(figure, axis)

    def draw(frame):
        axis.clear()
        surfaces.panel_of(axis, run, frame, axes_of_view, (corner, size), coloring, parts=4)
        surfaces.scale_bar(axis, run, corner, size)
        title(run, axis, frame)

    return figure, draw


def in_the_plane(run, frames, field):
    seen = partners.outlines(run)
    for k in frames:
        points = np.concatenate([run.points(k, body) for body in run.epochs[k]])
        seen += [points, partners.near_walls(run, k, points)]
    points = np.concatenate(seen)
    margin = 0.04 * np.ptp(points, axis=0).max()
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    low[1] -= margin  # space for the scale bar
    figure, axis = figure_of((high - low)[1] / (high - low)[0])
    coloring = surfaces.Coloring(run, field, frames)
    coloring.bar(figure, axis)

    def draw(frame):
        axis.clear()
        for body in run.epochs[frame]:
            x, values = run.points(frame, body), coloring.values(frame, body)
            axis.add_collection(
                PolyCollection(
                    x[body.cells], facecolors=coloring(values[body.cells].mean(axis=1)),
                    edgecolors=(0, 0, 0, 0.12), linewidths=0.3,
                )  # fmt: skip
            )
            directors.draw(axis, directors.rods(run, frame, body, np.ones(len(x), bool), [0, 1]))
            axis.add_collection(plt.matplotlib.collections.LineCollection(x[body.surface], colors="0.2", lw=0.9))
        partners.draw(axis, run, 1, frame)
        axis.set_xlim(low[0], high[0])
        axis.set_ylim(low[1], high[1])
        axis.set_aspect("equal")
        axis.axis("off")
        surfaces.scale_bar(axis, run, low, high - low)
        title(run, axis, frame)

    return figure, draw
