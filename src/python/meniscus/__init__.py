# SPDX-License-Identifier: BSD-3-Clause
"""Meniscus in Python: runs in progress and results.

    import meniscus

    run = meniscus.Run("drop.toml", set={"body[0].radius": "2 nm"})    # or a dictionary
    run.advance_to(10)
    run.measure("drop.aspect"), run.field("drop", "velocity")

    results = meniscus.open("results/drop")        # the directory of a run, also of one that goes on
    results.history["drop.aspect"]                 # over results.history["time"]
    results.frame(-1).field("pressure", "drop")    # at the particles, in the last frame

    meniscus.fit("fit.toml")["gamma"]              # parameters from measurements

Reading results needs numpy and h5py only. meniscus.Run needs the extension module, which
`tools/run --python` builds.
"""

from .errors import Error, FileError, InputError, SolveError
from .fitting import Fit, fit
from .results import Results
from .results import open_results as open  # pylint: disable=redefined-builtin
from .run import Run
from .scene import to_toml

__all__ = ["Error", "FileError", "Fit", "InputError", "Results", "Run", "SolveError", "fit", "open", "to_toml"]
