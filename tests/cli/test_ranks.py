#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A run on several ranks ends with the same bits as one that is alone, and fails as one.
Usage: test_ranks.py PROGRAM"""
import os
import re
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

import h5py

import program
from hostile_files import set_text
from program import (BLOCK, DROP, ENVIRONMENT, RELAXING_SHEET, REMAPPED_DROP, ProgramTest, shipped, state_of,
                     with_output)

# As many ranks as we like on any machine, which leave the processor to others while they wait.
MPIRUN = ["mpirun", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1", "-n"]
RANKS_ENVIRONMENT = {**ENVIRONMENT, "OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1",
                     "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}

SHORT_DROP = DROP.replace('"60 ps"', '"9 ps"').replace('"7 ps"', '"3 ps"')
SHORT_REMAP = REMAPPED_DROP.replace('"60 ps"', '"9 ps"').replace('["17 ps", "35 ps"]', '["4 ps"]')
SHORT_BLOCK = BLOCK.replace("end = 0.4", "end = 0.06")
PUSHED = BLOCK.replace("[time]", "[time]\nstep = 0.008").replace(
    "[[body]]", '[[body]]\ninitial_velocity = ["-60*x", 0, 0]')
FIELDS = 'fields = ["J", "F", "pressure", "von_mises", "cauchy_stress", "velocity"]\n' \
    'measures = ["block.volume", "block.min_J", "block.mean_pressure"]'
VARYING = SHORT_BLOCK.replace("mu = 1e5", 'mu = "1e5*(1 + x)"')
# [name] what the rows of the internal force can be: of cells, of Gauss points
# in fours and one by one, of particles, and those of a viscosity
ROWS = {
    "cells": SHORT_BLOCK,
    "cells that share volume changes": SHORT_BLOCK.replace("lambda = 1e5", "lambda = 1e6"),
    "Gauss points": SHORT_BLOCK.replace("[body.material]",
                                        'integration = "gauss"\ngauss_points = 2\n[body.material]'),
    "points of laws of their own": VARYING.replace(
        "[body.material]", 'integration = "gauss"\ngauss_points = 1\n[body.material]'),
    "particles": SHORT_BLOCK.replace("[body.material]", 'integration = "nodal"\n[body.material]'),
    "a viscosity": SHORT_BLOCK.replace("[body.material]", "[body.material]\nviscosity = 10"),
}
LONG_DROP = SHORT_DROP.replace('"7.5 nm"', '"15 nm"').replace("core = 3", "core = 8").replace(
    "layers = 2", "layers = 3") + 'form = "weak"\n'
SKIN = """
[[surface]]
body = "drop"
law = { type = "gurtin_murdoch", lambda = "1 mN/m", mu = "2 mN/m" }
[[surface]]
body = "drop"
law = { type = "boussinesq_scriven", shear = 1e-13, dilatational = 2e-13 }
"""
LONG_BLOCK = SHORT_BLOCK.replace("size = [1, 1, 1]", "size = [4, 1, 1]").replace("[4, 4, 4]",
                                                                                "[23, 4, 4]")
# [name] bodies of which a rank needs a part
LONG = {
    "a solid": LONG_BLOCK,
    "a stiff solid": LONG_BLOCK.replace("lambda = 1e5", "lambda = 1e6"),
    "a viscous solid": LONG_BLOCK.replace("[body.material]", "[body.material]\nviscosity = 10"),
    "Gauss points": LONG_BLOCK.replace("[body.material]",
                                       'integration = "gauss"\ngauss_points = 1\n[body.material]'),
    "a drop": LONG_DROP,
    "a drop in a skin": LONG_DROP.replace('form = "weak"', 'form = "curvature"') + SKIN,
    "two solids": LONG_BLOCK + LONG_BLOCK[LONG_BLOCK.index("[[body]]"):].replace(
        '"block"', '"other"').replace("[body.material]", "centre = [0, 3, 0]\n[body.material]"),
}
LONG["implicit viscosity"] = LONG_DROP.replace("[time]", '[time]\nviscosity = "implicit"')
RELAXING_BLOCK = LONG_BLOCK[:LONG_BLOCK.index("[[body_force]]")].replace(
    "[time]\nend = 0.06", '[time]\nsolver = "relax"\nend = 20').replace(
        "[[body]]", '[[body]]\ninitial_displacement = [0, 0, "0.02*x^2"]')
LONG["a solid held and loaded"] = LONG_BLOCK + """
[[held]]
body = "block"
face = "x_min"
displacement = [0, 0, "0.01*sin(20*t)"]
[[traction]]
body = "block"
face = "x_max"
force = [0, 0, 100]
[[traction]]
name = "end"
body = "block"
face = "x_max"
pressure = 30
[[spring]]
body = "block"
face = "x_max"
stiffness = 100
"""


def thick(cells):
    return LONG_BLOCK.replace("size = [4, 1, 1]", "size = [1, 1, 1]").replace(
        "[23, 4, 4]", f"[{cells}, {cells}, {cells}]").replace("end = 0.06", "end = 0.004")


THICK_PAIR = thick(14) + thick(5)[thick(5).index("[[body]]"):].replace('"block"', '"other"').replace(
    "[body.material]", "centre = [0, 0, 1.05]\n[body.material]")
TWO_DROPS = LONG["implicit viscosity"] + LONG_DROP[LONG_DROP.index("[[body]]"):].replace(
    '"drop"', '"far"').replace("core = 8", 'centre = ["20 nm", 0, 0]\ncore = 7')


def contact(first, second, epsilon):
    return f"""
