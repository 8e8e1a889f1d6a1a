#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drops at rest on a plane with a wetting interaction of finite range: the references of the tests
of `physics/contact/bent_line.hpp`, with SciPy's integrators.

The meridian of a drop of surface tension 1 is followed from its apex to the film, on which it ends
parallel to the plane. Its sphere beyond the range has Young's angle at the depth `depth` below the
film (2D: circle), on the radius `radius`; `beyond` is this radius minus that of a disk (2D: half of
the length) of the area energy / adhesion.

Prints the values as JSON; tests/data/bent_line.json is this output.
"""

import json
import math

from scipy.integrate import solve_ivp
from scipy.optimize import brentq

ACCURATE = {"rtol": 1e-11, "atol": 1e-13, "method": "DOP853"}


def contact(t):
    """The part of the adhesion at the height t over the film, in ranges, and its derivative."""
    if t <= 0:
        return 1, 0
    if t >= 1:
        return 0, 0
    return 1 - t**3 * (10 - 15 * t + 6 * t * t), -30 * t * t * (1 - t) ** 2


def meridian(dimension, theta, ell, sphere, apex):
    """The end of the meridian whose apex has the height `apex`: radius, height, and area in
    contact between the end and the apex."""
    W = 1 + math.cos(theta)
    round_ = dimension - 2

    def rates(_, y):
        r, h, psi = y[:3]
        part, slope = contact(h / ell)
        across = round_ * (1 / sphere if r < 1e-9 else math.sin(psi) / r)
        along = (1 + round_) / sphere - across - W * slope / ell
        return [math.cos(psi), -math.sin(psi), along,
                -part * math.cos(psi) * (2 * math.pi * r if dimension == 3 else 1)]  # fmt: skip

    def on_film(_, y):
        return y[2] - math.pi

    def below(_, y):
        return y[1] + ell

    on_film.terminal = below.terminal = True
    end = solve_ivp(rates, [0, 20 * sphere], [0, apex, 0, 0], events=[on_film, below],
                    max_step=ell / 10, **ACCURATE)  # fmt: skip
    return end.y[:, -1]


def bent_line(dimension, degrees, ell, sphere):
    theta = math.radians(degrees)
    cap = sphere * (1 - math.cos(theta))
    # A higher apex ends higher.
    apex = brentq(lambda z: meridian(dimension, theta, ell, sphere, z)[1],
                  cap - 1.4 * ell, cap + 1.4 * ell, xtol=1e-13)  # fmt: skip
    r, _, _, area = meridian(dimension, theta, ell, sphere, apex)
    radius = sphere * math.sin(theta)
    disk = math.sqrt(r * r + area / math.pi) if dimension == 3 else r + area
    return {"dimension": dimension, "angle": degrees, "range": ell, "radius": radius,
            "depth": cap - apex, "beyond": radius - disk}  # fmt: skip


cases = [bent_line(3, degrees, ell, sphere)
         for degrees, sphere in ((30, 4), (60, 1.86), (90, 1.26), (120, 1.06), (150, 1.006))
         for ell in (0.157, 0.0785)]  # fmt: skip
cases += [bent_line(2, degrees, 0.157, sphere) for degrees, sphere in ((60, 2.25), (120, 1.11))]
print(json.dumps(cases, indent=1))
