#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""`meniscus converge` and --refine: a refined scene is the scene with more cells; orders, limits and
error bars of its expectations. Usage: test_converge.py PROGRAM"""
import csv
import math
import re
import unittest

import program
from program import DROP, ProgramTest, state_of

program.ENVIRONMENT["OMP_NUM_THREADS"] = "1"

# A beam of nearly incompressible rubber whose end is pushed down; its deflection is that of a thin
# beam to 1 %.
BEAM = """
dimension = 2
time = { end = 1, step = 1, solver = "newton" }
[output]
measures = ["beam.mean_pressure"]
[[body]]
name = "beam"
shape = "rectangle"
size = [10, 1]
cells = [10, 2]
centre = [5, 0]
material = { type = "neo_hookean", density = 1, youngs_modulus = 1, poissons_ratio = 0.3 }
[[held]]
body = "beam"
face = "x_min"
[[probe]]
name = "tip"
body = "beam"
at = [10, 0]
fields = ["displacement"]
[[traction]]
body = "beam"
face = "x_max"
force = [0, -1e-6]
[expect]
deflection = { of = "tip.displacement_y", value = -3.66e-3, within_relative = 0.02 }
"""

# A drop of a liquid in 2D that touches a wall, whose contact has no range.
TOUCHING = """
dimension = 2
time = { end = 0.02 }
[output]
measures = ["drop.aspect"]
[[body]]
name = "drop"
shape = "disk"
radius = 1
spacing = 0.25
material = { type = "newtonian", density = 1, bulk_modulus = 50, viscosity = 1 }
[[surface_tension]]
body = "drop"
gamma = 1
[[contact]]
bodies = ["drop"]
contact_angle = 90
partner = { type = "half_space", point = [0, -1.05], normal = [0, 1] }
[expect]
aspect = { of = "drop.aspect" }
"""

# The end of the beam is pushed down, and then let go.
STAGES = BEAM.split("[expect]", maxsplit=1)[0].replace('time = { end = 1, step = 1, solver = "newton" }\n', "").replace(
    "[[traction]]", '[[stage]]\nname = "push"\ntime = { end = 1, step = 1, solver = "newton" }\n[[stage.traction]]') + """
