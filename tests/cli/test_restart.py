#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A run that is stopped and continued in any way has the same bits as an uninterrupted one.
Usage: test_restart.py PROGRAM"""
import json
import re
import shutil
import signal
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

import program
from hostile_files import sign
from program import BLOCK, DROP, RELAXING_SHEET, REMAPPED_DROP, ProgramTest, state_of, with_output

# One thread by default. Beside other tests, two threads would take 1.5 times as long for such small
# bodies.
program.ENVIRONMENT["OMP_NUM_THREADS"] = "1"


class Restart(ProgramTest):
    kept = {}  # [scene] copy of the uninterrupted run, and its hash

    def reference(self, text):
        """The uninterrupted run: scene, hash, history and frames, each with the state. Each scene is
        run once; a test may change its copy."""
        self.file = self.scene(with_output(text, "restartable = true"))
        self.end = re.search(r"end = (.*)", text).group(1).strip('"')
        if text not in self.kept:
            state = state_of(self.call("run", self.file, "--output", "whole"))
            folder = tempfile.TemporaryDirectory()
            unittest.addModuleCleanup(folder.cleanup)
            self.kept[text] = shutil.copytree(self.directory / "whole", Path(folder.name) / "whole"), state
        else:
            shutil.copytree(self.kept[text][0], self.directory / "whole")
        self.whole = self.kept[text][1]
        self.whole_history = (self.directory / "whole/history.csv").read_text()
        self.whole_frames = self.frames("whole")

    def assert_same(self, done, output):
        self.assertEqual(state_of(done), self.whole)
        self.assertEqual((self.directory / output / "history.csv").read_text(), self.whole_history)
        self.assert_same_frames(self.frames(output), self.whole_frames)

    def assert_same_frames(self, frames, expected):
        self.assertEqual(len(frames), len(expected))
        for frame, other in zip(frames, expected):
            self.assertEqual(frame.keys(), other.keys())
            for name in frame:
                self.assertTrue(np.array_equal(frame[name], other[name]), name)

    def stop_at(self, time, output, *options):
        self.call("run", self.file, "--output", output, "--until", time, *options)

    def go_on(self, output, *options):
        return self.call("run", self.file, "--output", output, *options)


class EveryWay:
    """All ways to stop and continue, for a scene with a TIME in its middle."""

    def test_threads(self):
        self.reference(self.SCENE)
        for threads in (2, 3):
            done = self.call("run", self.file, "--output", f"t{threads}", "--threads", threads)
            self.assert_same(done, f"t{threads}")

    def test_directory(self):
        self.reference(self.SCENE)
        self.stop_at(self.TIME, "part")
        self.assert_same(self.go_on("part", "--restart", "part", "--threads", "2"), "part")

    def test_checkpoint_file(self):
        self.reference(self.SCENE)
        self.stop_at(self.TIME, "part")
        checkpoint = self.directory / "part/checkpoint-a.h5"
        self.assert_same(self.go_on("part", "--restart", checkpoint), "part")

    def test_elsewhere(self):
        """In another directory, there are only the rows and frames after the stop."""
        self.reference(self.SCENE)
        self.stop_at(self.TIME, "part")
        rows = len((self.directory / "part/history.csv").read_text().splitlines())
        done = self.go_on("rest", "--restart", "part")
        self.assertEqual(state_of(done), self.whole)
        lines = self.whole_history.splitlines()
        rest = (self.directory / "rest/history.csv").read_text().splitlines()
        self.assertEqual(rest, lines[:2] + lines[rows:])
        self.assert_same_frames(self.frames("rest"), self.whole_frames[len(self.frames("part")):])

    def test_frame(self):
        """Continues from a frame of a finished run; later frames are made again."""
        self.reference(self.SCENE)
        self.assert_same(self.call("run", self.file, "--output", "whole", "--restart", "whole",
                                   "--frame", "3"), "whole")

    def test_stop_after_going_back(self):
        """After a return to a frame, no checkpoint is left that would skip rows."""
        self.reference(self.SCENE)
        first = self.whole_frames[2]["time"] * (1 + 1e-9)
        self.call("run", self.file, "--restart", "whole", "--frame", "2", "--until", first)
        self.assert_same(self.call("run", self.file, "--restart", "whole"), "whole")

    def test_twice(self):
        self.reference(self.SCENE)
        self.stop_at(self.TIME, "part")
        self.stop_at(self.LATER, "part", "--restart", "part")
        self.assert_same(self.go_on("part", "--restart", "part"), "part")

    def test_signal(self):
        self.reference(self.SCENE)
        for number in (signal.SIGTERM, signal.SIGINT):
            output = f"signal{number}"
            process = self.start("run", self.file, "--output", output)
            while process.poll() is None and not (self.directory / output / "history.csv").exists():
                pass
            process.send_signal(number)
            _, stderr = process.communicate()
            self.assertEqual(process.returncode, 128 + number, stderr)
            self.assertIn(f"--restart {output}", stderr)
            self.assert_same(self.go_on(output, "--restart", output), output)

    def test_wall_clock(self):
        self.reference(self.SCENE)
        done = self.call("run", self.file, "--output", "part", "--max-walltime", "0:0:0.001",
                         code=142)
        self.assertIn("--restart part", done.stderr)
        self.assert_same(self.go_on("part", "--restart", "part"), "part")

    def test_longer(self):
        """A finished run can be continued with a later end time, from a frame before its end."""
        self.reference(self.SCENE)
        shorter = ["--set", f"time.end={self.TIME!r}"]
        self.call("run", self.file, "--output", "part", *shorter)
        self.call("run", self.file, "--output", "part", "--restart", "part")
        self.assertEqual(self.frames("part")[-1]["time"], self.whole_frames[-1]["time"])
        self.call("run", self.file, "--output", "again", *shorter)
        self.assert_same(self.go_on("again", "--restart", "again", "--frame", "2"), "again")


class Drop(EveryWay, Restart):
    SCENE, TIME, LATER = DROP, "20.3 ps", "41 ps"


class ViscousDrop(Restart):
    """A drop with implicit viscosity, stopped in the second epoch."""
    SCENE = REMAPPED_DROP.replace("[time]\n", "[time]\nviscosity = \"automatic\"\n").replace(
        "0.6 mPa s", "6 mPa s")

    def test_choice(self):
        self.reference(self.SCENE)
        self.assertIn("viscosity is implicit", (self.directory / "whole/run.log").read_text())
        self.stop_at("20.3 ps", "part")
        self.assert_same(self.go_on("part", "--restart", "part", "--threads", "2"), "part")

    def test_it_may_change(self):
        self.reference(self.SCENE)
        for before, after in (("explicit", "automatic"), ("implicit", "explicit"), ("automatic", "implicit")):
            with self.subTest(before=before, after=after):
                self.call("run", self.file, "--output", before, "--until", "2 ps", "--set", f"time.viscosity={before}")
                self.call("run", self.file, "--restart", before, "--until", "3 ps", "--set", f"time.viscosity={after}")


class ChangedState(Restart):
    """An impossible state with a right hash is refused; the message names the value."""
    NO_NUMBERS = {"nan": np.nan, "inf": np.inf}
    LENGTHS = NO_NUMBERS | {"zero": 0.0, "negative": -1.0, "huge": 1e300}
    CHANGES = {
        "time": NO_NUMBERS | {"negative": -1.0},
        "step": {"negative": -1, "huge": 1 << 62},
        "epoch": {"negative": -1},
        "last_step": NO_NUMBERS | {"negative": -1.0, "huge": 1e300},
        "step_control/step": LENGTHS,
        "step_control/stable/dt": LENGTHS,
        "step_control/stable/stiffness": NO_NUMBERS | {"negative": -1.0, "huge": 1e300},
        "step_control/stable/viscosity": NO_NUMBERS | {"negative": -1.0},
        "step_control/first_limit": NO_NUMBERS | {"zero": 0.0, "negative": -1.0},
        "step_control/interval": LENGTHS,
        "step_control/next_check": {"negative": -1, "huge": 1 << 62},
        "demand/longest": NO_NUMBERS | {"zero": 0.0, "negative": -1.0},
        "stepper/dynamics/energy_resolution/energy": NO_NUMBERS | {"negative": -1.0},
        "stepper/dynamics/energy_resolution/held": NO_NUMBERS | {"negative": -1.0},
        "velocity": NO_NUMBERS,
    }

    def test_numbers_out_of_range(self):
        scene = self.scene(with_output(DROP.replace('"60 ps"', '"15 ps"'), "restartable = true"))
        self.call("run", scene, "--output", "whole")
        original = (self.directory / "whole/run.h5").read_bytes()
        path = self.directory / "changed.h5"
        for name, changes in self.CHANGES.items():
            for what, value in changes.items():
                with self.subTest(name=name, change=what):
                    path.write_bytes(original)
                    with h5py.File(path, "r+") as file:
                        file["steps/1/state"][name][-1] = value
                        sign(file["steps/1"])
                    self.refused(["run", scene, "--output", "on", "--restart", path, "--frame", 1], 5,
                                 "out of range" if np.isfinite(value) else f"'{name}' is {value}")

    def test_another_order_of_particles(self):
        """Another version of the program may number particles in another order."""
        scene = self.scene(with_output(DROP.replace('"60 ps"', '"15 ps"'), "restartable = true"))
        self.call("run", scene, "--output", "out")
        with h5py.File(self.directory / "out/run.h5", "r+") as file:
            file["steps/1/state/orders/drop"][0] *= 1 + 1e-5
            sign(file["steps/1"])
        self.refused(["run", scene, "--output", "on", "--restart", "out", "--frame", 1], 5, "body 'drop'",
                     "another order")


class RemappedDrop(EveryWay, Restart):
    # The run is stopped in the second and the third epoch.
    SCENE, TIME, LATER = REMAPPED_DROP, "20.3 ps", "41 ps"

    def test_series(self):
        """A file per epoch; sidecar files list all of them; the energy balance covers all."""
        self.reference(self.SCENE)
        names = ["run.h5", "run.1.h5", "run.2.h5"]
        self.assertEqual([file.name for file in self.result_files("whole")], names)
        listed = json.loads((self.directory / "whole/run.vtkhdf.series").read_text())["files"]
        views = [name.replace(".h5", ".vtkhdf") for name in names]
        self.assertEqual([file["name"] for file in listed], views)
        for view in views:
            self.assertTrue((self.directory / "whole" / view).exists())
        times = [frame["time"] for frame in self.whole_frames]
        self.assertTrue(all(a < b for a, b in zip(times, times[1:])))
        for file in listed:
            self.assertIn(file["time"], times)
        xdmf = (self.directory / "whole/run.xdmf").read_text()
        self.assertEqual(xdmf.count("<Time "), len(times))
        self.assertIn("run.2.h5:/steps/0/position", xdmf)
        self.assertIn("run.2.h5", self.call("info", "whole").stdout)
        history = self.history("whole")
        self.assertEqual(len(set(history["remapped"])), 3)
        self.assertEqual(history["remaps"][-1], 2)
        before = self.call("run", self.scene(DROP, "other"), "--output", "other")
        self.assertNotEqual(state_of(before), self.whole)
        other = self.history("other")
        self.assertNotIn("remapped", other)
        scale = np.ptp(other["surface_energy"])
        for name in ("surface_energy", "kinetic_energy", "dissipated"):
            self.assertLess(abs(history[name][-1] - other[name][-1]), 0.1 * scale, name)
        self.assertLess(np.abs(history["momentum_error"]).max(), 1e-12)
        self.assertLess(np.abs(history["angular_momentum_error"]).max(), 1e-12)

    def test_back_into_the_first_epoch(self):
        """Files of later epochs are removed with their frames."""
        self.reference(self.SCENE)
        first = self.whole_frames[1]["time"] * (1 + 1e-9)
        self.call("run", self.file, "--restart", "whole", "--frame", "1", "--until", first)
        self.assertEqual(len(self.result_files("whole")), 1)
        self.assertEqual([file.name for file in self.directory.glob("whole/run*.vtkhdf")], ["run.vtkhdf"])
        self.assertFalse((self.directory / "whole/run.vtkhdf.series").exists())
        self.assert_same(self.call("run", self.file, "--restart", "whole"), "whole")

    def test_overwrite(self):
        self.reference(self.SCENE)
        self.call("run", self.scene(DROP, "other"), "--output", "whole", "--overwrite")
        self.assertEqual(len(self.result_files("whole")), 1)


class Block(EveryWay, Restart):
    # The deformation is so large that the step changes several times.
    SCENE = BLOCK.replace("20*sin", "60*sin").replace("check_every = 30", "check_every = 15").replace(
        "end = 0.4", "end = 0.8")
    TIME, LATER = "0.2 s", "0.43"

    def test_step_changes(self):
        self.reference(self.SCENE)
        self.assertGreater(len(set(self.history("whole")["dt"][1:-2])), 2)


class RelaxingPlate(EveryWay, Restart):
    """A thin plate, which relaxes with an artificial inertia. Its residual has a floor near 0.05. A
    lower tolerance would take 2100 steps instead of 500; the test does not depend on the state at the end."""
    SCENE = RELAXING_SHEET.replace("dimension = 2", "dimension = 3").replace("rectangle", "box").replace(
        "[1, 2]", "[1, 2, 0.08]").replace("[5, 10]", "[3, 6, 2]").replace(
        '["0.1*y^2", "0.05*y"]', '[0, 0, "0.1*y^2"]').replace(
        "check_every = 40", "force_tolerance = 0.07\nshape_tolerance = 2e-3")
    TIME, LATER = "0.2", "0.35"
    test_longer = None  # the run ends before the end time of the scene


class RelaxingSheet(EveryWay, Restart):
    SCENE, TIME, LATER = RELAXING_SHEET, "0.2", "0.35"
    test_longer = None  # the run ends before the end time of the scene

    def test_ends_by_itself(self):
        self.reference(self.SCENE)
        last = self.whole_frames[-1]["time"]
        self.assertLess(last, 10)
        history = self.history("whole")
        self.assertEqual(history["time"][-1], last)
        self.assertLess(history["force_residual"][-1], 1e-5)
        self.assertLess(history["shape_change"][-1], 1e-4)
        self.assertIn("at rest at t = ", (self.directory / "whole/run.log").read_text())
        # A continued run is still at rest.
        self.assert_same(self.call("run", self.file, "--restart", "whole"), "whole")

    def test_relaxing_what_moved(self):
        """Relaxation can continue from the end of a dynamic run."""
        moving = self.SCENE.replace('"relax"', '"dynamics"').replace("end = 20", "end = 0.2")
        self.call("run", self.scene(moving, "moving"), "--output", "moving")
        self.call("run", self.scene(self.SCENE), "--restart", "moving", "--output", "rest")
        self.assertLess(self.history("rest")["force_residual"][-1], 1e-5)


class Partners(ProgramTest):
    """Frames of rigid partners are removed and continued with those of the run."""
    WALL = """
