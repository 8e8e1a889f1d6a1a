#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Opens runs as ParaView does: cells, times, volumes, a surface, a slice, rigid partners; and reads the
meshes that VTK writes.
Usage: check_paraview.py PROGRAM"""
import itertools
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from paraview.simple import (Delete, ExtractSurface, IntegrateVariables, MeshQuality, Slice, Xdmf3ReaderS,
                             Xdmf3ReaderT, XDMFReader, servermanager)  # fmt: skip
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

PROGRAM = str(Path(sys.argv.pop(1)).resolve())
MATERIAL = 'material = { type = "neo_hookean", density = 1, mu = 1, lambda = 2 }\n'
WALL = """
[[contact]]
bodies = ["{0}"]
adhesion = 1e-3
range = 0.1
partner = {{ {1} }}
"""
IN_SPACE = f"""
dimension = 3
[time]
end = 0.1
step = 0.01
[output]
frames_every = 0.02
fields = ["velocity", "von_mises"]
[[body]]
name = "ball"
shape = "ball"
radius = 1
core = 4
layers = 2
initial_velocity = ["0.1", "0", "0"]
{MATERIAL}
[[body]]
name = "block"
shape = "mesh"
file = "block.msh"
move = [4, 0, 0]
{MATERIAL}
""" + WALL.format(
    "ball", 'type = "half_space", point = [0, 0, -1.3], normal = [0, 0, 1], displacement = ["0", "0", "-t"]'
) + WALL.format("block", 'type = "ball", centre = [4.5, 0.5, -2], radius = 1.5')
IN_THE_PLANE = f"""
dimension = 2
[time]
end = 0.1
step = 0.01
[output]
frames_every = 0.02
[[body]]
name = "disk"
shape = "disk"
radius = 1
core = 4
rings = 2
{MATERIAL}
""" + WALL.format("disk", 'type = "frame", low = [-1.4, -1.3], high = [2, 3]')
REVOLVED = f"""
dimension = "axisymmetric"
[time]
end = 0.1
step = 0.01
[output]
frames_every = 0.02
fields = ["velocity", "von_mises"]
measures = ["ball.volume"]
revolved = true
[[body]]
name = "ball"
shape = "disk"
radius = 1
core = 16
rings = 8
centre = [0, 0.5]
initial_velocity = ["0.2*x", "0.1"]
{MATERIAL}
[[body]]
name = "torus"
shape = "rectangle"
size = [0.4, 0.4]
cells = [4, 4]
centre = [2, 0]
{MATERIAL}
"""


def cube_of_tetrahedra(n):
    """A text mesh of Gmsh of the unit cube, 6 n^3 cells."""
    number = {x: k + 1 for k, x in enumerate(itertools.product(range(n + 1), repeat=3))}
    nodes = [f"{k} " + " ".join(f"{v / n:.9g}" for v in x) for x, k in number.items()]
    cells = []
    for low in itertools.product(range(n), repeat=3):
        for order in itertools.permutations(range(3)):
            x, corners = list(low), [number[low]]
            for axis in order:
                x[axis] += 1
                corners.append(number[tuple(x)])
            cells.append(f"{len(cells) + 1} 4 0 " + " ".join(map(str, corners)))
    lists = [("Nodes", nodes), ("Elements", cells)]
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + "".join(
        f"${name}\n{len(lines)}\n" + "\n".join(lines) + f"\n$End{name}\n" for name, lines in lists
    )


def block_of_hexahedra(n):
    """A VTK grid in the unit cube with a vector, whose range VTK writes as <InformationKey>."""
    number = {x: k for k, x in enumerate(itertools.product(range(n + 1), repeat=3))}
    grid, points, field = vtkUnstructuredGrid(), vtkPoints(), vtkDoubleArray()
    points.SetDataTypeToDouble()
    field.SetName("vector")
    field.SetNumberOfComponents(3)
    for x in number:
        points.InsertNextPoint(*(v / n for v in x))
        field.InsertNextTuple3(*x)
    grid.SetPoints(points)
    grid.GetPointData().AddArray(field)
    for array in (field, points.GetData()):
        array.GetRange(-1)
    for i, j, k in itertools.product(range(n), repeat=3):
        around = [(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        grid.InsertNextCell(VTK_HEXAHEDRON, 8, [number[x] for x in around])
    return grid


class ParaView(unittest.TestCase):
    def run_of(self, text):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        directory = Path(folder.name)
        (directory / "block.msh").write_text(cube_of_tetrahedra(3))
        (directory / "scene.toml").write_text(text)
        subprocess.run(
            [PROGRAM, "run", "scene.toml", "--output", "out"], cwd=directory, check=True, capture_output=True
        )
        return directory / "out"

    def opened(self, file):
        reader = XDMFReader(FileNames=[str(file)])
        self.addCleanup(Delete, reader)
        reader.UpdatePipeline()
        return reader

    def sizes(self, reader, **measures):
        """Volume (2D: area) of each cell."""
        quality = MeshQuality(Input=reader, **measures)
        quality.UpdatePipeline()
        return vtk_to_numpy(servermanager.Fetch(quality).GetCellData().GetArray("Quality"))

    def total(self, source, name):
        integral = IntegrateVariables(Input=source)
        integral.UpdatePipeline()
        return servermanager.Fetch(integral).GetCellData().GetArray(name).GetValue(0)

    def test_bodies_in_space(self):
        """Hexahedra of a ball beside tetrahedra of a mesh."""
        out = self.run_of(IN_SPACE)
        run = self.opened(out / "run.xdmf")
        self.assertEqual(len(run.TimestepValues), 6)
        self.assertAlmostEqual(run.TimestepValues[-1], 0.1, 12)
        self.assertEqual(set(run.PointData.keys()), {"body", "surface", "velocity", "von_mises"})
        types = {}
        grid = servermanager.Fetch(run)
        for c in range(grid.GetNumberOfCells()):
            types[grid.GetCellType(c)] = types.get(grid.GetCellType(c), 0) + 1
        self.assertEqual(types[10], 6 * 3**3)
        self.assertEqual(set(types), {10, 12})
        self.assertGreater(self.sizes(run, TetQualityMeasure="Volume", HexQualityMeasure="Volume").min(), 0)
        # The volumes of the ball (a polyhedron of its hexahedra) and of the cube.
        self.assertLess(abs(self.total(run, "Volume") - (4 * 3.14159265 / 3 + 1)), 0.4)
        surface = ExtractSurface(Input=run)
        surface.UpdatePipeline()
        kinds = vtk_to_numpy(servermanager.Fetch(surface).GetPointData().GetArray("surface"))
        self.assertEqual(kinds.min(), 1)
        cut = Slice(Input=run, SliceType="Plane")
        cut.SliceType.Origin, cut.SliceType.Normal = [0, 0, 0.1], [0, 0, 1]
        cut.UpdatePipeline()
        self.assertLess(abs(self.total(cut, "Area") - (3.14159265 * 0.99 + 1)), 0.2)
        low, high = servermanager.Fetch(cut).GetPointData().GetArray("velocity").GetRange(0)
        self.assertLess(abs(high - 0.1), 0.1)
        self.assertGreater(high, low)

    def test_meshes_of_vtk(self):
        """Every data mode of VTK, compressed or not, with appended data as base64 or as raw bytes."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        directory = Path(folder.name)
        (directory / "scene.toml").write_text(
            f'dimension = 3\ntime.end = 1\n[[body]]\nname = "block"\nshape = "mesh"\nfile = "block.vtu"\n{MATERIAL}'
        )
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetInputData(block_of_hexahedra(3))
        writer.SetFileName(str(directory / "block.vtu"))
        default = (writer.Appended, True, True, 32, 32768)
        for mode, base64, zlib, header, block in (
            default,
            (writer.Ascii, True, True, 32, 32768),
            (writer.Binary, True, True, 64, 256),
            (writer.Binary, True, False, 32, 32768),
            (writer.Appended, False, True, 64, 256),
            (writer.Appended, False, False, 64, 32768),
            (writer.Appended, True, False, 32, 32768),
        ):
            writer.SetDataMode(mode)
            writer.SetEncodeAppendedData(base64)
            writer.SetBlockSize(block)
            (writer.SetCompressorTypeToZLib if zlib else writer.SetCompressorTypeToNone)()
            (writer.SetHeaderTypeToUInt64 if header == 64 else writer.SetHeaderTypeToUInt32)()
            writer.Write()
            said = subprocess.run([PROGRAM, "check", "scene.toml"], cwd=directory, capture_output=True, text=True)
            self.assertEqual((said.returncode, said.stderr), (0, ""), (mode, base64, zlib, header, block))
            self.assertIn("27 hexahedra of a mesh, surface closed, with area 6 and volume 1 within", said.stdout)

    def test_rigid_partners(self):
        """The plane moves away, the ball is fixed."""
        walls = self.opened(self.run_of(IN_SPACE) / "partners.xdmf")
        self.assertEqual(len(walls.TimestepValues), 6)
        for time in (0, walls.TimestepValues[-1]):
            walls.UpdatePipeline(time)
            grid = servermanager.Fetch(walls)
            self.assertEqual({grid.GetCellType(c) for c in range(grid.GetNumberOfCells())}, {9})
            plane, ball = grid.GetCell(0).GetBounds(), grid.GetBounds()
            self.assertAlmostEqual(plane[4], -1.3 - time, 6)
            self.assertAlmostEqual(plane[5], -1.3 - time, 6)
            self.assertLess(plane[0], -2)
            self.assertAlmostEqual(ball[4], -3.5, 6)
            self.assertAlmostEqual(ball[5], -0.5, 6)

    def test_every_reader_of_paraview(self):
        """ParaView has three readers for XDMF."""
        for text in (IN_SPACE, IN_THE_PLANE):
            out = self.run_of(text)
            for name in ("run", "partners"):
                file, found = str(out / f"{name}.xdmf"), []
                for reader in (
                    XDMFReader(FileNames=[file]), Xdmf3ReaderS(FileName=[file]), Xdmf3ReaderT(FileName=[file])
                ):  # fmt: skip
                    self.addCleanup(Delete, reader)
                    reader.UpdatePipeline(reader.TimestepValues[3])
                    self.assertEqual(len(reader.TimestepValues), 6)
                    data = reader.GetDataInformation()
                    found.append((data.GetNumberOfCells(), data.GetNumberOfPoints()))
                self.assertEqual(found, [found[0]] * 3)
                self.assertGreater(min(found[0]), 0)

    def test_bodies_of_revolution(self):
        """Their surfaces in space: the area of a ball and of a torus, and velocities that turn with them."""
        frames = self.opened(self.run_of(REVOLVED) / "revolved.xdmf")
        self.assertEqual(len(frames.TimestepValues), 6)
        pi = 3.14159265
        self.assertLess(abs(self.total(frames, "Area") / (4 * pi + 2 * pi * 2 * 1.6) - 1), 0.01)
        frames.UpdatePipeline(0)
        grid = servermanager.Fetch(frames)
        self.assertEqual({grid.GetCellType(c) for c in range(grid.GetNumberOfCells())}, {9})
        low = grid.GetBounds()
        for found, expected in zip(low, (-2.2, 2.2, -0.5, 1.5, -2.2, 2.2)):
            self.assertAlmostEqual(found, expected, 6)
        x = vtk_to_numpy(grid.GetPoints().GetData())
        velocity = vtk_to_numpy(grid.GetPointData().GetArray("velocity"))
        self.assertIsNotNone(grid.GetPointData().GetArray("von_mises"))
        ball = (x[:, 0] ** 2 + x[:, 2] ** 2 < 1.01)
        for axis in (0, 2):
            self.assertLess(abs(velocity[ball, axis] - 0.2 * x[ball, axis]).max(), 1e-6)
        self.assertLess(abs(velocity[ball, 1] - 0.1).max(), 1e-6)

    def test_the_plane(self):
        out = self.run_of(IN_THE_PLANE)
        run, frame = self.opened(out / "run.xdmf"), self.opened(out / "partners.xdmf")
        self.assertEqual(servermanager.Fetch(run).GetCellType(0), 9)
        self.assertGreater(self.sizes(run, QuadQualityMeasure="Area").min(), 0)
        self.assertLess(abs(self.total(run, "Area") - 3.14159265), 0.2)
        grid = servermanager.Fetch(frame)
        self.assertEqual([grid.GetCellType(c) for c in range(grid.GetNumberOfCells())], [4] * 4)
        self.assertEqual(grid.GetBounds(), (-1.4, 2, -1.3, 3, 0, 0))


if __name__ == "__main__":
    unittest.main(verbosity=2)
