#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the data of inputs/fits, with noise of a fixed seed: forces of bars in uniaxial tension from closed forms;
the base of a drop that spreads, and forces on a ball on a layer, from runs with finer cells than the scenes of the
fits have. The oscillation of a drop is an exact solution (tests/cli/test_fit.py).

Usage: fit_data.py PROGRAM [NAME...]"""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import scipy.optimize

ROOT = pathlib.Path(__file__).resolve().parents[2]
FITS = ROOT / "inputs" / "fits"
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "src" / "python"))
from meniscus.results import read_history  # noqa: E402

NOISE = 0.02


def neo_hookean(s, a, mu=200.0, lame=500.0):
    """Energy per volume of P = mu (F - F^-T) + lambda (J - 1) cof F at the stretches s along and a across the bar."""
    J = s * a * a
    return mu * ((s * s + 2 * a * a - 3) / 2 - np.log(J)) + lame * (J - 1) ** 2 / 2


def mooney_rivlin(s, a, c1=70.0, c2=30.0, lame=150.0):
    """W = c1 (I1 - 3 J^(2/3)) + c2 (I2 - 3 J^(4/3)) + lambda/2 (ln J^2)^2"""
    J = s * a * a
    first, second = s * s + 2 * a * a, 2 * s * s * a * a + a**4
    return c1 * (first - 3 * J ** (2 / 3)) + c2 * (second - 3 * J ** (4 / 3)) + lame / 2 * np.log(J * J) ** 2


def uniaxial(energy, s):
    """Force per area of the reference, and stretch across, with free sides."""
    step = 1e-30
    across = scipy.optimize.brentq(lambda a: energy(s, a + step * 1j).imag, 0.5, 1, xtol=1e-14)
    return energy(s + step * 1j, across).imag / step, across


def tension(energy, seed):
    """A bar of 4 mm x 1 mm x 1 mm: force with noise of 2 %, width with noise of 0.003 mm."""
    random = np.random.default_rng(seed)
    rows = []
    for s in np.linspace(1.05, 2, 20):
        force, across = uniaxial(energy, s)  # in kPa, so that the force is in mN
        rows.append((4 * (s - 1), force * (1 + NOISE * random.standard_normal()), across + 0.003 * random.standard_normal()))
    return "extension,force,width", rows


def history(program, scene, *options):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "run", FITS / scene, "--quiet", "--output", f"{folder}/out", *options], check=True)
        return read_history(pathlib.Path(folder) / "out" / "history.csv")[0]


def spreading(program):
    """Radius of the base by four times as many cells, with noise of 2 % of its way."""
    run = history(program, "spreading_drop.toml", "--refine", "2")
    random = np.random.default_rng(7)
    base = run["wall.base_radius"]
    base = base + NOISE * (base[-1] - base[0]) * random.standard_normal(len(base))
    return "time,base", list(zip(run["time"], base))[2::2]


def afm(program, settings):
    """Forces while the ball is withdrawn, with noise of 2 % of the largest pull. Prints both."""
    sets = [word for setting in settings for word in ("--set", setting)]
    run = history(program, "afm_layer.toml", "--refine", "2", "--set", "time.step=0.03125", "--set",
                  "output.history_every=0.03125", *sets)  # fmt: skip
    random = np.random.default_rng(11)
    back = run["time"] > 0.25
    z, force = run["ball.displacement_y"][back], run["ball.force_y"][back]
    noise = NOISE * force.max()
    print(f"largest pull {force.max():.6g}, noise {noise:.6g}")
    return "z,force", list(zip(z, force + noise * random.standard_normal(len(force))))


DATA = {
    "tension_neo_hookean": lambda program: tension(neo_hookean, 1),
    "tension_mooney_rivlin": lambda program: tension(mooney_rivlin, 2),
    "spreading": spreading,
    "afm_tabor_01": lambda program: afm(program, ["constants.w=2.06e-4", "constants.up=0.03"]),
    "afm_tabor_1": lambda program: afm(program, []),
}


def main():
    program, *names = sys.argv[1:]
    for name in names or DATA:
        header, rows = DATA[name](program)
        doc = f"# Made by tests/reference/fit_data.py {name}."
        lines = [doc, header, *(",".join(f"{x:.6g}" for x in row) for row in rows)]
        (FITS / f"{name}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
