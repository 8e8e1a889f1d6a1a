# SPDX-License-Identifier: BSD-3-Clause
"""What a fit consists of: scenes, measured data, and the parameters that are looked for."""

from __future__ import annotations

import csv
import dataclasses
import os
import pathlib
import re
import tomllib
from typing import Any

import numpy as np

from .errors import FileError, InputError
from .results import text_of
from .scene import to_value

REDUCTIONS = {"last": lambda y: y[-1], "min": np.min, "max": np.max, "mean": np.mean}


@dataclasses.dataclass
class Axis:
    """A column of the data and the column of the history that it is compared with."""

    of: str
    unit: str  # of the data; empty: that of the history


@dataclasses.dataclass
class Data:
    """Measured values with their standard errors: of a curve y over x, or one value."""

    name: str
    y: Axis
    values: np.ndarray
    errors: np.ndarray | None  # None: not known
    x: Axis | None = None  # of a curve
    places: np.ndarray | None = None
    reduce: str = "last"  # of one value
    begin: float = -np.inf  # times of the run between which it is compared
    end: float = np.inf
    stage: str = ""


@dataclasses.dataclass
class Scene:
    file: pathlib.Path
    settings: list[str]  # "key=value"
    data: list[Data]

    @property
    def finds_equilibria(self) -> bool:
        """True if its solver is newton and it has no stages."""
        scene = tomllib.loads(text_of(self.file))
        solver = scene.get("time", {}).get("solver")
        for setting in self.settings:
            key, _, value = setting.partition("=")
            solver = value.strip('"') if key == "time.solver" else solver
        return solver == "newton" and "stage" not in scene


@dataclasses.dataclass
class Parameter:
    """A number that is looked for. `keys` of all scenes have its value."""

    name: str
    keys: list[str]
    unit: str
    start: float
    low: float
    high: float
    log: bool

    def text(self, value: float) -> str:
        """The value as a scene has it."""
        number = f"{value:.12g}"
        return f"{number} {self.unit}" if self.unit else number


@dataclasses.dataclass
class FitFile:
    path: pathlib.Path
    title: str
    scenes: list[Scene]
    parameters: list[Parameter]


