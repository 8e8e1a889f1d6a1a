#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A spherical capsule of radius 1 with a membrane of Skalak (G = C = 1) and a fixed volume, stretched
along its axis by a dead load f cos(theta) per area of the reference: the references of
tests/unit/test_membranes.cpp and of inputs/cells/axisymmetric_capsule.toml.

The meridian r(theta), z(theta) is a sum of harmonics that are symmetric about the equator. Newton's
method finds the stationary point of membrane energy - work of the load - p (volume - 4 pi/3), with
derivatives by complex steps. For surface tensions 0 and 0.3 beside the membrane, each load, and 8, 12
and 16 harmonics, prints: surface tension, load, half of the length, radius at the equator, pressure,
energy, area, least and largest tensions T1 (along the meridian) and T2 (around), and the residual."""

import numpy as np

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(200)
THETA, WEIGHT = (POINTS + 1) * np.pi / 2, WEIGHTS * np.pi / 2
RADIUS = np.sin(THETA)  # of the reference
C = 1.0


def harmonics(n):
    """Values and slopes of r and z by theta, per coefficient."""
    k = 2 * np.arange(n) + 1
    sines, cosines = np.sin(np.outer(THETA, k)), np.cos(np.outer(THETA, k))
    return sines, cosines * k, -cosines, sines * k


def stretches(x, table):
    n = (len(x) - 1) // 2
    r, slope_r, slope_z = table[0] @ x[:n], table[1] @ x[:n], table[3] @ x[n : 2 * n]
    return r, slope_r, slope_z, np.sqrt(slope_r * slope_r + slope_z * slope_z), r / RADIUS


def tensions(along, around, gamma):
    """Derivatives of the energy per reference area by the stretches."""
    change = along * along * around * around - 1
    return (along * (along * along - 1) + C * along * around * around * change + gamma * around,
            around * (around * around - 1) + C * around * along * along * change + gamma * along)  # fmt: skip


def residual(x, f, gamma, table):
    value_r, rate_r, value_z, rate_z = table
    r, slope_r, slope_z, along, around = stretches(x, table)
    first, second = tensions(along, around, gamma)
    p = x[-1]
    of_r = rate_r.T @ (WEIGHT * first * RADIUS * slope_r / along) + value_r.T @ (WEIGHT * (second - p * r * slope_z))
    of_z = (rate_z.T @ (WEIGHT * (first * RADIUS * slope_z / along - p * r * r / 2))
            + value_z.T @ (WEIGHT * f * np.cos(THETA) * RADIUS))  # fmt: skip
    return np.concatenate([of_r, of_z, [(WEIGHT * r * r * slope_z).sum() - 4 / 3]])


def equilibrium(x, f, gamma, table):
    for _ in range(40):
        jacobian = np.array([residual(x + 1e-30j * e, f, gamma, table).imag / 1e-30 for e in np.eye(len(x))]).T
        step = np.linalg.solve(jacobian, -residual(x, f, gamma, table))
        x = x + step * min(1, 0.3 / abs(step[:-1]).max())
        if abs(step).max() < 1e-12:
            break
    return x


def describe(x, f, gamma, table):
    n = (len(x) - 1) // 2
    r, _, _, along, around = stretches(x, table)
    first, second = tensions(along, around, gamma)
    first, second = first / around, second / along
    change = along**2 * around**2 - 1
    density = ((along**2 - 1) ** 2 + (around**2 - 1) ** 2) / 4 + C / 4 * change**2
    radius = (x[:n] * np.sin((2 * np.arange(n) + 1) * np.pi / 2)).sum()
    energy, area = (2 * np.pi * (WEIGHT * a).sum() for a in (RADIUS * density, r * along))
    print(f"{gamma} {f:.3g} {x[n : 2 * n].sum():.8f} {radius:.8f} {x[-1]:.8f} {energy:.8f} {area:.7f} "
          f"T1 {first.min():.4f} {first.max():.4f} T2 {second.min():.4f} {second.max():.4f} "
          f"{abs(residual(x, f, gamma, table)).max():.0e}")  # fmt: skip


for surface_tension in (0.0, 0.3):
    for count in (8, 12, 16):
        rows = harmonics(count)
        shape = np.zeros(2 * count + 1)
        shape[0] = shape[count] = 1
        shape[-1] = 2 * surface_tension
        for load in np.arange(0.05, 1.0001, 0.05):
            shape = equilibrium(shape, load, surface_tension, rows)
            if round(load, 2) in (0.05, 0.5, 1.0):
                describe(shape, load, surface_tension, rows)
