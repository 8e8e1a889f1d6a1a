#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""tools/mesh fills closed surfaces with tetrahedra that the program reads, and refuses others.
Usage: test_mesh_tool.py PROGRAM"""
import os
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


# Two hexahedra, one on top of the other, each in its own element set.
INP = """*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 0, 0, 2
10, 1, 0, 2
11, 1, 1, 2
12, 0, 1, 2
*ELEMENT, TYPE=C3D8, ELSET=all
1, 1,2,3,4,5,6,7,8
2, 5,6,7,8,9,10,11,12
*ELSET, ELSET=soft
1
*ELSET, ELSET=stiff
2
"""
VTK = """# vtk DataFile Version 3.0
a tetrahedron
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 4 double
0 0 0  1 0 0  0 1 0  0 0 1
CELLS 1 5
4 0 1 2 3
CELL_TYPES 1
10
"""


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
        """Volume of the ball that the program reads from the mesh made from NAME.stl."""
        done = self.mesh(f"{name}.stl", "--spacing", "0.45", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        volume = float(re.search(r"closed, volume ([\d.]+)", done.stdout)[1])
        self.assertLess(abs(volume / (4 * np.pi / 3) - 1), 0.02)
        said = self.check(arguments[-1] if arguments else f"{name}.msh")
        return float(re.search(r"tetrahedra of a mesh, surface closed.* of the cells ([\d.]+)", said)[1])

    def test_closed_surfaces(self):
        """Surfaces in binary and text files, with normals to the outside and to the inside; output as .msh and
        .vtu."""
        (self.directory / "text.stl").write_text(text_stl(self.triangles))
        (self.directory / "turned.stl").write_text(text_stl(self.triangles[:, ::-1]))
        for arguments in (["ball"], ["text"], ["turned"], ["ball", "--out", "ball.vtu"]):
            volume = self.volume_of(*arguments)
            self.assertLess(abs(volume / (4 * np.pi / 3) - 1), 0.05, arguments)

    def test_small_units(self):
        """CGAL compares some lengths with absolute numbers; a ball of radius 1e-15 took for ever."""
        (self.directory / "tiny.stl").write_text(text_stl(1e-15 * self.triangles.astype(float)))
        done = self.mesh("tiny.stl", "--spacing", "6e-16")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertLess(abs(float(re.search(r"tetrahedra, volume (\S+)", done.stdout)[1]) / 4.19e-45 - 1), 0.1)

    def test_shells(self):
        """An inner surface of opposite orientation bounds a cavity. The same orientation and crossings are refused."""
        inner = 0.5 * self.triangles
        for name, parts, words in (
            ("nested", [self.triangles, inner], "lies within another one and goes round the same way"),
            ("crossing", [self.triangles, self.triangles + [1, 0.1, 0.2]], "pairs of triangles cross"),
        ):
            (self.directory / f"{name}.stl").write_text(text_stl(np.concatenate(parts)))
            done = self.mesh(f"{name}.stl", "--spacing", "0.45")
            self.assertEqual(done.returncode, 1, name)
            self.assertIn(words, done.stderr)
        for turn in (1, -1):
            hollow = np.concatenate([self.triangles[:, ::turn], inner[:, ::-turn]])
            (self.directory / "hollow.stl").write_text(text_stl(hollow))
            done = self.mesh("hollow.stl", "--spacing", "1.5")
            self.assertIn("is less than eight cubes", done.stderr)
            volume = float(re.search(r"closed, volume ([\d.]+)", done.stdout)[1])
            self.assertLess(abs(volume / (4 * np.pi / 3 * 7 / 8) - 1), 0.02)

    def test_sharp_edges_are_told_and_read(self):
        corners = np.array([[i, j, k] for k in (0, 1) for j in (0, 1) for i in (0, 1)], float)
        sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        cube = corners[[t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]]
        (self.directory / "cube.stl").write_text(text_stl(cube))
        done = self.mesh("cube.stl", "--spacing", "0.4")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("12 edges of the surface are sharp and cut off in the mesh", done.stderr)
        self.assertIn("tetrahedra of a mesh, surface closed", self.check("cube.msh"))

    def test_files_with_cells(self):
        """Cells of a file are written unchanged, and element sets as groups."""
        (self.directory / "two.inp").write_text(INP)
        (self.directory / "one.vtk").write_text(VTK)
        done = self.mesh("two.inp")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("12 nodes, 2 cells of kind hexahedron, groups soft, stiff", done.stdout)
        written = (self.directory / "two.msh").read_text()
        self.assertIn('3 1 "soft"\n3 2 "stiff"', written)
        self.assertRegex(written, r"1 5 2 1 1 1 2 3 4 5 6 7 8\s+2 5 2 2 2 5 6 7 8 9 10 11 12")
        done = self.mesh("one.vtk", "--out", "one.vtu")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("4 nodes, 1 cells of kind tetra", done.stdout)

    def test_refusals(self):
        os.mkfifo(self.directory / "fifo.stl")
        (self.directory / "broken.inp").write_text(INP[:150])
        point = VTK.replace("CELLS 1 5\n4 0 1 2 3", "CELLS 1 2\n1 0").replace("\n10\n", "\n1\n")
        (self.directory / "points.vtk").write_text(point)
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
            ("ball.stl", "1e-9", "at most 2e+06 are possible; use --spacing 0.028 or more"),
            ("fifo.stl", "1", "cannot read 'fifo.stl': it is a directory or a device; expected is a file"),
            ("broken.inp", "1", "meshio does not read 'broken.inp': "),
            ("points.vtk", "1", "'points.vtk' has no hexahedra, tetrahedra, quadrilaterals or triangles"),
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