[[contact]]
bodies = ["{first}", "{second}"]
epsilon = {epsilon}
sigma0 = 0.05
beta = 1
points = 2
"""


# Bars fly at each other from beyond the reach of their contact, meet with their ends and part.
BAR = LONG_BLOCK[:LONG_BLOCK.index("[[body_force]]")]
MEETING_BARS = BAR.replace("end = 0.06", "end = 0.12") + BAR[BAR.index("[[body]]"):].replace(
    '"block"', '"other"').replace(
        "[body.material]", "centre = [4.4, 0, 0]\ninitial_velocity = [-5, 0, 0]\n[body.material]") + contact("block", "other", 2e6)
# [name] bodies of which every rank needs most, but not all
MOST = {
    "two drops": TWO_DROPS,
    "a wall": thick(12) + """
[[contact]]
name = "wall"
bodies = ["block"]
epsilon = 100
sigma0 = 0.05
beta = 1
[contact.partner]
type = "half_space"
point = [0, 0, -0.55]
normal = [0, 0, 1]
displacement = [0, 0, "0.5*t"]
""",
    "a pair": THICK_PAIR + contact("block", "other", 100),
    "a law of the gap": THICK_PAIR + """
[[contact]]
bodies = ["block", "other"]
adhesion = 10
offset = 0.04
range = 0.2
points = 2
""",
}


def blocks(count, gap, y=0, cells=4, speed=10):
    """Small viscous bodies in a row. The first one moves."""
    body = SHORT_BLOCK[SHORT_BLOCK.index("[[body]]"):SHORT_BLOCK.index("[[body_force]]")]
    return "".join(
        body.replace('"block"', f'"block{k}"').replace("[4, 4, 4]", f"[{cells}, {cells}, {cells}]").replace(
            "[body.material]", f"""centre = [{k * (1 + gap)}, {y}, 0]
initial_velocity = [{speed if k == 0 else 0}, 0, 0]
[body.material]
viscosity = 10""") for k in range(count))


def drops(count):
    """Small drops side by side, with implicit viscosity."""
    start = SHORT_DROP.index("[[body]]")
    return SHORT_DROP[:start].replace("[time]", '[time]\nviscosity = "implicit"').replace(
        "drop.", "drop0.") + "".join(
            SHORT_DROP[start:].replace('"drop"', f'"drop{k}"').replace(
                "[body.material]", f'centre = ["{40 * k} nm", 0, 0]\n[body.material]')
            for k in range(count))


def law_of_the_gap(first, second):
    return f"""
