#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes with stages: each stage is the run that a scene of its own would be, and a run of stages
that is stopped goes on. Usage: test_stages.py PROGRAM"""
import csv
import re
import shutil
import signal
import unittest

import program
from program import ProgramTest, state_of

program.ENVIRONMENT["OMP_NUM_THREADS"] = "1"

# A strip, clamped at one end, is bent by a grip with a force, moved on from there, and swings.
COMMON = """
dimension = 2
[output]
measures = ["strip.min_J"]
[[body]]
name = "strip"
shape = "rectangle"
size = [10, 1]
cells = [20, 4]
[body.material]
type = "neo_hookean"
density = 1
mu = 1
lambda = 1
[[held]]
body = "strip"
face = "x_min"
"""
GRIP = '[[held]]\nname = "grip"\nbody = "strip"\nface = "x_max"\n'
BEND = {"time": '[time]\nsolver = "newton"\nend = 1\nstep = 0.25\n',
        "held": GRIP + "force = [0, 1e-3]\nramp = [0, 1]\n"}
MOVE = {"time": '[time]\nsolver = "newton"\nend = 1\nstep = 0.5\n',
        "held": GRIP + 'from = "start"\ndisplacement = ["-0.1*t", 0]\n'}
SWING = {"time": "[time]\nend = 20\n", "held": GRIP + "force = [0, 0]\n"}
STAGES = {"bend": BEND, "move": MOVE, "swing": SWING}


def in_stage(text):
    return re.sub(r"\[(?=\w+\]\]?$)", "[stage.", text, flags=re.MULTILINE).replace("[stage.[", "[[stage.")


def with_stages(stages):
    """The scene whose stages have these tables."""
    return COMMON + "".join(f'[[stage]]\nname = "{name}"\n' + in_stage("".join(tables.values()))
                            for name, tables in stages.items())


class Stages(ProgramTest):
    def hashes(self, done):
        return re.findall(r"state ([0-9a-f]{16})", done.stdout)

    def test_are_the_runs_of_their_scenes(self):
        done = self.call("run", self.scene(with_stages(STAGES), "three"))
        states, before = self.hashes(done), None
        self.assertEqual(len(set(states)), 3)
        for (name, tables), state in zip(STAGES.items(), states):
            initial = f'[initial]\nfrom = "results/{before}"\n' if before else ""
            alone = self.call("run", self.scene(COMMON + initial + "".join(tables.values()), name))
            self.assertEqual(state_of(alone), state, name)
            self.assertEqual((self.directory / f"results/{name}/history.csv").read_text(),
                             (self.directory / f"results/three/{name}/history.csv").read_text())
            before = name
        self.assertIn("stage 2 of 3: move", done.stdout)
        self.assertIn("the first state is that of results/three/bend/checkpoint-a.h5, t = 1 s, at rest",
                      (self.directory / "results/three/move/run.log").read_text())

    def test_a_grip_pulls_with_its_force_and_stays_plane(self):
        """The force of a grip is that by which it is held in the place where it moves to. Nothing else
        acts on the strip, so that momentum and angular momentum are those of the force."""
        measured = '[output]\nmeasures = ["grip.displacement_y", "strip-x_min.force_y"]\n'
        self.call("run", self.scene(with_stages({**STAGES, "bend": {"output": measured, **BEND}})))
        bent, swing = (self.history(f"results/scene/{name}") for name in ("bend", "swing"))
        self.assertAlmostEqual(bent["strip-x_min.force_y"][-1], -1e-3, delta=1e-12)
        way = bent["grip.displacement_y"][-1]
        # A beam with E I/(1 - nu^2) = 2/9, whose ends do not turn, and its shear; 4 cells across.
        self.assertAlmostEqual(way, 1e-3 * 1000 / (12 * 2 / 9) + 1e-3 * 10 / (5 / 6), delta=0.01)
        held = self.scene(COMMON + BEND["time"] + GRIP + 'components = ["y"]\n' +
                          f"displacement = [0, {way:.17g}]\nramp = [0, 1]\n" +
                          GRIP.replace('"grip"', '"along"') + 'components = ["x"]\nforce = [0, 0]\n', "moved")
        self.call("run", held, "--set", "output.measures=['grip.force_y']")
        self.assertAlmostEqual(self.history("results/moved")["grip.force_y"][-1], 1e-3, delta=1e-9)
        for column in ("momentum_error", "angular_momentum_error"):
            self.assertLess(abs(swing[column]).max(), 1e-12)
        self.assertLess(abs(swing["energy_balance_error"]).max(), 5e-3)
        self.assertGreater(swing["kinetic_energy"].max(), 1e-5)

    def test_go_on_after_a_signal(self):
        text = with_stages({**STAGES, "swing": {**SWING, "time": "[time]\nend = 4000\nstep = 0.01\n"}})
        file = self.scene(text)
        process = self.start("run", file)
        while not (self.directory / "results/scene/swing/history.csv").exists():
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 128 + signal.SIGTERM)
        self.assertIn("run the same command with --restart results/scene\n", errors)
        shorter = ("--set", "stage.swing.time.end=20")
        done = self.call("run", file, "--restart", "results/scene", *shorter)
        self.assertEqual(self.hashes(done)[0],
                         self.hashes(self.call("run", file, "--output", "whole", *shorter))[2])
        self.assertNotIn("stage 2 of 3", done.stdout)
        # Without a state of the last stage, the one before is the first.
        shutil.rmtree(self.directory / "results/scene/swing")
        again = self.call("run", file, "--restart", "results/scene", *shorter)
        self.assertIn("stage 2 of 3: move", again.stdout)
        self.assertEqual(self.hashes(again)[1], self.hashes(done)[0])

    def test_stop_in_time_and_end_with_a_failure(self):
        fails = {**MOVE, "held": MOVE["held"].replace('"-0.1*t"', '"-30*t"')}
        done = self.call("run", self.scene(with_stages({**STAGES, "move": fails})), code=4)
        self.assertNotIn("stage 3", done.stdout)
        self.assertIn("strip", done.stderr)
        long = {**SWING, "time": "[time]\nend = 4000\nstep = 0.01\n"}
        self.call("run", self.scene(with_stages({**STAGES, "swing": long})), "--overwrite",
                  "--max-walltime", "2", code=128 + signal.SIGALRM)

    def test_missed_expectations_are_the_exit_code_of_all(self):
        file = self.scene(with_stages(STAGES) + "[stage.expect]\n"
                          'a = { of = "strip.min_J", value = 0.9, within = 0.2 }\n')
        self.call("run", file)
        missed = self.scene(with_stages(STAGES).replace('name = "move"\n', 'name = "move"\n[stage.expect]\n'
                            'a = { of = "strip.min_J", value = 2, within = 0.2 }\n'), "missed")
        done = self.call("run", missed, code=7)
        self.assertIn("stage 3 of 3", done.stdout)

    def test_are_all_read_before_the_first_runs(self):
        wrong = with_stages(STAGES).replace("force = [0, 0]", "fource = [0, 0]")
        self.refused(["run", self.scene(wrong)], 3, "held[1].fource: unknown key", "(in stage 'swing')")
        self.assertFalse((self.directory / "results").exists())
        measure = with_stages(STAGES) + '[stage.output]\nmeasures = ["no.measure"]\n'
        self.refused(["run", self.scene(measure)], 3, "'no.measure' is unknown", "(in stage 'swing')")
        self.refused(["run", self.scene(with_stages(STAGES)), "--until", "1"], 3, "--until", "stage.NAME.time.end")
        self.refused(["run", "scene.toml", "--restart", "results/scene"], 5, "results/scene/bend")
        self.call("run", "scene.toml", "-q")
        self.refused(["run", "scene.toml"], 5, "already holds a run", "--overwrite")
        self.call("run", "scene.toml", "-q", "--overwrite")

    def test_are_checked_one_after_the_other(self):
        file = self.scene(with_stages(STAGES))
        done = self.call("check", file)
        self.assertEqual(re.findall(r"stage (\d) of 3: (\w+)\n", done.stdout),
                         [("1", "bend"), ("2", "move"), ("3", "swing")])
        self.assertEqual(done.stdout.count("the scene is in order"), 3)
        self.assertEqual(done.stdout.count("which has not run"), 2)
        self.call("run", file)
        self.assertNotIn("which has not run", self.call("check", file).stdout)

    def test_swept_values_have_the_results_of_the_last_stage(self):
        file = self.scene(with_stages(STAGES))
        self.call("sweep", file, "--set", "stage.bend.held.grip.force=[0, 1e-3],[0, 2e-3]")
        with open(self.directory / "results/scene-sweep/sweep.csv", encoding="utf-8") as file:
            names, _, *rows = csv.reader(file)
        self.assertEqual([float(row[names.index("time")]) for row in rows], [20, 20])
        energies = [float(row[names.index("strain_energy")]) for row in rows]
        self.assertGreater(energies[1], 1.5 * energies[0])

    def test_plots_name_the_stages(self):
        self.call("run", self.scene(with_stages(STAGES)))
        self.refused(["report", "results/scene"], 5, "name one of them: bend, move, swing")


if __name__ == "__main__":
    program.main()
