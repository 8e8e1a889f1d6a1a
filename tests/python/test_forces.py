#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Forces on particles by functions of Python: exact motions, work, and functions that are wrong.
Usage: test_forces.py PROGRAM, with the package on PYTHONPATH"""
import math
import os
import signal
import sys
import unittest

import numpy as np

import meniscus
from scenes import SHEET, sheet

MASS = 2000  # of the sheet


def balance(run):
    """What is constant: all energies, less the work from outside."""
    energies = run.energies()
    outside = energies.pop("external_work") + energies.pop("remapped")
    return sum(energies.values()) - outside


class Motions(unittest.TestCase):
    def pushed(self, dt):
        """A sheet that is pushed for a second in steps of dt, and the energy of its centre."""
        run = meniscus.Run(sheet(step=dt))
        begin = run.field("sheet", "position")
        particles = len(begin)
        force = np.tile(np.array([300.0, -500.0]) / particles, (particles, 1))
        centre = np.array([run.measure(f"sheet.centre_{i}") for i in "xy"])
        run.add_force("sheet", lambda t, x, v: force)
        run.advance_to(1 - dt / 2)
        moved = np.array([run.measure(f"sheet.centre_{i}") for i in "xy"]) - centre
        np.testing.assert_allclose(moved, force.sum(axis=0) * run.time**2 / (2 * MASS), rtol=1e-12)
        way = np.sum(force * (run.field("sheet", "position") - begin))
        return run, way, np.sum(force.sum(axis=0) ** 2) * run.time**2 / (2 * MASS)

    def test_a_constant_force(self):
        """The centre moves by F t^2/2M. The work is the force times the way, and the kinetic energy of the
        centre plus a small strain, since the force is not distributed like the mass."""
        errors = []
        for dt in (4e-3, 2e-3, 1e-3):
            run, way, whole = self.pushed(dt)
            energies = run.energies()
            errors.append([abs(balance(run)) / whole, abs(energies["external_work"] - way) / whole])
            self.assertAlmostEqual(energies["kinetic"] / whole, 1, delta=1e-3)
            self.assertAlmostEqual(energies["external_work"] / whole, 1, delta=1e-3)
        orders = np.log2(np.array(errors[:-1]) / errors[1:])
        print(f"\nconstant force: errors of balance and work {errors[-1]}, orders {orders.tolist()}")
        self.assertTrue((np.array(errors[-1]) < 1e-6).all())
        self.assertTrue((orders > 1.7).all(), orders)

    def test_a_spring_swings_with_its_period(self):
        """A stiff body on soft springs: x = v/w sin(w t) with w^2 = k/M."""
        scene = sheet()
        scene["body"][0]["initial_velocity"] = [0.01, 0]
        run = meniscus.Run(scene)
        rest = run.field("sheet", "position")
        run.add_force("sheet", lambda t, x, v: -MASS / len(x) * (x - rest))  # w = 1
        begin, worst, turned = run.measure("sheet.centre_x"), 0, []
        while run.time < 2 * math.pi:
            before, time = run.measure("sheet.velocity_x"), run.time
            run.step()
            worst = max(worst, abs(run.measure("sheet.centre_x") - begin - 0.01 * math.sin(run.time)))
            now = run.measure("sheet.velocity_x")
            if before * now < 0:
                turned.append(time + (run.time - time) * before / (before - now))
        period = 2 * (turned[1] - turned[0])
        scale = run.energies()["kinetic"]
        print(f"\nspring: period / 2 pi - 1 = {period / (2 * math.pi) - 1:.1e}, error {worst / 0.01:.1e}, "
              f"balance {(balance(run) - MASS * 1e-4 / 2) / scale:.1e}")
        self.assertAlmostEqual(period / (2 * math.pi), 1, delta=1e-3)
        self.assertLess(worst, 1e-2 * 0.01)
        self.assertAlmostEqual((balance(run) - MASS * 1e-4 / 2) / scale, 0, delta=1e-5)

    def test_forces_act_from_the_present_state_on(self):
        run, never = meniscus.Run(SHEET), meniscus.Run(SHEET)
        for each in (run, never):
            each.advance_to(0.1)
        begin, time = run.measure("sheet.centre_x"), run.time
        run.add_force("sheet", lambda t, x, v: np.full(x.shape, [MASS / len(x), 0]))
        self.assertEqual(run.time, time)
        run.advance_to(0.5)
        self.assertAlmostEqual((run.measure("sheet.centre_x") - begin) / ((run.time - time) ** 2 / 2), 1, delta=1e-12)
        self.assertEqual(never.measure("sheet.centre_x"), begin)

    def test_each_body_has_its_own_forces(self):
        """Two forces on the second of two bodies."""
        scene = sheet()
        scene["body"].append({**scene["body"][0], "name": "other", "centre": [5, 0], "cells": [4, 6]})
        run, places = meniscus.Run(scene), []

        def pull(t, x, v):
            places.append(x)
            return np.full(x.shape, [MASS / len(x), 0])

        run.add_force("other", pull)
        run.add_force("other", lambda t, x, v: np.full(x.shape, [0, -MASS / len(x)]))
        run.advance_to(0.5)
        np.testing.assert_allclose(places[0].mean(axis=0), [5, 0], atol=1e-12)
        fallen = run.time**2 / 2
        for name, expected in (("sheet", [0, 0]), ("other", [5 + fallen, -fallen])):
            centre = [run.measure(f"{name}.centre_{i}") for i in "xy"]
            np.testing.assert_allclose(centre, expected, atol=1e-12)

    def test_drops_with_either_viscosity_and_bodies_of_revolution(self):
        drop = {"name": "drop", "shape": "disk", "radius": 1, "core": 4, "rings": 2, "material": {
            "type": "newtonian", "density": 1, "bulk_modulus": 200, "viscosity": 2}}  # fmt: skip
        tension = [{"body": "drop", "gamma": 1}]
        for dimension, viscosity in ((2, "implicit"), (2, "explicit"), ("axisymmetric", "implicit")):
            run = meniscus.Run({"dimension": dimension, "time": {"end": 1, "viscosity": viscosity}, "body": [drop],
                                "surface_tension": tension})  # fmt: skip
            mass, begin, energy = run.field("drop", "mass"), run.measure("drop.centre_y"), balance(run)
            run.add_force("drop", lambda t, x, v, m=mass: m[:, None] * [0, 3])
            run.advance_to(0.5)
            moved = run.measure("drop.centre_y") - begin
            self.assertAlmostEqual(moved / (3 * run.time**2 / 2), 1, delta=1e-12)
            work = run.energies()["external_work"]
            self.assertAlmostEqual(work / (mass.sum() * 3 * moved), 1, delta=5e-3)
            self.assertAlmostEqual((balance(run) - energy) / work, 0, delta=1e-4)

    def test_damping_takes_energy_out(self):
        """M v' = - c v."""
        scene = sheet()
        scene["body"][0]["initial_velocity"] = [1, 0]
        run = meniscus.Run(scene)
        run.add_force("sheet", lambda t, x, v: -MASS / len(x) * v)
        run.advance_to(1)
        self.assertAlmostEqual(run.measure("sheet.velocity_x") / math.exp(-run.time), 1, delta=3e-3)
        self.assertAlmostEqual(balance(run) / (MASS / 2), 1, delta=1e-4)

    def test_relaxation_to_the_rest_of_springs(self):
        run = meniscus.Run(sheet(solver="relax", end=100))
        goal = run.field("sheet", "position") + [0.3, -0.2]
        run.add_force("sheet", lambda t, x, v: -MASS / len(x) * (x - goal))
        run.advance_to(100)
        self.assertTrue(run.finished)
        self.assertLess(run.time, 100)
        away = np.abs(run.field("sheet", "position") - goal).max()
        print(f"\nrelaxation: {away:.1e} from the rest, t = {run.time:.3g}")
        self.assertLess(away, 1e-4)

    def test_forces_stay_through_remaps(self):
        scene = sheet()
        scene["body"][0]["material"] = {"type": "newtonian", "density": 1000, "bulk_modulus": 1e5, "viscosity": 100}
        scene["remap"] = [{"body": "sheet", "at": [0.1, 0.2]}]
        run = meniscus.Run(scene)
        run.add_force("sheet", lambda t, x, v: np.full(x.shape, [MASS / len(x), 0]))
        run.advance_to(0.3)
        self.assertNotEqual(run.energies()["remapped"], 0)
        self.assertAlmostEqual(run.measure("sheet.velocity_x") / run.time, 1, delta=1e-12)

    def test_a_stiff_function_shortens_the_step(self):
        run, free = meniscus.Run(SHEET), meniscus.Run(SHEET)
        rest = run.field("sheet", "position")
        run.add_force("sheet", lambda t, x, v: -1e8 / len(x) * (x - rest))
        for each in (run, free):
            each.step()
        self.assertLess(run.time, 0.7 * free.time)
        run.advance_to(0.1)
        self.assertLess(np.abs(run.field("sheet", "velocity")).max(), 1e-9)


