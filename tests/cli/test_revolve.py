#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes in space and their twins in the half plane: what they expect of the body in space holds for
the body of revolution, and what is not of revolution is refused with its place.
Usage: test_revolve.py PROGRAM"""
import re
import unittest
from pathlib import Path

import program
from program import DROP, ProgramTest, shipped

ROOT = Path(__file__).resolve().parents[2]
program.ENVIRONMENT["OMP_NUM_THREADS"] = "1"

# A ball of rubber between two plates that close, about an axis through (1, 2, 0); %s: along it.
PRESSED = """
dimension = 3
time = { end = 20, solver = "relax" }
constants = { mu = 10, grip = "mu/5" }
[functions]
radius = "sqrt((x - 1)^2 + (y - 2)^2)"
"wave(x)" = "1 + 0.1*x^2"
[output]
measures = ["ball.extent_x", "ball.extent_z", "ball.velocity_x", "low.force_z"]
[[body]]
name = "ball"
shape = "ball"
radius = 1
core = 4
layers = 2
centre = [1, 2, 0.5]
material = { type = "neo_hookean", density = "wave(radius)", mu = "mu", lambda = "grip*10" }
[[contact]]
name = "low"
bodies = ["ball"]
adhesion = 0.1
offset = 0.1
range = 0.2
partner = { type = "half_space", point = [7, 7, -0.6], normal = [0, 0, 1] }
[[contact]]
name = "high"
bodies = ["ball"]
adhesion = 0.1
offset = 0.1
range = 0.2
partner = { type = "half_space", point = [0, 0, 1.6], normal = [0, 0, -2], displacement = [0, 0, "-0.1*min(t/0.5, 1)"] }
"""


class Revolve(ProgramTest):
    def twin(self, text):
        self.scene(text, "space")
        return self.call("revolve", "space.toml").stdout

    def test_twins_meet_what_is_expected_in_space(self):
        """Drops that oscillate, spread, rest under their weight, hang between plates and wet a soft
        layer; shells that are blown up or deflated; a ball that bounces: twins of the scenes of the
        gallery with the same cells have their expected values."""
        for name in ("ellipsoid_drop droplet_spreading sharp_line sessile_drop_3d liquid_bridge marangoni_drop "
                     "droplet_on_ball droplet_on_soft_layer_3d pressurised_sphere rbc_deflate first_ball_on_wall "
                     "drop_small_oh093").split():
            with self.subTest(name):
                self.call("revolve", shipped.scene(name), f"{name}.toml")
                printed = self.call("run", f"{name}.toml", "--output", name).stdout
                self.assertIn(" met", printed)

    def test_formulas_and_places_are_those_of_the_half_plane(self):
        twin = self.twin(PRESSED)
        for line in ('dimension = "axisymmetric"', 'shape = "disk"', "rings = 2", "centre = [0, 0.5]",
                     'radius = "sqrt(((1 + x) - 1)^2 + ((2) - 2)^2)"', '"wave(x)" = "1 + 0.1*x^2"',
                     "point = [0, -0.6]", "normal = [0, -2]", 'displacement = [0, "-0.1*min(t/0.5, 1)"]',
                     'measures = ["ball.extent_x", "ball.extent_y", "low.force_y"]',
                     "# Without the measure ball.velocity_x."):
            self.assertIn(line, twin)
        self.scene(twin, "twin")
        force, extent = (self.last("twin.toml", column) for column in ("low.force_y", "ball.extent_x"))
        space = self.last("space.toml", "low.force_z"), self.last("space.toml", "ball.extent_x")
        self.assertLess(abs(force / space[0] - 1), 0.05)
        self.assertLess(abs(extent / space[1] - 1), 0.005)

    def last(self, scene, column):
        self.call("run", scene, "--output", "results", "--overwrite")
        lines = (self.directory / "results" / "history.csv").read_text().splitlines()
        return float(lines[-1].split(",")[lines[0][2:].split(",").index(column)])

    def test_the_axis_may_be_another_one(self):
        twin = self.twin(DROP)
        self.assertIn('semi_axes = ["5 nm", "7.5 nm"]\ncore = 4', twin)
        self.assertIn("# core = 4 instead of 3, for nodes on the axis.\n", twin)
        turned = self.twin(DROP.replace('["5 nm", "7.5 nm", "5 nm"]', '["7.5 nm", "5 nm", "5 nm"]'))
        self.assertEqual(twin, turned)

    def test_what_is_not_of_revolution_is_named(self):
        drop = DROP.replace('["5 nm", "7.5 nm", "5 nm"]', '["5 nm", "5 nm", "5 nm"]')
        beside = '[[contact]]\nbodies = ["drop"]\ncontact_angle = 90\n[contact.partner]\ntype = "ball"\nradius = "3 nm"\n'
        for text, words in (
                (drop + '[[body_force]]\nbody = "drop"\nacceleration = ["y", "0", "0"]\n', ["acceleration is", "about x"]),
                (drop + '[[body_force]]\nbody = "drop"\nacceleration = [0.1, 0.2, 0]\n', ["space.toml:27", "of revolution it is"]),
                (drop.replace("core = 3", "core = 4\ninitial_displacement = [\"1e-15*sin(1e9*y)\", 0, 0]"),
                 ["initial_displacement is", "of revolution it is"]),
                (drop + beside + 'centre = ["3 nm", "9 nm", "0 nm"]\n', ["centre is", "beside the axis z"]),
                (drop.replace('core = 3', 'core = 4').replace(
                    "viscosity =", 'bulk_viscosity = "1e-3*(1 + x*1e7 + y*z*1e16)"\nviscosity ='),
                 ["bulk_viscosity is", "as far from the axis"]),
                (drop.replace("dimension = 3", "dimension = 2"), ["space.toml:2:13: dimension is not 3"]),
                (drop.replace("dimension = 3", ""), ["dimension: missing"]),
                (drop + '[[probe]]\nname = "p"\nbody = "drop"\nfrom = ["1 nm", "1 nm", "1 nm"]\nto = ["-1 nm", "-1 nm", "-1 nm"]\n',
                 ["another half plane"]),
                (drop + '[[spring]]\nbody = "drop"\nat = ["1 nm", "2 nm", "0 nm"]\nconstant = 1\n', ["at is", "beside the axis"]),
                (drop.replace('shape = "ellipsoid"\nsemi_axes = ["5 nm", "5 nm", "5 nm"]\ncore = 3\nlayers = 2',
                              'shape = "box"\nsize = ["5 nm", "5 nm", "5 nm"]\ncells = [3, 3, 3]'),
                 ["shape 'box' is not of revolution"])):
            with self.subTest(words[0]):
                self.scene(text, "space")
                self.refused(["revolve", "space.toml"], 3, *words)
        self.scene(drop.replace("core = 3", "core = 4"), "space")
        self.scene("x", "there")
        self.refused(["revolve", "space.toml", "there.toml"], 5, "there.toml")

    def test_twins_have_as_many_cells_by_default(self):
        """The defaults of shapes in the plane are finer than those of 3D shapes."""
        scene = re.search(r"```toml\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)[1]
        self.assertNotIn("core", scene)
        twin = self.twin(scene)
        for line in ('shape = "ellipse"', "core = 10", "rings = 5"):
            self.assertIn(line, twin)
        layer = self.twin(scene.replace('shape = "ellipsoid"\nsemi_axes = ["5 nm", "7.5 nm", "5 nm"]',
                                        'shape = "cylinder"\nradius = "5 nm"\nheight = "2 nm"').replace(
                                            "aspect", "volume"))
        self.assertIn("cells = [18, 3]", layer)

    def test_check_tells_of_the_twin(self):
        self.scene(DROP.replace("core = 3", "core = 4"), "space")
        found = re.search(r"of revolution: .* with (\d+) particles instead of (\d+)", self.call("check", "space.toml").stdout)
        self.assertLess(4 * int(found[1]), int(found[2]))
        self.scene(DROP.replace("core = 3", "core = 4") +
                   '[[body_force]]\nbody = "drop"\nacceleration = [0.1, 0.2, 0]\n', "space")
        self.assertNotIn("of revolution", self.call("check", "space.toml").stdout)


if __name__ == "__main__":
    program.main()