[[contact]]
bodies = ["drop"]
interaction = "smooth_young"
contact_angle = 90
range = "1 nm"
partner = { type = "half_space", point = ["0 nm", "0 nm", "-6.5 nm"], normal = [0, 0, 1], displacement = ["0 m", "0 m", "-1e-9*t/60e-12"] }
"""

    def frames_of(self, output):
        with h5py.File(self.directory / output / "partners.h5") as partners, h5py.File(
            self.directory / output / "run.h5"
        ) as run:
            times = [run["steps"][k].attrs["time"] for k in sorted(run["steps"], key=int)]
            steps = [partners["steps"][k] for k in sorted(partners["steps"], key=int)]
            self.assertEqual([step.attrs["time"] for step in steps], times)
            heights = np.array([step["position"][:, 2] for step in steps])
            for height, time in zip(heights, times):
                self.assertTrue(np.allclose(height, -6.5e-9 - 1e-9 * time / 60e-12, rtol=0, atol=1e-15))
            return heights

    def test_they_are_dropped_and_made_again(self):
        file = self.scene(DROP + self.WALL)
        self.call("run", file, "--output", "whole")
        self.call("run", file, "--output", "part")
        self.call("run", file, "--output", "part", "--overwrite", "--until", "30 ps")
        self.assertLess(len(self.frames_of("part")), len(self.frames_of("whole")))
        self.call("run", file, "--output", "part", "--restart", "part")
        self.assertTrue(np.array_equal(self.frames_of("part"), self.frames_of("whole")))


class OtherScene(ProgramTest):
    def test_physics_may_not_change(self):
        file = self.scene(BLOCK)
        self.call("run", file, "--output", "out", "--until", "0.02")
        for change in ("body[0].material.mu=2e5", "body_force[0].acceleration=[0,0,1]"):
            self.refused(["run", file, "--restart", "out", "--set", change], 3, "another scene")

    def test_nor_may_a_mesh(self):
        """A drop from a mesh file continues bit for bit. Another file with the same name is refused."""
        self.call("new", "drop", "--like", "mesh_drop")
        scene, mesh = self.directory / "drop.toml", self.directory / "meshes/ball_tetrahedra.msh"
        scene.write_text(scene.read_text().partition("[expect]")[0])
        run = ["run", "drop.toml", "--set", "time.end=0.1", "--output"]
        whole = state_of(self.call(*run, "whole"))
        self.call(*run, "part", "--until", "0.05", "--threads", "2")
        self.call(*run, "same", "--restart", "part")
        self.assertEqual(state_of(self.call(*run, "part", "--restart", "part")), whole)
        text = mesh.read_text()
        mesh.write_text(text.replace("\n1 0.7", "\n1 0.71", 1))
        self.refused([*run, "other", "--restart", "part"], 3, "another scene: body[0].sha256 differs")
        mesh.unlink()
        self.refused([*run, "other", "--restart", "part"], 3, "drop.toml", "body[0].file", "No such file")

    def test_what_may_change(self):
        file = self.scene(BLOCK)
        self.call("run", file, "--output", "out", "--until", "0.02")
        # A default may be given or left out.
        self.call("run", file, "--restart", "out", "--until", "0.03", "--set", "title=other",
                  "--set", "body[0].support_factor=1.5", "--set", "time.safety=0.5")

    def test_new_step_is_taken_and_checked(self):
        file = self.scene(BLOCK)
        self.call("run", file, "--output", "out", "--until", "0.02")
        self.refused(["run", file, "--restart", "out", "--set", "time.step=1"], 3, "time.step",
                     "stable step")
        self.call("run", file, "--restart", "out", "--until", "0.04", "--set", "time.step=1e-4")
        self.assertEqual(self.history("out")["dt"][-1], 1e-4)


if __name__ == "__main__":
    program.main()
