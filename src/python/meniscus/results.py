# SPDX-License-Identifier: BSD-3-Clause
"""Reads results, the directories that `meniscus run` writes, with numpy and h5py alone.

    results = meniscus.open("results/ellipsoid_drop")
    results.times                                 # of the frames
    results.points(-1, "drop")                    # [particle, i] in the last frame
    results.field(-1, "pressure", "drop")         # [particle] or [particle, component]
    results.body("drop").cells                    # [cell, corner] in the order of VTK
    results.history["drop.aspect"]                # over results.history["time"]
    results.frame(-1).to_vtk("last.vtu")

A run whose bodies were remapped has files run.h5, run.1.h5, ...: its frames follow each other here,
and `body(name, frame)` is the body in the reference of that frame. A run may still be going on: the
frames that are there when it is opened are read.
"""

from __future__ import annotations

import csv
import functools
import os
import pathlib
import stat
import tomllib
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
from numpy.typing import NDArray

from . import pictures

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[Any]
Path = str | os.PathLike[str]

LARGEST_TEXT = 1 << 30  # bytes of a text file
EXPANSION = 1100  # no array takes more than that many times its bytes in the file: deflate gives 1032


def item(group, name):
    """The group or array of that name, which is stored in the file itself. Raises ValueError if there is
    none: links to other files, arrays whose bytes are elsewhere, and arrays that claim to be larger than
    the file can hold are refused."""
    for part in name.split("/"):
        if not isinstance(group, h5py.Group) or not isinstance(group.get(part, getlink=True), h5py.HardLink):
            raise ValueError(f"{group.file.filename} has no '{name}' of its own")
        group = group[part]
    if isinstance(group, h5py.Dataset):
        where = f"'{group.name}' of {group.file.filename}"
        if group.external or group.is_virtual:
            raise ValueError(f"{where} is stored in another file")
        if group.nbytes > EXPANSION * group.id.get_storage_size():
            raise ValueError(f"{where} claims {group.nbytes} bytes, which the file does not hold")
    return group


def text_of(path):
    """The text of a regular file of a gigabyte at most. Raises OSError or ValueError for others: a named
    pipe or a device would never end."""
    with open(path, "rb", opener=lambda name, flags: os.open(name, flags | os.O_NONBLOCK)) as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode):
            raise OSError(f"{path} is not a regular file")
        if status.st_size > LARGEST_TEXT:
            raise OSError(f"{path} has {status.st_size} bytes; allowed are {LARGEST_TEXT}")
        return file.read(LARGEST_TEXT).decode()


class Body:
    """A body in one of its references; of revolution, in the half plane."""

    def __init__(self, name, group, settings, dimension):
        self.name = name
        self.dimension = dimension
        self.settings = settings  # its [[body]] table of the complete input
        first = int(group.attrs["first_particle"])
        self.particles = slice(first, first + int(group.attrs["particles"]))  # of all of a frame
        self._group = group

    def __len__(self):
        return self.particles.stop - self.particles.start

    @functools.cached_property
    def X(self):
        """Reference places [particle, i]; in 2D the file has a third column, 0."""
        return item(self._group, "X")[:, : self.dimension]

    @functools.cached_property
    def volume(self):
        """Of nodal cells [particle]; 2D: area, axisymmetric: volume of the ring."""
        return item(self._group, "volume")[()]

    @functools.cached_property
    def mass(self):
        """[particle]"""
        return item(self._group, "mass")[()]

    @functools.cached_property
    def cells(self):
        """Hexahedra (2D: quadrilaterals) [cell, corner] in the order of VTK, the body's own numbers."""
        return item(self._group, "cells")[()]

    @functools.cached_property
    def surface(self):
        """Facets [facet, corner] in tensor order, the body's own numbers."""
        return item(self._group, "surface")[()]

    @property
    def spacing(self):
        if self.dimension == 2:
            x, y = np.moveaxis(self.X[self.cells], 2, 0)
            area = (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1) / 2
            return np.sqrt(np.abs(area).sum() / len(self.volume))
        return (self.volume.sum() / len(self.volume)) ** (1 / self.dimension)


