# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of scenes from measurements, by nonlinear least squares."""

from __future__ import annotations

import dataclasses
import json
import os
import pathlib
import shutil
import time
from collections.abc import Callable

import numpy as np

from .errors import Error, FileError, InputError
from .fit_file import Data, Parameter, read_fit_file
from .fit_model import Model

STEP = 0.01  # of the differences of runs: a share of the parameter
SMALL_STEP = 1e-4  # of the differences of equilibria, whose errors are a millionth of those of other runs
INDISTINGUISHABLE = 0.99  # correlation of two parameters


@dataclasses.dataclass
class Found:
    """A parameter that was found."""

    name: str
    value: float
    unit: str
    deviation: float  # standard deviation
    at_bound: bool
    by_resolution: float | None  # by how much finer cells would change it


@dataclasses.dataclass
class Curve:
    """Measured values and those of the fit; x is None for a single value."""

    name: str
    x_name: str | None
    y_name: str
    x_unit: str
    y_unit: str
    x: np.ndarray | None
    measured: np.ndarray
    error: np.ndarray | None
    fitted: np.ndarray


@dataclasses.dataclass
class Fit:
    """Result of fit()."""

    title: str
    parameters: list[Found]
    correlation: np.ndarray
    chi_squared: float | None  # sum of (residual / error)^2; None if errors are not known
    freedom: int  # number of measured values - number of parameters
    deviation: float  # root of the mean square of the residuals, relative to errors or largest values
    curves: list[Curve]
    notes: list[str]
    runs: int
    seconds: float

    def __getitem__(self, name: str) -> float:
        """The value of a parameter."""
        for found in self.parameters:
            if found.name == name:
                return found.value
        raise InputError(f"there is no parameter '{name}'; there are {', '.join(p.name for p in self.parameters)}")

    def to_json(self) -> str:
        return json.dumps(dataclasses.asdict(self), indent=1, default=np.ndarray.tolist)


class Scales:
    """Parameters as the numbers z of the least squares: logarithms, or multiples of the start."""

    def __init__(self, parameters: list[Parameter]):
        self.log = np.array([p.log for p in parameters])
        starts = np.array([p.start for p in parameters])
        self.unit = np.where(starts == 0, 1.0, np.abs(starts))
        self.start = self.z(starts)
        self.low, self.high = (self.z(np.array([getattr(p, b) for p in parameters])) for b in ("low", "high"))

    def z(self, p):
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(self.log, np.log(p), p / self.unit)

    def p(self, z):
        return np.where(self.log, np.exp(np.where(self.log, z, 0)), z * self.unit)

    def slope(self, p):
        """dp/dz"""
        return np.where(self.log, p, self.unit)


def weights_of(data: list[Data]) -> np.ndarray:
    """Errors of all values; where they are not known, the largest value of the data."""
    return np.concatenate([np.full(len(d.values), np.abs(d.values).max() or 1.0) if d.errors is None else d.errors for d in data])


class Residuals:
    """(value of the model - measured value) / error, and their derivatives by z."""

    def __init__(self, model: Model, scales: Scales, data: list[Data], told: Callable[[str], None]):
        self.model, self.scales, self.told = model, scales, told
        self.measured = np.concatenate([d.values for d in data])
        self.errors = weights_of(data)

    def at(self, z, refine=1.0):
        """Raises the error of a run that fails."""
        values = self._values(z, refine)
        if isinstance(values, Error):
            raise values
        return (values - self.measured) / self.errors

    def tried(self, z):
        """NaN where a run fails: the next trial is closer to the last good one."""
        values = self._values(z)
        good = not isinstance(values, Error)
        residuals = (values - self.measured) / self.errors if good else np.full(len(self.measured), np.nan)
        shown = ", ".join(f"{p.name} = {p.text(x)}" for p, x in zip(self.model.request.parameters, self.scales.p(z)))
        self.told(f"{shown}: " + (f"{np.sqrt(np.mean(residuals**2)):.4g}" if good else f"a run failed ({values})"))
        return residuals

    def slopes(self, z):
        return self.model.derivatives(self._pairs(z, SMALL_STEP), self._pairs(z, STEP)) / self.errors[:, None]

    def _values(self, z, refine=1.0):
        beside = [point for pair in self._pairs(z, SMALL_STEP) for point in pair[:2]] if refine == 1 else []
        return self.model.values([self.scales.p(z)], refine, beside)[0]

    def _pairs(self, z, step):
        """For each parameter, points that differ in this parameter, and the difference of z."""
        pairs = []
        for k in range(len(z)):
            below, above = max(z[k] - step, self.scales.low[k]), min(z[k] + step, self.scales.high[k])
            ends = [self.scales.p(np.where(np.arange(len(z)) == k, end, z)) for end in (below, above)]
            pairs.append((*ends, above - below))
        return pairs


