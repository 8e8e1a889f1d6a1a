#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A cylinder pressed on a block in plane strain, both soft, with adhesion: the reference curves of
inputs/contact/cylinder_indentation.toml, by finite elements that share no code with the program.

Quadrilaterals of second order (nine nodes, 3 x 3 Gauss points), the neo-Hookean law mu/2 (I1 - 3 - 2 ln J)
+ lambda/2 (J - 1)^2, contact as the double sum of u(r) n1.n2 over Gauss points of both surfaces (CGCM note,
kernel `integrated`), and Newton's method with the exact tangent and a sparse factorisation. The flat
face of the lower half of the cylinder goes down, the base of the block is held.

Usage: cylinder_on_block.py [--refine N] [--cutoff SIGMAS] [--pressure U]... U...
Prints for each depth U, in this order of loading: force P (push > 0), least gap, energies; for
--pressure U also place and pressure of contact along the surface of the block.
"""

import argparse

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

MU, LAMBDA = 1 / 2.4, 0.2 / (1.2 * 0.6)  # E = 1, nu = 0.2
SIGMA, EPSILON, GAP = 0.15, 1.5, 0.2
TURN = np.array([[0.0, 1.0], [-1.0, 0.0]])  # tangent (counterclockwise) to outer normal


def lagrange(t):
    """Quadratic polynomials of the nodes -1, 0, 1 at t, and their derivatives."""
    return (np.array([t * (t - 1) / 2, 1 - t * t, t * (t + 1) / 2]),
            np.array([t - 0.5, -2 * t, t + 0.5]))  # fmt: skip


class Body:
    """Elements of structured patches [i, j, xy] with odd numbers of nodes; common nodes are merged."""

    def __init__(self, patches, first, points):
        known, elements = {}, []
        for X in patches:
            number = np.array([[known.setdefault(tuple(np.round(x, 8) + 0.0), len(known))
                                for x in row] for row in X])  # fmt: skip
            for i in range(0, X.shape[0] - 1, 2):
                for j in range(0, X.shape[1] - 1, 2):
                    elements.append(number[i : i + 3, j : j + 3].T.ravel())
        self.X, self.first = np.array(list(known)), first
        for k, e in enumerate(elements):
            (ax, ay), (bx, by) = self.X[e[2]] - self.X[e[0]], self.X[e[6]] - self.X[e[0]]
            if ax * by < ay * bx:
                elements[k] = e.reshape(3, 3)[:, ::-1].ravel()
        self.elements = np.array(elements)
        x, w = np.polynomial.legendre.leggauss(3)
        N, dN = np.transpose([lagrange(t) for t in x], (1, 0, 2))
        slope = np.stack([np.einsum("qb,pa->pqba", N, dN), np.einsum("qb,pa->pqba", dN, N)], -1)
        slope = slope.reshape(9, 9, 2)  # [point, node, direction]
        map_ = np.einsum("eai,qak->eqik", self.X[self.elements], slope)
        self.weight = np.linalg.det(map_) * np.outer(w, w).ravel()
        assert self.weight.min() > 0
        self.slope = np.einsum("qak,eqkj->eqaj", slope, np.linalg.inv(map_))
        self.dofs = (2 * (self.elements[:, :, None] + first) + np.arange(2)).reshape(-1, 18)
        self.surface(points)

    def surface(self, points):
        """Matrices of places and of area vectors (before their rotation) of Gauss points."""
        count = {}
        for e in self.elements:
            for side in ((0, 1, 2), (2, 5, 8), (8, 7, 6), (6, 3, 0)):
                count.setdefault(frozenset(e[list(side)]), []).append(e[list(side)])
        edges = np.array([found[0] for found in count.values() if len(found) == 1])
        nodes, local = np.unique(edges, return_inverse=True)
        x, w = np.polynomial.legendre.leggauss(points)
        N, dN = np.transpose([lagrange(t) for t in x], (1, 0, 2))
        rows = np.arange(len(edges) * points).reshape(len(edges), points, 1)
        columns = local.reshape(len(edges), 1, 3)
        self.place = np.zeros((rows.size, len(nodes)))
        self.tangent = self.place.copy()
        self.place[rows, columns] = N
        self.tangent[rows, columns] = dN * w[:, None]
        self.surface_dofs = (2 * (nodes[:, None] + self.first) + np.arange(2)).ravel()

    def strain(self, x):
        """Energy, forces and stiffness per element; None if an element is inverted."""
        F = np.einsum("eai,eqaj->eqij", x[self.dofs].reshape(-1, 9, 2), self.slope)
        J = np.linalg.det(F)
        if J.min() <= 0:
            return None
        cof = np.stack([np.stack([F[..., 1, 1], -F[..., 1, 0]], -1),
                        np.stack([-F[..., 0, 1], F[..., 0, 0]], -1)], -2)  # fmt: skip
        W = MU / 2 * ((F**2).sum((2, 3)) - 2 - 2 * np.log(J)) + LAMBDA / 2 * (J - 1) ** 2
        pressure = LAMBDA * (J - 1) - MU / J
        w, g = self.weight, self.slope
        P = MU * F + pressure[..., None, None] * cof
        force = np.einsum("eq,eqij,eqaj->eai", w, P, g).reshape(-1, 18)
        dJ = np.einsum("eqij,eqaj->eqai", cof, g).reshape(*J.shape, 18)
        K = np.einsum("eq,eqa,eqb->eab", w * (LAMBDA + MU / J**2), dJ, dJ)
        K = K.reshape(-1, 9, 2, 9, 2)
        isotropic = np.einsum("eq,eqaj,eqbj->eab", MU * w, g, g)
        K[:, :, 0, :, 0] += isotropic
        K[:, :, 1, :, 1] += isotropic
        turned = np.einsum("eq,eqa,eqb->eab", w * pressure, g[..., 0], g[..., 1])
        turned -= turned.transpose(0, 2, 1)
        K[:, :, 0, :, 1] += turned
        K[:, :, 1, :, 0] -= turned
        return (w * W).sum(), force, K.reshape(-1, 18, 18)


def pair(r, cutoff):
    """u(r), u' and u'' of two surface elements, switched off between 3/4 of the cut-off and the cut-off."""
    x = (SIGMA / r) ** 6
    u = EPSILON * np.pi * r**3 * (x / 12 - 7 / 2304 * x**2)
    du = EPSILON * np.pi * r**2 * (7 / 256 * x**2 - x / 4)
    ddu = EPSILON * np.pi * r * (x - 70 / 256 * x**2)
    if cutoff:
        width = cutoff / 4
        t = np.clip((r - 3 * width) / width, 0, 1)
        Q = 1 - t**3 * (10 - 15 * t + 6 * t**2)
        dQ = -30 * t**2 * (1 - t) ** 2 / width
        ddQ = -60 * t * (1 - t) * (1 - 2 * t) / width**2
        u, du, ddu = u * Q, du * Q + u * dQ, ddu * Q + 2 * du * dQ + u * ddQ
    return u, du, ddu