[stage.expect]
pushed = { of = "tip.displacement_y" }
[[stage]]
name = "swing"
time = { end = 1 }
[stage.expect]
begins = { of = "tip.displacement_y", at = 0 }
"""


class Converge(ProgramTest):
    def table(self, *arguments, code=0):
        """The rows of the printed table by result, and all that was printed."""
        printed = self.call("converge", *arguments, code=code).stdout
        with (self.directory / "out" / "convergence.csv").open() as file:
            return {row["result"]: row for row in csv.DictReader(file)}, printed

    def test_a_refined_scene_is_the_scene_with_more_cells(self):
        short = DROP.replace('end = "60 ps"', 'end = "3 ps"')
        self.scene(short, "coarse")
        self.scene(short.replace("core = 3", "core = 6").replace("layers = 2", "layers = 4"), "fine")
        for option in (["--refine", "2"], ["--set", "resolution.refine=2"]):
            coarse = self.call("run", "coarse.toml", *option, "--output", "coarse", "--overwrite")
            fine = self.call("run", "fine.toml", "--output", "fine", "--overwrite")
            self.assertEqual(state_of(coarse), state_of(fine))
        self.scene(short + "[resolution]\nrefine = 2\n", "table")
        self.assertEqual(state_of(self.call("run", "table.toml", "--output", "table")), state_of(fine))

    def test_orders_limits_and_error_bars(self):
        self.scene(BEAM, "beam")
        rows, printed = self.table("beam.toml", "--output", "out", "--factor", "2", "--of", "beam.mean_pressure")
        row = rows["deflection"]
        values = [float(row[f"refine {k}"]) for k in (1, 2, 4)]
        order, limit, bar = float(row["order"]), float(row["limit"]), float(row["error bar"])
        quotient = (values[0] - values[1]) / (values[1] - values[2])
        self.assertGreater(order, 0.8)
        self.assertLess(abs(limit - (values[2] - (values[1] - values[2]) / (quotient - 1))), 0.05 * bar + 1e-7)
        finer = float(self.table("beam.toml", "--output", "out", "--factor", "2", "--levels", "5")[0]["deflection"]["refine 16"])
        self.assertLess(abs(values[2] - finer), bar)
        self.assertLess(abs(limit / finer - 1), 2e-3)
        self.assertIn("beam.mean_pressure", rows)
        self.assertGreater(float(rows["seconds"]["refine 4"]), 0)
        self.assertIn("refine 4", printed)
        self.assertTrue(math.isclose(float(row["expected"]), -3.66e-3))

    def test_what_the_scene_asks_of_a_series(self):
        """Numbers without a tolerance are reported; a missed order or error bar is exit code 7."""
        scene = BEAM.replace("within_relative = 0.02", "order = 0.8, error_bar_within = 0.01")
        self.scene(scene + 'pressure = { of = "beam.mean_pressure", error_bar_within = 1e-3 }\n', "beam")
        told = self.call("run", "beam.toml", "--output", "alone").stdout
        self.assertRegex(told, r"deflection +-0\.003\d+ +-0\.00366 +-  reported")
        self.assertRegex(told, r"pressure +\S+ +- +-  reported")
        rows, _ = self.table("beam.toml", "--output", "out", "--factor", "2", code=7)
        self.assertEqual((rows["deflection"]["asked"], rows["pressure"]["asked"]), ("met", "MISSED"))
        self.scene(scene, "beam")
        self.assertEqual(self.table("beam.toml", "--output", "out", "--overwrite")[0]["deflection"]["asked"], "met")
        self.scene(scene.replace("order = 0.8", "order = 5"), "beam")
        self.assertEqual(self.table("beam.toml", "--output", "out", "--overwrite", code=7)[0]["deflection"]["asked"], "MISSED")

    def test_budget(self):
        """Ranges, bulk moduli and steps of a scene, one after the other; the parts are percent of the value."""
        scene = DROP.replace('end = "60 ps"', 'end = "3 ps"') + """
