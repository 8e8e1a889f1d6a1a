#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Triangulated surfaces like those of scanners, of a ball of radius 1 or of a red blood cell at rest:
the level set 0 of
    r^2 + (2 z/t)^2 - 1,  t = 2 or 0.207161 + 2.002558 r^2 - 1.122762 r^4,  r^2 = x^2 + y^2
on a lattice. Each cube is cut into six tetrahedra, in which the surface is a plane (marching
tetrahedra). Triangles may be thin and small; the surface is closed.

Usage: level_set_stl.py FILE.stl [--ball] [--cell SIZE]
"""

import argparse
import itertools

import numpy as np


def level(x, ball):
    r2 = x[..., 0] ** 2 + x[..., 1] ** 2
    thickness = 2 + 0 * r2 if ball else 0.207161 + r2 * (2.002558 - 1.122762 * r2)
    return r2 + (2 * x[..., 2] / np.maximum(thickness, 0.05)) ** 2 - 1


def triangles(size, ball):
    """Corner positions [triangle, corner, axis] of triangles oriented outward."""
    counts = np.ceil(np.array([2.3, 2.3, 2.3 if ball else 1.1]) / size).astype(int)
    lattice = np.stack(np.meshgrid(*[np.arange(n + 1) for n in counts], indexing="ij"), -1)
    # Shifts the lattice off the planes of symmetry, where many of its points would lie on the
    # surface.
    x = (lattice - counts / 2 + [0.013, 0.021, 0.037]) * size
    f = level(x, ball)
    found = []
    cubes = lattice[:-1, :-1, :-1].reshape(-1, 3)
    for order in itertools.permutations(range(3)):
        steps = np.vstack([np.zeros(3, int), np.cumsum(np.eye(3, dtype=int)[list(order)], axis=0)])
        corners = cubes[:, None] + steps
        index = tuple(np.moveaxis(corners, -1, 0))
        X, F = x[index], f[index]
        inside = F < 0
        for tetrahedron in np.flatnonzero(inside.any(1) & ~inside.all(1)):
            found += cut(X[tetrahedron], F[tetrahedron])
    return np.array(found)


def cut(X, F):
    """One or two triangles of a tetrahedron, oriented outward."""
    low, high = np.flatnonzero(F < 0), np.flatnonzero(F >= 0)

    def between(i, j):
        i, j = (i, j) if tuple(X[i]) < tuple(X[j]) else (j, i)  # same order of ends for all neighbours
        return X[i] + F[i] / (F[i] - F[j]) * (X[j] - X[i])

    if len(low) == 2:
        a, b, c, d = (between(low[i], high[j]) for i, j in ((0, 0), (0, 1), (1, 1), (1, 0)))
        pieces = [[a, b, c], [a, c, d]]
    else:
        alone, others = (low, high) if len(low) == 1 else (high, low)
        pieces = [[between(alone[0], other) for other in others]]
    out = X[high].mean(0) - X[low].mean(0)
    return [t if np.cross(t[1] - t[0], t[2] - t[0]) @ out > 0 else t[::-1] for t in pieces]


def write(path, places):
    normals = np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    records = np.zeros(len(places), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("unused", "<u2")])
    records["normal"], records["corners"] = normals, places
    with open(path, "wb") as file:
        file.write(b"red blood cell".ljust(80) + np.uint32(len(places)).tobytes() + records.tobytes())


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("file")
    parser.add_argument("--ball", action="store_true")
    parser.add_argument("--cell", type=float, default=0.1, metavar="SIZE")
    arguments = parser.parse_args()
    write(arguments.file, triangles(arguments.cell, arguments.ball))


if __name__ == "__main__":
    main()
