# SPDX-License-Identifier: BSD-3-Clause
"""The program under test, small scenes, and helpers that compare results."""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "tools"))
import shipped  # noqa: E402, F401  pylint: disable=wrong-import-position,unused-import

PROGRAM = None
ENVIRONMENT = {**os.environ, "OMP_WAIT_POLICY": "passive", "OMP_NUM_THREADS": "2"}

# A viscous drop under surface tension; the step is estimated again every 20 steps.
DROP = """
dimension = 3
[time]
end = "60 ps"
check_every = 20
[output]
frames_every = "7 ps"
history_every = "1.5 ps"
fields = ["velocity", "J"]
measures = ["drop.aspect", "drop.p2"]
[[body]]
name = "drop"
shape = "ellipsoid"
semi_axes = ["5 nm", "7.5 nm", "5 nm"]
core = 3
layers = 2
[body.material]
type = "newtonian"
density = 1000
bulk_modulus = "2.2 GPa"
viscosity = "0.6 mPa s"
[[surface_tension]]
body = "drop"
gamma = "72.8 mN/m"
"""

# The drop with two remaps.
REMAPPED_DROP = DROP + """
[[remap]]
body = "drop"
at = ["17 ps", "35 ps"]
"""

# An elastic block in oscillation.
BLOCK = """
dimension = 3
[time]
end = 0.4
check_every = 30
[output]
frames_every = 0.04
history_every = 0.01
[[body]]
name = "block"
shape = "box"
size = [1, 1, 1]
cells = [4, 4, 4]
[body.material]
type = "neo_hookean"
density = 1000
mu = 1e5
lambda = 1e5
[[body_force]]
body = "block"
acceleration = ["20*sin(40*t)*(1 + z)", "5*y*cos(11*t)", 0]
"""

# An elastic sheet in 2D.
SHEET = """
dimension = 2
[time]
end = 0.1
[output]
[[body]]
name = "sheet"
shape = "rectangle"
size = [1, 2]
cells = [5, 10]
[body.material]
type = "neo_hookean"
density = 1000
mu = 1e5
lambda = 1e5
"""

# The bent sheet comes to rest.
RELAXING_SHEET = SHEET.replace("end = 0.1", 'end = 20\nsolver = "relax"\ncheck_every = 40').replace(
    "[output]", "[output]\nframes_every = 0.05\nhistory_every = 0.01").replace(
    "[[body]]", '[[body]]\ninitial_displacement = ["0.1*y^2", "0.05*y"]')


def with_output(text, lines):
    """The scene with further lines in [output]."""
    return text.replace("[output]", f"[output]\n{lines}")


class ProgramTest(unittest.TestCase):
    """A test that runs the program in a directory of its own."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = Path(temporary.name)

    def scene(self, text, name="scene"):
        (self.directory / f"{name}.toml").write_text(text)
        return f"{name}.toml"

    def call(self, *arguments, code=0, **options):
        """Runs the program; the result has its output as attributes (stdout, stderr). `code`: the
        required exit code, None for any."""
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.directory, text=True,
                              capture_output=True, env=ENVIRONMENT, timeout=100, **options)
        if code is not None:
            self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def start(self, *arguments):
        """Starts the program without waiting for its end."""
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.directory, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=ENVIRONMENT)
        self.addCleanup(process.__exit__, None, None, None)
        self.addCleanup(process.kill)
        return process

    def refused(self, arguments, code, *words):
        """The program ends with the exit code `code` and prints all of `words` on stderr."""
        done = self.call(*arguments, code=code)
        for word in words:
            self.assertIn(word, done.stderr)
        return done

    def result_files(self, output):
        """run.h5, run.1.h5, ..."""
        folder = self.directory / output
        files = [folder / "run.h5"]
        while (file := folder / f"run.{len(files)}.h5").exists():
            files.append(file)
        return files

    def frames(self, output):
        """The frames of a run: a list of {name: array}, with step and time."""
        frames = []
        for path in self.result_files(output):
            with h5py.File(path) as file:
                for k in range(len(file["steps"])):
                    frame = file[f"steps/{k}"]
                    frames.append({"step": frame.attrs["step"], "time": frame.attrs["time"],
                                   **{name: array[:] for name, array in frame.items()
                                      if isinstance(array, h5py.Dataset)}})
        return frames

    def history(self, output, killed=False):
        """Columns of history.csv by name. A kill may cut the last row, which readers then leave out."""
        text = (self.directory / output / "history.csv").read_text()
        lines = text.splitlines()[:None if text.endswith("\n") or not killed else -1]
        return dict(zip(lines[0][2:].split(","), np.loadtxt(lines, delimiter=",", ndmin=2).T))


def state_of(done):
    """The hash of the last state of a run."""
    return re.search(r"state ([0-9a-f]{16})", done.stdout).group(1)


def main():
    global PROGRAM
    PROGRAM = sys.argv.pop(1)
    sys.modules["program"].PROGRAM = PROGRAM
    unittest.main(module="__main__", verbosity=2)
