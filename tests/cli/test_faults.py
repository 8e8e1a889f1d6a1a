#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Closed or full streams, full disks, signals at any time, and other programs in
the same directory: the exit code names the cause, and no earlier output is lost.
Usage: test_faults.py PROGRAM"""
import itertools
import os
import resource
import shutil
import signal
import subprocess
import time


import program
from program import BLOCK, ENVIRONMENT, SHEET, ProgramTest, with_output


class FaultTest(ProgramTest):
    def code(self, *arguments, closed=(), full=(), limit=None, ignored=()):
        """The exit code with some of the streams 0, 1, 2 closed or full and files of limited size. Stores the
        text on stderr."""
        def prepare():
            for number in ignored:
                signal.signal(number, signal.SIG_IGN)
            for stream in full:
                os.dup2(os.open("/dev/full", os.O_RDWR), stream)
            for stream in closed:
                os.close(stream)
            if limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        done = subprocess.run([program.PROGRAM, *map(str, arguments)], cwd=self.directory, text=True,
                              capture_output=True, env=ENVIRONMENT, timeout=100, preexec_fn=prepare)
        self.stderr = done.stderr
        return done.returncode

    def names(self, output="out"):
        return {path.name for path in (self.directory / output).iterdir()}


class Streams(FaultTest):
    def test_exit_codes_survive(self):
        """Every combination of closed and full streams, for each kind of end."""
        good = self.scene(SHEET.replace("end = 0.1", "end = 0.02"))
        bad = self.scene(SHEET.replace("mu = 1e5", "mu = 0"), "bad")
        # The compression is far too fast for the step.
        pushed = BLOCK.replace("[[body]]", '[[body]]\ninitial_velocity = ["-60*x", 0, 0]')
        broken = self.scene(pushed.replace("[time]", "[time]\nstep = 0.008"), "broken")
        missed = self.scene(SHEET.replace("end = 0.1", "end = 0.02") + "[expect.step]\nvalue = 0\nwithin = 0\n",
                            "missed")
        for states in itertools.product(("open", "closed", "full"), repeat=2):
            streams = {"closed": [], "full": [], "open": []}
            for stream, state in zip((1, 2), states):
                streams[state].append(stream)
            for closed in ([], [0]):
                how = {"closed": closed + streams["closed"], "full": streams["full"]}
                with self.subTest(**how):
                    self.assertEqual(self.code("walk", **how), 2)
                    self.assertEqual(self.code("run", bad, **how), 3)
                    self.assertEqual(self.code("run", "nowhere.toml", **how), 5)
                    self.assertEqual(self.code("run", good, "--overwrite", **how), 0)
            with self.subTest(**how):
                self.assertEqual(self.code("run", broken, "--overwrite", **how), 4)
                self.assertEqual(self.code("run", missed, "--overwrite", **how), 7)

    def test_messages_stay_out_of_files(self):
        """If standard streams are closed, files of the run may get their descriptors."""
        text = SHEET.replace("[[body]]", '[[body]]\nintegration = "nodal"\ngauss_points = 1')
        file = self.scene(text)
        self.code("run", file, "--output", "open")
        for closed in ([2], [1, 2], [0, 1, 2]):
            self.code("run", file, "--output", "out", "--overwrite", closed=closed)
            self.assertEqual((self.directory / "out/history.csv").read_bytes(),
                             (self.directory / "open/history.csv").read_bytes())
            self.frames("out")

    def test_lost_reports(self):
        """For commands that only print, a full stream is a file error."""
        file = self.scene(SHEET)
        self.call("run", file, "--output", "out")
        for command in (["keys"], ["version"], ["info", "out"], ["check", file], ["study", "--list"]):
            self.assertEqual(self.code(*command, full=[1]), 5, command)
            self.assertIn("No space left", self.stderr)
            self.assertEqual(self.code(*command, closed=[1]), 0, command)

    def test_reader_that_goes(self):
        """A run continues if the program that reads its messages ends."""
        file = self.scene(SHEET)
        read, write = os.pipe()
        os.close(read)
        process = subprocess.run([program.PROGRAM, "run", file], cwd=self.directory, stdout=write,
                                 stderr=write, env=ENVIRONMENT)
        os.close(write)
        self.assertEqual(process.returncode, 0)


class Disk(FaultTest):
    FIELDS = "frames_every = 0.01\n"

    def test_file_size(self):
        """Ten limits on the size of files: exit code 5 with the reason, also in the log if it
        fits. The files can be read, and a later run continues from them."""
        file = self.scene(with_output(BLOCK, "restartable = true"))
        whole = program.state_of(self.call("run", file, "--output", "whole"))
        largest = (self.directory / "whole/run.h5").stat().st_size
        continued = 0
        for limit in (0, 100, 1000, 5000, 20000, *(largest * k // 6 for k in range(1, 6))):
            with self.subTest(limit=limit):
                shutil.rmtree(self.directory / "out", ignore_errors=True)
                self.assertEqual(self.code("run", file, "--output", "out", limit=limit), 5)
                self.assertIn("File too large", self.stderr)
                self.assertEqual(len(self.stderr.strip().splitlines()), 1, self.stderr)
                self.assertFalse([name for name in self.names() if name.endswith(".new")])
                if limit > 10000:
                    self.assertIn("File too large", (self.directory / "out/run.log").read_text())
                if limit > largest // 4:
                    frames = len(self.frames("out"))
                    self.assertGreater(frames, 0)
                    done = self.call("run", file, "--restart", "out", "--frame", frames - 1, "--output", "out")
                    self.assertEqual(program.state_of(done), whole)
                    continued += 1
        self.assertGreater(continued, 2)

    def test_directory_removed(self):
        process = self.start("run", self.scene(BLOCK.replace("end = 0.4", "end = 40")), "--output", "out")
        while not (self.directory / "out/history.csv").exists():
            self.assertIsNone(process.poll())
        shutil.rmtree(self.directory / "out", ignore_errors=True)
        shutil.rmtree(self.directory / "out", ignore_errors=True)
        _, stderr = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 5, stderr)
        self.assertIn("No such file", stderr)

    def test_links_are_not_followed(self):
        """The program does not write through a link with the temporary name of a file."""
        file = self.scene(BLOCK)
        out = self.directory / "out"
        self.call("run", file, "--output", "out", "--until", "0.1")
        precious = self.directory / "precious"
        precious.write_text("precious")
        for name in ("checkpoint-a.h5.new", "checkpoint-b.h5.new", "history.csv.new", "run.xdmf.new"):
            (out / name).symlink_to(precious)
        self.call("run", file, "--restart", "out")
        self.assertEqual(precious.read_text(), "precious")
        self.assertFalse([name for name in self.names() if name.endswith(".new")])

    def test_two_writers(self):
        file = self.scene(BLOCK.replace("end = 0.4", "end = 40"))
        process = self.start("run", file, "--output", "out")
        while not (self.directory / "out/history.csv").exists():
            self.assertIsNone(process.poll())
        for options in ([], ["--overwrite"], ["--restart", "out", "--frame", "0"]):
            self.refused(["run", file, "--output", "out", *options], 5, "out")
        process.terminate()
        process.communicate()
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)
        self.frames("out")


class Signals(FaultTest):
    # The set-up takes seconds, even on a machine that is several times faster.
    LARGE = BLOCK.replace("cells = [4, 4, 4]", "cells = [48, 48, 48]")

    def test_checkpoint(self):
        """Every signal to stop leaves a checkpoint; the continued run reaches the same end."""
        file = self.scene(BLOCK)
        whole = program.state_of(self.call("run", file, "--output", "whole"))
        for number in (signal.SIGHUP, signal.SIGUSR1, signal.SIGXCPU, signal.SIGTERM, signal.SIGINT):
            with self.subTest(signal=number):
                output = f"out{number}"
                process = self.start("run", file, "--output", output)
                while process.poll() is None and not (self.directory / output / "run.xdmf").exists():
                    time.sleep(0.001)
                process.send_signal(number)
                _, stderr = process.communicate()
                if process.returncode != 0:  # the run may have reached its end
                    self.assertEqual(process.returncode, 128 + number, stderr)
                done = self.call("run", file, "--restart", output)
                self.assertEqual(program.state_of(done), whole)

    def test_same_request_twice(self):
        """`timeout` sends its signal to the program and to its group; the second one may arrive
        when the program is about to exit."""
        process = self.start("run", self.scene(BLOCK.replace("end = 0.4", "end = 40")), "--output", "out")
        while not (self.directory / "out/run.xdmf").exists():
            self.assertIsNone(process.poll())
        begin = time.monotonic()
        while process.poll() is None and time.monotonic() - begin < 0.5:  # signals continue while the program ends
            process.terminate()
            time.sleep(0.0005)
        _, stderr = process.communicate()
        self.assertEqual(process.returncode, 128 + signal.SIGTERM, stderr)
        self.assertIn("to continue, run the same command with --restart out", stderr)

    def test_set_up(self):
        """Before the first output, a signal ends the program at once."""
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGUSR1, signal.SIGXCPU):
            process = self.start("run", self.scene(self.LARGE), "--output", "out")
            time.sleep(0.3)
            self.assertIsNone(process.poll())
            process.send_signal(number)
            process.communicate(timeout=20)
            self.assertEqual(process.returncode, -number)
            self.assertFalse((self.directory / "out").exists())

    def test_ignored(self):
        """The program respects nohup."""
        file = self.scene(BLOCK.replace("end = 0.4", "end = 40"))
        process = subprocess.Popen([program.PROGRAM, "run", file, "--output", "out"], cwd=self.directory,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=ENVIRONMENT,
                                   preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.addCleanup(process.kill)
        while not (self.directory / "out/run.xdmf").exists():
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGHUP)
        time.sleep(0.3)
        self.assertIsNone(process.poll())
        process.terminate()
        process.communicate()
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)


if __name__ == "__main__":
    program.main()
