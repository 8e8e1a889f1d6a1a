#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A bar of a viscoelastic solid with free sides: the references of inputs/solids/viscoelastic_bar.toml.

The solid is neo-Hookean (P = mu (F - F^-T) + lambda (J - 1) cof F) with branches of Maxwell, whose
conformations b follow the upper-convected equation. Along the axes of a bar,

    dA/dt = (J^(2/3)/l^2 - A)/time,   P = m J^(-2/3) (l A - (A : C)/(3 l)),   b = l^2 J^(-2/3) A.

The stretch across makes the stress of the sides zero at each time. Prints time, stretch, stretch across,
nominal stress P, work per volume, energy and heat of the motion of the scene: pulled at a constant
rate to 1.5 in the time 1, then held."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

MU, LAMBDA = 1.0, 20.0
BRANCHES = ((1.0, 0.5), (0.5, 4.0))  # modulus, time
LONG, RAMP = 1.5, 1.0


def stretch(t):
    return 1 + (LONG - 1) * min(t / RAMP, 1)


def stress(along, across, states):
    """Nominal stresses along and across."""
    J = along * across * across
    shrunk = J ** (-2 / 3)
    P = [MU * (x - 1 / x) + LAMBDA * (J - 1) * J / x for x in (along, across)]
    for (m, _), (a, q) in zip(BRANCHES, states):
        contracted = (a * along**2 + 2 * q * across**2) / 3
        P[0] += m * shrunk * (along * a - contracted / along)
        P[1] += m * shrunk * (across * q - contracted / across)
    return P


def across_of(along, states):
    return brentq(lambda q: stress(along, q, states)[1], 0.5, 1.5, xtol=1e-15)


def rates(t, y):
    """Of the states of all branches, of the work and of the heat."""
    states = y[:-2].reshape(-1, 2)
    along = stretch(t)
    across = across_of(along, states)
    grown = (along * across * across) ** (2 / 3)
    relaxed = np.array([grown / along**2, grown / across**2])
    slope = [(relaxed - state) / time for (_, time), state in zip(BRANCHES, states)]
    heat = 0
    for (m, time), (a, q) in zip(BRANCHES, states):
        x, z = a / relaxed[0], q / relaxed[1]
        heat += m / (2 * time) * (x + 1 / x + 2 * (z + 1 / z) - 6)
    speed = (LONG - 1) / RAMP if t < RAMP else 0
    return [*np.ravel(slope), speed * stress(along, across, states)[0], heat]


def energy(along, across, states):
    J = along * across * across
    trace = along**2 + 2 * across**2
    total = MU / 2 * (trace - 3 - 2 * np.log(J)) + LAMBDA / 2 * (J - 1) ** 2
    for (m, _), (a, q) in zip(BRANCHES, states):
        total += m / 2 * ((a * along**2 + 2 * q * across**2) / J ** (2 / 3) - 3 - np.log(a * q * q))
    return total


def main():
    y = np.r_[np.ones(2 * len(BRANCHES)), 0, 0]
    for begin, end, times in ((0.0, RAMP, (0.5, 1.0)), (RAMP, 6.0, (1.5, 2.0, 4.0, 6.0))):
        found = solve_ivp(rates, (begin, end), y, method="DOP853", t_eval=times, rtol=1e-12, atol=1e-13)
        for t, values in zip(found.t, found.y.T):
            states = values[:-2].reshape(-1, 2)
            across = across_of(stretch(t), states)
            print(f"{t:4.1f} {stretch(t):.3f} {across:.9f} {stress(stretch(t), across, states)[0]:.9f} "
                  f"{values[-2]:.9f} {energy(stretch(t), across, states):.9f} {values[-1]:.9f}")  # fmt: skip
        y = found.y[:, -1]


if __name__ == "__main__":
    main()
