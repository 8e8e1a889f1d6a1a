# SPDX-License-Identifier: BSD-3-Clause
"""The values of measured data by runs of scenes, for given parameters."""

from __future__ import annotations

import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import threading

import numpy as np

from .errors import Error, FileError, InputError, SolveError
from .fit_file import REDUCTIONS, Data, FitFile, Scene
from .results import read_history, text_of

Pair = tuple[np.ndarray, np.ndarray, float]  # two points, and how far apart they are
BESIDE = "; beside"  # ends the keys of points that a run has followed


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
        self._alone = set()  # scenes whose equilibria cannot be followed
        self._kept = directory / "evaluations.json"
        self._inputs = self._hash()
        self._known = self._read()

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
        return sum(not key.endswith(BESIDE) for key in self._known)

    def values(self, points: list[np.ndarray], refine: float = 1, beside: list[np.ndarray] = ()) -> list[np.ndarray | Error]:
        """The values at several points, whose runs are made at the same time: an error for a point at which a
        run fails. Runs through equilibria also follow those of the points `beside`, which are near."""
        numbers = range(len(self.request.scenes))
        failures = self._make([(point, number) for point in points for number in numbers], refine, beside)
        found = []
        for point in points:
            keys = [self._key(point, number, refine) for number in numbers]
            failed = [failures[key] for key in keys if key in failures]
            found.append(failed[0] if failed else np.concatenate([self._known[key] for key in keys]))
        return found

    def derivatives(self, near: list[Pair], far: list[Pair]) -> np.ndarray:
        """Derivatives of all values, [value, pair]: differences over the pairs `near`, where a run has followed
        their equilibria, and otherwise over the pairs `far`, by runs. Raises the error of a run that fails."""
        numbers = range(len(self.request.scenes))
        followed = [all(self._key(p, n, 1) + BESIDE in self._known for pair in near for p in pair[:2]) for n in numbers]
        failures = self._make([(p, n) for pair in far for p in pair[:2] for n in numbers if not followed[n]])
        for failure in failures.values():
            raise failure
        parts = []
        for number in numbers:
            pairs, mark = (near, BESIDE) if followed[number] else (far, "")
            ends = [[np.array(self._known[self._key(p, number, 1) + mark]) for p in pair[:2]] for pair in pairs]
            parts.append([(above - below) / pair[2] for (below, above), pair in zip(ends, pairs)])
        return np.concatenate(parts, axis=1).T

    def _make(self, wanted, refine=1, beside=()):
        """Makes the runs of pairs (point, number of the scene) that are not known; returns errors by key."""
        jobs, failures = {}, {}
        for point, number in wanted:
            key = self._key(point, number, refine)
            if key not in self._known and key not in jobs:
                jobs[key] = self._pool.submit(self._run, number, point, refine, beside)
        for key, job in jobs.items():
            try:
                self._keep(job.result())
            except (SolveError, OutOfReach) as error:
                failures[key] = error
        return failures

    def _key(self, point, number, refine):
        texts = [parameter.text(x) for parameter, x in zip(self.request.parameters, point)]
        return "; ".join([f"scene {number}", *texts, f"refine {refine:g}"])

    def _keep(self, values):
        with self._lock:
            self._known |= values
            made = self._kept.with_suffix(".new")
            made.write_text(json.dumps({"inputs": self._inputs, "values": self._known}), encoding="utf-8")
            os.replace(made, self._kept)

    def settings(self, point: np.ndarray) -> list[str]:
        """What a point changes in a scene, "key=value"."""
        return [f"{key}={parameter.text(x)}" for parameter, x in zip(self.request.parameters, point) for key in parameter.keys]

    def words(self, scene: Scene, point: np.ndarray, refine: float, output: pathlib.Path) -> list[str]:
        """The command line of a run."""
        words = [self.program, "run", str(scene.file), "--quiet", "--overwrite", "--output", str(output)]
        words += ["--threads", str(self.threads)]
        for setting in scene.settings + self.settings(point):
            words += ["--set", setting]
        return words + (["--refine", f"{refine:g}"] if refine != 1 else [])

    def _run(self, number, point, refine, beside):
        """Values by key. A scene whose equilibria cannot be followed is run alone from then on."""
        scene, key = self.request.scenes[number], self._key(point, number, refine)
        if beside and scene.finds_equilibria and number not in self._alone:
            try:
                first, *others = self._results(scene, point, refine, beside)
                return {key: first} | {self._key(p, number, refine) + BESIDE: v for p, v in zip(beside, others)}
            except InputError:
                self._alone.add(number)
            except (SolveError, OutOfReach):
                pass
        return {key: self._results(scene, point, refine, [])[0]}

    def _results(self, scene, point, refine, beside):
        """The values of a run, and those of the points that it follows."""
        with tempfile.TemporaryDirectory(prefix="run-", dir=self.directory) as folder:
            output = pathlib.Path(folder)
            words = self.words(scene, point, refine, output)
            for near in beside:
                words += ["--beside", "; ".join(self.settings(near))]
            with self._lock:
                if self._stopped:
                    raise Stopped("stopped")
                process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                self._going.add(process)
            with process:
                said = process.communicate()[1].strip()
            self._going.discard(process)
            if process.returncode not in (0, 7):
                self._raise(process.returncode, said, point)
            files = ["history.csv"] + [f"beside-{k}.csv" for k in range(1, len(beside) + 1)]
            return [self._compared(scene, output, file) for file in files]

    def _raise(self, code, said, point):
        if code < 0 or code > 128 or self._stopped:
            raise Stopped(f"a run was stopped by signal {abs(code) % 128}")
        values = zip(self.request.parameters, point)
        at = ", ".join(f"{p.name} = {p.text(x)}" for p, x in values)
        kind = {3: InputError, 4: SolveError, 5: FileError}.get(code, SolveError)
        raise kind(f"with {at}: {said or f'the run ended with exit code {code}'}")

    def _compared(self, scene, output, file):
        """The values of the run that belong to the measured ones, in the units of the data."""
        values = []
        for data in scene.data:
            history, units = read_history(output / data.stage / file)
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
    """The values of a history at the places of the data, in the units of the data. Between records, curves are
    cubic and as monotonic as the records."""
    from scipy.interpolate import PchipInterpolator  # pylint: disable=import-outside-toplevel

    y = column(data.y.of, history) * factor(units[data.y.of], data.y.unit, data.name)
    times = history["time"]
    shown = (times >= data.begin) & (times <= data.end)
    if shown.sum() < (1 if data.x is None else 2):
        raise InputError(f"{data.name}: the run has {shown.sum()} records between the times {data.begin:g} and {data.end:g}; "
                         "expected are more")  # fmt: skip
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
    return PchipInterpolator(x[order], y[shown][order])(data.places)


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