class Frame:
    """The state of all bodies at one time of the results."""

    def __init__(self, results, number):
        count = len(results.frames)
        if not -count <= number < count:
            raise IndexError(f"there is no frame {number}; there are {count}, from 0 to {count - 1}")
        self.results = results
        self.number = number % count
        self.time = float(results.times[number])
        self.step = int(results.steps[number])

    def field(self, name: str, body: Body | str) -> Array:
        """Values of a field at the particles of a body, [particle] or [particle, component]."""
        return self.results.field(self.number, name, body)

    def points(self, body: Body | str) -> Array:
        """Positions of the particles of a body, [particle, i]."""
        return self.results.points(self.number, body)

    def to_meshio(self) -> Any:
        """A meshio.Mesh of all bodies: particles, cells, and all fields of the frame. Needs meshio."""
        import meshio  # pylint: disable=import-outside-toplevel

        results, bodies = self.results, self.results.epochs[self.number]
        kind = "hexahedron" if results.dimension == 3 else "quad"
        cells = np.concatenate([body.cells.astype(np.int64) + body.particles.start for body in bodies])
        values = {name: item(results.frames[self.number], name)[()] for name in results.fields}
        points = values.pop("position")
        if points.shape[1] == 2:
            points = np.pad(points, [(0, 0), (0, 1)])
        return meshio.Mesh(points, [(kind, cells)], point_data=values)

    def to_vtk(self, path: Path) -> None:
        """Writes the frame as a file that ParaView and VisIt open, such as last.vtu. Needs meshio."""
        self.to_meshio().write(path)

    def plot(self, field: str | None = None, body: str | None = None) -> Figure:
        """A matplotlib figure of the bodies (or of one body) with their cells, in 3D their surfaces, coloured
        by a field; by default the first scalar one. Vectors and tensors are shown by their size."""
        return pictures.of_frame(self, field, body)

    def __repr__(self):
        return f"<frame {self.number}: step {self.step}, t = {self.time:g} {self.results.time_unit}>"