class WrongFunctions(unittest.TestCase):
    def run_with(self, wrong):
        """A run whose function gives wrong(x) after the time 0.05."""
        run = meniscus.Run(SHEET)
        run.add_force("sheet", lambda t, x, v: wrong(x) if t > 0.05 else 0 * x)
        return run

    def refused(self, wrong, message):
        run = self.run_with(wrong)
        with self.assertRaisesRegex(meniscus.SolveError, message):
            run.advance_to(1)

    def test_results_of_another_shape(self):
        expected = r"^step \d+, t = .*: the function has returned {}; expected is an array of shape \(66, 2\) " \
                   r"\(force function on 'sheet'\)$"
        self.refused(lambda x: x[:3], expected.format(r"an array of shape \(3, 2\)"))
        self.refused(lambda x: x[:, 0], expected.format(r"an array of shape \(66,\)"))
        self.refused(lambda x: None, expected.format("an object of type NoneType"))
        self.refused(lambda x: "pull", expected.format("an object of type str"))

    def test_results_that_are_no_numbers(self):
        def wrong(x):
            x[17, 1] = math.nan
            return x

        self.refused(wrong, r"^step \d+, t = .*: body 'sheet', particle 17 at .*: the force on the particle is nan")

    def test_exceptions_of_functions_are_passed_on(self):
        def wrong(x):
            raise KeyError("stiffness")

        run = self.run_with(wrong)
        begin = run.snapshot()
        with self.assertRaisesRegex(KeyError, "stiffness"):
            run.advance_to(1)
        with self.assertRaisesRegex(meniscus.SolveError, "cannot go on"):
            run.step()
        run.restore(begin)
        run.advance_to(0.04)
        same = meniscus.Run(SHEET)
        same.add_force("sheet", lambda t, x, v: 0 * x)
        same.advance_to(0.04)
        self.assertEqual(run.snapshot().hash, same.snapshot().hash)

    def test_a_function_that_is_refused_leaves_the_run_as_it_was(self):
        run, same = meniscus.Run(SHEET), meniscus.Run(SHEET)
        with self.assertRaisesRegex(meniscus.SolveError, r"shape \(1, 2\); expected .*\(66, 2\)"):
            run.add_force("sheet", lambda t, x, v: x[:1])
        with self.assertRaisesRegex(meniscus.InputError, "there is no body 'shet'.*sheet"):
            run.add_force("shet", lambda t, x, v: x)
        for each in (run, same):
            each.advance_to(0.1)
        self.assertEqual(run.snapshot().hash, same.snapshot().hash)

    def test_newton_refuses_them(self):
        scene = sheet(solver="newton", end=1)
        scene["held"] = [{"body": "sheet", "face": "y_min", "displacement": [0, 0]}]
        run = meniscus.Run(scene)
        with self.assertRaisesRegex(meniscus.InputError, "force function on 'sheet' is not the gradient of an energy"):
            run.add_force("sheet", lambda t, x, v: 0 * x)
        run.step()

    def test_the_run_is_not_free_in_its_own_step(self):
        run = meniscus.Run(SHEET)
        with self.assertRaisesRegex(RuntimeError, "in the step that called this function"):
            run.add_force("sheet", lambda t, x, v: 0 * x + run.time)

    def test_control_c_in_a_function(self):
        """The step is completed first."""
        run, same = meniscus.Run(SHEET), meniscus.Run(SHEET)

        def force(t, x, v):
            if t > 0.05 and not pressed:
                pressed.append(True)
                os.kill(os.getpid(), signal.SIGINT)
                for _ in range(100):  # the exception is raised between two of these
                    pass
            return 0 * x

        pressed = []
        run.add_force("sheet", force)
        with self.assertRaises(KeyboardInterrupt):
            run.advance_to(1)
        self.assertTrue(0.05 < run.time < 0.1)
        same.add_force("sheet", lambda t, x, v: 0 * x)
        for each in (run, same):
            each.advance_to(0.1)
        self.assertEqual(run.snapshot().hash, same.snapshot().hash)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