class Contact:
    """Energy, forces [body] and stiffness [body][body] of two surfaces."""

    def __init__(self, bodies, x, cutoff, stiffness):
        coefficients = [x[b.surface_dofs].reshape(-1, 2) for b in bodies]
        self.y = [b.place @ c for b, c in zip(bodies, coefficients)]
        self.area = V = [b.tangent @ c @ TURN.T for b, c in zip(bodies, coefficients)]
        way = self.y[0][:, None] - self.y[1]
        r = np.linalg.norm(way, axis=2)
        self.gap = r.min()
        u, du, ddu = pair(r, cutoff)
        k, both = way / r[..., None], V[0] @ V[1].T
        self.energy = (u * both).sum()
        # Pressure on points of the first body: - sum psi (y2 - y1).V2, their energy per volume.
        self.pressure = np.einsum("ij,ijk,jk->i", du, k, V[1])
        self.force = []
        for b, sign, other in ((0, 1, 1), (1, -1, 0)):
            T = sign * np.einsum("ij,ij,ijk->" + "ij"[b] + "k", du, both, k)
            S = (u if b == 0 else u.T) @ V[other]
            self.force.append((bodies[b].place.T @ T + bodies[b].tangent.T @ S @ TURN).ravel())
        if not stiffness:
            return
        first, second = bodies
        M = np.einsum("ij,ijk,ijl->ijkl", (ddu - du / r) * both, k, k)
        M += (du / r * both)[..., None, None] * np.eye(2)
        q = du[..., None] * k
        turned = [v @ TURN for v in V]

        def between(A, form, B):
            return np.einsum("ia,ijkl,jb->akbl", A, form, B, optimize=True)

        def within(A, form, B):
            return np.einsum("ia,ikl,ib->akbl", A, form, B, optimize=True)

        c = within(first.place, np.einsum("ijk,jl->ikl", q, turned[1]), first.tangent)
        K11 = within(first.place, M.sum(1), first.place) + c + c.transpose(2, 3, 0, 1)
        c = within(second.place, -np.einsum("ijk,il->jkl", q, turned[0]), second.tangent)
        K22 = within(second.place, M.sum(0), second.place) + c + c.transpose(2, 3, 0, 1)
        K12 = -between(first.place, M, second.place)
        K12 += between(first.place, np.einsum("ijk,il->ijkl", q, turned[0]), second.tangent)
        K12 -= between(first.tangent, np.einsum("ijl,jk->ijkl", q, turned[1]), second.place)
        areas = first.tangent.T @ u @ second.tangent
        for i in range(2):
            K12[:, i, :, i] += areas
        n1, n2 = (b.surface_dofs.size for b in bodies)
        K12 = K12.reshape(n1, n2)
        self.stiffness = [[K11.reshape(n1, n1), K12], [K12.T, K22.reshape(n2, n2)]]


