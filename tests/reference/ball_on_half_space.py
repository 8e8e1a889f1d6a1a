#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pull-off of a rigid ball from an elastic half space with the Lennard-Jones law: the reference of
`study pull_off_map`, by boundary elements that share no code with the program.

Linear elasticity of the half space (rings of uniform pressure, elliptic integrals), a frictionless
surface, and the traction of two half spaces at the gap g,
    8 W/(3 g*) [(g*/g)^3 - (g*/g)^9]
as in Greenwood (1997) and Feng (2000) for paraboloids; here the gap is that of a ball. Equilibria
are followed by arc length, through unstable ones: where the distance of the ball turns
back, a moved ball jumps. R = E* = 1, W = (tabor g*)^(3/2).

Usage: ball_on_half_space.py [--gap G] [--rings N] [--paraboloid] [--until D] [--curve] TABOR...
Prints for each Tabor number the largest pull over 2 pi W R (stiff: 1, soft: 0.75) and the value of
Maugis and Dugdale, distances in g* at which the ball jumps in and off, and the energy lost in a
cycle.
"""

import argparse

import numpy as np
from scipy.linalg import lu_factor, lu_solve
from scipy.special import ellipe, ellipk


def disc(r, a):
    """Displacement at r by a uniform pressure 1 within the radius a, E* = 1."""
    k = np.where(r < a, r / a, a / r) ** 2
    return 4 / np.pi * np.where(r < a, a * ellipe(k), r * (ellipe(k) - (1 - k) * ellipk(k)))


class Ball:
    def __init__(self, tabor, gap, rings, paraboloid):
        self.gap, self.W = gap, (tabor * gap) ** 1.5
        contact = (9 * np.pi * self.W / 8) ** (1 / 3)  # contact radius of soft balls at the largest pull
        even = max(1.9 * contact, 2 * np.sqrt(gap))
        far = min(0.99, max(12 * np.sqrt(gap), 5 * contact))
        edges = np.concatenate([np.linspace(0, even, rings),
                                np.geomspace(even, far, rings // 4)[1:]])  # fmt: skip
        self.r = (edges[1:] + edges[:-1]) / 2
        discs = disc(self.r[:, None], edges[None, 1:])
        self.K = discs.copy()
        self.K[:, 1:] -= discs[:, :-1]
        self.area = np.pi * (edges[1:] ** 2 - edges[:-1] ** 2)
        r2 = self.r**2
        self.shape = r2 / 2 if paraboloid else r2 / (1 + np.sqrt(1 - r2))

    def tension(self, g):
        x, scale = self.gap / g, 8 * self.W / (3 * self.gap)
        return scale * (x**3 - x**9), -scale / self.gap * (3 * x**4 - 9 * x**10)

    def corrected(self, y, along):
        """The equilibrium (gaps, distance), in units of `unit`, near y in the plane normal to
        `along`, and the direction of the curve there; None if Newton's method needs more than a
        few iterations."""
        n = len(self.r)
        start = y
        J = np.empty((n + 1, n + 1))
        for _ in range(8):
            g, d = y[:n] * self.unit[:n], y[n] * self.gap
            if g.min() < 0.3 * self.gap:
                return None
            tension, slope = self.tension(g)
            f = g - d - self.shape + self.K @ tension
            J[:n, :n] = np.eye(n) + self.K * slope
            J[:n, n] = -1
            J[:n] *= self.unit
            J[n] = along
            factors = lu_factor(J)
            if np.abs(f).max() < 1e-10 * self.gap:
                turned = lu_solve(factors, np.append(np.zeros(n), 1.0))
                return y, turned / np.linalg.norm(turned)
            y = y - lu_solve(factors, np.append(f, along @ (y - start)))
        return None

    def curve(self, start, until):
        """Distances, pulls and gaps in the middle, from the distance `start` to `until`, in g*."""
        n = len(self.r)
        self.unit = np.append(np.full(n, np.sqrt(n)), 1.0) * self.gap
        fixed = np.append(np.zeros(n), 1.0)
        y = np.append(start * self.gap + self.shape, start * self.gap) / self.unit
        y, along = self.corrected(y, fixed)
        along, step, way = -along, 0.1, []
        while True:
            g = y[:n] * self.unit[:n]
            way.append((y[n], self.area @ self.tension(g)[0], g[0]))
            if y[n] < until or len(way) > 5000:
                return np.array(way)
            while True:
                found = self.corrected(y + step * along, along)
                if found and found[1] @ along > 0.99:
                    break
                step /= 2
                if step < 1e-7:
                    raise RuntimeError(f"lost at the distance {y[n]:.4g} g*")
            y, along = found
            step = min(1.5 * step, 0.3)


def maugis(tabor):
    """Pull-off over 2 pi W R (Maugis 1992)."""
    lam = 1.157 * tabor
    m = 1 + 10 ** np.linspace(-6, 4, 20001)
    s, angle = np.sqrt(m * m - 1), np.arccos(1 / m)
    A = lam / 2 * ((m * m - 2) * angle + s)
    B = 4 * lam * lam / 3 * (s * angle - m + 1)
    a = (-B + np.sqrt(B * B + 4 * A)) / (2 * A)
    return (lam * a * a * (s + m * m * angle) - a**3).max() / 2


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("tabor", type=float, nargs="+")
    arguments.add_argument("--gap", type=float, default=0.002)
    arguments.add_argument("--rings", type=int, default=300)
    arguments.add_argument("--paraboloid", action="store_true")
    arguments.add_argument("--until", type=float, help="distance in g* at which to end")
    arguments.add_argument("--curve", action="store_true", help="distances and pulls, too")
    a = arguments.parse_args()
    for tabor in a.tabor:
        ball = Ball(tabor, a.gap, a.rings, a.paraboloid)
        way = ball.curve(6 + 3 * tabor, -4 * tabor if a.until is None else a.until)
        d, pull = way[:, 0], way[:, 1] / (2 * np.pi * ball.W)
        k = pull.argmax()
        before, after = pull[k] - pull[k - 1], pull[k] - pull[k + 1]
        most = pull[k] + (before - after) ** 2 / (8 * (before + after))
        jumps = "no jump"
        back = np.nonzero(np.diff(d) > 0)[0]
        if back.size:
            inwards, outwards = slice(0, back[0] + 1), slice(back[-1] + 1, None)
            at = np.linspace(d[back[0]], d[back[-1] + 1], 4001)
            loop = [np.interp(at, d[s][::-1], pull[s][::-1]) for s in (inwards, outwards)]
            lost = np.mean(loop[1] - loop[0]) * (at[-1] - at[0])
            jumps = f"in at {at[0]:.4f}, off at {at[-1]:.4f}, lost {lost:.5g} (2 pi W R g*)"
        print(f"Tabor {tabor:g}: pull-off {most:.5f} at {d[k]:.3f} g*, Maugis-Dugdale "
              f"{maugis(tabor):.5f}, ratio {most / maugis(tabor):.4f}; {jumps}", flush=True)  # fmt: skip
        if a.curve:
            for row in zip(d, pull, way[:, 2] / ball.gap):
                print("  %.5f %.6f %.5f" % row)


if __name__ == "__main__":
    main()
