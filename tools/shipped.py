# SPDX-License-Identifier: BSD-3-Clause
"""The scenes of inputs/, which are in folders by field."""

import pathlib

INPUTS = pathlib.Path(__file__).resolve().parents[1] / "inputs"
FIELDS = ("drops", "wetting", "soft_wetting", "contact", "solids", "cells", "elastomers")


def scenes():
    """The files of all scenes, by their names."""
    return sorted((path for field in FIELDS for path in (INPUTS / field).glob("*.toml")), key=lambda path: path.stem)


def scene(name):
    """The file of the scene of that name. Raises ValueError if there is none."""
    for path in scenes():
        if path.stem == name:
            return path
    raise ValueError(f"'{name}' is no scene of inputs/")
