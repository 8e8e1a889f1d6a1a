#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Kills runs with SIGKILL at random times: everything they had written can be read, and from the
newest checkpoint they end as if nothing had happened. Usage: test_kill.py PROGRAM
With MENISCUS_VERIFY=full there are 110 kills instead of 22; with MENISCUS_SEED=N they come at other
times."""
import os
import random
import shutil
import signal
import time

import program
from program import DROP, RELAXING_SHEET, REMAPPED_DROP, ProgramTest, state_of


# A disk between two walls; one wall approaches and recedes.
CONTACT = """
dimension = 2
[time]
end = 16
[output]
history_every = 0.2
frames_every = 2
[[body]]
name = "disk"
shape = "disk"
radius = 1
core = 4
rings = 2
[body.material]
type = "neo_hookean"
density = 1
mu = 5
lambda = 5
"""
for name, normal, formula in (("left", 1, "0"), ("right", -1, "-0.3*sin(0.5*t)")):
    CONTACT += f"""
[[contact]]
name = "{name}"
bodies = ["disk"]
epsilon = 0.05
sigma0 = 0.4
beta = 1
[contact.partner]
type = "half_space"
point = [{-1.35 * normal}, 0]
normal = [{normal}, 0]
displacement = ["{formula}", 0]
"""


SEED = int(os.environ.get("MENISCUS_SEED", 2))
FULL = os.environ.get("MENISCUS_VERIFY") == "full"


class Kill(ProgramTest):
    def kill_and_continue(self, text, kills, *longer):
        """Kills one run several times and continues it after each kill; in the full form, does this five times."""
        for seed in range(SEED, SEED + (5 if FULL else 1)):
            with self.subTest(seed=seed):
                try:
                    self.kill_one_run(seed, text, kills, *longer)
                finally:
                    shutil.rmtree(self.directory / "out", ignore_errors=True)
                    shutil.rmtree(self.directory / "whole", ignore_errors=True)

    def kill_one_run(self, seed, text, kills, *longer):
        random.seed(seed)
        file = self.scene(text)
        longer = [*longer, "--set", "output.checkpoint_minutes=0.00003"]  # 2 ms: also in fast runs
        whole = state_of(self.call("run", file, "--output", "whole", *longer))
        size = (self.directory / "whole/history.csv").stat().st_size
        options = []
        enough = 0
        for _ in range(kills):
            process = self.start("run", file, "--output", "out", *longer, *options)
            while not all((self.directory / "out" / name).exists() for name in ("history.csv", "run.h5")):
                self.assertIsNone(process.poll())
            # Kills after some more rows than at the last kill, however fast the run is. All kills
            # come before the end.
            history = self.directory / "out/history.csv"
            enough = max(enough, history.stat().st_size) + random.uniform(0, 0.5 * size / kills)
            while process.poll() is None and history.stat().st_size < enough:
                time.sleep(random.uniform(0, 0.003))
            process.kill()
            process.communicate()
            self.assertEqual(process.returncode, -signal.SIGKILL, "ended before it was killed")
            frames, history = self.frames("out"), self.history("out", killed=True)
            self.assertTrue(all(a["time"] < b["time"] for a, b in zip(frames, frames[1:])))
            self.assertTrue((history["time"][1:] > history["time"][:-1]).all())
            has_checkpoint = any((self.directory / "out").glob("checkpoint-?.h5"))
            options = ["--restart", "out"] if has_checkpoint else []
            if not has_checkpoint:
                shutil.rmtree(self.directory / "out")  # the next run starts afresh
        self.assertIn("--restart", options)
        done = self.call("run", file, "--output", "out", *longer, *options)
        self.assertEqual(state_of(done), whole)
        self.assertEqual((self.directory / "out/history.csv").read_text(),
                         (self.directory / "whole/history.csv").read_text())
        self.assertEqual(len(self.frames("out")), len(self.frames("whole")))
        self.assertFalse(list((self.directory / "out").glob("*.new")))

    def test_drop(self):
        self.kill_and_continue(DROP, 10, "--set", "time.end='0.6 ns'")

    def test_remaps(self):
        many = ", ".join(f"'{t} ps'" for t in range(5, 300, 20))
        self.kill_and_continue(REMAPPED_DROP, 6, "--set", "time.end='0.3 ns'",
                               "--set", f"remap[0].at=[{many}]")

    def test_contact(self):
        self.kill_and_continue(CONTACT, 6)

    def test_relaxation(self):
        # The tolerances are above round-off, to which the sheet would return in the end.
        self.kill_and_continue(RELAXING_SHEET, 6, "--set", "time.shape_tolerance=1e-8",
                               "--set", "time.force_tolerance=1e-7")


if __name__ == "__main__":
    program.main()