[[contact]]
bodies = ["drop"]
contact_angle = 90
range = "0.5 nm"
offset = "0.2 nm"
partner = { type = "half_space", point = [0, 0, "-8 nm"], normal = [0, 0, 1] }
[expect]
aspect = { of = "drop.aspect" }
"""
        self.scene(scene, "drop")
        _, printed = self.table("drop.toml", "--output", "out", "--factor", "1.5", "--budget")
        with (self.directory / "out" / "budget.csv").open() as file:
            row = next(csv.DictReader(file))
        self.assertEqual(list(row), ["result", "value", "resolution", "range", "compressibility", "step"])
        for part in ("resolution", "range", "compressibility", "step"):
            self.assertRegex(row[part], r"^\S+ %$", printed)
        self.assertEqual(float(row["range"].split()[0]), 0)  # the wall is out of reach
        self.assertGreater(float(row["compressibility"].split()[0]), 0)
        runs = sorted(path.name for path in (self.directory / "out" / "range").iterdir() if path.is_dir())
        self.assertEqual(runs, ["refine=1,range=1.125e-09", "refine=1,range=7.5e-10"])
        steps = sorted(path.name for path in (self.directory / "out" / "step").iterdir() if path.is_dir())
        self.assertEqual(steps, ["refine=1,safety=0.4", "refine=1,safety=0.6"])

    def test_lengths_that_follow_the_cells(self):
        """They change with the levels, or are held at what they are in the first one."""
        self.scene(TOUCHING, "drop")
        values = {}
        for option in ("with", "fixed"):
            rows, printed = self.table("drop.toml", "--output", "out", "--overwrite", "--range", option)
            values[option] = [float(rows["aspect"][f"refine {k}"]) for k in (1, 2, 4)]
            length = re.search(r"contact\[0\]\.range is (\S+) m at first", printed)[1]
        set_by_hand, _ = self.table("drop.toml", "--output", "out", "--overwrite", "--set", f"contact[0].range={length}")
        for k, value in zip((1, 2, 4), values["fixed"]):
            self.assertAlmostEqual(float(set_by_hand["aspect"][f"refine {k}"]), value, delta=1e-5)
        self.assertAlmostEqual(values["with"][0], values["fixed"][0], delta=1e-6)
        self.assertGreater(abs(values["with"][1] - values["fixed"][1]), 1e-3)
        # The levels begin at the refinement of the scene.
        rows, _ = self.table("drop.toml", "--output", "out", "--overwrite", "--set", "resolution.refine=2")
        self.assertEqual(float(rows["aspect"]["refine 2"]), values["with"][1])
        self.assertIn("refine 8", rows["aspect"])

    def test_stages(self):
        self.scene(STAGES, "swing")
        rows, _ = self.table("swing.toml", "--output", "out")
        self.assertEqual(set(rows), {"pushed", "begins", "seconds"})
        for level in ("refine 1", "refine 2", "refine 4"):
            self.assertAlmostEqual(float(rows["begins"][level]) / float(rows["pushed"][level]), 1, delta=1e-6)
        self.assertNotEqual(rows["pushed"]["refine 1"], rows["pushed"]["refine 2"])
        for option in (["--budget"], ["--range", "fixed"]):
            self.refused(["converge", "swing.toml", *option], 3, "without [[stage]]")

    def test_spacing_instead_of_numbers_of_cells(self):
        short = DROP.replace('end = "60 ps"', 'end = "3 ps"')
        self.scene(short.replace("core = 3\nlayers = 2", "core = 4\nlayers = 2"), "counts")
        self.scene(short.replace("core = 3\nlayers = 2", 'spacing = "14.3 angstrom"'), "spacing")
        self.assertEqual(state_of(self.call("run", "counts.toml", "--output", "a")), state_of(self.call("run", "spacing.toml", "--output", "b")))
        self.scene(short.replace("core = 3", 'spacing = "1 nm"'), "both")
        self.refused(["check", "both.toml"], 3, "is given beside layers; allowed is either spacing or core, layers")

    def test_a_series_goes_on(self):
        self.scene(BEAM, "beam")
        first = self.table("beam.toml", "--output", "out", "--factor", "2")[1]
        self.assertNotIn("done before", first)
        again = self.table("beam.toml", "--output", "out", "--factor", "2")[1]
        self.assertEqual(again.count("done before"), 3)

    def test_bad_requests(self):
        self.scene(BEAM, "beam")
        for arguments, code, words in (
                (["--levels", "2"], 2, "allowed is an integer >= 3"),
                (["--factor", "1.0001"], 2, "--factor"),
                (["--range", "held"], 2, "not in {fixed,with}"),
                (["--set", "body.beam.cells=[1,1],[2,2]"], 3, "has 2 values"),
                (["--factor", "1.05"], 3, "no more cells than the level before")):
            with self.subTest(words):
                self.refused(["converge", "beam.toml", *arguments], code, words)
        self.refused(["run", "beam.toml", "--refine", "0"], 3, "resolution.refine")
        self.refused(["run", "beam.toml", "--refine", "x"], 3, "resolution.refine")
        self.scene(BEAM.split("[expect]")[0], "nothing")
        self.refused(["converge", "nothing.toml"], 3, "nothing to report")
        self.scene(BEAM.replace("[[traction]]", "[[contact]]\nbodies = [\"beam\"]\nadhesion = 1e-9\noffset = 0.1\n"
                                "partner = { type = \"half_space\", point = [0, -3], normal = [0, 1] }\n[[traction]]"), "left")
        self.assertIn("contact[0].range is", self.call("converge", "left.toml", "--output", "out", "--factor", "2", code=None).stdout)


if __name__ == "__main__":
    program.main()