class Table:
    """A table of the file, read strictly: what is missing, wrong or unknown is an InputError with its place."""

    def __init__(self, values: dict[str, Any], place: str):
        if not isinstance(values, dict):
            raise InputError(f"{place}: expected is a table")
        self._values, self._place, self._known = values, place, set()

    def problem(self, key: str, what: str):
        return InputError(f"{self._place}{'.' if self._place and key else ''}{key}: {what}")

    def take(self, key: str, kind: type | tuple[type, ...], what: str, default: Any = ...) -> Any:
        self._known.add(key)
        if key not in self._values:
            if default is ...:
                raise self.problem(key, f"is missing; expected is {what}")
            return default
        value = self._values[key]
        if not isinstance(value, kind) or isinstance(value, bool):
            raise self.problem(key, f"is {value!r}; expected is {what}")
        return value

    def text(self, key: str, default: Any = ...) -> str:
        return self.take(key, str, "a text", default)

    def number(self, key: str, default: Any = ...) -> float:
        return float(self.take(key, (int, float), "a number", default))

    def quantity(self, key: str, default: Any = ...) -> tuple[float, str]:
        """Number and unit of a number or of a text such as "2 nN"."""
        value = self.take(key, (int, float, str), 'a number or a quantity such as "2 nN"', default)
        if value is default:
            return default
        match = re.fullmatch(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(.*)", str(value), re.DOTALL)
        try:
            return float(match[1]), match[2].strip()
        except (TypeError, ValueError):
            raise self.problem(key, f"is {value!r}; expected is a number or a quantity such as '2 nN'") from None

    def tables(self, key: str) -> list[Table]:
        values = self.take(key, list, f"tables [[{self._place + '.' if self._place else ''}{key}]]", [])
        return [Table(v, f"{self._place}{'.' if self._place else ''}{key}[{k}]") for k, v in enumerate(values)]

    def table(self, key: str) -> Table:
        return Table(self.take(key, dict, "a table"), f"{self._place}.{key}")

    def done(self) -> None:
        for key in self._values:
            if key not in self._known:
                raise self.problem(key, f"is unknown; known are {', '.join(sorted(self._known))}")


def read_fit_file(path: str | os.PathLike[str]) -> FitFile:
    """Reads a fit from its TOML file; files that it names are relative to it. Raises InputError with file, key,
    what was found and what is expected, and FileError."""
    path = pathlib.Path(path)
    try:
        root = Table(tomllib.loads(text_of(path)), "")
    except (OSError, ValueError) as error:
        raise (FileError if isinstance(error, OSError) else InputError)(f"{path}: {error}") from None
    try:
        scenes = [_scene(table, path.parent) for table in root.tables("scene")]
        parameters = [_parameter(table) for table in root.tables("parameter")]
        fit = FitFile(path, root.text("title", path.stem), scenes, parameters)
        root.done()
        if not scenes or not any(scene.data for scene in scenes):
            raise InputError("scene: expected is a table [[scene]] with measured data")
        if not parameters:
            raise InputError("parameter: expected is a table [[parameter]]")
        names = [parameter.name for parameter in parameters]
        if len(set(names)) < len(names):
            raise InputError(f"parameter: two have the same name; there are {', '.join(names)}")
        return fit
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def _scene(table: Table, folder: pathlib.Path) -> Scene:
    file = folder / table.text("file")
    if not file.is_file():
        raise table.problem("file", f"there is no '{file}'")
    settings = [f"{key}={to_value(value, key)}" for key, value in table.take("set", dict, "a table", {}).items()]
    curves = [_curve(t, folder) for t in table.tables("curve")]
    values = [_value(t) for t in table.tables("value")]
    table.done()
    return Scene(file, settings, curves + values)


def _window(table: Table) -> dict[str, Any]:
    begin, end = table.number("from", -np.inf), table.number("to", np.inf)
    if not begin < end:
        raise table.problem("from", f"is {begin:g} and 'to' is {end:g}; expected is a time before it")
    return {"begin": begin, "end": end, "stage": table.text("stage", "")}


def _curve(table: Table, folder: pathlib.Path) -> Data:
    file, columns = folder / table.text("file"), {}
    try:
        columns = columns_of(file)
    except (OSError, ValueError) as error:
        raise table.problem("file", str(error)) from None

    def axis(key):
        inner = table.table(key)
        of, column, unit = inner.text("of"), inner.text("column"), inner.text("unit", "")
        inner.done()
        if column not in columns:
            raise table.problem(f"{key}.column", f"{file} has no column '{column}'; it has {', '.join(columns)}")
        return Axis(of, unit), columns[column]

    (x, places), (y, values) = axis("x"), axis("y")
    errors = _errors(table, y, values, columns, file)
    data = Data(file.stem, y, values, errors, x, places, **_window(table))
    table.done()
    return data


def _value(table: Table) -> Data:
    value, unit = table.quantity("value")
    reduce = table.text("reduce", "last")
    if reduce not in REDUCTIONS:
        raise table.problem("reduce", f"is '{reduce}'; expected is one of {', '.join(REDUCTIONS)}")
    axis, values = Axis(table.text("of"), unit), np.array([value])
    data = Data(axis.of, axis, values, _errors(table, axis, values, {}, None), reduce=reduce, **_window(table))
    table.done()
    return data


def _errors(table: Table, y: Axis, values: np.ndarray, columns: dict[str, np.ndarray], file) -> np.ndarray | None:
    """Standard errors: a quantity, a share such as "2 %" of each value, or the name of a column."""
    given = table.take("error", (int, float, str), 'a quantity, a share such as "2 %", or a column', None)
    if given is None:
        return None
    if given in columns:
        errors = columns[given]
    elif isinstance(given, str) and not re.match(r"\s*[-+.\d]", given):
        raise table.problem("error", f"{file} has no column '{given}'; it has {', '.join(columns)}")
    else:
        number, unit = table.quantity("error")
        if unit not in ("%", y.unit, ""):
            raise table.problem("error", f"has the unit '{unit}'; expected is that of the values, '{y.unit}', or %")
        errors = np.abs(values) * number / 100 if unit == "%" else np.full(len(values), number)
    if not (errors > 0).all():
        raise table.problem("error", f"is {errors.min():g} for one of the values; expected are errors > 0")
    return errors


def _parameter(table: Table) -> Parameter:
    keys = table.take("keys", list, 'a list of keys of the scenes, such as ["body.bar.material.mu"]')
    if not keys or not all(isinstance(key, str) for key in keys):
        raise table.problem("keys", f"is {keys}; expected is a list of keys of the scenes")
    start, unit = table.quantity("start")
    bounds = []
    for key, default in (("low", -np.inf), ("high", np.inf)):
        bound, of_bound = table.quantity(key, (default, unit))
        if of_bound != unit:
            raise table.problem(key, f"has the unit '{of_bound}'; expected is that of start, '{unit}'")
        bounds.append(bound)
    low, high = bounds
    if not low < start < high:
        raise table.problem("start", f"is {start:g}; expected is a number between low, {low:g}, and high, {high:g}")
    scale = table.text("scale", "log" if start > 0 and (low > 0 or low == -np.inf) else "linear")
    if scale not in ("log", "linear") or (scale == "log" and not (start > 0 and (low > 0 or low == -np.inf))):
        raise table.problem("scale", f"is '{scale}'; expected is linear, or log with numbers > 0")
    name = table.text("name", keys[0].rpartition(".")[2])
    table.done()
    return Parameter(name, keys, unit, start, 0.0 if scale == "log" and low == -np.inf else low, high, scale == "log")


def columns_of(file: pathlib.Path) -> dict[str, np.ndarray]:
    """The columns of a CSV file by their names in its first line. Lines that begin with # are left out. Raises
    OSError and ValueError."""
    lines = [(k, line) for k, line in enumerate(text_of(file).splitlines(), 1) if line.strip() and line.lstrip()[0] != "#"]
    if len(lines) < 2:
        raise ValueError(f"{file} has no rows; expected are a line with names of columns, and rows of numbers")
    names, *rows = ([cell.strip() for cell in row] for row in csv.reader(line for _, line in lines))
    for (number, _), row in zip(lines[1:], rows):
        if len(row) != len(names):
            raise ValueError(f"{file}:{number} has {len(row)} cells; expected are {len(names)}, one per column")
        for name, cell in zip(names, row):
            try:
                finite = np.isfinite(float(cell))
            except ValueError:
                finite = False
            if not finite:
                raise ValueError(f"{file}:{number}: '{cell}' of column '{name}' is no number")
    return dict(zip(names, np.array(rows, dtype=float).T))
