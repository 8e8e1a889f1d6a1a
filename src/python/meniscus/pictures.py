# SPDX-License-Identifier: BSD-3-Clause
"""Figures and tables of results for notebooks. `meniscus plot` draws finer ones."""

import html

import numpy as np


def html_table(rows):
    """A small table of names and values in HTML."""
    cells = (f"<tr><th>{html.escape(str(name))}</th><td>{html.escape(str(value))}</td></tr>" for name, value in rows)
    return f"<table>{''.join(cells)}</table>"


def of_history(results, names):
    """A figure with the columns `names` of the history over time, below each other."""
    from matplotlib.figure import Figure  # pylint: disable=import-outside-toplevel

    for name in names:
        if name not in results.history:
            raise ValueError(f"the history has no column '{name}'; it has {', '.join(results.history)}")
    names = names or [name for name in results.history if "." in name]
    if not names:
        raise ValueError(f"the history has no measures of bodies; name columns of {', '.join(results.history)}")
    figure = Figure(figsize=(6, 1 + 1.8 * len(names)), layout="constrained")
    for axes, name in zip(np.ravel(figure.subplots(len(names), sharex=True)), names):
        axes.plot(results.history["time"], results.history[name])
        axes.set_ylabel(_label(name, results.units[name]))
    axes.set_xlabel(_label("time", results.time_unit))
    return figure


def of_frame(frame, field, name_of_body):
    """A figure of the bodies of a frame, or of one of them, coloured by a field."""
    from matplotlib.figure import Figure  # pylint: disable=import-outside-toplevel

    results = frame.results
    field = field or _first_scalar(results)
    bodies = results.epochs[frame.number]
    if name_of_body is not None:
        bodies = [results.body(name_of_body, frame.number)]
    figure = Figure(figsize=(6, 5), layout="constrained")
    axes = figure.add_subplot(projection="3d" if results.dimension == 3 else None)
    places, values = [], []
    for body in bodies:
        of_body = frame.field(field, body.name)
        if of_body.ndim > 1:
            of_body = np.linalg.norm(of_body, axis=1)
        elements = body.surface[:, [0, 1, 3, 2]] if results.dimension == 3 else body.cells
        places.append(frame.points(body.name)[elements])  # [element, corner, i]
        values.append(of_body[elements].mean(axis=1))
    drawn = axes.add_collection(_polygons(np.concatenate(places), np.concatenate(values)))
    figure.colorbar(drawn, label=_label(field, results.unit_of(field)))
    _fit(axes, np.concatenate([corners.reshape(-1, results.dimension) for corners in places]))
    axes.set_title(f"t = {frame.time:g} {results.time_unit}")
    return figure


def _polygons(corners, values):
    from matplotlib.collections import PolyCollection  # pylint: disable=import-outside-toplevel
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # pylint: disable=import-outside-toplevel

    polygons = (Poly3DCollection if corners.shape[2] == 3 else PolyCollection)(corners)
    polygons.set_array(values)
    return polygons


def _fit(axes, places):
    """Sets the limits of the axes around the places, with the same scale along all axes."""
    low, high = places.min(axis=0), places.max(axis=0)
    margin = 0.02 * (high - low).max()
    for name, begin, end in zip("xyz", low - margin, high + margin):
        getattr(axes, f"set_{name}lim")(begin, end)
        getattr(axes, f"set_{name}label")(name)
    axes.set_aspect("equal")


def _first_scalar(results):
    scalars = [name for name in results.fields if results.frames[0][name].ndim == 1]
    return scalars[0] if scalars else "velocity" if "velocity" in results.fields else "position"


def _label(name, unit):
    return name if unit == "1" else f"{name} ({unit})"