def fit(
    path: str | os.PathLike[str],
    *,
    directory: str | os.PathLike[str] | None = None,
    program: str | None = None,
    parallel: int = 1,
    threads: int = 0,
    refine: float | None = None,
    most_iterations: int = 30,
    told: Callable[[str], None] = lambda text: None,
) -> Fit:
    """Finds the parameters with which runs of scenes agree best with measured data.

    path: the TOML file that names scenes, data and parameters (`meniscus help measurements`).
    directory: keeps the values of all runs, so that a fit that was stopped goes on, and at the end the runs
        of the parameters that were found; by default `results/NAME-fit`.
    program: the program meniscus; by default the one that is found on the path.
    parallel, threads: runs at the same time, and threads of each.
    refine: also says by how much cells that are finer by this number would change the parameters.
    told: is called with a line for each trial.

    Raises InputError, SolveError, FileError.
    """
    from scipy.optimize import least_squares  # pylint: disable=import-outside-toplevel

    began = time.monotonic()
    request = read_fit_file(path)
    folder = pathlib.Path(directory or pathlib.Path("results") / f"{request.path.stem}-fit")
    folder.mkdir(parents=True, exist_ok=True)
    program = program or shutil.which("meniscus")
    if program is None:
        raise FileError("there is no program 'meniscus' on the path; name it by 'program'")
    data = [d for scene in request.scenes for d in scene.data]
    scales = Scales(request.parameters)
    model = Model(request, program, folder, parallel, threads)
    residuals = Residuals(model, scales, data, told)
    freedom = len(residuals.measured) - len(request.parameters)
    if freedom < 0:
        raise InputError(f"{request.path}: has {len(residuals.measured)} measured values for {len(request.parameters)} parameters; "
                         "expected are at least as many")  # fmt: skip
    try:
        residuals.at(scales.start)
        _require_influence(residuals.slopes(scales.start), request)
        end = least_squares(
            residuals.tried, scales.start, residuals.slopes, bounds=(scales.low, scales.high), x_scale="jac",
            xtol=1e-6, ftol=1e-9, gtol=1e-10, max_nfev=most_iterations,
        )  # fmt: skip
        slopes = residuals.slopes(end.x)
        shift = _shift_by_cells(residuals, slopes, end.x, refine) if refine else None
        fitted = model.values([scales.p(end.x)])[0]
        model.keep_runs(scales.p(end.x))
    finally:
        model.stop()
    result = _result(request, scales, end, slopes, shift, fitted, freedom)
    result.runs, result.seconds = model.runs, time.monotonic() - began
    (folder / "fit.json").write_text(result.to_json(), encoding="utf-8")
    return result


def _require_influence(slopes, request):
    sizes = np.linalg.norm(slopes, axis=0)
    for parameter, size in zip(request.parameters, sizes):
        if not size > 1e-9 * sizes.max() or size == 0:
            raise InputError(f"{request.path}: the parameter '{parameter.name}' has no influence on the data; "
                             "expected are parameters that change them")  # fmt: skip


def _shift_by_cells(residuals, slopes, z, refine):
    """The change of z that makes up for the change of the residuals by finer cells, to first order."""
    change = residuals.at(z, refine) - residuals.at(z)
    return -np.linalg.lstsq(slopes, change, rcond=None)[0]


def _result(request, scales, end, slopes, shift, fitted, freedom) -> Fit:
    data = [d for scene in request.scenes for d in scene.data]
    known = all(d.errors is not None for d in data)
    square = float(np.sum(end.fun**2))
    spread = np.linalg.pinv(slopes.T @ slopes, rcond=1e-14) * (1 if known else square / max(freedom, 1))
    deviations = np.sqrt(np.diag(spread))
    with np.errstate(invalid="ignore", divide="ignore"):
        correlation = spread / np.outer(deviations, deviations)
    p = scales.p(end.x)
    slope = scales.slope(p)
    found = [
        Found(q.name, float(p[k]), q.unit, float(deviations[k] * slope[k]), bool(end.active_mask[k]),
              None if shift is None else float(shift[k] * slope[k]))
        for k, q in enumerate(request.parameters)
    ]  # fmt: skip
    curves, first = [], 0
    for d in data:
        part = fitted[first : first + len(d.values)]
        first += len(d.values)
        curves.append(Curve(d.name, d.x and d.x.of, d.y.of, d.x.unit if d.x else "", d.y.unit, d.places, d.values, d.errors, part))
    return Fit(request.title, found, correlation, square if known else None, freedom, float(np.sqrt(np.mean(end.fun**2))), curves,
               _notes(found, correlation, end, square if known else None, freedom), 0, 0.0)  # fmt: skip


def _notes(found, correlation, end, square, freedom) -> list[str]:
    notes = [] if end.success else ["the number of iterations was not enough; the same request with more goes on"]
    for k, first in enumerate(found):
        if first.at_bound:
            notes.append(f"'{first.name}' is at its bound")
        for j, second in enumerate(found[:k]):
            if abs(correlation[k, j]) > INDISTINGUISHABLE:
                notes.append(f"'{second.name}' and '{first.name}' can hardly be told apart by these data: "
                             f"their correlation is {correlation[k, j]:.4f}")  # fmt: skip
    if square is not None and freedom > 0 and square / freedom > 2:
        notes.append(f"the residuals are {np.sqrt(square / freedom):.2g} times the errors of the data: the scene, or the errors, "
                     "do not describe them")  # fmt: skip
    return notes