[[contact]]
bodies = ["{first}", "{second}"]
adhesion = "10*(1 + 20*t)"
offset = 0.02
range = 0.1
points = 4
"""


def beside_partner(number, more):
    """A wall below a block, with keys of the contact and of the wall."""
    keys, of_partner = more
    return f"""
[[contact]]
name = "wall{number}"
bodies = ["block{number}"]
points = 2
{keys}
[contact.partner]
type = "half_space"
point = [0, 0, -0.52]
normal = [0, 0, 1]
{of_partner}
"""


LENNARD_JONES = "epsilon = 100\nsigma0 = 0.02\nbeta = 1"
ADHESIVE = "offset = 0.01\nrange = 0.1"
# [k] walls at rest, with history in their motion and their adhesion, and with a friction
PARTNERS = [(LENNARD_JONES, ""), (LENNARD_JONES, 'displacement = [0, 0, "0.1*t"]'),
            (f'adhesion = "10*(1 + 20*t)"\n{ADHESIVE}', ""),
            (f"adhesion = 10\nfriction = 30\n{ADHESIVE}", 'displacement = ["t^2", 0, 0]')]
NO_BODY = SHORT_BLOCK[:SHORT_BLOCK.index("[[body]]")]
# [name] small bodies that are whole on some numbers of ranks
WHOLE = {
    "apart": NO_BODY + blocks(16, 1),
    "in contact": NO_BODY.replace("end = 0.06", "end = 0.016") + blocks(8, 0.08) + "".join(contact(f"block{k}", f"block{k + 1}", 2e6) for k in range(7)),
    "with a law of the gap": NO_BODY + blocks(8, 0.04, speed=0.5) + "".join(
        law_of_the_gap(f"block{k}", f"block{k + 1}") for k in range(7)),
    "beside partners": NO_BODY + blocks(8, 1) + "".join(
        beside_partner(k, more) for k, more in zip(range(8), [*PARTNERS, *PARTNERS])),
    "drops": drops(8),
    "beside a large one": thick(9) + blocks(4, 0.5, y=2, cells=3),
}
PRESSED = SHORT_BLOCK.replace("neo_hookean", "st_venant_kirchhoff").replace(
    "[[body]]", '[[body]]\ninitial_velocity = ["-20*x^2", 0, 0]')
BENT_SHEET = RELAXING_SHEET.replace('"relax"', '"newton"')

SMALLER = ("--set", "body.drop.core=4", "--set", "body.drop.layers=2")
# [name] scene of inputs/ and how much of it
SCENES = {
    "two bodies in contact": ("first_two_discs", "--until", "0.0024"),
    "contact with a plate": ("droplet_spreading", "--until", "1"),
    "a surface law": ("drop_with_skin", "--until", "0.05", *SMALLER),
    "a nematic": ("nematic_drop", "--until", "0.005", *SMALLER),
}


class RanksTest(ProgramTest):
    def command(self, ranks, *arguments):
        return [*MPIRUN, str(ranks), program.PROGRAM, *map(str, arguments)]

    def ranks(self, ranks, *arguments, code=0):
        """Runs the program on `ranks` ranks."""
        done = subprocess.run(self.command(ranks, *arguments), cwd=self.directory, text=True,
                              capture_output=True, env=RANKS_ENVIRONMENT, timeout=100)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def start_ranks(self, ranks, *arguments):
        process = subprocess.Popen(self.command(ranks, *arguments), cwd=self.directory, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   env=RANKS_ENVIRONMENT)
        self.addCleanup(process.__exit__, None, None, None)
        self.addCleanup(process.kill)
        return process

    def log(self, output):
        return (self.directory / output / "run.log").read_text()


class SameBits(RanksTest):
    def assert_same_bits(self, counts, scene, *options):
        alone = self.call("run", scene, *options, "--output", "alone")
        for count in counts:
            done = self.ranks(count, "run", scene, *options, "--output", f"ranks{count}")
            self.assertEqual(state_of(done), state_of(alone), f"{count} ranks")
            self.assertIn(f"{count} ranks: at most", self.log(f"ranks{count}"))
            for file in ("history.csv",):
                self.assertEqual((self.directory / f"ranks{count}" / file).read_text(),
                                 (self.directory / "alone" / file).read_text())

    def test_viscous_drop(self):
        self.assert_same_bits((2, 3, 4), self.scene(SHORT_DROP))
        self.assert_same_frames(self.frames("ranks3"), self.frames("alone"))

    def assert_same_frames(self, frames, expected):
        self.assertEqual(len(frames), len(expected))
        for frame, other in zip(frames, expected):
            self.assertEqual(frame.keys(), other.keys())
            for name in frame:
                self.assertTrue((frame[name] == other[name]).all(), name)

    def test_rows(self):
        """Results have the same bits, also fields and measures, which read rows of all ranks."""
        for name, scene in ROWS.items():
            with self.subTest(name):
                self.directory = self.directory / name.split()[-1]
                self.directory.mkdir()
                self.assert_same_bits((3,), self.scene(with_output(scene, FIELDS)))
                self.assert_same_frames(self.frames("ranks3"), self.frames("alone"))
                self.directory = self.directory.parent

    def test_own_rows(self):
        """A rank has only the rows of its part."""
        scene = self.scene(SHORT_BLOCK.replace("[4, 4, 4]", "[12, 12, 12]"))
        megabytes = {}
        for count in (1, 4):
            self.ranks(count, "run", scene, "--output", f"ranks{count}", "--until", 1e-5)
            log = self.log(f"ranks{count}")
            megabytes[count] = float(re.search(r"([\d.]+) MB for the internal force", log)[1])
        self.assertLess(megabytes[4], 0.35 * megabytes[1])
        self.assertRegex(log, r"at most \d+ MB of memory")

    def test_ghosts(self):
        """Ranks make steps with their own and ghost particles. The motion of all other particles is NaN."""
        for name, scene in LONG.items():
            with self.subTest(name):
                self.directory = self.directory / name.replace(" ", "_")
                self.directory.mkdir()
                self.assert_same_bits((2, 4) if name == "a solid" else (4,), self.scene(scene))
                self.assert_follows_a_part("ranks4")
                self.directory = self.directory.parent

    def test_estimates_in_the_halo(self):
        """The search for the stable step sends no vector over all particles."""
        scene = self.scene(SHORT_BLOCK.replace("[1, 1, 1]", "[11, 1, 1]").replace(
            "[4, 4, 4]", "[63, 4, 4]").replace("check_every = 30", "check_every = 1").replace(
                "history_every = 0.01", "history_every = 1").replace("frames_every = 0.04",
                                                                     "frames_every = 1"))
        sent = {}  # [steps] bytes
        for until in (0.03, 0.055):
            self.ranks(4, "run", scene, "--output", str(until), "--until", until)
            log = self.log(str(until))
            steps = int(re.search(r"(\d+) steps in", log)[1])
            sent[steps] = int(re.search(r"messages of (\d+) bytes", log)[1])
        (few, less), (many, more) = sent.items()
        particles, bytes_of_each = 64 * 5 * 5, 32
        self.assertLess((more - less) / (many - few), particles * bytes_of_each)

    def assert_follows_a_part(self, output):
        steps = re.search(r"on (\d+) of (\d+) particles at most, (\d+) of them ghosts",
                          self.log(output))
        followed, of_all, ghosts = map(int, steps.groups())
        self.assertLess(followed, 0.8 * of_all)
        self.assertLess(ghosts, 0.6 * of_all)

    def test_ghosts_of_several_bodies(self):
        """All ranks follow the surfaces in contact and a part of each body."""
        for name, scene in MOST.items():
            with self.subTest(name):
                self.directory = self.directory / name.replace(" ", "_")
                self.directory.mkdir()
                self.assert_same_bits((3,), self.scene(scene))
                steps = re.search(r"on (\d+) of (\d+) particles at most", self.log("ranks3"))
                followed, of_all = map(int, steps.groups())
                self.assertLess(followed, of_all)
                self.directory = self.directory.parent

    def test_partners_beside_shared_points(self):
        """Two contacts of a body use the same points; a rank may have points near one of them only. Their sums
        are added in the same order as in one process."""
        self.assert_same_bits((2,), shipped.scene("pull_off"), "--until", "1")

    def test_small_bodies(self):
        """Small bodies lie on one rank each, if no rank then has much more than the others."""
        for name, scene in WHOLE.items():
            with self.subTest(name):
                self.directory = self.directory / name.replace(" ", "_")
                self.directory.mkdir()
                counts = (2, 3, 4) if name == "beside a large one" else (4,)
                self.assert_same_bits(counts, self.scene(scene))
                self.directory = self.directory.parent
        log = (self.directory / "apart" / "ranks4" / "run.log").read_text()
        self.assertIn("on 500 of 2000 particles at most, 0 of them ghosts", log)
        log = (self.directory / "drops" / "ranks4" / "run.log").read_text()
        self.assertRegex(log, r"on \d+ of \d+ particles at most, 0 of them ghosts")
        # A rank follows two bodies of 125 particles each and the surfaces of two of the others.
        log = (self.directory / "in_contact" / "ranks4" / "run.log").read_text()
        self.assertLessEqual(int(re.search(r", (\d+) of them ghosts", log)[1]), 250)
        log = (self.directory / "beside_partners" / "ranks4" / "run.log").read_text()
        self.assertIn("on 250 of 1000 particles at most, 0 of them ghosts", log)

    def test_restart_of_small_bodies(self):
        for name in ("in contact", "beside partners"):
            scene = self.scene(WHOLE[name])
            whole = self.call("run", scene, "--output", "whole", "--overwrite")
            self.ranks(2, "run", scene, "--output", "part", "--until", 0.006, "--overwrite")
            self.ranks(3, "run", scene, "--restart", "part", "--until", 0.011)
            done = self.ranks(2, "run", scene, "--restart", "part")
            self.assertEqual(state_of(done), state_of(whole))
            self.assertEqual((self.directory / "part/history.csv").read_text(),
                             (self.directory / "whole/history.csv").read_text())

    def test_failure_in_a_small_body(self):
        """A failure on one rank is reported by all, although they do not have its rows."""
        folding = WHOLE["apart"].replace("initial_velocity = [10, 0, 0]",
                                         'initial_velocity = ["-600*x", 0, 0]')
        # Of the wall of a body of the second rank.
        without_number = '10*sqrt(0.02 - t)"'.join(WHOLE["beside partners"].rsplit('10*(1 + 20*t)"', 1))
        for scene in (folding, without_number):
            path = self.scene(scene)
            alone = self.call("run", path, "--output", "alone", "--overwrite", code=4)
            done = self.ranks(2, "run", path, "--output", "ranks2", "--overwrite", code=4)
            words = [re.search(r"error: (step.*)", run.stderr)[1] for run in (alone, done)]
            self.assertEqual(*words)

    def test_parts_that_meet(self):
        """Ranks follow the parts of surfaces that are near the other surface. If more parts are needed in the
        middle of a step, the step is made again."""
        self.assert_same_bits((4,), self.scene(MEETING_BARS))
        self.assert_follows_a_part("ranks4")

    def test_failures_in_the_halo(self):
        """Failures have the position of the particle, which not all ranks know."""
        thrown = MOST["a wall"].replace("[[body]]", "[[body]]\ninitial_velocity = [0, 0, -300]")
        for scene in (PUSHED.replace("[4, 4, 4]", "[15, 2, 2]"), thrown):
            path = self.scene(scene)
            alone = self.call("run", path, "--output", "alone", "--overwrite", code=4)
            done = self.ranks(3, "run", path, "--output", "ranks3", "--overwrite", code=4)
            words = [re.search(r"error: (step.*)", run.stderr)[1] for run in (alone, done)]
            self.assertEqual(*words)

    def test_doubtful_law(self):
        """A warning of a law on one rank is printed once, with the same words as in a run alone."""
        scene = self.scene(PRESSED)
        self.call("run", scene, "--output", "alone")
        self.ranks(3, "run", scene, "--output", "ranks3")
        warnings = [re.findall(r"warning: t = .*", self.log(name)) for name in ("alone", "ranks3")]
        self.assertTrue(warnings[0])
        self.assertEqual(*warnings)

    def test_new_reference(self):
        self.assert_same_bits((3,), self.scene(SHORT_REMAP))

    def test_relaxation(self):
        self.assert_same_bits((2,), self.scene(RELAXING_SHEET), "--until", "0.05")
        self.assert_same_bits((4,), self.scene(RELAXING_BLOCK), "--overwrite", "--until", "0.2")
        self.assert_follows_a_part("ranks4")

    def test_newton(self):
        self.assert_same_bits((2,), self.scene(BENT_SHEET))
        self.assertIn('make their steps on all particles because of solver = "newton"',
                      self.log("ranks2"))

    def test_contact_without_some_ranks(self):
        """Beside a rigid partner, a rank knows only its own points, and may have none."""
        self.assert_same_bits((3,), shipped.scene("adhesion_cycle"), "--until", "0.75")
        self.assert_same_bits((3,), shipped.scene("droplet_friction"), "--until", "0.5", "--overwrite")

    def test_scenes(self):
        for name, (scene, *options) in SCENES.items():
            with self.subTest(name):
                self.directory = self.directory / scene
                self.directory.mkdir()
                self.assert_same_bits((2,), shipped.scene(scene), *options)
                if scene == "nematic_drop":
                    self.assertIn("on all particles because of the field 'director'",
                                  self.log("ranks2"))
                self.directory = self.directory.parent

    def test_one_rank(self):
        """With mpirun -n 1, the program runs as without mpirun."""
        scene = self.scene(SHORT_BLOCK)
        self.ranks(1, "run", scene, "--output", "one")
        self.assertNotIn("ranks", self.log("one"))

    def test_restart_on_other_numbers(self):
        scene = self.scene(SHORT_DROP)
        whole = self.call("run", scene, "--output", "whole")
        self.ranks(3, "run", scene, "--output", "part", "--until", "3 ps")
        self.ranks(2, "run", scene, "--restart", "part", "--until", "6 ps")
        done = self.call("run", scene, "--restart", "part")
        self.assertEqual(state_of(done), state_of(whole))
        self.assertEqual((self.directory / "part/history.csv").read_text(),
                         (self.directory / "whole/history.csv").read_text())


class Failures(RanksTest):
    def assert_said_once(self, done, text):
        self.assertEqual((done.stdout + done.stderr).count(text), 1, done.stdout + done.stderr)

    def test_bad_scene(self):
        done = self.ranks(2, "run", self.scene(SHORT_BLOCK.replace("mu = 1e5", "mu = -1")), code=3)
        self.assert_said_once(done, "mu")

    def test_bad_command_line(self):
        scene = self.scene(DROP)
        self.assert_said_once(self.ranks(2, "run", scene, "--wrong", code=2), "--wrong")
        self.assert_said_once(self.ranks(2, "check", scene, code=3), "several ranks")

    def test_ranks_that_mpi_does_not_know(self):
        """A launcher with another interface: its processes do not become runs of their own."""
        scene = self.scene(SHORT_BLOCK)
        for names in (("PMIX_RANK", "SLURM_STEP_NUM_TASKS"), ("PMI_RANK", "PMI_SIZE")):
            started = {**RANKS_ENVIRONMENT, **dict(zip(names, ("0", "2")))}
            done = subprocess.run([program.PROGRAM, "run", scene, "--output", "out"],
                                  cwd=self.directory, text=True, capture_output=True, env=started,
                                  timeout=100)
            self.assertEqual(done.returncode, 5, done.stderr)
            self.assert_said_once(done, "rank 0 of 2 as it was started, but MPI knows of 1 in all")
            self.assertFalse((self.directory / "out").exists())

    def test_existing_output(self):
        """Existing output is refused by the first rank, which writes the files."""
        scene = self.scene(SHORT_BLOCK)
        self.call("run", scene, "--output", "out", "--until", "0.01")
        self.assert_said_once(self.ranks(2, "run", scene, "--output", "out", code=5), "already holds")

    def test_failing_run(self):
        """The run fails at the same step with the same message, printed once, whichever rank has the rows."""
        scene = self.scene(PUSHED)
        alone = self.call("run", scene, "--output", "alone", code=4)
        words = re.search(r"error: (step.*)", alone.stderr)[1]
        for count in (2, 4):
            done = self.ranks(count, "run", scene, "--output", f"ranks{count}", code=4)
            self.assert_said_once(done, words)

    def in_two_directories(self, *arguments, code=0):
        """Runs the program on two ranks in different directories, as on machines without a common disk."""
        rank = [program.PROGRAM, *map(str, arguments)]
        command = [*MPIRUN, "1", "--wdir", self.directory / "a", *rank, ":", "-n", "1", "--wdir",
                   self.directory / "b", *rank]
        done = subprocess.run(command, cwd=self.directory, text=True, capture_output=True,
                              env=RANKS_ENVIRONMENT, timeout=60)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_ranks_that_see_different_directories(self):
        """The first rank decides whether a run is continued in place. All ranks must read the same files."""
        (self.directory / "a").mkdir()
        scene = self.scene(SHORT_BLOCK, "a/scene")
        self.call("run", scene, "--output", "a/out", "--until", "0.02")
        (self.directory / "a/from").symlink_to("out")
        shutil.copytree(self.directory / "a", self.directory / "b", symlinks=True)
        (self.directory / "b/from").unlink()
        shutil.copytree(self.directory / "b/out", self.directory / "b/from")
        run = ["run", "scene.toml", "--restart", "from", "--output", "out"]
        done = self.in_two_directories(*run)
        self.assertEqual(state_of(done), state_of(self.call("run", scene, "--output", "whole")))
        shutil.rmtree(self.directory / "b/from")
        self.assert_said_once(self.in_two_directories(*run, code=5), "'from'")
        shutil.copytree(self.directory / "a/out", self.directory / "b/from")
        self.call("run", scene, "--output", "a/out", "--overwrite", "--until", "0.03")
        self.assert_said_once(self.in_two_directories(*run, code=5), "the ranks 0 and 1 have read another state")
        (self.directory / "b/scene.toml").write_text(SHORT_BLOCK.replace("mu = 1e5", "mu = 2e5"))
        self.assert_said_once(self.in_two_directories(*run, code=5), "the ranks 0 and 1 have read another scene")
        (self.directory / "b/scene.toml").unlink()
        self.assert_said_once(self.in_two_directories(*run, code=5), "cannot read the scene")

    def test_full_disk(self):
        """If the first rank cannot write, all ranks end with the exit code for files."""
        scene = self.scene(BLOCK.replace("end = 0.4", "end = 40"))
        # The limit is not that of mpirun, nor of memory that ranks share as a file.
        limited = ["bash", "-c", 'ulimit -f 100; exec "$@"', "bash"]
        mpirun, program = self.command(2)[:-1], self.command(2)[-1:]
        done = subprocess.run([*mpirun, "--mca", "btl", "self,tcp", *limited, *program, "run", scene,
                               "--output", "out"], cwd=self.directory, text=True,
                              capture_output=True, env=RANKS_ENVIRONMENT, timeout=100)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assert_said_once(done, "File too large")

    def long_run(self):
        """A run on two ranks that has written its first frame, and the processes of meniscus-mpi by
        rank."""
        self.file = self.scene(BLOCK.replace("end = 0.4", "end = 400"))
        process = self.start_ranks(2, "run", self.file, "--output", "out")
        frames = self.directory / "out/run.h5"
        end = time.time() + 60
        while not frames.exists():
            self.assertLess(time.time(), end)
            self.assertIsNone(process.poll())
            time.sleep(0.05)
        return process, self.processes_of_ranks(process.pid)

    def processes_of_ranks(self, mpirun):
        """mpirun starts meniscus, and that starts meniscus-mpi."""
        parents = {}
        for entry in Path("/proc").glob("[0-9]*"):
            try:
                parents[int(entry.name)] = int((entry / "stat").read_text().rsplit(")")[-1].split()[1])
            except OSError:
                pass
        found = {}
        for process, parent in parents.items():
            if parents.get(parent) != mpirun:
                continue
            environment = Path(f"/proc/{process}/environ").read_bytes().split(b"\0")
            rank = next(word for word in environment if word.startswith(b"OMPI_COMM_WORLD_RANK="))
            found[int(rank.split(b"=")[1])] = process
        self.assertEqual(sorted(found), [0, 1])
        return found

    def test_rank_that_fails_alone(self):
        """The others wait for it somewhere else: it says why, and ends them."""
        broken = Path(program.PROGRAM).resolve().parent / "tests/libmeniscus_broken_tanh.so"
        self.assertTrue(broken.exists())
        scene = self.scene(LONG_BLOCK.replace('"20*sin(40*t)*(1 + z)"', '"tanh(t)"'))
        run = [program.PROGRAM, "run", scene, "--output", "out"]
        for rank in (0, 1):
            of_rank = [[], []]
            of_rank[rank] = ["-x", f"LD_PRELOAD={broken}"]
            done = subprocess.run([*MPIRUN, "1", *of_rank[0], *run, "--overwrite", ":", "-n", "1", *of_rank[1], *run,
                                   "--overwrite"], cwd=self.directory, text=True, capture_output=True,
                                  env=RANKS_ENVIRONMENT, timeout=90)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assert_said_once(done, "formula 'tanh(t)' is not a number")
            self.call("info", "out")

    def test_killed_rank(self):
        for rank in (0, 1):
            with self.subTest(rank=rank):
                process, ranks = self.long_run()
                begin = time.time()
                os.kill(ranks[rank], signal.SIGKILL)
                output, errors = process.communicate(timeout=60)
                self.assertLess(time.time() - begin, 60)
                self.assertEqual(process.returncode, 4, errors)
                self.assertIn(f"rank {rank} of 2", errors)
                self.call("info", "out")
                for file in (self.directory / "out").iterdir():
                    file.unlink()

    def test_signal_to_one_rank(self):
        """A signal to one rank stops all ranks after the same step, with a checkpoint from which the run
        continues."""
        process, ranks = self.long_run()
        os.kill(ranks[1], signal.SIGUSR1)
        output, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 128 + signal.SIGUSR1, errors)
        step = int(re.search(r"stopped after step (\d+)", errors)[1])
        self.assertEqual(errors.count("stopped after"), 1)
        done = self.call("run", self.file, "--restart", "out", "--until", "0.001")
        self.assertIn(f"continuing from step {step}", self.log("out"))

    def test_output_of_another_version(self):
        """Output of another version is reported once, and continued."""
        scene = self.scene(with_output(SHORT_BLOCK, "restartable = true"))
        self.call("run", scene, "--output", "out", "--until", "0.05")
        with h5py.File(self.directory / "out/run.h5", "r+") as results:
            set_text(results["meta"], "version", "0.0.7")
        done = self.ranks(2, "run", scene, "--restart", "out", "--frame", 1, "--output", "other")
        self.assertEqual(done.stderr.count("was written by meniscus 0.0.7"), 1, done.stderr)


if __name__ == "__main__":
    program.main()
