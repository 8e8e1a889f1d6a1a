# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of scenes from measurements, by nonlinear least squares."""

from __future__ import annotations

import concurrent.futures
import dataclasses
import functools
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from .errors import Error, FileError, InputError, SolveError
from .fit_file import REDUCTIONS, Data, FitFile, Parameter, Scene, read_fit_file
from .results import read_history, text_of

STEP = 0.01  # of the differences: a share of the parameter
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


class Stopped(Error):
    """The fit was stopped from outside. The same request goes on."""


class Model:
    """The values of all data for given parameters, by runs of the program. Each run is made once: values are
    kept in `directory` for the case that the fit is stopped."""

    def __init__(self, request: FitFile, program: str, directory: pathlib.Path, parallel: int, threads: int):
        self.request, self.program, self.directory = request, program, directory
        self.threads = threads or max(1, (os.cpu_count() or 1) // parallel)
        self._pool = concurrent.futures.ThreadPoolExecutor(parallel)
        self._going, self._lock, self._stopped = set(), threading.Lock(), False
        self._kept = directory / "evaluations.json"
        self._inputs = self._hash()
        self._known = self._read()
        self.units = {}  # of data: those of the history

    def _hash(self):
        texts = [text_of(self.request.path)] + [text_of(scene.file) for scene in self.request.scenes]
        data = [repr(d.values.tolist()) + repr(None if d.places is None else d.places.tolist())
                for scene in self.request.scenes for d in scene.data]  # fmt: skip
        return hashlib.sha256("\0".join(texts + data).encode()).hexdigest()

    def _read(self):
        if not self._kept.is_file():
            return {}
        kept = json.loads(text_of(self._kept))
        if kept.get("inputs") != self._inputs:
            raise InputError(f"{self.directory} has runs of another fit; another directory or overwriting begins anew")
        return kept["values"]

    @property
    def runs(self) -> int:
        return len(self._known)

    def values(self, points: list[np.ndarray], refine: float = 1) -> list[np.ndarray | Error]:
        """The values at several points, whose runs are made at the same time: an error for a point at which a
        run fails."""
        jobs = {}
        for point in points:
            for number, scene in enumerate(self.request.scenes):
                key = self._key(point, number, refine)
                if key not in self._known and key not in jobs:
                    jobs[key] = self._pool.submit(self._run, scene, point, refine)
        failures = {}
        for key, job in jobs.items():
            try:
                self._keep(key, job.result())
            except (SolveError, OutOfReach) as error:
                failures[key] = error
        return [self._assembled(point, refine, failures) for point in points]

    def _assembled(self, point, refine, failures):
        keys = [self._key(point, number, refine) for number in range(len(self.request.scenes))]
        return next((failures[k] for k in keys if k in failures), None) or np.concatenate([self._known[k] for k in keys])

    def _key(self, point, number, refine):
        texts = [parameter.text(x) for parameter, x in zip(self.request.parameters, point)]
        return "; ".join([f"scene {number}", *texts, f"refine {refine:g}"])

    def _keep(self, key, values):
        with self._lock:
            self._known[key] = values
            made = self._kept.with_suffix(".new")
            made.write_text(json.dumps({"inputs": self._inputs, "values": self._known}), encoding="utf-8")
            os.replace(made, self._kept)

    def words(self, scene: Scene, point: np.ndarray, refine: float, output: pathlib.Path) -> list[str]:
        """The command line of a run."""
        words = [self.program, "run", str(scene.file), "--quiet", "--overwrite", "--output", str(output)]
        words += ["--threads", str(self.threads)]
        for setting in scene.settings:
            words += ["--set", setting]
        for parameter, x in zip(self.request.parameters, point):
            for key in parameter.keys:
                words += ["--set", f"{key}={parameter.text(x)}"]
        return words + (["--refine", f"{refine:g}"] if refine != 1 else [])

    def _run(self, scene, point, refine):
        with tempfile.TemporaryDirectory(prefix="run-", dir=self.directory) as folder:
            output = pathlib.Path(folder)
            with self._lock:
                if self._stopped:
                    raise Stopped("stopped")
                process = subprocess.Popen(
                    self.words(scene, point, refine, output), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
                )
                self._going.add(process)
            with process:
                said = process.communicate()[1].strip()
            self._going.discard(process)
            if process.returncode not in (0, 7):
                self._raise(process.returncode, said, point)
            return self._compared(scene, output)

    def _raise(self, code, said, point):
        if code < 0 or code > 128 or self._stopped:
            raise Stopped(f"a run was stopped by signal {abs(code) % 128}")
        values = zip(self.request.parameters, point)
        at = ", ".join(f"{p.name} = {p.text(x)}" for p, x in values)
        kind = {3: InputError, 4: SolveError, 5: FileError}.get(code, SolveError)
        raise kind(f"with {at}: {said or f'the run ended with exit code {code}'}")

    def _compared(self, scene, output):
        """The values of the run that belong to the measured ones, in the units of the data."""
        values = []
        for data in scene.data:
            history, units = read_history(output / data.stage / "history.csv")
            values += list(compared(data, history, units))
        return values

    def stop(self):
        """Ends all runs."""
        with self._lock:
            self._stopped = True
            for process in self._going:
                process.terminate()
        self._pool.shutdown(cancel_futures=True)

    def keep_runs(self, point: np.ndarray):
        """Makes the runs at a point once more, each in a directory that stays."""
        for number, scene in enumerate(self.request.scenes):
            folder = self.directory / (scene.file.stem if len(self.request.scenes) == 1 else f"{scene.file.stem}-{number}")
            shutil.rmtree(folder, ignore_errors=True)
            subprocess.run(self.words(scene, point, 1, folder), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)


class OutOfReach(Error):
    """A run ends before the data do."""


def compared(data: Data, history: dict[str, np.ndarray], units: dict[str, str]) -> np.ndarray:
    """The values of a history at the places of the data, in the units of the data."""
    y = column(data.y.of, history) * factor(units[data.y.of], data.y.unit, data.name)
    times = history["time"]
    shown = (times >= data.begin) & (times <= data.end)
    if not shown.any():
        raise InputError(f"{data.name}: the run has no record between the times {data.begin:g} and {data.end:g}")
    if data.x is None:
        return np.array([REDUCTIONS[data.reduce](y[shown])])
    x = (column(data.x.of, history) * factor(units[data.x.of], data.x.unit, data.name))[shown]
    steps = np.diff(x)
    if not ((steps > 0).all() or (steps < 0).all()):
        raise InputError(f"{data.name}: {data.x.of} of the run does not only rise or only fall; 'from' and 'to' choose times "
                         "between which it does")  # fmt: skip
    low, high = min(x[0], x[-1]), max(x[0], x[-1])
    margin = 1e-9 * (high - low)
    if data.places.min() < low - margin or data.places.max() > high + margin:
        raise OutOfReach(f"{data.name}: {data.x.of} of the run is between {low:.6g} and {high:.6g}, but the data reach from "
                         f"{data.places.min():.6g} to {data.places.max():.6g}")  # fmt: skip
    order = np.argsort(x)
    return np.interp(data.places, x[order], y[shown][order])


def column(name: str, history: dict[str, np.ndarray]) -> np.ndarray:
    if name not in history:
        raise InputError(f"the run has no column '{name}'; it has {', '.join(history)}")
    return history[name]


def factor(unit: str, wanted: str, name: str) -> float:
    """By which numbers in `unit` are multiplied to be in `wanted`."""
    if wanted in ("", unit):
        return 1.0
    units = _units()
    try:
        return units.Quantity(1, unit).to(wanted).magnitude
    except (ValueError, AttributeError, TypeError) as error:
        raise InputError(f"{name}: the run has numbers in '{unit}', which are none in '{wanted}': {error}") from None


@functools.cache
def _units():
    import pint  # pylint: disable=import-outside-toplevel

    return pint.UnitRegistry()


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
    """(value of the model - measured value) / error, and their derivatives by z, by central differences."""

    def __init__(self, model: Model, scales: Scales, data: list[Data], told: Callable[[str], None]):
        self.model, self.scales, self.told = model, scales, told
        self.measured = np.concatenate([d.values for d in data])
        self.errors = weights_of(data)

    def at(self, z, refine=1.0):
        """Raises the error of a run that fails."""
        values = self.model.values([self.scales.p(z)], refine)[0]
        if isinstance(values, Error):
            raise values
        return (values - self.measured) / self.errors

    def tried(self, z):
        """NaN where a run fails: the next trial is closer to the last good one."""
        values = self.model.values([self.scales.p(z)])[0]
        good = not isinstance(values, Error)
        residuals = (values - self.measured) / self.errors if good else np.full(len(self.measured), np.nan)
        shown = ", ".join(f"{p.name} = {p.text(x)}" for p, x in zip(self.model.request.parameters, self.scales.p(z)))
        self.told(f"{shown}: " + (f"{np.sqrt(np.mean(residuals**2)):.4g}" if good else f"a run failed ({values})"))
        return residuals

    def slopes(self, z):
        n, points = len(z), []
        below = np.maximum(z - STEP, self.scales.low)
        above = np.minimum(z + STEP, self.scales.high)
        for k in range(n):
            for end in (below, above):
                points.append(self.scales.p(np.where(np.arange(n) == k, end, z)))
        values = self.model.values(points)
        for value in values:
            if isinstance(value, Error):
                raise value
        return np.stack([(values[2 * k + 1] - values[2 * k]) / (above[k] - below[k]) / self.errors for k in range(n)], axis=1)


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