class Results:
    """The results of a run, by their directory. Raises OSError or ValueError, with the reason, if they
    cannot be read."""

    def __init__(self, folder: Path):
        self.folder = pathlib.Path(folder)
        self.files = [h5py.File(path, "r") for path in result_series(self.folder)]
        self.input = tomllib.loads(item(self.files[0], "meta/input")[()].decode())  # complete, in its units
        self.dimension = self.input["dimension"]
        self.axisymmetric = self.dimension == "axisymmetric"  # the half plane x >= 0, y along the axis
        if self.axisymmetric:
            self.dimension = 2
        if self.dimension not in (2, 3):
            raise ValueError(f"{self.folder}/run.h5 has the dimension {self.dimension}")
        settings = {table["name"]: table for table in self.input["body"]}
        self.frames = []  # groups /steps/<k> of all files
        self.epochs = []  # [frame] bodies in the reference that the frame is in
        for file in self.files:
            groups = item(file, "reference")
            bodies = [
                Body(name, item(groups, name), settings[name], self.dimension)
                for name in sorted(groups, key=lambda name: item(groups, name).attrs["id"])
            ]
            steps = item(file, "steps")
            for k in sorted(steps, key=int):
                self.frames.append(item(steps, k))
                self.epochs.append(bodies)
        if not self.frames:
            raise ValueError(f"{self.folder}/run.h5 has no frames")
        self.times = np.array([frame.attrs["time"] for frame in self.frames])
        self.steps = np.array([frame.attrs["step"] for frame in self.frames])
        self.bodies = self.epochs[0]
        self.history, self.units = read_history(self.folder / "history.csv")

    def __enter__(self) -> Results:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        for file in self.files:
            file.close()

    @property
    def length_unit(self) -> str:
        return self.unit_of("position")

    @property
    def time_unit(self) -> str:
        return self.units["time"]

    @functools.cached_property
    def fields(self) -> list[str]:
        """Names of the fields of all frames."""
        frame = self.frames[0]
        return [name for name in frame if frame.get(name, getclass=True) is h5py.Dataset]

    def unit_of(self, field: str) -> str:
        return self._of_frame(0, field).attrs["units"].decode()

    def body(self, name: str, frame: int = 0) -> Body:
        """The body of that name in the reference of that frame."""
        for body in self.epochs[frame]:
            if body.name == name:
                return body
        raise ValueError(f"there is no body '{name}'; there are {', '.join(b.name for b in self.bodies)}")

    def field(self, frame: int, name: str, body: Body | str) -> Array:
        """Values of a field at the particles of a body (or of the body of that name), in the frame of
        that number."""
        name_of_body = body if isinstance(body, str) else body.name
        return self._of_frame(frame, name)[self.body(name_of_body, frame).particles]

    def points(self, frame: int, body: Body | str) -> Array:
        """Places [particle, i] of the particles of a body."""
        return self.field(frame, "position", body)[:, : self.dimension]

    def line(self, name: str) -> tuple[dict[str, Array], dict[str, str]]:
        """What the [[probe]] of that name has read along its line at all frames, one point after the
        other: columns by name, and their units."""
        return read_history(self.folder / f"probe-{name}.csv")

    def frame(self, number: int) -> Frame:
        """The frame of that number; -1 is the last one."""
        return Frame(self, number)

    def history_frame(self) -> Any:
        """The history as a pandas.DataFrame, with the time as its index. Needs pandas."""
        import pandas  # pylint: disable=import-outside-toplevel

        return pandas.DataFrame(self.history).set_index("time")

    def plot(self, *names: str) -> Figure:
        """A matplotlib figure of columns of the history over time; by default all measures of bodies and
        contacts, those with a dot in their names."""
        return pictures.of_history(self, names)

    def __repr__(self):
        return f"<results in {self.folder}: {len(self.frames)} frames to t = {self.times[-1]:g} {self.time_unit}>"

    def _repr_html_(self):
        rows = [("directory", self.folder), ("title", self.input.get("title", "")),
                ("bodies", ", ".join(f"{body.name} ({len(body)} particles)" for body in self.bodies)),
                ("frames", f"{len(self.frames)}, t = {self.times[0]:g} to {self.times[-1]:g} {self.time_unit}"),
                ("fields", ", ".join(self.fields))]  # fmt: skip
        return pictures.html_table(rows)

    def _of_frame(self, frame, name):
        if name not in self.fields:
            raise ValueError(f"there is no field '{name}'; there are {', '.join(self.fields)}")
        return item(self.frames[frame], name)


def open_results(folder: Path) -> Results:
    """The results in the directory of a run."""
    return Results(folder)


def result_series(folder, name="run"):
    """run.h5, run.1.h5, ..., as many as there are. Raises OSError if there is none."""
    paths = [folder / f"{name}.h5"]
    if not paths[0].is_file():
        if runs := sorted(path.parent.name for path in folder.glob("*/run.h5")):
            raise OSError(f"{folder} has several runs; name one of them: {', '.join(runs)}")
        raise OSError(f"there is no {name}.h5 in {folder}; expected is the directory of a run")
    while (path := folder / f"{name}.{len(paths)}.h5").is_file():
        paths.append(path)
    return paths


def read_history(path):
    """Columns of history.csv by name, and their units. A row that is being written is left out."""
    lines = list(csv.reader(text_of(path).split("\n")[:-1]))
    if len(lines) < 3:
        raise ValueError(f"{path} has no records")
    names, units = ([text.lstrip("# ") for text in line] for line in lines[:2])
    if any(len(line) != len(names) for line in lines):
        raise ValueError(f"{path} has rows of different lengths")
    values = np.array([[float(text) for text in line] for line in lines[2:]])
    return dict(zip(names, values.T)), dict(zip(names, units))
