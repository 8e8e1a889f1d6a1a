# SPDX-License-Identifier: BSD-3-Clause
"""Small scenes for the tests of the package."""
import copy
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tools"))
import shipped  # noqa: E402, F401  pylint: disable=wrong-import-position,unused-import

DROP = ROOT / "tests/data/drop.toml"

# An elastic sheet in 2D with a mass of 2000 kg per metre of depth.
SHEET = {
    "dimension": 2,
    "time": {"end": 10},
    "body": [{
        "name": "sheet", "shape": "rectangle", "size": [1, 2], "cells": [5, 10],
        "material": {"type": "neo_hookean", "density": 1000, "mu": 1e5, "lambda": 1e5},
    }],
}  # fmt: skip


def sheet(**time):
    """The sheet with other keys of [time]."""
    scene = copy.deepcopy(SHEET)
    scene["time"].update(time)
    return scene
