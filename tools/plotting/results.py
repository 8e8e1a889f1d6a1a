# SPDX-License-Identifier: BSD-3-Clause
"""What pictures need of results besides what the package meniscus reads."""

import functools

import h5py
import numpy as np

import package  # noqa: F401  pylint: disable=unused-import
import style

from meniscus import results as reader  # isort: skip


class Section:
    """A body of revolution with the other half of its section: its particles, then their images beyond
    the axis."""

    def __init__(self, half):
        self.half = half
        self.X = np.concatenate([half.X, half.X * [-1, 1]])
        self.cells = np.concatenate([half.cells, half.cells + len(half)])
        self.surface = np.concatenate([half.surface, half.surface[:, ::-1] + len(half)])
        circle = 2 * np.pi * np.maximum(half.X[:, 0], half.spacing / 4)
        self.volume = np.tile(half.volume / circle, 2)  # areas of the section

    def __getattr__(self, name):
        return getattr(self.half, name)

    def __len__(self):
        return len(self.half)


class Results(reader.Results):
    """A run, its frames worth showing and what its scene expects. Bodies of revolution are shown by their
    whole section."""

    def __init__(self, folder):
        super().__init__(folder)
        if self.axisymmetric:
            sections = {}
            self.epochs = [
                [sections.setdefault(id(body), Section(body)) for body in bodies] for bodies in self.epochs
            ]
            self.bodies = self.epochs[0]

    def field(self, frame, name, body):
        values = super().field(frame, name, body)
        if not self.axisymmetric:
            return values
        image = values.copy()
        if values.ndim > 1 and values.shape[1] == 3:
            image[:, 0] *= -1
        elif values.ndim > 1 and values.shape[1] == 9:
            image[:, [1, 3]] *= -1  # xy and yx
        return np.concatenate([values, image])

    def spread_frames(self, count):
        """First, last, and frames between them at equal lengths of the way that particles have
        moved: many where much happens, evenly in time for a body in steady motion."""
        way = np.zeros(len(self.frames))
        for body in self.bodies:
            before = self.points(0, body)
            for k in range(1, len(way)):
                now = self.points(k, body)
                way[k] += np.sqrt(np.mean((now - before) ** 2))
                before = now
        way = np.cumsum(way)
        if way[-1] <= 1e-3 * max(body.spacing for body in self.bodies):
            way = np.arange(len(way))
        targets = np.linspace(0, way[-1], min(count, len(way)))
        return sorted({int(np.argmin(np.abs(way - target))) for target in targets})

    def displacement_of_partner(self, frame, number):
        """[i] of the rigid partner of that number in the scene, as the run has written it beside the frame;
        None if it has not."""
        moved = self.partner_steps.get(int(self.steps[frame]))
        if moved is None:
            return None
        file, step = moved
        reference = reader.item(file, "reference")
        partners = [reader.item(reference, name) for name in reference]
        partner = next(partner for partner in partners if partner.attrs["id"] == number)
        position = reader.item(step, "position")[int(partner.attrs["first_particle"])]
        return (position - reader.item(partner, "X")[0])[: self.dimension]

    @functools.cached_property
    def partner_steps(self):
        """(file, frame) of partners.h5 by the number of the step; none if no partner was written."""
        found = {}
        try:
            files = reader.result_series(self.folder, "partners")
        except OSError:
            return found
        for path in files:
            file = h5py.File(path, "r")
            steps = reader.item(file, "steps")
            for k in steps:
                frame = reader.item(steps, k)
                found[int(frame.attrs["step"])] = (file, frame)
        return found

    def field_of(self, name):
        """That field, or the default one. Raises style.UsageError if there is none."""
        name = name or self.default_field()
        if name not in self.fields:
            raise style.UsageError(f"there is no field '{name}' in run.h5; it has {', '.join(self.fields)}")
        return name

    def sizes(self, frame, name, body):
        """Values of a scalar field [particle], norms of one of vectors or tensors."""
        values = self.field(frame, name, body)
        return values if values.ndim == 1 else np.linalg.norm(values.reshape(len(values), -1), axis=1)

    def field_in_words(self, name):
        words = style.column_name(name)
        return f"|{words}|" if self.frames[0][name].ndim > 1 else words

    def default_field(self):
        """The first scalar among the fields of the scene, or else the first field."""
        names = self.input["output"]["fields"]
        scalars = [name for name in names if self.frames[0][name].ndim == 1]
        return (scalars or names or ["position"])[0]

    def expectations(self, column):
        """(time, value, tolerance) of what the scene expects of a column at given times."""
        end = self.input["time"]["end"]
        for name, expected in self.input.get("expect", {}).items():
            if expected.get("of", name) != column or expected["reduce"] != "at" or "value" not in expected:
                continue
            relative = expected.get("within_relative", 0) * abs(expected["value"])
            tolerance = max(expected.get("within", 0), relative)
            yield expected.get("at", end), expected["value"], tolerance
