#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The reader of the package meniscus, and probes: fields at points and along lines.
Usage: test_reader.py PROGRAM"""
import re
import sys
import tomllib
from pathlib import Path

import meshio
import numpy as np

import program
from program import BLOCK, REMAPPED_DROP, SHEET, ProgramTest, shipped, with_output

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "src/python"))
import meniscus  # noqa: E402  pylint: disable=wrong-import-position

PROBES = """
[[probe]]
name = "corner"
body = "block"
at = [0.5, 0.5, 0.5]
fields = ["position", "von_mises"]
[[probe]]
name = "axis"
body = "block"
from = [0, 0, -0.5]
to = [0, 0, 0.5]
points = 5
"""


class Reader(ProgramTest):
    def open(self, output):
        run = meniscus.open(self.directory / output)
        self.addCleanup(run.close)
        return run

    def test_a_run_of_three_epochs(self):
        self.call("run", self.scene(REMAPPED_DROP), "--output", "out")
        run, frames = self.open("out"), self.frames("out")
        self.assertEqual(len(run.files), 3)
        np.testing.assert_array_equal(run.times, [frame["time"] for frame in frames])
        np.testing.assert_array_equal(run.steps, [frame["step"] for frame in frames])
        self.assertEqual(set(run.fields), {"position", "velocity", "J"})
        references = set()
        for k, frame in enumerate(frames):
            drop = run.body("drop", k)
            references.add(id(drop))
            np.testing.assert_array_equal(run.points(k, "drop"), frame["position"])
            np.testing.assert_array_equal(run.field(k, "J", drop), frame["J"])
            # In each epoch, the cells with the positions of this frame fill the drop.
            corners = run.points(k, "drop")[drop.cells]
            edges = corners[:, [1, 3, 4]] - corners[:, :1]
            self.assertTrue((np.linalg.det(edges) > 0).all())
            self.assertEqual(len(drop), len(drop.X))
            self.assertAlmostEqual(drop.mass.sum() / run.body("drop").mass.sum(), 1, delta=1e-12)
        self.assertEqual(len(references), 3)
        for name, column in self.history("out").items():
            np.testing.assert_array_equal(run.history[name], column)
        self.assertEqual((run.units["drop.aspect"], run.units["time"], run.length_unit), ("1", "s", "m"))

    def test_what_is_not_there_is_named(self):
        self.call("run", self.scene(SHEET), "--output", "out")
        run = self.open("out")
        with self.assertRaisesRegex(ValueError, "no body 'shet'; there are sheet"):
            run.body("shet")
        with self.assertRaisesRegex(ValueError, "no field 'presure'; there are J, position"):
            run.field(0, "presure", "sheet")
        self.assertEqual(run.points(0, "sheet").shape, (66, 2))
        with self.assertRaises(OSError):
            meniscus.open(self.directory / "nowhere")

    def test_a_row_that_is_being_written_is_left_out(self):
        self.call("run", self.scene(SHEET), "--output", "out")
        before = self.open("out").history["time"]
        with open(self.directory / "out/history.csv", "a", encoding="utf-8") as file:
            file.write("0.1,3")
        np.testing.assert_array_equal(self.open("out").history["time"], before)

    def test_frames(self):
        text = with_output(BLOCK, 'fields = ["velocity", "J", "von_mises", "F"]')
        self.call("run", self.scene(text), "--output", "out")
        results = self.open("out")
        frame = results.frame(-1)
        self.assertEqual((frame.time, frame.step), (results.times[-1], results.steps[-1]))
        self.assertEqual(frame.number, len(results.frames) - 1)
        np.testing.assert_array_equal(frame.points("block"), results.points(-1, "block"))
        np.testing.assert_array_equal(frame.field("J", "block"), results.field(-1, "J", "block"))
        with self.assertRaisesRegex(IndexError, f"there is no frame 99; there are {len(results.frames)}"):
            results.frame(99)
        self.assertIn("<td>block (125 particles)</td>", results._repr_html_())  # pylint: disable=protected-access

    def test_frames_for_other_programs(self):
        for text, kind, name in ((BLOCK, "hexahedron", "block"), (SHEET, "quad", "sheet")):
            self.call("run", self.scene(text), "--output", name, "--until", "0.04")
            results = self.open(name)
            frame = results.frame(0)
            frame.to_vtk(self.directory / "frame.vtu")
            mesh = meshio.read(self.directory / "frame.vtu")
            body = results.body(name)
            np.testing.assert_array_equal(mesh.points[:, : results.dimension], frame.points(name))
            np.testing.assert_array_equal(mesh.cells_dict[kind], body.cells)
            self.assertEqual(set(mesh.point_data), set(results.fields) - {"position"})
            # The cells have the volume of the body.
            corners = mesh.points[mesh.cells_dict[kind]]
            edges = corners[:, [1, 3] if kind == "quad" else [1, 3, 4]] - corners[:, :1]
            volumes = np.linalg.det(edges[:, :, : results.dimension])
            self.assertAlmostEqual(volumes.sum(), body.volume.sum(), delta=1e-6)

    def test_pictures(self):
        for text, name in ((BLOCK, "block"), (SHEET, "sheet")):
            self.call("run", self.scene(with_output(text, f'measures = ["{name}.centre_x"]')), "--output", name,
                      "--until", "0.02")  # fmt: skip
            results = self.open(name)
            for figure, axes in ((results.plot(), 1), (results.plot("time", "step"), 2), (results.frame(-1).plot(), 2),
                                 (results.frame(0).plot("velocity", name), 2)):  # fmt: skip
                figure.savefig(self.directory / "figure.png")
                self.assertEqual(len(figure.axes), axes)
            with self.assertRaisesRegex(ValueError, "the history has no column 'tiem'; it has time, step"):
                results.plot("tiem")

    def test_history_in_pandas(self):
        self.call("run", self.scene(SHEET), "--output", "out")
        results = self.open("out")
        frame = results.history_frame()
        np.testing.assert_array_equal(frame.index, results.history["time"])
        for name in frame:
            np.testing.assert_array_equal(frame[name], results.history[name])
        self.assertEqual(len(frame.columns), len(results.history) - 1)


class Probes(ProgramTest):
    def test_points_and_lines(self):
        self.call("run", self.scene(BLOCK + PROBES), "--output", "out")
        run = meniscus.open(self.directory / "out")
        self.addCleanup(run.close)
        last = run.body("block")
        corner = np.argmin(np.linalg.norm(last.X - 0.5, axis=1))
        for i, axis in enumerate("xyz"):
            self.assertAlmostEqual(run.history[f"corner.position_{axis}"][-1],
                                   run.points(-1, "block")[corner, i], delta=1e-13)
        self.assertEqual(run.units["corner.von_mises"], "Pa")
        axis, units = run.line("axis")
        self.assertEqual((units["distance"], units["velocity_x"]), ("m", "m/s"))
        np.testing.assert_array_equal(np.unique(axis["time"]), run.times)
        np.testing.assert_allclose(axis["distance"], np.tile(np.linspace(0, 1, 5), len(run.times)))
        # Three of the five points of the line are particles.
        bottom = np.argmin(np.linalg.norm(last.X - [0, 0, -0.5], axis=1))
        displacement = run.field(-1, "position", "block")[bottom] - last.X[bottom]
        self.assertAlmostEqual(axis["displacement_x"][-5], displacement[0], delta=1e-13)
        self.assertGreater(abs(axis["displacement_x"][-5]), 1e-6)

    def test_they_cost_the_run_nothing_and_go_on_after_a_restart(self):
        text = with_output(BLOCK, "restartable = true") + PROBES
        plain = self.call("run", self.scene(BLOCK), "--output", "plain")
        whole = self.call("run", self.scene(text), "--output", "whole")
        self.assertEqual(program.state_of(plain), program.state_of(whole))
        self.call("run", self.scene(text), "--output", "part", "--until", "0.17")
        part = self.call("run", self.scene(text), "--restart", "part")
        self.assertEqual(program.state_of(part), program.state_of(whole))
        again = self.call("run", self.scene(text), "--restart", "whole", "--frame", "3", "--threads", "1")
        self.assertEqual(program.state_of(again), program.state_of(whole))
        lines = [(self.directory / name / "probe-axis.csv").read_text() for name in ("whole", "part")]
        self.assertEqual(lines[0], lines[1])
        self.assertEqual(len(lines[0].splitlines()), 2 + 5 * 11)

    def test_a_run_that_is_replaced_takes_its_lines_along(self):
        self.call("run", self.scene(BLOCK + PROBES), "--output", "out", "--until", "0.01")
        self.assertTrue((self.directory / "out/probe-axis.csv").exists())
        self.call("run", self.scene(BLOCK), "--output", "out", "--until", "0.01", "--overwrite")
        self.assertFalse((self.directory / "out/probe-axis.csv").exists())

    def test_refusals(self):
        text = BLOCK + PROBES.replace("0.5, 0.5, 0.5", "0.5, 0.5, 0.9")
        self.refused(["check", self.scene(text)], 3, "scene.toml:", "probe[0].at: (0.5, 0.5, 0.9) is outside")
        text = BLOCK + PROBES.replace("von_mises", "von_mses")
        self.refused(["run", self.scene(text)], 3, "probe[0].fields: 'von_mses'", "did you mean 'von_mises'?")


class Measures(ProgramTest):
    def test_every_measure_is_listed(self):
        """`keys --measures` lists all measures that scenes of inputs/ write and expect, with a meaning."""
        text = self.call("keys", "--measures").stdout
        self.assertEqual(text, self.call("keys", "--measures").stdout)
        listed = {}
        for line in text.splitlines():
            if match := re.match(r"  (?:BODY|NAME)\.(\w+) +(\S+(?: \S+)*)  +(\S.*)$", line):
                listed[match.group(1)] = match.group(2)
        for name, unit in {"centre_x": "m", "velocity_z": "m/s", "momentum_y": "kg m/s", "spin_z": "kg m^2/s",
                           "kinetic_energy": "J", "principal_extent_1": "m", "aspect": "1", "gap": "m",
                           "isoperimetric": "1", "ridge_height": "m", "pole_thickness": "m"}.items():
            self.assertEqual(listed.get(name), unit, name)
        for path in shipped.scenes():
            scene = tomllib.loads(path.read_text(encoding="utf-8"))
            used = set(scene.get("output", {}).get("measures", []))
            used |= {e.get("of", name) for name, e in scene.get("expect", {}).items()}
            for name in used:
                if "." in name:
                    self.assertIn(name.split(".")[-1], listed, path.name)
        self.refused(["keys", "time", "--measures"], 2, "--measures")


if __name__ == "__main__":
    program.main()
