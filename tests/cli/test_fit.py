#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""`meniscus fit`: parameters of synthetic data with noise, their errors, and what is refused.
Usage: test_fit.py PROGRAM"""
import json
import signal
import sys
import time
import unittest
from pathlib import Path

import numpy as np
import scipy.optimize
import scipy.special

import program
from program import ProgramTest

ROOT = Path(__file__).resolve().parents[2]
INPUTS = ROOT / "inputs"
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "src" / "python"))
from meniscus import InputError  # noqa: E402
from meniscus.fit_file import read_fit_file  # noqa: E402
from meniscus.results import read_history  # noqa: E402

program.ENVIRONMENT["OMP_NUM_THREADS"] = "1"

BAR = """
dimension = 3
time = { solver = "newton", end = 1, step = 0.1 }
output = { history_every = 0.1, measures = ["grip.force_x", "grip.displacement_x", "bar.extent_y"] }
[[body]]
name = "bar"
shape = "box"
size = [4, 1, 1]
cells = [4, 2, 2]
material = { type = "neo_hookean", density = 1, mu = 1, lambda = 1.5 }
[[held]]
body = "bar"
face = "x_min"
components = ["x"]
[[held]]
name = "grip"
body = "bar"
face = "x_max"
components = ["x"]
displacement = [0.8, 0, 0]
ramp = [0, 1]
"""

FORCE = """
[[scene.curve]]
file = "tension.csv"
x = { of = "grip.displacement_x", column = "extension", unit = "mm" }
y = { of = "grip.force_x", column = "force", unit = "mN" }
error = "2 %"
"""
WIDTH = """
[[scene.curve]]
file = "tension.csv"
x = { of = "grip.displacement_x", column = "extension", unit = "mm" }
y = { of = "bar.extent_y", column = "width" }
error = 0.001
"""
MU = '[[parameter]]\nkeys = ["body.bar.material.mu"]\nstart = "3 Pa"\nlow = "0.1 Pa"\nhigh = "10 Pa"\n'
LAMBDA = '[[parameter]]\nkeys = ["body.bar.material.lambda"]\nstart = 5\nlow = 0.1\nhigh = 100\n'
FIT = '[[scene]]\nfile = "bar.toml"\n' + FORCE + WIDTH + MU + LAMBDA


def tension(stretch, mu, lame):
    """Force on the undeformed section, and width, of a bar of the neo-Hookean law in uniaxial tension."""
    def side(a):
        return mu * (a - 1 / a) + lame * (stretch * a**2 - 1) * stretch * a
    a = scipy.optimize.brentq(side, 0.5, 1)
    return mu * (stretch - 1 / stretch) + lame * (stretch * a**2 - 1) * a**2, a


def oscillation(t, nu, gamma, mode=2, terms=24):
    """Amplitude a(t)/a(0) of a plane drop of radius and density 1 that begins at rest: the equations in
    inputs/drops/drop_2d.toml, whose Laplace transform is inverted on the contour of Talbot."""
    total = 0
    for j in range(terms):
        angle = (2 * j + 1) * np.pi / (2 * terms)
        s = terms / t * (angle * (1 / np.tan(angle) + 1j)) * 0.8
        slope = terms / t * (1 / np.tan(angle) - angle / np.sin(angle) ** 2 + 1j) * 0.8
        k = np.sqrt(s / nu)
        bessel, its_slope = scipy.special.iv(mode, k), scipy.special.ivp(mode, k)
        matrix = np.array([[s, -mode, -mode * bessel],
                           [0, 2 * mode * (mode - 1), (k**2 + 2 * mode**2) * bessel - 2 * k * its_slope],
                           [gamma * (mode**2 - 1), s + 2 * nu * mode * (mode - 1), 2 * nu * mode * (k * its_slope - bessel)]])
        total += (np.exp(s * t) * np.linalg.solve(matrix, [1, 0, 0])[0] * slope).imag
    return total / terms


LAYER = """
dimension = "axisymmetric"
constants = { E = 1, w = 0.02, gamma = 0, width = 1.2, reach = 0.15 }
time = { solver = "newton", end = 1, step = 0.5 }
output = { history_every = 0.5, measures = ["ball.force_y", "layer.extent_x"] }
[[body]]
name = "layer"
shape = "rectangle"
size = ["width", 0.4]
cells = [8, 3]
centre = ["width/2", 0.2]
material = { type = "neo_hookean", density = 1, youngs_modulus = "E", poissons_ratio = 0.4 }
[[held]]
body = "layer"
face = "y_min"
[[contact]]
name = "ball"
bodies = ["layer"]
interaction = "scaled_lennard_jones"
adhesion = "w"
sigma0 = "reach"
[contact.partner]
type = "ball"
centre = [0, "1.4 + reach"]
radius = 1
displacement = [0, "-0.2*t"]
"""
SKIN = '[[surface]]\nbody = "layer"\nlaw = { type = "neo_hookean_skin", mu = "gamma", lambda = 0.1 }\n'


class Fit(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene(BAR, "bar")
        self.table()

    def table(self, scale=1.0, noise=(0.02, 0.001), text=None):
        random = np.random.default_rng(3)
        rows = ["extension,force,width"]
        for s in np.linspace(1.02, 1.2, 10):
            force, width = tension(s, 1.0, 1.5)
            force *= 1 + noise[0] * random.standard_normal()
            rows.append(f"{4e3 * scale * (s - 1):.6f},{1e3 * force:.6f},{width + noise[1] * random.standard_normal():.6f}")
        (self.directory / "tension.csv").write_text(text or "# made up\n" + "\n".join(rows) + "\n")

    def fit(self, text, *options):
        """What was found, from fit.json, and what was printed."""
        (self.directory / "fit.toml").write_text(text)
        printed = self.call("fit", "fit.toml", "--output", "out", *options).stdout
        found = json.loads((self.directory / "out" / "fit.json").read_text())
        return {p["name"]: p for p in found["parameters"]}, found, printed

    def test_two_moduli_from_a_tension_test(self):
        found, whole, printed = self.fit(FIT, "--parallel", "2", "--refine", "1.5")
        for name, true in (("mu", 1.0), ("lambda", 1.5)):
            self.assertLess(abs(found[name]["value"] - true), 3 * found[name]["deviation"])
            self.assertLess(found[name]["deviation"], 0.05 * true)
            self.assertLess(abs(found[name]["by_resolution"]), 1e-9)  # a uniform state has no error of cells
            self.assertIn(f"\n{name} ", printed)
        self.assertEqual(found["mu"]["unit"], "Pa")
        self.assertLess(whole["chi_squared"] / whole["freedom"], 2)
        self.assertEqual(whole["freedom"], 18)
        self.assertLess(whole["correlation"][0][1], 0)
        self.assertTrue((self.directory / "out" / "bar" / "history.csv").exists())
        self.assertGreater((self.directory / "out" / "fit.png").stat().st_size, 10000)
        # The covariance is that of the formulas.
        step, errors, slopes = 1e-5, [], []
        at = np.array([found["mu"]["value"], found["lambda"]["value"]])
        x, measured = np.array(whole["curves"][0]["x"]), np.array(whole["curves"][0]["measured"])
        for k in range(2):
            up, down = (np.array([tension(1 + e / 4e3, *(at + sign * step * np.eye(2)[k])) for e in x]) for sign in (1, -1))
            slopes.append(np.concatenate([(up - down)[:, 0] * 1e3, (up - down)[:, 1]]) / (2 * step))
        errors = np.concatenate([0.02 * measured, np.full(10, 0.001)])
        spread = np.linalg.inv((slopes / errors) @ (slopes / errors).T)
        self.assertLess(abs(found["mu"]["deviation"] / np.sqrt(spread[0, 0]) - 1), 1e-3)
        self.assertLess(abs(found["lambda"]["deviation"] / np.sqrt(spread[1, 1]) - 1), 1e-3)
        # The same request makes no run again; data that have changed are refused.
        again, repeated, _ = self.fit(FIT, "--refine", "1.5")
        self.assertEqual((again, repeated["runs"]), (found, whole["runs"]))
        self.table(noise=(0.01, 0.001))
        self.refused(["fit", "fit.toml", "--output", "out"], 3, "has runs of another fit")

    def derivatives(self, scene, keys):
        """Derivatives of all columns by keys (with their values): of equilibria beside a run, and of runs alone."""
        step, derivatives = 1e-4, []
        ends = [f"{key}={value * (1 + sign * step):.15g}" for key, value in keys.items() for sign in (1, -1)]
        beside = [word for end in ends for word in ("--beside", end)]
        self.call("run", scene, "--quiet", "--overwrite", "--output", "near", *beside)
        for k, end in enumerate(ends):
            self.call("run", scene, "--quiet", "--overwrite", "--output", f"alone-{k}", "--set", end)
        near = [read_history(self.directory / "near" / f"beside-{k + 1}.csv")[0] for k in range(len(ends))]
        alone = [read_history(self.directory / f"alone-{k}" / "history.csv")[0] for k in range(len(ends))]
        for k, value in enumerate(keys.values()):
            for name in near[0]:
                derivatives.append([(h[2 * k][name] - h[2 * k + 1][name]) / (2 * step * value) for h in (near, alone)])
        return derivatives

    def test_equilibria_beside_a_run(self):
        """Derivatives by numbers of material, contact and geometry are those of runs alone, to 1e-6. With a surface law,
        runs alone end at 1e-9 of the energy, so that their differences are known to 1e-2 only."""
        self.scene(LAYER, "layer")
        keys = {"constants.E": 1, "constants.w": 0.02, "constants.width": 1.2, "contact.ball.partner.radius": 1}
        for near, alone in self.derivatives("layer.toml", keys):
            self.assertLessEqual(np.abs(near - alone).max(), 1e-6 * np.abs(alone).max())
        self.scene(LAYER.replace("gamma = 0,", "gamma = 0.05,") + SKIN, "skin")
        pairs = self.derivatives("skin.toml", {"constants.gamma": 0.05})
        for near, alone in pairs:
            self.assertLessEqual(np.abs(near - alone).max(), 5e-2 * np.abs(alone).max())
        self.assertGreater(np.abs(pairs[-1][0]).max(), 0.01)
        self.refused(["run", "bar.toml", "--beside", "body.bar.cells=[2, 2, 2]"], 3, "has other particles")
        self.refused(["run", "bar.toml", "--overwrite", "--beside", "body.bar.material.my=1"], 3, "body.bar.material.my")

    def test_tension_and_viscosity_from_an_oscillation(self):
        """The example of the guide, coarser: the exact solution of a plane drop with noise of 2 % of its amplitude, times
        in ms. The drop of the scene is slightly compressible, which changes its values by up to 0.5 % of the amplitude."""
        amplitude = 0.0243921
        self.assertLess(abs(amplitude * oscillation(1, 0.1, 1) + 0.0115739), 2e-7)
        data = np.loadtxt(INPUTS / "fits/drop_oscillation.csv", delimiter=",", skiprows=2)
        noise = [y - amplitude * oscillation(t / 1e3, 0.1, 1) for t, y in data]
        self.assertLess(np.abs(noise).max(), 3 * 0.02 * amplitude)
        self.assertGreater(np.std(noise), 0.01 * amplitude)
        for name in ("drops/drop_2d.toml", "fits/drop_oscillation.csv"):
            (self.directory / name).parent.mkdir(exist_ok=True)
            (self.directory / name).write_text((INPUTS / name).read_text())
        text = (INPUTS / "fits/drop_oscillation.toml").read_text().replace("../drops/drop_2d", "drops/drop_2d").replace('"drop_osc', '"fits/drop_osc')
        coarse = 'set = { "body.drop.core" = 6, "body.drop.rings" = 3 }\n\n[[scene.curve]]'
        found, _, _ = self.fit(text.replace("[[scene.curve]]", coarse))
        for name, true in (("gamma", 1.0), ("viscosity", 0.1)):
            self.assertLess(abs(found[name]["value"] - true), 3 * found[name]["deviation"] + 0.01 * true)
        self.assertLess(found["gamma"]["deviation"], 0.02)
        self.assertLess(found["viscosity"]["deviation"], 0.01)

    def test_shipped_fits(self):
        """All can be read. Data of the tension test are those of the closed form, with noise of 2 % and 0.003 mm."""
        for path in sorted((INPUTS / "fits").glob("*.toml")):
            if "[[parameter]]" in path.read_text():
                read_fit_file(path)
        data = np.loadtxt(INPUTS / "fits/tension_neo_hookean.csv", delimiter=",", skiprows=2)
        true = np.array([tension(1 + extension / 4, 200, 500) for extension in data[:, 0]])
        noise = np.column_stack([(data[:, 1] / true[:, 0] - 1) / 0.02, (data[:, 2] - true[:, 1]) / 0.003])
        self.assertLess(np.abs(noise).max(), 4)
        self.assertGreater(noise.std(), 0.5)

    def test_values_bounds_and_parameters_that_cannot_be_told_apart(self):
        """One force of a small stretch gives only a sum of the moduli, and no error."""
        small = ('[[scene]]\nfile = "bar.toml"\nset = { "held.grip.displacement" = [0.01, 0, 0] }\n[[scene.value]]\n'
                 'of = "grip.force_x"\nreduce = "max"\nvalue = "5.5 mN"\n[[scene.value]]\nof = "strain_energy"\nvalue = 2.75e-5\n')  # fmt: skip
        found, whole, printed = self.fit(small + MU + LAMBDA)
        self.assertIsNone(whole["chi_squared"])
        self.assertIn("can hardly be told apart", printed)
        found, whole, printed = self.fit(small + MU.replace("start = \"3 Pa\"\nlow = \"0.1 Pa\"", "start = \"8 Pa\"\nlow = \"6 Pa\""), "--overwrite")
        self.assertTrue(found["mu"]["at_bound"])
        self.assertAlmostEqual(found["mu"]["value"], 6, delta=1e-3)
        self.assertIn("'mu' is at its bound", printed)

    def test_a_fit_that_was_stopped_goes_on(self):
        request = '[[scene]]\nfile = "bar.toml"\n' + FORCE + MU
        (self.directory / "fit.toml").write_text(request)
        process = self.start("fit", "fit.toml", "--output", "out")
        kept = self.directory / "out" / "evaluations.json"
        while not kept.exists() or len(json.loads(kept.read_text())["values"]) < 4:
            time.sleep(0.02)
        process.send_signal(signal.SIGTERM)
        said, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 128 + signal.SIGTERM, said)
        self.assertIn("the same command goes on", said)
        made = len(json.loads(kept.read_text())["values"])
        _, whole, _ = self.fit(request)
        self.assertGreater(whole["runs"], made)
        _, alone, _ = self.fit(request, "--overwrite")
        self.assertEqual((whole["parameters"], whole["runs"]), (alone["parameters"], alone["runs"]))

    def test_refusals(self):
        def refused(text, *words):
            """When the file is read."""
            (self.directory / "fit.toml").write_text(text)
            with self.assertRaises(InputError) as caught:
                read_fit_file(self.directory / "fit.toml")
            for word in words:
                self.assertIn(word, str(caught.exception))

        def refused_later(text, *words):
            """By the program, after a run."""
            (self.directory / "fit.toml").write_text(text)
            self.refused(["fit", "fit.toml", "--output", "out", "--overwrite"], 3, *words)

        refused(FIT.replace("bar.toml", "no.toml"), "fit.toml: scene[0].file: there is no", "no.toml")
        refused(FIT.replace("tension.csv", "no.csv"), "scene[0].curve[0].file", "no.csv")
        refused(FIT.replace('"force"', '"farce"'), "scene[0].curve[0].y.column", "no column 'farce'; it has extension, force, width")
        refused_later(FIT.replace('"mN"', '"mm"'), "numbers in 'N', which are none in 'mm'")
        refused_later(FIT.replace('"grip.force_x"', '"grip.farce"'), "the run has no column 'grip.farce'; it has time")
        refused(FIT.replace("start = 5", "start = 500"), "parameter[1].start: is 500; expected is a number between low, 0.1, and high, 100")
        refused(FIT.replace('low = "0.1 Pa"', "low = 0.1"), "parameter[0].low: has the unit ''; expected is that of start, 'Pa'")
        refused(FIT.replace("start = 5", "begin = 5"), "parameter[1].start: is missing")
        refused(FIT.replace("error = 0.001", "eror = 0.001"), "scene[0].curve[1].eror: is unknown; known are")
        refused(FIT.replace("error = 0.001", "error = 0"), "expected are errors > 0")
        refused_later(FIT.replace("material.mu", "material.my"), "body.bar.material.my", "with my = 3 Pa")
        refused_later(FIT.replace("material.lambda", "material.density"), "the parameter 'density' has no influence on the data")
        refused(FIT + "nonsense", "fit.toml: ")
        refused('[[scene]]\nfile = "bar.toml"\n' + MU, "expected is a table [[scene]] with measured data")
        refused('[[scene]]\nfile = "bar.toml"\n' + FORCE, "expected is a table [[parameter]]")
        self.table(scale=1.2)
        refused_later(FIT, "the run is between 0 and 800, but the data reach from 96 to 960")
        self.table(text="extension,force,width\n1,2\n")
        refused(FIT, "tension.csv:2 has 2 cells; expected are 3")
        self.table(text="extension,force,width\n1,2,x\n")
        refused(FIT, "tension.csv:2: 'x' of column 'width' is no number")
        self.refused(["fit", "nowhere.toml"], 5, "nowhere.toml")
        self.refused(["fit", "fit.toml", "--parallel", "0"], 2, "--parallel")


if __name__ == "__main__":
    program.main()
