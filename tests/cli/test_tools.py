#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of tools/ say how they are called, and do nothing where they do not know an argument."""
import os
import subprocess
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools"
SCRIPTS = sorted(file for file in TOOLS.iterdir() if file.is_file() and os.access(file, os.X_OK))


def call(script, *arguments):
    return subprocess.run([script, *arguments], text=True, capture_output=True, timeout=60)


class ToolsTest(unittest.TestCase):
    def test_help_is_their_usage(self):
        self.assertGreater(len(SCRIPTS), 8)
        for script in SCRIPTS:
            with self.subTest(script.name):
                done = call(script, "--help")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertRegex(done.stdout, rf"^(usage: )?(tools/)?{script.name}\b")

    def test_unknown_arguments_are_refused(self):
        for script in SCRIPTS:
            if script.name != "run":  # its arguments are those of the program, which it builds first
                with self.subTest(script.name):
                    done = call(script, "--nonsense")
                    self.assertEqual((done.returncode, done.stdout), (2, ""))
                    self.assertIn(script.name, done.stderr)

    def test_options_that_lack_their_value_are_refused(self):
        self.assertEqual(call(TOOLS / "verify", "-R").returncode, 2)
        self.assertEqual(call(TOOLS / "verification_table.py", "/nowhere").returncode, 2)
        self.assertEqual(call(TOOLS / "count_instructions.py", "/nowhere").returncode, 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
