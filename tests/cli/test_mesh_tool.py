#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""tools/mesh fills closed surfaces with tetrahedra that the program reads, and refuses others.
Usage: test_mesh_tool.py PROGRAM"""
import re
import subprocess
from pathlib import Path

import numpy as np

import program
from program import ProgramTest

ROOT = Path(__file__).resolve().parents[2]
KIND = [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("unused", "<u2")]
SCENE = """
dimension = 3
time.end = 1
[[body]]
name = "ball"
shape = "mesh"
file = "{}"
material = {{ type = "neo_hookean", density = 1, mu = 1, lambda = 2 }}
"""


def text_stl(triangles):
    facets = [
        "facet normal 0 0 0\nouter loop\n"
        + "\n".join("vertex " + " ".join(f"{v:.17g}" for v in x) for x in corners)
        + "\nendloop\nendfacet\n"
        for corners in triangles
    ]
    return "solid ball\n" + "".join(facets) + "endsolid ball\n"


class MeshTool(ProgramTest):
    def setUp(self):
        super().setUp()
        script = ROOT / "tests/reference/level_set_stl.py"
        subprocess.run([script, "ball.stl", "--ball", "--cell", "0.15"], cwd=self.directory, check=True)
        self.triangles = np.fromfile(self.directory / "ball.stl", KIND, offset=84)["corners"]

    def mesh(self, *arguments):
        return subprocess.run(
            [ROOT / "tools/mesh", *arguments], cwd=self.directory, text=True, capture_output=True, timeout=300
        )

    def check(self, file):
        return self.call("check", self.scene(SCENE.format(file))).stdout

    def volume_of(self, name, *arguments):
        """Of the ball that the program reads from what the tool makes of NAME.stl."""
        done = self.mesh(f"{name}.stl", "--spacing", "0.45", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        volume = float(re.search(r"closed, volume ([\d.]+)", done.stdout)[1])
        self.assertLess(abs(volume / (4 * np.pi / 3) - 1), 0.02)
        said = self.check(arguments[-1] if arguments else f"{name}.msh")
        return float(re.search(r"tetrahedra of a mesh, surface closed.* of the cells ([\d.]+)", said)[1])

    def test_closed_surfaces(self):
        """Binary, as text, turned inside out; .msh and .vtu."""
        (self.directory / "text.stl").write_text(text_stl(self.triangles))
        (self.directory / "turned.stl").write_text(text_stl(self.triangles[:, ::-1]))
        for arguments in (["ball"], ["text"], ["turned"], ["ball", "--out", "ball.vtu"]):
            volume = self.volume_of(*arguments)
            self.assertLess(abs(volume / (4 * np.pi / 3) - 1), 0.05, arguments)

    def test_refusals(self):
        (self.directory / "open.stl").write_text(text_stl(self.triangles[1:]))
        (self.directory / "cut.stl").write_bytes((self.directory / "ball.stl").read_bytes()[:-7])
        (self.directory / "words.stl").write_text("solid x\nvertex a b c\n")
        (self.directory / "empty.stl").write_text("solid x\nendsolid x\n")
        for file, spacing, words in (
            ("open.stl", "0.45", "is not closed: 3 edges have not one triangle on either side"),
            ("cut.stl", "0.45", "is no .stl file, or is cut off"),
            ("words.stl", "0.45", "has a vertex that is not three numbers"),
            ("empty.stl", "0.45", "has no triangles"),
            ("nowhere.stl", "0.45", "cannot read 'nowhere.stl': No such file or directory"),
            ("ball.stl", "2", "is less than eight cubes of the spacing 2"),
        ):
            done = self.mesh(file, "--spacing", spacing)
            self.assertEqual(done.returncode, 1, file)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertEqual(list(self.directory.glob("*.msh")), [])
        self.assertEqual(self.mesh("ball.stl", "--spacing", "-1").returncode, 2)
        self.assertEqual(self.mesh("ball.stl", "--spacing", "1", "--out", "ball.obj").returncode, 2)


if __name__ == "__main__":
    program.main()
