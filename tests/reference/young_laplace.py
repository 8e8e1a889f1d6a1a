#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Drops at rest by the equation of Young and Laplace: the references of the tests of
`measure/young_laplace.hpp` and of `study sharp_line`, with SciPy's integrators.

- Sessile and hanging drops of the volume of the unit ball on a plane: base radius, height, and
  energy of the surface and of the weight over the surface tension.
- Bridges of the volume pi between plates at the distance 1: radii on both plates, pressure and
  force on a plate, over the surface tension.

Prints the values as JSON; tests/data/young_laplace.json is this output.
"""

import json
import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, fsolve

ACCURATE = {"rtol": 1e-12, "atol": 1e-14, "method": "DOP853"}


def meridian_of_drop(k, bond, theta):
    """Until the tangent has the angle theta, from the apex, where the curvature is k: radius,
    depth, volume, area, integral of the depth over the volume."""

    def rates(_, y):
        r, z, phi = y[:3]
        across = k if r < 1e-9 else math.sin(phi) / r
        slice_ = math.pi * r * r * math.sin(phi)
        return [math.cos(phi), math.sin(phi), 2 * k + bond * z - across, slice_,
                2 * math.pi * r, slice_ * z]  # fmt: skip

    def at_wall(_, y):
        return y[2] - theta

    at_wall.terminal, at_wall.direction = True, 1
    s = 1e-6
    start = [s, k * s * s / 2, k * s, math.pi * k * s**4 / 4, math.pi * s * s, 0]
    profile = solve_ivp(rates, [s, 60 / k], start, events=at_wall, **ACCURATE)
    if not len(profile.t_events[0]):
        return None  # a hanging drop may have a neck and no end
    end = profile.y[:, -1]
    return end[0], end[1], end[3], end[4], end[5]


def drop(degrees, bond, volume=4 * math.pi / 3):
    theta = math.radians(degrees)
    c = math.cos(theta)

    def misfit(log_k):
        end = meridian_of_drop(math.exp(log_k), bond, theta)
        return math.log(end[2] / volume) if end else math.inf

    radius = (3 * volume / (math.pi * (2 + c) * (1 - c) ** 2)) ** (1 / 3)
    # The flatter the apex, the larger the drop.
    low = high = -math.log(radius)
    while bond >= 0 and misfit(low) < 0:
        low -= 0.3
    while misfit(high) > 0:
        low, high = (high, high + 0.01) if bond < 0 else (low, high + 0.01)
    a, h, V, area, moment = meridian_of_drop(math.exp(brentq(misfit, low, high, xtol=1e-15)), bond,
                                             theta)  # fmt: skip
    energy = area - c * math.pi * a * a + bond * (h * V - moment)
    return {"degrees": degrees, "bond": bond, "base_radius": a, "height": h, "energy": energy}


def bridge(below, above, gap=1.0, volume=math.pi):
    first, last = math.radians(below), math.radians(above)

    def end(unknown):
        a, pressure = unknown

        def rates(_, y):
            r, _, psi, _ = y
            return [math.cos(psi), math.sin(psi), pressure - math.sin(psi) / r,
                    math.pi * r * r * math.sin(psi)]  # fmt: skip

        def at_plate(_, y):
            return y[1] - gap

        at_plate.terminal, at_plate.direction = True, 1
        return solve_ivp(rates, [0, 10], [a, 0, math.pi - first, 0], events=at_plate, **ACCURATE).y[:, -1]

    def misfit(unknown):
        y = end(unknown)
        return [y[2] - last, y[3] - volume]

    unknown = fsolve(misfit, [1.0, 0.5], xtol=1e-13)
    if not np.allclose(misfit(unknown), 0, atol=1e-9):
        raise SystemExit(f"no bridge was found for {below} and {above} degrees")
    a, pressure = unknown
    force = 2 * math.pi * a * math.sin(first) - pressure * math.pi * a * a
    return {"below": below, "above": above, "radius_below": a, "radius_above": end(unknown)[0],
            "pressure": pressure, "force": force}  # fmt: skip


def main():
    drops = [drop(degrees, bond) for degrees in (15, 30, 60, 90, 120, 150) for bond in (0, 0.3, 1, 3)]
    hanging = [drop(degrees, -0.3) for degrees in (30, 60, 90)]
    bridges = [bridge(60, 60), bridge(90, 60)]
    print(json.dumps({"drops": drops + hanging, "bridges": bridges}, indent=1))


if __name__ == "__main__":
    main()
