#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Settings of the curvature study: maps given by formulas, refused settings, and the pictures.

Usage: test_studies.py PROGRAM (meniscus)
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
PLOT = pathlib.Path(__file__).resolve().parents[2] / "tools/plotting/plot.py"

# twist_ellipsoid as formulas.
TWIST = """
x = "(x*cos(0.7*y) - z*sin(0.7*y))*cos(-0.6*(x*sin(0.7*y) + z*cos(0.7*y))) \
- y*sin(-0.6*(x*sin(0.7*y) + z*cos(0.7*y)))"
y = "1.5*((x*cos(0.7*y) - z*sin(0.7*y))*sin(-0.6*(x*sin(0.7*y) + z*cos(0.7*y))) \
+ y*cos(-0.6*(x*sin(0.7*y) + z*cos(0.7*y))))"
z = "x*sin(0.7*y) + z*cos(0.7*y)"
"""


class Curvature(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def study(self, *settings, levels=("4",)):
        options = [f"--set={setting}" for setting in settings]
        return subprocess.run(
            [PROGRAM, "study", "curvature", "--short", "--output", self.folder / "out",
             "--levels", *levels, *options],
            capture_output=True, text=True,
        )  # fmt: skip

    def measurements(self):
        return json.loads((self.folder / "out/study.json").read_text())["measurements"]

    def map_file(self, text):
        path = self.folder / "map.toml"
        path.write_text(text)
        return f"map={path}"

    def assertRefused(self, done, *words):
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_formulas_agree_with_the_map_built_in(self):
        self.assertEqual(self.study("map=twist_ellipsoid").returncode, 0)
        exact = self.measurements()
        self.assertEqual(self.study(self.map_file(TWIST)).returncode, 0)
        formulas = self.measurements()
        self.assertEqual(len(exact), len(formulas))
        for one, other in zip(exact, formulas):
            for name, error in one["errors"].items():
                self.assertLess(abs(other["errors"][name] / error - 1), 1e-7, name)

    def test_formulas_of_two_variables_map_the_disk(self):
        self.assertEqual(self.study(self.map_file('x = "x + 0.1*sin(y)"\ny = "y"')).returncode, 0)
        self.assertEqual({m["particles"] for m in self.measurements()}, {57})

    def test_edges_are_refused(self):
        for shape in ("box", "cylinder", "rectangle"):
            self.assertRefused(self.study(f"shape={shape}"), shape, "has edges", "weak form")

    def test_folds_are_refused(self):
        done = self.study(self.map_file('x = "x + x^2"\ny = "y"\nz = "z"'))
        self.assertRefused(done, "folds the body", "det F = -", "map.toml")

    def test_kinks_are_refused(self):
        done = self.study(self.map_file('x = "x + 0.1*abs(y)"\ny = "y"'))
        self.assertRefused(done, "not smooth enough", "map.toml")

    def test_wrong_settings_are_refused_together(self):
        done = self.study("maps=twist", "shape=bal")
        self.assertRefused(done, "unknown key", "did you mean 'map'", "did you mean 'ball'")
        self.assertRefused(self.study("shape=disk", "map=twist"), "not one of the disk")

    def test_pictures(self):
        self.assertEqual(self.study("shape=ball", levels=("4", "6")).returncode, 0)
        draw = ["/usr/bin/python3", "-B", PLOT, self.folder / "out"]
        subprocess.run(draw, check=True, capture_output=True)
        sizes = {p.stem: p.stat().st_size for p in self.folder.glob("out/plots/*.png")}
        self.assertEqual(set(sizes), {f"error_against_{x}" for x in ("h", "time")})
        self.assertGreater(min(sizes.values()), 10000)
        done = subprocess.run([*draw, "--field", "L3"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no error 'L3'", done.stderr)


if __name__ == "__main__":
    unittest.main()
