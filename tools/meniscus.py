# SPDX-License-Identifier: BSD-3-Clause
"""Reads runs of Meniscus, with numpy and h5py alone.

    import sys; sys.path.append("tools")          # or a copy of this file beside the script
    import meniscus

    run = meniscus.Run("results/ellipsoid_drop")
    run.times                                     # of the frames
    run.points(-1, "drop")                        # [particle, i] in the last frame
    run.field(-1, "pressure", "drop")             # [particle] or [particle, component]
    run.body("drop").cells                        # [cell, corner] in the order of VTK
    run.history["drop.aspect"]                    # over run.history["time"]
    pandas.DataFrame(run.history)                 # if you like

A run whose bodies were referred anew has files run.h5, run.1.h5, ...: its frames follow each other here,
and `body(name, frame)` is the body in the reference of that frame. It may still be going on: what is
there when it is opened is read.
"""

import csv
import functools
import pathlib
import tomllib

import h5py
import numpy as np


class Body:
    """A body in one of its references."""

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
        return self._group["X"][:, : self.dimension]

    @functools.cached_property
    def volume(self):
        """Of nodal cells [particle]; 2D: area."""
        return self._group["volume"][()]

    @functools.cached_property
    def mass(self):
        """[particle]"""
        return self._group["mass"][()]

    @functools.cached_property
    def cells(self):
        """Hexahedra (2D: quadrilaterals) [cell, corner] in the order of VTK, the body's own numbers."""
        return self._group["cells"][()]

    @functools.cached_property
    def surface(self):
        """Facets [facet, corner] in tensor order, the body's own numbers."""
        return self._group["surface"][()]

    @property
    def spacing(self):
        return (self.volume.sum() / len(self.volume)) ** (1 / self.dimension)


class Run:
    """A run directory. Raises OSError or ValueError, with the reason, if it cannot be read."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.files = [h5py.File(path, "r") for path in result_series(self.folder)]
        self.input = tomllib.loads(self.files[0]["meta/input"][()].decode())  # complete, in its units
        self.dimension = self.input["dimension"]
        settings = {table["name"]: table for table in self.input["body"]}
        self.frames = []  # groups /steps/<k> of all files
        self.epochs = []  # [frame] bodies in the reference that the frame is in
        for file in self.files:
            groups = file["reference"]
            bodies = [
                Body(name, groups[name], settings[name], self.dimension)
                for name in sorted(groups, key=lambda name: groups[name].attrs["id"])
            ]
            for k in sorted(file["steps"], key=int):
                self.frames.append(file["steps"][k])
                self.epochs.append(bodies)
        if not self.frames:
            raise ValueError(f"{self.folder}/run.h5 has no frames")
        self.times = np.array([frame.attrs["time"] for frame in self.frames])
        self.steps = np.array([frame.attrs["step"] for frame in self.frames])
        self.bodies = self.epochs[0]
        self.history, self.units = read_history(self.folder / "history.csv")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        for file in self.files:
            file.close()

    @property
    def length_unit(self):
        return self.unit_of("position")

    @property
    def time_unit(self):
        return self.units["time"]

    @property
    def fields(self):
        """Names of the fields of all frames."""
        return [name for name, item in self.frames[0].items() if isinstance(item, h5py.Dataset)]

    def unit_of(self, field):
        return self._of_frame(0, field).attrs["units"].decode()

    def body(self, name, frame=0):
        """The body of that name in the reference of that frame."""
        for body in self.epochs[frame]:
            if body.name == name:
                return body
        raise ValueError(f"there is no body '{name}'; there are {', '.join(b.name for b in self.bodies)}")

    def field(self, frame, name, body):
        """Values of a field at the particles of a body (or of the body of that name), in the frame of
        that number."""
        name_of_body = body if isinstance(body, str) else body.name
        return self._of_frame(frame, name)[self.body(name_of_body, frame).particles]

    def points(self, frame, body):
        """Places [particle, i] of the particles of a body."""
        return self.field(frame, "position", body)[:, : self.dimension]

    def line(self, name):
        """What the [[probe]] of that name has read along its line at all frames, one point after the
        other: columns by name, and their units."""
        return read_history(self.folder / f"probe-{name}.csv")

    def _of_frame(self, frame, name):
        if name not in self.fields:
            raise ValueError(f"there is no field '{name}'; there are {', '.join(self.fields)}")
        return self.frames[frame][name]


def result_series(folder):
    """run.h5, run.1.h5, ..., as many as there are."""
    paths = [folder / "run.h5"]
    while (path := folder / f"run.{len(paths)}.h5").exists():
        paths.append(path)
    return paths


def read_history(path):
    """Columns of history.csv by name, and their units. A row that is being written is left out."""
    with open(path, newline="", encoding="utf-8") as file:
        lines = list(csv.reader(line for line in file if line.endswith("\n")))
    if len(lines) < 3:
        raise ValueError(f"{path} has no records")
    names, units = ([text.lstrip("# ") for text in line] for line in lines[:2])
    values = np.array([[float(text) for text in line] for line in lines[2:]])
    return dict(zip(names, values.T)), dict(zip(names, units))
