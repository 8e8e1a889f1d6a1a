#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The lines of Python in the guide run as they stand, and it lists all functions.
Usage: test_guide.py PROGRAM, with the package on PYTHONPATH"""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import meniscus
from scenes import ROOT

GUIDE = (ROOT / "inputs/guide/python.md").read_text(encoding="utf-8")
DROP = """
dimension = 3
[time]
end = "40 ps"
[output]
frames_every = "20 ps"
fields = ["velocity", "pressure"]
measures = ["drop.aspect"]
[[body]]
name = "drop"
shape = "ellipsoid"
semi_axes = ["5 nm", "7.5 nm", "5 nm"]
core = 3
layers = 2
material = { type = "newtonian", density = 1000, bulk_modulus = "2.2 GPa", viscosity = "0.6 mPa s" }
[[surface_tension]]
body = "drop"
gamma = "72.8 mN/m"
"""
PROGRAM = None


class Guide(unittest.TestCase):
    def test_its_lines_run(self):
        blocks = re.findall(r"```python\n(.*?)```", GUIDE, re.DOTALL)
        self.assertEqual(len(blocks), 4)
        with tempfile.TemporaryDirectory() as directory:
            (Path(directory) / "drop.toml").write_text(DROP)
            subprocess.run([PROGRAM, "run", "drop.toml", "--quiet"], cwd=directory, check=True)
            done = subprocess.run([sys.executable, "-c", "\n".join(blocks)], cwd=directory, text=True,
                                  capture_output=True, check=False)  # fmt: skip
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("[[", done.stdout)

    def test_all_functions_are_named(self):
        for of, name in ((meniscus, "meniscus"), (meniscus.Run, "run")):
            for function in getattr(of, "__all__", [key for key in vars(of) if not key.startswith("_")]):
                if function not in ("Error", "Results", "dimension", "bodies", "field_unit"):
                    self.assertRegex(GUIDE, rf"\b{function}\b", f"{name}.{function}")


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
