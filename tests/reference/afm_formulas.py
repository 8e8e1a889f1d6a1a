#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Modulus and adhesion that the formulas of Hertz, of Hertz on a layer (Dimitriadis et al. 2002, nu = 0.45, bonded) and
of Johnson, Kendall and Roberts find in the curves inputs/fits/afm_tabor_*.csv, whose true values are E = 1 and the
w below. The distance at which the ball would touch is a further unknown. Hertz is fitted to the part that pushes.

Usage: afm_formulas.py"""

import pathlib

import numpy as np
from scipy.optimize import least_squares

FITS = pathlib.Path(__file__).resolve().parents[2] / "inputs" / "fits"
NU, THICKNESS = 0.45, 0.4
TRUE = {"01": 2.06e-4, "1": 0.0065}
# alpha and beta of Dimitriadis for a bonded layer
ALPHA = -(1.2876 - 1.4678 * NU + 1.3442 * NU**2) / (1 - NU)
BETA = (0.6387 - 1.0277 * NU + 1.5164 * NU**2) / (1 - NU)


def hertz(depth, E, layer=False):
    depth = np.maximum(depth, 0)
    x, factor = np.sqrt(depth), 1
    if layer:
        y = x / THICKNESS
        factor = (1 - 2 * ALPHA / np.pi * y + 4 * ALPHA**2 / np.pi**2 * y**2
                  - 8 / np.pi**3 * (ALPHA**3 + 4 * np.pi**2 / 15 * BETA) * y**3
                  + 16 * ALPHA / np.pi**4 * (ALPHA**3 + 3 * np.pi**2 / 5 * BETA) * y**4)  # fmt: skip
    return 4 / 3 * E / (1 - NU**2) * x**3 * factor


def jkr(depth, E, w):
    """Force on the ball on the branch that is stable at a given distance."""
    stiff = E / (1 - NU**2)
    radius = np.linspace(1e-3, 1, 4000) ** 2
    way = radius**2 - np.sqrt(2 * np.pi * w * radius / stiff)
    force = 4 / 3 * stiff * radius**3 - np.sqrt(8 * np.pi * w * stiff * radius**3)
    first = np.argmin(way)
    return np.interp(depth, way[first:], force[first:])


def errors(name, true):
    z, force = np.loadtxt(FITS / f"afm_tabor_{name}.csv", delimiter=",", skiprows=2).T
    push = -force
    size, middle = np.abs(push).max(), z[np.argmin(np.abs(push))]
    part = push > 0

    def fitted(model, start, use):
        return least_squares(lambda q: (model(q[0] - z[use], *np.exp(q[1:])) - push[use]) / size,
                             [middle, *np.log(start)], x_scale=[0.01, *np.ones(len(start))]).x  # fmt: skip

    rows = [("Hertz", np.exp(fitted(hertz, [1], part)[1]), None),
            ("Hertz, layer", np.exp(fitted(lambda d, E: hertz(d, E, True), [1], part)[1]), None)]  # fmt: skip
    E, w = np.exp(fitted(jkr, [1, true], np.full(len(z), True))[1:])
    for label, modulus, adhesion in [*rows, ("JKR", E, w)]:
        off = "" if adhesion is None else f"{100 * (adhesion / true - 1):+8.1f} %"
        print(f"afm_tabor_{name:3} {label:14} E {100 * (modulus - 1):+8.1f} %   w {off}")
    print(f"afm_tabor_{name:3} {'largest pull':14} w {100 * (force.max() / (1.5 * np.pi * true) - 1):+8.1f} % (JKR) "
          f"{100 * (force.max() / (2 * np.pi * true) - 1):+8.1f} % (Bradley)")  # fmt: skip


for name, true in TRUE.items():
    errors(name, true)
