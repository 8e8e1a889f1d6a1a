# SPDX-License-Identifier: BSD-3-Clause
"""Reads what a run has written: run.h5 (frames, reference, input), run.1.h5, ... after remaps, and
history.csv."""

import csv
import tomllib

import h5py
import numpy as np


class Body:
    """A body in the reference configuration."""

    def __init__(self, name, group, settings, dimension):
        self.name = name
        self.dimension = dimension
        self.settings = settings  # its [[body]] table of the complete input
        first = int(group.attrs["first_particle"])
        self.particles = slice(first, first + int(group.attrs["particles"]))
        self.X = group["X"][:, :dimension]  # [particle, i]; in 2D the file has a third column, 0
        self.volume = group["volume"][()]  # [particle]; 2D: area
        self.surface = group["surface"][()]  # [facet, corner in tensor order], body's own numbers

    @property
    def spacing(self):
        return (self.volume.sum() / len(self.volume)) ** (1 / self.dimension)


class Results:
    """A run directory. Raises OSError or ValueError, with the reason, if it cannot be read."""

    def __init__(self, folder):
        self.files = [h5py.File(path, "r") for path in result_series(folder)]
        self.input = tomllib.loads(self.files[0]["meta/input"][()].decode())
        settings = {table["name"]: table for table in self.input["body"]}
        self.frames = []  # groups /steps/<k> of all files
        self.epochs = []  # [frame] bodies in the reference that the frame is in
        for file in self.files:
            groups = file["reference"]
            bodies = [
                Body(name, groups[name], settings[name], self.input["dimension"])
                for name in sorted(groups, key=lambda name: groups[name].attrs["id"])
            ]
            for k in sorted(file["steps"], key=int):
                self.frames.append(file["steps"][k])
                self.epochs.append(bodies)
        if not self.frames:
            raise ValueError(f"{folder}/run.h5 has no frames")
        self.times = np.array([frame.attrs["time"] for frame in self.frames])
        self.bodies = self.epochs[0]
        self.history, self.units = read_history(folder / "history.csv")

    @property
    def length_unit(self):
        return self.unit_of("position")

    @property
    def time_unit(self):
        return self.units["time"]

    def unit_of(self, field):
        return self.frames[0][field].attrs["units"].decode()

    def field(self, frame, name, body):
        """Values of a field at the particles of a body, in the frame of that number."""
        return self.frames[frame][name][body.particles]

    def places(self, frame, body):
        """Positions [particle, i] of the particles of a body."""
        return self.field(frame, "position", body)[:, : body.dimension]

    def spread_frames(self, count):
        """First, last, and frames between them at equal lengths of the way that particles have
        moved: many where much happens, evenly in time for a body in steady motion."""
        way = np.zeros(len(self.frames))
        for body in self.bodies:
            before = self.places(0, body)
            for k in range(1, len(way)):
                now = self.places(k, body)
                way[k] += np.sqrt(np.mean((now - before) ** 2))
                before = now
        way = np.cumsum(way)
        if way[-1] <= 1e-3 * max(body.spacing for body in self.bodies):
            way = np.arange(len(way))
        targets = np.linspace(0, way[-1], min(count, len(way)))
        return sorted({int(np.argmin(np.abs(way - target))) for target in targets})

    def default_field(self):
        """The first scalar among the fields of the scene, or else the first field."""
        names = self.input["output"]["fields"]
        scalars = [name for name in names if self.frames[0][name].ndim == 1]
        return (scalars or names or ["position"])[0]

    def expectations(self, column):
        """(time, value, tolerance) of what the scene expects of a column at given times."""
        end = self.input["time"]["end"]
        for name, expected in self.input.get("expect", {}).items():
            if expected.get("of", name) != column or expected["reduce"] != "at":
                continue
            relative = expected.get("within_relative", 0) * abs(expected["value"])
            tolerance = max(expected.get("within", 0), relative)
            yield expected.get("at", end), expected["value"], tolerance


def result_series(folder):
    """run.h5, run.1.h5, ..., as many as there are."""
    paths = [folder / "run.h5"]
    while (path := folder / f"run.{len(paths)}.h5").exists():
        paths.append(path)
    return paths


def read_history(path):
    """Columns by name, and their units."""
    with open(path, newline="", encoding="utf-8") as file:
        lines = list(csv.reader(file))
    if len(lines) < 3:
        raise ValueError(f"{path} has no records")
    names, units = ([text.lstrip("# ") for text in line] for line in lines[:2])
    values = np.array([[float(text) for text in line] for line in lines[2:]])
    return dict(zip(names, values.T)), dict(zip(names, units))
