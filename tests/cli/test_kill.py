#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Kills a run with SIGKILL at 10 random times: everything it had written can be read, and from the
newest checkpoint it ends as if nothing had happened. Usage: test_kill.py PROGRAM"""
import random
import signal
import time

import program
from program import DROP, ProgramTest, state_of


class Kill(ProgramTest):
    def test_kill(self):
        """Ten kills of one run, each continued from what the last one left."""
        random.seed(2)
        file = self.scene(DROP)
        longer = ["--set", "time.end='0.6 ns'", "--set", "output.checkpoint_minutes=0.0003"]
        begin = time.monotonic()
        whole = state_of(self.call("run", file, "--output", "whole", *longer))
        longest = (time.monotonic() - begin) / 15  # ten kills end before the run does
        options, kills, rows = [], 0, 0
        while kills < 10:
            process = self.start("run", file, "--output", "out", *longer, *options)
            while not (self.directory / "out/history.csv").exists():
                self.assertIsNone(process.poll())
            time.sleep(random.uniform(0.0, longest))
            process.kill()
            process.communicate()
            self.assertEqual(process.returncode, -signal.SIGKILL, "ended before it was killed")
            kills += 1
            frames, history = self.frames("out"), self.history("out")
            self.assertTrue(all(a["time"] < b["time"] for a, b in zip(frames, frames[1:])))
            self.assertTrue((history["time"][1:] > history["time"][:-1]).all())
            rows = max(rows, len(history["time"]))
            has_checkpoint = any((self.directory / "out").glob("checkpoint-?.h5"))
            options = ["--restart", "out"] if has_checkpoint else ["--overwrite"]
        self.assertIn("--restart", options)
        done = self.call("run", file, "--output", "out", *longer, *options)
        self.assertEqual(state_of(done), whole)
        self.assertEqual((self.directory / "out/history.csv").read_text(),
                         (self.directory / "whole/history.csv").read_text())
        self.assertEqual(len(self.frames("out")), len(self.frames("whole")))


if __name__ == "__main__":
    program.main()
