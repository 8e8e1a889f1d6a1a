#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs in progress: the same bits and messages as the program, states, arrays, threads and Ctrl-C.
Usage: test_run.py PROGRAM, with the package on PYTHONPATH"""
import gc
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import weakref
from pathlib import Path

import numpy as np

import meniscus
from scenes import DROP, ROOT, SHEET, sheet

PROGRAM = None


def call(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], text=True, capture_output=True, check=False)


class Runs(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = Path(temporary.name)

    def test_steps_are_those_of_the_program(self):
        call("run", DROP, "--output", self.directory / "out", "--set", "time.end=0.03")
        run, last = (meniscus.Run(DROP, set={"time.end": 0.03}) for _ in range(2))
        run.advance_to(1)
        self.assertTrue(run.finished)
        last.load(self.directory / "out")
        self.assertEqual((last.time, last.steps), (run.time, run.steps))
        for field in run.fields("drop"):
            self.assertEqual(last.field("drop", field).tobytes(), run.field("drop", field).tobytes(), field)
        with meniscus.open(self.directory / "out") as results:
            self.assertEqual(run.measure("drop.area"), results.history["drop.area"][-1])
            self.assertEqual(run.unit("drop.area"), results.units["drop.area"])
            np.testing.assert_allclose(run.field("drop", "position"), results.points(-1, "drop"), rtol=1e-6)

    def test_what_a_run_says_of_itself(self):
        run = meniscus.Run(SHEET)
        self.assertEqual((run.dimension, run.bodies, run.time, run.steps), (2, ["sheet"], 0, 0))
        self.assertIn("sheet.centre_x", run.measures)
        self.assertEqual(run.fields("sheet")[:4], ["position", "displacement", "velocity", "mass"])
        self.assertEqual(run.field_unit("sheet", "velocity"), "m/s")
        run.step()
        self.assertEqual(run.steps, 1)
        self.assertIn("step 1", repr(run))
        self.assertIn("<td>sheet</td>", run._repr_html_())  # pylint: disable=protected-access

    def test_arrays_own_their_data(self):
        run = meniscus.Run(DROP)
        mass, before = run.field("drop", "mass"), run.field("drop", "position")
        self.assertEqual((mass.ndim, before.shape), (1, (len(mass), 2)))
        self.assertEqual(run.field("drop", "F").shape, (len(mass), 9))
        kept = before.copy()
        run.advance_to(0.01)
        self.assertGreater(np.abs(run.field("drop", "position") - before).max(), 1e-6)
        run.field("drop", "position")[:] = 7  # changes the array only
        self.assertLess(np.abs(run.field("drop", "position")).max(), 2)
        del run
        gc.collect()
        np.testing.assert_array_equal(before, kept)

    def test_messages_are_those_of_the_program(self):
        path = self.directory / "wrong.toml"
        path.write_text(DROP.read_text().replace("density = 1", "density = -1").replace("core", "coer"))
        with self.assertRaises(meniscus.InputError) as raised:
            meniscus.Run(path)
        self.assertEqual(str(raised.exception), call("run", path).stderr.strip())
        self.assertIsInstance(raised.exception, ValueError)
        with self.assertRaises(meniscus.FileError) as raised:
            meniscus.Run("/no/such/scene.toml")
        self.assertEqual(str(raised.exception), call("run", "/no/such/scene.toml").stderr.strip())
        self.assertIsInstance(raised.exception, OSError)
        with self.assertRaisesRegex(meniscus.InputError, r"'body\[0\].rdius=1'"):
            meniscus.Run(DROP, set={"body[0].rdius": 1})
        with self.assertRaisesRegex(meniscus.InputError, "did you mean 'drop.area'"):
            meniscus.Run(DROP).measure("drop.aera")
        with self.assertRaisesRegex(ValueError, "threads is 0"):
            meniscus.Run(DROP, threads=0)
        self.assertTrue(issubclass(meniscus.SolveError, (meniscus.Error, RuntimeError)))

    def test_a_failed_run_goes_on_after_a_restore(self):
        run = meniscus.Run(sheet(step=1e-3), set={"body[0].initial_velocity": ["60*x", 0]})
        begin = run.snapshot()
        with self.assertRaisesRegex(meniscus.SolveError, r"step \d+, t = .*body 'sheet', particle"):
            run.advance_to(10)
        with self.assertRaisesRegex(meniscus.SolveError, "cannot go on after its failure at step"):
            run.step()
        run.restore(begin)
        run.step()
        self.assertEqual(run.steps, 1)

    def test_snapshots_continue_bit_for_bit(self):
        run = meniscus.Run(DROP)
        run.advance_to(0.01)
        middle = run.snapshot()
        run.advance_to(0.03)
        positions, end = run.field("drop", "position").tobytes(), run.snapshot().hash
        other = meniscus.Run(DROP)
        for again in (run, other):
            again.restore(middle)
            self.assertEqual(again.snapshot().hash, middle.hash)
            again.advance_to(0.03)
            self.assertEqual(again.field("drop", "position").tobytes(), positions)
            self.assertEqual(again.snapshot().hash, end)
        with self.assertRaises(meniscus.FileError):
            meniscus.Run(SHEET).restore(middle)
        run.restore(middle)
        run.save(self.directory / "saved")
        other.load(self.directory / "saved")
        self.assertEqual(other.snapshot().hash, middle.hash)

    def test_runs_in_threads_have_the_bits_of_runs_alone(self):
        scenes = [sheet(end=0.2 + 0.05 * k) for k in range(3)]
        for scene in scenes:
            scene["body"][0]["initial_velocity"] = ["0.1*y", "0.2*x"]

        def hash_of(scene, threads):
            run = meniscus.Run(scene, threads=threads)
            run.advance_to(10)
            return run.snapshot().hash

        alone, together = [hash_of(scene, 2) for scene in scenes], {}
        threads = [threading.Thread(target=lambda k=k: together.update({k: hash_of(scenes[k], k + 1)}))
                   for k in range(3)]  # fmt: skip
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual([together[k] for k in range(3)], alone)
        self.assertEqual(len(set(alone)), 3)

    def test_the_interpreter_is_free_while_a_run_computes(self):
        run = meniscus.Run(DROP, set={"time.end": 0.5})
        thread = threading.Thread(target=run.advance_to, args=(0.2,))
        thread.start()
        counted, refused = 0, 0
        while thread.is_alive():
            counted += 1
            try:
                run.measure("drop.area")
            except RuntimeError as error:
                self.assertIn("the run is computing", str(error))
                refused += 1
            time.sleep(1e-4)
        self.assertGreater(counted, 50)
        self.assertGreater(refused, 50)
        self.assertGreaterEqual(run.time, 0.2)

    def test_control_c_between_steps(self):
        run, same = (meniscus.Run(DROP, set={"time.end": 100}) for _ in range(2))
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            run.advance_to(100)
        self.assertGreater(run.steps, 0)
        while same.steps < run.steps:
            same.step()
        self.assertEqual(run.snapshot().hash, same.snapshot().hash)
        run.step()
        same.step()
        self.assertEqual(run.snapshot().hash, same.snapshot().hash)

    def test_signals_within_a_step_of_newton(self):
        scene = sheet(end=1, solver="newton", step=0.1)
        scene["body"][0]["cells"] = [40, 80]
        scene["held"] = [{"body": "sheet", "face": "y_min", "displacement": [0, 0]},
                         {"body": "sheet", "face": "y_max", "displacement": ["0.1*t", "-0.3*t"]}]  # fmt: skip
        run, same = meniscus.Run(scene), meniscus.Run(scene)
        self.addCleanup(signal.signal, signal.SIGALRM, signal.signal(signal.SIGALRM, self.stop))
        signal.setitimer(signal.ITIMER_REAL, 0.02)
        with self.assertRaisesRegex(InterruptedError, "by a signal"):
            run.advance_to(1)
        self.assertEqual(run.steps, 0)
        self.assertEqual(run.snapshot().hash, same.snapshot().hash)
        run.step()
        same.step()
        self.assertEqual(run.snapshot().hash, same.snapshot().hash)

    def test_three_dimensions(self):
        ball = {"dimension": 3, "time": {"end": 1}, "body": [{
            "name": "ball", "shape": "ball", "radius": 1, "core": 2, "layers": 1,
            "material": {"type": "neo_hookean", "density": 1, "mu": 1, "lambda": 1}}]}  # fmt: skip
        run = meniscus.Run(ball)
        run.step()
        self.assertEqual(run.field("ball", "position").shape[1], 3)

    @staticmethod
    def stop(*_):
        raise InterruptedError("by a signal")


class Package(unittest.TestCase):
    def test_results_can_be_read_without_the_extension(self):
        code = ("import meniscus\n"
                "meniscus.open, meniscus.InputError\n"
                "try:\n    meniscus.Run('drop.toml')\nexcept ImportError as error:\n    print(error)\n")  # fmt: skip
        done = subprocess.run([sys.executable, "-B", "-c", code], text=True, capture_output=True, check=False,
                              env={**os.environ, "PYTHONPATH": str(ROOT / "src/python")})  # fmt: skip
        self.assertEqual(done.stderr, "")
        self.assertRegex(done.stdout, r"^meniscus.Run needs the extension module, .*tools/run --python.*\n$")

    def test_what_is_public_is_documented(self):
        for name in meniscus.__all__:
            self.assertTrue(getattr(meniscus, name).__doc__, name)
        for name, member in vars(meniscus.Run).items():
            if not name.startswith("_"):
                self.assertTrue(member.__doc__ or getattr(member, "__func__", member).__doc__, name)

    def test_a_run_in_its_own_force_is_collected(self):
        def reference_to_run():
            run = meniscus.Run(SHEET)
            run.add_force("sheet", lambda t, x, v: 0 * x + (run is None))
            return weakref.ref(run)

        reference = reference_to_run()
        self.assertIsNotNone(reference())
        gc.collect()
        self.assertIsNone(reference())


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main(verbosity=2)
