# SPDX-License-Identifier: BSD-3-Clause
"""A run in progress."""

from __future__ import annotations

import importlib
import os
import weakref
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .pictures import html_table
from .scene import to_toml, to_value

if TYPE_CHECKING:
    from ._meniscus import Snapshot

__all__ = ["Run"]

Array = NDArray[np.float64]
Path = str | os.PathLike[str]


def _extension():
    """The extension module. Raises ImportError, which says how to build it."""
    # Threads of OpenMP that wait spin for microseconds, as in the program; read when it is loaded.
    waits = not {"GOMP_SPINCOUNT", "OMP_WAIT_POLICY"} & os.environ.keys()
    if waits:
        os.environ["GOMP_SPINCOUNT"] = "5000"
    try:
        return importlib.import_module("meniscus._meniscus")
    except ModuleNotFoundError as error:
        raise ImportError(
            "meniscus.Run needs the extension module, which is not built: build it by 'tools/run --python' "
            "in the source tree, or by cmake with -DMENISCUS_PYTHON=ON"
        ) from error
    finally:
        if waits:
            del os.environ["GOMP_SPINCOUNT"]


class Run:
    """A run in progress, with the same steps, bit for bit, as those of `meniscus run`.

    scene: the path of a scene file, or a dictionary with the keys of a scene. Quantities with units are
        texts ("2 nm"), and tables of numbers may be numpy arrays.
    set: changes of the scene by the path of the key, as of `meniscus run --set`:
        {"body[0].radius": "2 nm", "time.end": 3}.
    threads: number of threads that compute; by default as many as there are cores (OMP_NUM_THREADS).
        Results do not depend on it.

    All numbers are in the units of the scene. The interpreter is free for other threads while a run
    computes, so that several runs in several threads compute at the same time. One run is used by one
    thread at a time, otherwise its functions raise RuntimeError. Ctrl-C raises KeyboardInterrupt between
    two steps, and the run may go on afterwards.

    Raises InputError, SolveError and FileError, with the messages of the program, and ImportError if the
    extension module is not built.
    """

    def __init__(
        self,
        scene: Path | Mapping[str, Any],
        set: Mapping[str, Any] | None = None,  # pylint: disable=redefined-builtin
        *,
        threads: int | None = None,
    ):
        if isinstance(scene, (str, os.PathLike)):
            self._begin(os.fspath(scene), False, set, threads)
        else:
            self._begin(to_toml(scene), True, set, threads)

    @classmethod
    def from_text(
        cls,
        toml: str,
        set: Mapping[str, Any] | None = None,  # pylint: disable=redefined-builtin
        *,
        threads: int | None = None,
    ) -> Run:
        """A run of a scene that is given as TOML text."""
        run = cls.__new__(cls)
        run._begin(toml, True, set, threads)
        return run

    def _begin(self, scene, is_text, changes, threads):
        overrides = [f"{key}={to_value(value, key)}" for key, value in (changes or {}).items()]
        if threads is not None and threads < 1:
            raise ValueError(f"threads is {threads}; expected is 1 or more")
        self._forces = []
        self._run = _extension().Run(scene, is_text, overrides, threads or 0)

    @property
    def dimension(self) -> int:
        """2 or 3; 2 also for bodies of revolution, in the half plane."""
        return self._run.dimension()

    @property
    def time(self) -> float:
        """The time of the present state."""
        return self._run.time()

    @property
    def steps(self) -> int:
        """The number of steps that were made."""
        return self._run.steps()

    @property
    def finished(self) -> bool:
        """True if the end of the scene, or the rest that its solver looks for, is reached."""
        return self._run.finished()

    @property
    def bodies(self) -> list[str]:
        """The names of the bodies."""
        return self._run.bodies()

    @property
    def measures(self) -> list[str]:
        """The names of all measures, such as "drop.aspect"."""
        return self._run.measures()

    def step(self) -> None:
        """Makes one step. After a SolveError, or an error in a force function, further steps raise
        SolveError until a state is restored."""
        self._run.step()

    def advance_to(self, time: float) -> None:
        """Makes steps until this time, or the end of the scene, is reached or passed."""
        self._run.advance_to(time)

    def measure(self, name: str) -> float:
        """The present value of a measure."""
        return self._run.measure(name)

    def unit(self, measure: str) -> str:
        """The unit of a measure; "1" for a pure number."""
        return self._run.unit(measure)

    def fields(self, body: str) -> list[str]:
        """The names of the fields of a body: "position", "displacement", "velocity", "mass", and those of
        its material and loads, such as "pressure"."""
        return self._run.fields(body)

    def field(self, body: str, name: str) -> Array:
        """The values of a field at the particles of a body, [particle] or [particle, component]; tensors have 9
        components, row by row. The array is new and owns its data: values at particles are sums over
        coefficients, which the run does not store. Changing it does not change the run."""
        return self._run.field(body, name)

    def field_unit(self, body: str, name: str) -> str:
        """The unit of a field."""
        return self._run.field_unit(body, name)

    def energies(self) -> dict[str, float]:
        """The energies by name: "kinetic", the stored ones such as "strain" and "surface", and "dissipated",
        "external_work" and "remapped" since the start. kinetic + stored + dissipated - external_work -
        remapped is constant, up to errors of the time steps."""
        return self._run.energies()

    def add_force(self, body: str, function: Callable[[float, Array, Array], Any]) -> None:
        """Adds forces on the particles of a body from the present state on.

        function(time, positions, velocities) returns the forces [particle, i]; positions and velocities are
        arrays [particle, i] of its own. It must depend on its arguments only, since it is also called for
        trial positions that the run never takes. A force acts at the position of its particle. Its work
        is booked as external work, and the stable step takes it into account. A result of another shape
        or with NaN fails the step with SolveError. `newton` refuses a scene with such a force, since
        nothing says that it has an energy.
        """
        number, this = len(self._forces), weakref.ref(self)
        self._forces.append(function)  # here, where the collector of cycles sees it

        def force(time, positions, velocities):
            return this()._forces[number](time, positions, velocities)

        try:
            self._run.add_force(body, force)
        except BaseException:
            self._forces.pop()
            raise

    def snapshot(self) -> Snapshot:
        """The whole present state, in memory. Its `hash` is equal for equal states. Force functions are not in
        it."""
        return self._run.snapshot()

    def restore(self, snapshot: Snapshot) -> None:
        """Continues from a snapshot of this run, or of another run of the same scene, bit for bit."""
        self._run.restore(snapshot)

    def save(self, directory: Path) -> None:
        """Writes a checkpoint, from which load() and `meniscus run SCENE --restart DIRECTORY` continue."""
        self._run.save(os.fspath(directory))

    def load(self, directory: Path) -> None:
        """Continues from the newest checkpoint in a directory, which a run of the same scene has written."""
        self._run.load(os.fspath(directory))

    def __repr__(self):
        return f"<meniscus.Run of {', '.join(self.bodies)}: step {self.steps}, t = {self.time:g}>"

    def _repr_html_(self):
        rows = [("time", f"{self.time:g}"), ("steps", self.steps), ("bodies", ", ".join(self.bodies))]
        rows += [(f"energy: {name}", f"{value:.6g}") for name, value in self.energies().items()]
        return html_table(rows)
