#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""tools/benchmarks: results of its short form are within the tolerances of published values, and a result that is
not is found. Usage: test_benchmarks.py PROGRAM"""
import csv
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import program
from program import ProgramTest

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tools" / "benchmarking"))
import compare  # noqa: E402  pylint: disable=wrong-import-position
import entries  # noqa: E402  pylint: disable=wrong-import-position


class Benchmarks(ProgramTest):
    def run_them(self, *arguments, code, root=ROOT):
        done = subprocess.run([root / "tools/benchmarks", *arguments, "--program", program.PROGRAM, "--output", "out", "--no-page"],
                              cwd=self.directory, text=True, capture_output=True, timeout=300)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def rows(self):
        with (self.directory / "out" / "table.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def test_the_short_form_is_within_its_tolerances(self):
        self.run_them("--short", code=0)
        rows = self.rows()
        self.assertGreaterEqual(len({row["benchmark"] for row in rows}), 10)
        self.assertEqual({row["verdict"] for row in rows}, {"met"})

    def test_a_result_off_its_published_value_is_found(self):
        """In a copy of the folders in which another moment was published."""
        copy = self.directory / "copy"
        for folder in ("tools", "inputs/benchmarks", "src/python"):
            shutil.copytree(ROOT / folder, copy / folder)
        scene = copy / "inputs/benchmarks/roll_up.toml"
        scene.write_text(scene.read_text().replace("value = -5.02655e-3", "value = -5.12655e-3"))
        self.run_them("--only", "roll_up", code=7, root=copy)
        self.assertEqual([row["verdict"] for row in self.rows()], ["MISSED", "met", "met"])

    def test_what_is_unknown_is_refused(self):
        self.assertIn("there is no field 'cooking'", self.run_them("cooking", code=1).stderr)
        self.assertIn("no benchmark 'cool'", self.run_them("--only", "cool", code=1).stderr)

    def test_every_benchmark_has_a_scene_or_a_reason(self):
        known = entries.read()
        scenes = {file.stem for file in entries.FOLDER.glob("*.toml")} - {"published"}
        self.assertEqual({entry["name"] for entry in known if "reason" not in entry}, scenes)
        for entry in known:
            self.assertTrue(entry["source"] and entry["title"])

    def test_the_pulsation_is_that_of_the_crossings(self):
        time = compare.np.linspace(0, 10, 500)
        self.assertAlmostEqual(compare.pulsation(time, 3 + compare.np.sin(2 * time)), 2, delta=1e-3)
        with self.assertRaisesRegex(ValueError, "crosses its mean"):
            compare.pulsation(time, time)


if __name__ == "__main__":
    program.main()