class System:
    def __init__(self, refine, cutoff):
        self.cutoff = cutoff
        points = 5
        self.block = Body([block(refine)], 0, points)
        self.cylinder = Body(half_disk(3 * refine, 2 * refine), len(self.block.X), points)
        self.bodies = [self.block, self.cylinder]
        self.X = np.concatenate([b.X for b in self.bodies])
        self.base = np.flatnonzero(np.abs(self.X[:, 1] + 5) < 1e-9)
        self.grip = np.flatnonzero(np.abs(self.X[:, 1] - 1 - GAP) < 1e-9)
        held = np.concatenate([self.base, self.grip])
        self.free = np.setdiff1d(np.arange(self.X.size), (2 * held[:, None] + [0, 1]).ravel())

    def at(self, x, stiffness=True):
        """Total energy, forces, stiffness; None if an element is inverted or the gap is too small."""
        contact = Contact(self.bodies, x, self.cutoff, stiffness)
        strain = [b.strain(x) for b in self.bodies]
        if contact.gap < 0.3 * SIGMA or None in strain:
            return None
        self.contact, self.strain_energy = contact, sum(s[0] for s in strain)
        force = np.zeros(x.size)
        rows, columns, values = [], [], []
        for b, (_, f, K) in zip(self.bodies, strain):
            np.add.at(force, b.dofs, f)
            rows.append(np.repeat(b.dofs, 18, 1).ravel())
            columns.append(np.tile(b.dofs, (1, 18)).ravel())
            values.append(K.ravel())
        for a in range(2):
            force[self.bodies[a].surface_dofs] += contact.force[a]
            for b in range(2 if stiffness else 0):
                i, j = self.bodies[a].surface_dofs, self.bodies[b].surface_dofs
                rows.append(np.repeat(i, j.size))
                columns.append(np.tile(j, i.size))
                values.append(contact.stiffness[a][b].ravel())
        K = None
        if stiffness:
            entries = (np.concatenate(rows), np.concatenate(columns))
            K = sparse.csc_matrix((np.concatenate(values), entries), (x.size, x.size))
        return self.strain_energy + contact.energy, force, K

    def rest(self, x):
        """The equilibrium found from x by decreasing the energy."""
        for _ in range(60):
            E, force, K = self.at(x)
            r = -force[self.free]
            if np.abs(r).max() < 1e-11:
                return x
            K = K[self.free][:, self.free]
            step = splu(K).solve(r)
            if r @ step < 0:  # the direction is still downhill
                step = splu(K + 0.3 * abs(K.diagonal()).mean() * sparse.identity(r.size)).solve(r)
            a = min(1, 0.03 / np.abs(step).max())
            while True:
                trial = x.copy()
                trial[self.free] += a * step
                found = self.at(trial, False)
                if found and (found[0] <= E - 1e-4 * a * (r @ step) + 1e-13 or a < 1e-6):
                    break
                a /= 2
            x = trial
        raise RuntimeError("no equilibrium")

    def follow(self, depths):
        """States at the given depths, with steps of at most 0.02."""
        x, before, now = self.X.ravel(), None, 0.0
        for depth in depths:
            pieces = max(1, int(np.ceil(abs(depth - now) / 0.02 - 1e-9)))
            for u in now + (depth - now) * np.arange(1, pieces + 1) / pieces:
                guess = x.copy()
                if before is not None and (u - now) * (now - before[1]) > 0:
                    guess += (x - before[0]) * (u - now) / (now - before[1])
                else:
                    guess[2 * self.cylinder.first + 1 :: 2] -= u - now
                guess[2 * self.grip + 1] = self.X[self.grip, 1] - u
                before, now = (x, now), u
                x = self.rest(guess)
            E, force, _ = self.at(x)
            yield depth, E, -force[2 * self.grip + 1].sum()


def block(refine):
    """A block of 10 x 5, with elements of 0.12 / refine under the cylinder and larger ones elsewhere."""

    def growing(length, n, ratio):
        sizes = ratio ** np.arange(n)
        return np.concatenate([[0], np.cumsum(sizes) / sizes.sum()]) * length

    outside = 1.2 + growing(3.8, 5 * refine, 1.6 ** (1 / refine))
    inside = np.linspace(-1.2, 1.2, 20 * refine + 1)
    x = np.concatenate([-outside[:0:-1], inside, outside[1:]])
    y = -growing(5, 8 * refine, 1.5 ** (1 / refine))[::-1]
    with_middles = [np.interp(np.arange(2 * t.size - 1) / 2, np.arange(t.size), t) for t in (x, y)]
    return np.stack(np.meshgrid(*with_middles, indexing="ij"), -1)


def half_disk(core, rings):
    """The lower half of the cylinder: a core of 2 core x core elements inside rings."""
    u, v = np.linspace(-1, 1, 4 * core + 1), np.linspace(0, 1, 2 * core + 1)

    def inside(u, v):
        return 0.45 * np.array([u * (1.12 - 0.12 * v * v), v * (1.12 - 0.12 * u * u)])

    square = np.array([[inside(a, b) for b in v] for a in u])
    rim = np.concatenate([square[-1], square[-2::-1, -1], square[0, -2::-1]])
    angle = np.linspace(0, np.pi, len(rim))[:, None]
    arc = np.concatenate([np.cos(angle), np.sin(angle)], 1)
    share = 1 - (1 - np.linspace(0, 1, 2 * rings + 1)) ** 1.5
    ring = np.stack([(1 - s) * rim + s * arc for s in share], 1)
    return [[0, 1 + GAP] + patch * [1, -1] for patch in (square, ring)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--refine", type=int, default=1)
    parser.add_argument("--cutoff", type=float, default=6, help="in sigma0; 0: none")
    parser.add_argument("--pressure", type=float, action="append", default=[])
    parser.add_argument("depths", type=float, nargs="+")
    options = parser.parse_args()
    system = System(options.refine, options.cutoff * SIGMA)
    print(f"# {system.X.size} unknowns, {[len(b.place) for b in system.bodies]} points of contact")
    print("# depth, P, gap, energy, strain energy, contact energy")
    for depth, E, P in system.follow(options.depths):
        contact = system.contact
        print(f"{depth:.4f} {P:.7g} {contact.gap:.6g} {E:.7g} {system.strain_energy:.7g} "
              f"{contact.energy:.7g}", flush=True)  # fmt: skip
        if depth in options.pressure:
            for y, p in sorted(zip(contact.y[0].tolist(), contact.pressure)):
                if abs(y[0]) < 1.2 and y[1] > -1:
                    print(f"pressure {depth:.4f} {y[0]:.5f} {p:.6g}")


if __name__ == "__main__":
    main()
