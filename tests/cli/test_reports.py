#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Results of all kinds, and what the program says: info, check, keys, version, help, progress.
Usage: test_reports.py PROGRAM"""
import json
import os
import pty
import re
import select
import subprocess
import tomllib

import h5py
import numpy as np

import program
from program import BLOCK, DROP, ENVIRONMENT, RELAXING_SHEET, SHEET, ProgramTest, shipped, state_of, with_output

FIELDS = {"displacement": (3, "m"), "velocity": (3, "m/s"), "force": (3, "N"), "J": (1, "1"),
          "F": (9, "1"), "pressure": (1, "Pa"), "von_mises": (1, "Pa"), "cauchy_stress": (9, "Pa")}
ALL = "fields = [" + ", ".join(f'"{name}"' for name in FIELDS) + "]"


def violations(schema, value, place=""):
    """Places at which a value violates a schema, for the keywords of JSON Schema that our schema uses."""
    known = {"type", "enum", "properties", "required", "additionalProperties", "items", "minItems", "maxItems",
             "minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "anyOf", "description", "title", "$schema"}
    assert schema.keys() <= known, schema.keys() - known
    kind = {bool: "boolean", int: "integer", float: "number", str: "string", list: "array", dict: "object"}[type(value)]
    types = schema.get("type", kind)
    if kind not in types and not (kind == "integer" and "number" in types):
        yield f"{place}: type"
        return
    if value not in schema.get("enum", [value]):
        yield f"{place}: enum"
    if kind in ("integer", "number") and not (
            schema.get("minimum", value) <= value <= schema.get("maximum", value)
            and value > schema.get("exclusiveMinimum", -np.inf) and value < schema.get("exclusiveMaximum", np.inf)):
        yield f"{place}: bound"
    if "anyOf" in schema:
        found = [(option.get("type"), list(violations(option, value, place))) for option in schema["anyOf"]]
        if all(wrong for _, wrong in found):
            of_kind = [wrong for of, wrong in found if of == kind]
            yield from of_kind[0] if of_kind else [f"{place}: none of all"]
        return
    if kind == "array":
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            yield f"{place}: length"
        for i, item in enumerate(value):
            yield from violations(schema["items"], item, f"{place}[{i}]")
    if kind == "object":
        yield from (f"{place}: {key} is missing" for key in schema.get("required", []) if key not in value)
        for key, item in value.items():
            below = schema["properties"].get(key, schema["additionalProperties"])
            if below is False:
                yield f"{place}: {key}"
            else:
                yield from violations(below, item, f"{place}.{key}".lstrip("."))


class Results(ProgramTest):
    def assert_finite_history(self, output):
        for name, column in self.history(output).items():
            self.assertTrue(np.isfinite(column).all(), name)

    def test_every_field(self):
        self.call("run", self.scene(with_output(BLOCK, ALL)), "--output", "out")
        for frame in self.frames("out"):
            n = len(frame["position"])
            self.assertEqual(frame.keys() - {"step", "time"}, FIELDS.keys() | {"position"})
            for name, (components, _) in FIELDS.items():
                self.assertEqual(frame[name].reshape(n, -1).shape, (n, components), name)
            self.assertEqual(frame["position"].dtype, np.float64)
        with h5py.File(self.directory / "out/run.h5") as file:
            for name, (_, unit) in FIELDS.items():
                self.assertEqual(file[f"steps/0/{name}"].attrs["units"], unit.encode())
            X = file["reference/block/X"][:]
            mass = file["reference/block/mass"][:].ravel()
        last = self.frames("out")[-1]
        np.testing.assert_allclose(last["position"], X + last["displacement"], atol=1e-14)
        F = last["F"].reshape(-1, 3, 3)
        np.testing.assert_allclose(np.linalg.det(F), last["J"].ravel(), rtol=1e-2)
        stress = last["cauchy_stress"].reshape(-1, 3, 3)
        np.testing.assert_allclose(-np.trace(stress, axis1=1, axis2=2) / 3, last["pressure"].ravel(),
                                   rtol=1e-10, atol=1e-6)
        self.assertAlmostEqual(mass.sum(), 1000, delta=1e-6)
        self.assertFalse(np.array_equal(self.frames("out")[0]["position"], last["position"]))

    def test_cells(self):
        """The cells that viewers draw are the right-handed cells of the body and have its volume."""
        for text, volume in ((BLOCK, 1), (SHEET, 2)):
            self.call("run", self.scene(text), "--output", "out", "--overwrite")
            with h5py.File(self.directory / "out/run.vtkhdf") as file:
                view = file["VTKHDF"]
                X, surface = view["Points"][:view["NumberOfPoints"][0]], view["PointData/surface"][:]
                corners = X[view["Connectivity"][:].reshape(view["NumberOfCells"][0], -1)]
            edges = corners[:, [1, 3, 4 if corners.shape[1] == 8 else 3]] - corners[:, :1]
            if corners.shape[1] == 4:
                edges[:, 2] = [0, 0, 1]
                np.testing.assert_allclose(corners[:, 2], corners[:, 1] + corners[:, 3] - corners[:, 0])
            else:
                np.testing.assert_allclose(corners[:, 6], corners[:, 0] + edges.sum(axis=1), atol=1e-14)
            size = np.linalg.det(edges)
            self.assertTrue((size > 0).all())
            self.assertAlmostEqual(size.sum(), volume, delta=1e-12)
            low, high = X.min(axis=0), X.max(axis=0)
            outside = ((X == low) | (X == high))[:, :2 if corners.shape[1] == 4 else 3].any(axis=1)
            np.testing.assert_array_equal(surface, outside)

    def test_rigid_motion(self):
        """Positions are X + sum N u: exact for a uniform velocity."""
        text = SHEET.replace("[[body]]", "[[body]]\ninitial_velocity = [3, -2]")
        self.call("run", self.scene(with_output(text, ALL)), "--output", "out")
        first, last = self.frames("out")[0], self.frames("out")[-1]
        np.testing.assert_allclose(last["position"] - first["position"],
                                   np.tile([0.3, -0.2, 0], (len(first["position"]), 1)), atol=1e-12)
        np.testing.assert_allclose(last["velocity"], np.tile([3, -2, 0], (66, 1)), atol=1e-10)
        np.testing.assert_allclose(last["J"], 1, atol=1e-12)

    def test_sheet_at_rest(self):
        text = with_output(SHEET, ALL + '\nmeasures = ["sheet.aspect", "sheet.p2", "sheet.radius", '
                           '"sheet.extent_x", "sheet.extent_y", "sheet.state_error"]')
        text += """
        [[exact]]
        body = "sheet"
        displacement = [0, 0]
        velocity = [0, 0]
        rate = 1
        """
        self.call("run", self.scene(text), "--output", "out")
        self.assert_finite_history("out")
        history = self.history("out")
        np.testing.assert_array_equal(history["step"], np.arange(len(history["step"])))
        np.testing.assert_allclose(history["sheet.aspect"], 2, rtol=1e-14)
        np.testing.assert_array_equal(history["sheet.state_error"], 0)
        for name in ("kinetic_energy", "momentum_error", "energy_balance_error"):
            np.testing.assert_array_equal(history[name], 0)
        frame = self.frames("out")[-1]
        self.assertEqual(frame["position"].shape, (66, 3))
        self.assertTrue((frame["position"][:, 2] == 0).all())

    def test_two_bodies(self):
        second = BLOCK[BLOCK.index("[[body]]"):].replace('"block"', '"brick"').replace(
            "cells = [4, 4, 4]", "cells = [3, 3, 3]\ncentre = [5, 0, 0]\ninitial_velocity = [0, 7, 0]")
        second = second[:second.index("[[body_force]]")]
        text = with_output(BLOCK, ALL + '\nmeasures = ["brick.aspect", "block.aspect"]') + second
        self.call("run", self.scene(text), "--output", "out")
        self.call("run", self.scene(with_output(BLOCK, ALL)), "--output", "alone", "--set",
                  f"time.step={self.history('out')['dt'][10]}")
        frame = self.frames("out")[-1]
        self.assertEqual(len(frame["position"]), 125 + 64)
        np.testing.assert_allclose(frame["velocity"][125:], np.tile([0, 7, 0], (64, 1)), atol=1e-9)
        np.testing.assert_allclose(frame["J"][125:], 1, atol=1e-9)
        np.testing.assert_allclose(frame["position"][:125], self.frames("alone")[-1]["position"],
                                   atol=1e-3)
        with h5py.File(self.directory / "out/run.h5") as file:
            self.assertEqual(file["reference/brick"].attrs["first_particle"], 125)
        self.assert_finite_history("out")
        self.assertIn("brick", self.call("info", "out").stdout)

    def test_small_files(self):
        """Output in float32, compressed and without states."""
        text = with_output(BLOCK, 'precision = "float32"\ncompression = 6')
        self.call("run", self.scene(with_output(BLOCK, "restartable = true")), "--output", "full")
        self.call("run", self.scene(text), "--output", "small")
        for small, full in zip(self.frames("small"), self.frames("full")):
            self.assertEqual(small["velocity"].dtype, np.float32)
            np.testing.assert_array_equal(small["velocity"], full["velocity"].astype(np.float32))
        with h5py.File(self.directory / "small/run.h5") as file:
            self.assertNotIn("state", file["steps/1"])
            self.assertEqual(file["steps/1/velocity"].compression, "gzip")
        self.assertLess((self.directory / "small/run.h5").stat().st_size,
                        0.6 * (self.directory / "full/run.h5").stat().st_size)
        self.refused(["run", self.scene(text), "--restart", "small", "--frame", "1"], 5,
                     "output.restartable = true")

    def test_units(self):
        """The same drop in other units gives the same results."""
        self.call("run", self.scene(DROP), "--output", "si")
        self.call("run", self.scene('units.system = "nm-ps-ag"\n' + DROP.replace(
            "density = 1000", 'density = "1 g/cm^3"')), "--output", "nm")
        si, nm = self.frames("si")[-1], self.frames("nm")[-1]
        self.assertAlmostEqual(nm["time"], 60)
        np.testing.assert_allclose(nm["position"], 1e9 * si["position"], atol=1e-6)
        with h5py.File(self.directory / "nm/run.h5") as file:
            self.assertEqual(file["steps/0/velocity"].attrs["units"], b"nm/ps")

    def test_named_numbers(self):
        """A scene with named constants has the same bits as a scene with numbers, also if --set changes a
        constant."""
        text = DROP + ('[constants]\nR = "5 nm"\nlong = "R + R/2"\ngamma = "72.8 mN/m"\nmu = "gamma/v"\n'
                       'v = "1 m/s"\nn = 2\n')
        for old, new in (('["5 nm", "7.5 nm", "5 nm"]', '["R", "long", "R"]'), ("layers = 2", 'layers = "n"'),
                         ('gamma = "72.8', 'gamma = "gamma"\n#'), ('viscosity = "0.6 mPa s"', 'viscosity = "mu"')):
            self.assertIn(old, text)
            text = text.replace(old, new, 1)
        file = self.scene(text)
        for R, v in (5e-9, 121), (6e-9, 145):
            named = self.call("run", file, "--output", f"named{v}", "--set", f"constants.R={R * 1e9:.0f} nm",
                              "--set", f"constants.v={v} m/s")
            plain = self.scene(DROP.replace('["5 nm", "7.5 nm", "5 nm"]', f"[{R!r}, {R + R / 2!r}, {R!r}]").replace(
                '"0.6 mPa s"', repr(0.0728 / v)), "plain")
            self.assertEqual(state_of(named), state_of(self.call("run", plain, "--output", f"plain{v}")))
        self.refused(["run", file, "--restart", "named121", "--set", "constants.v=2 m/s"], 3, "constants.v")

    def test_moduli(self):
        """Young's modulus and Poisson's ratio replace the parameters of a law, on a graded body, too."""
        own = BLOCK.replace("mu = 1e5\nlambda = 1e5", 'mu = "(6e5*(1 + x))/(2*(1 + (0.25)))"\n'
                            'lambda = "(6e5*(1 + x))*(0.25)/((1 + (0.25))*(1 - 2*(0.25)))"')
        moduli = BLOCK.replace("mu = 1e5\nlambda = 1e5",
                               'youngs_modulus = "6e5*(1 + x)"\npoissons_ratio = 0.25')
        states = [state_of(self.call("run", self.scene(text, name), "--output", name))
                  for text, name in ((own, "own"), (moduli, "moduli"))]
        self.assertEqual(*states)
        self.refused(["check", self.scene(moduli.replace("0.25", '"0.3 + x"'))], 3, "scene.toml:",
                     "the bulk modulus lambda + 2/3 mu must be positive")

    def test_result_does_not_depend_on_what_is_written(self):
        a = self.call("run", self.scene(BLOCK), "--output", "a")
        b = self.call("run", self.scene(with_output(BLOCK, ALL)), "--output", "b", "--set",
                      "output.frames_every=0.003", "--set", "output.checkpoint_minutes=1e-6")
        self.assertEqual(state_of(a), state_of(b))
        c = self.call("run", self.scene(BLOCK), "--output", "c", "--set", "output.history_every=0.05")
        self.assertEqual(state_of(a), state_of(c))

    def test_until_a_multiple_of_the_step(self):
        """25 steps of 0.1 ms are 2.4999999999999996 ms in floating point. The run ends there, not at 2.6 ms."""
        self.assertLess(sum(25 * [1e-4]), 0.0025)
        text = SHEET.replace("end = 0.1", "end = 0.003\nstep = 1e-4")
        self.call("run", self.scene(text), "--output", "out", "--until", "0.0025")
        self.assertIn("step      25\n", self.call("info", "out/checkpoint-a.h5").stdout)
        whole = self.call("run", self.scene(text), "--output", "whole")
        self.assertEqual(state_of(self.call("run", self.scene(text), "--restart", "out")), state_of(whole))

    def test_a_load_without_face_is_on_the_whole_surface(self):
        """A load without `face` acts on the whole surface, as `meniscus keys` describes."""
        loads = ("", '[[traction]]\nbody = "sheet"\npressure = 100\n', '[[spring]]\nbody = "sheet"\nstiffness = 100\n')
        states = [state_of(self.call("run", self.scene(SHEET.replace("[[body]]", "[[body]]\ninitial_velocity = [0, '0.1*y']")
                                                       + load + more), "--output", "out", "--overwrite"))
                  for load in loads for more in ("", "where = 1\n" if load else "")]
        self.assertEqual(states[::2], states[1::2])
        self.assertEqual(len(set(states)), 3)

    def test_expectations_with_units(self):
        """A value with a unit means the same as a number in the unit of the column, in any unit system."""
        expect = '[expect]\nheight = {{ of = "drop.extent_y", at = 0.0, value = {}, within = {} }}\n'
        text = DROP.replace('end = "60 ps"', 'end = "3 ps"')
        for value, within, code in (('"15 nm"', '"10 pm"', 0), (15e-9, 1e-11, 0), ('"0.015 um"', '"10 pm"', 0),
                                    ('"15.02 nm"', '"10 pm"', 7)):
            self.call("run", self.scene(text + expect.format(value, within)), "--output", "out", "--overwrite",
                      code=code)
        units = '[units]\nsystem = "nm-ps-ag"\n[constants]\nheight = "150 angstrom"\n'
        text = self.scene(text + expect.format('"height"', '"10 pm"') + units)
        done = self.call("run", text, "--output", "out", "--overwrite")
        self.assertRegex(done.stdout, r"height +15\S* +15 +0.01 +met")


class Nodal(ProgramTest):
    """Integration at the particles alone has modes without energy, which the measured area excites. A warning
    must appear."""

    def test_drop(self):
        text = DROP.replace("core = 3\nlayers = 2", 'core = 6\nlayers = 3\nintegration = "nodal"')
        text = text.replace('end = "60 ps"', 'end = "200 ps"')
        text += """
        [expect]
        "drop.aspect" = { value = 1.0019, within = 0.01 }
        energy_balance_error = { reduce = "max_abs", value = 0, within = 1e-2 }
        """
        file = self.scene(text)
        self.call("run", file, "--output", "good", "--set", "body.drop.integration=q_scni")
        self.assertIn("warning: body 'drop': integration = \"nodal\"", self.call("check", file).stdout)
        process = self.start("run", file, "--output", "out", "--set", "surface_tension[0].form=weak")
        _, stderr = process.communicate()
        self.assertIn("warning: body 'drop': integration = \"nodal\"", stderr)
        self.assertIn("nodal", (self.directory / "out/run.log").read_text())
        self.assertIn(process.returncode, (4, 7))


class Reports(ProgramTest):
    def test_info(self):
        self.call("run", self.scene(with_output(BLOCK, "restartable = true")), "--output", "out")
        for path in ("out", "out/run.h5"):
            text = self.call("info", path).stdout
            for word in ("block", "125 particles", "velocity", "m/s", "frames    11", "with state",
                         "time 0.4 "):
                self.assertIn(word, text)
        text = self.call("info", "out/checkpoint-a.h5").stdout
        for word in ("step", "time", "hash", "velocity"):
            self.assertIn(word, text)
        for path, word in (("scene.toml", "scene.toml"), ("nowhere", "nowhere"), (".", "run.h5"),
                           ("out/history.csv", "history.csv")):
            self.refused(["info", path], 5, word)

    def test_check(self):
        text = self.call("check", self.scene("title = 'A drop'\n" + DROP)).stdout
        for word in ("A drop", "176 particles", "MB", "stable step", "steps, about", "in order"):
            self.assertIn(word, text)
        self.assertFalse((self.directory / "results").exists())

    def test_no_cap_between_plates(self):
        """A drop between two plates is no spherical cap. It has contact angles by its profile but no height, and
        the log gives the reason."""
        text = """
        dimension = 2
        time.end = 0.01
        [[body]]
        name = "drop"
        shape = "disk"
        radius = 1
        core = 4
        rings = 2
        material = { type = "newtonian", density = 1, bulk_modulus = 200, viscosity = 0.3 }
        [[surface_tension]]
        body = "drop"
        gamma = 1
        """
        for name, side in ("lower", -1), ("upper", 1):
            text += f"""
        [[contact]]
        name = "{name}"
        bodies = ["drop"]
        contact_angle = 90
        sigma0 = 0.2
        partner = {{ type = "half_space", point = [0, {1.13 * side}], normal = [0, {-side}] }}
        """
        text += '[output]\nmeasures = ["lower.contact_angle"]\n'
        self.call("run", self.scene(text), "--output", "out")
        log = (self.directory / "out/run.log").read_text()
        self.assertIn("not measured: lower.height, lower.contact_angle_vh, upper.height, upper.contact_angle_vh", log)
        self.assertIn("body 'drop' has 2 contacts", log)
        self.refused(["run", self.scene(text.replace("lower.contact_angle", "upper.height"))], 3, "scene.toml:",
                     "'upper.height' is not measured: body 'drop' has 2 contacts", "output.measures")

    def test_times_to_rest(self):
        """The number of steps that check expects of relax is one, and about right."""
        sheet = RELAXING_SHEET.replace("end = 20", "end = 2000")
        still = SHEET.replace("end = 0.1", 'end = 2000\nsolver = "relax"')
        bottom = '[[held]]\nbody = "sheet"\nface = "y_min"\n'
        top = '[[held]]\nbody = "sheet"\nface = "y_max"\ndisplacement = {}\nramp = [0, {}]\n'
        load = '[[traction]]\nbody = "sheet"\nface = "y_max"\nforce = {}\nramp = [0, {}]\n'
        for number, text in enumerate((
                sheet,
                still + bottom + top.format('[0, "0.2"]', 5),       # pulled slowly
                still + bottom + top.format('["0.1", 0]', 0.2),     # sheared fast
                still + bottom + load.format("[50, 0]", 0.01),      # bent at once
                still + bottom + load.format("[50, 0]", 3))):
            scene = self.scene(text)
            expected = self.call("check", scene).stdout
            steps = int(re.search(r"relax: about (\d+) steps", expected)[1])
            self.assertIn(f"\n{steps} steps to rest, about ", expected)
            self.call("run", scene, "--output", f"out{number}")
            made = int(re.search(r"(\d+) steps in ", (self.directory / f"out{number}/run.log").read_text())[1])
            self.assertLess(max(steps / made, made / steps), 2, text)

        # Of a body without loads, whose forces vanish, round-off may be what is left.
        fine = sheet.replace("check_every", "force_tolerance = 1e-8\ncheck_every")
        self.assertRegex(self.call("check", self.scene(fine)).stdout,
                         r"\n\d+ steps to time.end, fewer if it comes to rest before, about ")

    def test_times_of_drops(self):
        """How long a drop creeps nobody knows before: check says between which numbers of steps."""
        text = DROP.replace('end = "60 ps"', 'end = "2 ns"\nsolver = "relax"')
        said = self.call("check", self.scene(text)).stdout
        least, most, last = map(int, re.search(r"relax: (\d+) to (\d+) steps .*\n(?:.*\n)?"
                                               r"(\d+) steps to rest, or 5 times more or fewer, about", said).groups())
        self.assertLess(abs(most - 5 * last), 6)
        self.call("run", self.scene(text), "--output", "out")
        made = int(re.search(r"(\d+) steps in ", (self.directory / "out/run.log").read_text())[1])
        self.assertTrue(least < made < most, (least, made, most))

    def test_steps_of_ramps(self):
        """Ramps shorten steps: the number is said to be one of steps as long as at the start."""
        text = SHEET + '[[held]]\nbody = "sheet"\nface = "y_min"\n'
        self.assertNotIn("as long as at the start", self.call("check", self.scene(text)).stdout)
        text += '[[held]]\nbody = "sheet"\nface = "y_max"\ndisplacement = [0, 18]\nramp = [0, 0.1]\n'
        said = self.call("check", self.scene(text)).stdout
        self.assertRegex(said, r"\n\d+ steps if they stay as long as at the start, about ")
        self.assertIn("loads or motions change until the end: steps become shorter", said)

    def test_numbers_of_drops(self):
        """Ohnesorge and Bond numbers and times of a drop, by hand. Softer drops take the number of steps that
        is printed."""
        R = 50e-6
        text = DROP.replace('["5 nm", "7.5 nm", "5 nm"]', '["50 um", "50 um", "50 um"]').replace("60 ps", "60 us")
        text += '[[body_force]]\nbody = "drop"\nacceleration = [0, "3 m/s2", "-4 m/s2"]\n'
        plane = [("dimension = 3", "dimension = 2"), ("layers", "rings"), ('"ellipsoid"', '"ellipse"'),
                 ('["50 um", "50 um", "50 um"]', '["50 um", "50 um"]'),
                 ('[0, "3 m/s2", "-4 m/s2"]', '["3 m/s2", "-4 m/s2"]')]
        for dimension, changes in (3, []), (2, plane):
            for old, new in changes:
                self.assertIn(old, text)
                text = text.replace(old, new)
            file = self.scene(text)
            report = self.call("check", file).stdout
            numbers = re.search(r"^drop 'drop': radius of its volume (\S+) m, .*?gamma R\) (\S+), .*?gamma (\S+); "
                                r"times .*?R/c (\S+), .*?gamma\) (\S+), .*?mu (\S+) s$", report, re.M).groups()
            expected = (R, 6e-4 / (1000 * 0.0728 * R)**0.5, 1000 * 5 * R**2 / 0.0728, R / 2.2e6**0.5,
                        (1000 * R**3 / 0.0728)**0.5, 1000 * R**2 / 6e-4)
            # The radius follows from the inscribed cells and from the mass, printed with three
            # digits.
            np.testing.assert_allclose([float(x) for x in numbers], expected, rtol=0.03)
            modulus, fewer = re.search(r"^bulk_modulus (\S+) Pa of 'drop' .* in (\S+) times fewer steps$", report,
                                       re.M).groups()
            self.assertAlmostEqual(float(modulus) / (100 * (dimension - 1) * 0.0728 / R), 1, delta=0.06)
            softer = self.call("check", file, "--set", f"body.drop.material.bulk_modulus={modulus}").stdout
            self.assertNotIn("times fewer", softer)
            steps = [float(re.search(r"^(\d+) steps", output, re.M).group(1)) for output in (report, softer)]
            self.assertAlmostEqual(steps[0] / steps[1] / float(fewer), 1, delta=0.05)
        # A fast drop is compressed by its speed. A fixed step does not become longer.
        fast = self.scene(text.replace("core = 3", 'core = 3\ninitial_velocity = ["30 m/s", 0]'))
        self.assertIn("bulk_modulus 9e+07 Pa", self.call("check", fast).stdout)
        self.assertNotIn("times fewer", self.call("check", file, "--set", "time.step=1 ns").stdout)
        self.assertNotIn("times fewer", self.call("check", self.scene(DROP)).stdout)

    def test_contact_by_its_adhesion(self):
        """An adhesion given with a range or with sigma0 is reached between bodies and with rigid partners."""
        second = BLOCK[BLOCK.index("[[body]]"):BLOCK.index("[[body_force]]")].replace("block", "twin")
        second = second.replace("cells", "centre = [0, 0, 1.4]\ncells")
        wall = '[contact.partner]\ntype = "half_space"\npoint = [0, 0, -0.9]\nnormal = [0, 0, 1]\n'
        for keys, law in ('range = 0.4\noffset = 0.3\n', "smooth_young"), ("sigma0 = 0.4\n", "scaled_lennard_jones"):
            for scene in (BLOCK + f'[[contact]]\nbodies = ["block"]\nadhesion = "50 mJ/m^2"\n{keys}{wall}',
                          BLOCK + second + f'[[contact]]\nbodies = ["block", "twin"]\nadhesion = "50 mJ/m^2"\n{keys}'):
                self.assertIn(f", {law}, form energy: adhesion W = 0.05 N/m",
                              self.call("check", self.scene(scene)).stdout)

    def test_functions_are_their_formulas(self):
        """A scene with functions has the bits of one with formulas, and so has its complete input; the run
        continues."""
        plain = with_output(BLOCK, "restartable = true").replace("end = 0.4", "end = 0.08")
        named = plain.replace('"20*sin(40*t)*(1 + z)"', '"shake(40, 20)*(1 + z)"').replace(
            '"5*y*cos(11*t)"', '"push"')
        named += '[functions]\n"shake(rate, size)" = "size*sin(rate*t)"\npush = "5*y*cos(11*t)"\n'
        self.assertEqual(named.count("shake("), 2)
        states = {program.state_of(self.call("run", self.scene(text, name), "--output", name))
                  for name, text in (("plain", plain), ("named", named))}
        with h5py.File(self.directory / "named/run.h5") as file:
            complete = file["meta/input"][()].decode()
        self.assertNotIn("shake(", complete)
        states.add(program.state_of(self.call("run", self.scene(complete, "complete"))))
        states.add(program.state_of(self.call("run", "named.toml", "--restart", "named", "--frame", "1")))
        self.assertEqual(len(states), 1)
        self.refused(["run", "named.toml", "--restart", "named", "--frame", "1", "--set",
                      "functions.push=6*y"], 3, "body_force[0].acceleration[1] differs")

    def test_numbers_of_contact(self):
        """Impact pressure rho c v and elastocapillary number W/(mu R) of a block of 1 m^3, by hand."""
        text = BLOCK.replace('name = "block"', 'name = "block"\ninitial_velocity = [0, 0, "-SPEED"]')
        text += ('[[contact]]\nname = "wall"\nbodies = ["block"]\nadhesion = ADHESION\nrange = 0.2\noffset = 0.1\n'
                 '[contact.partner]\ntype = "half_space"\npoint = [0, 0, -0.9]\nnormal = [0, 0, 1]\n')
        R, c = (3 / (4 * np.pi))**(1 / 3), (3e5 / 1e3)**0.5
        for speed, adhesion, warned in (0.1, 500, ()), (20, 500, ("impact",)), (0, 2e5, ("W/(mu R)",)):
            said = self.call("check", self.scene(text.replace("SPEED", str(speed)).replace("ADHESION", str(adhesion))))
            softness = float(re.search(r"^contact 'wall': elastocapillary number W/\(mu R\) of 'block' (\S+)$",
                                       said.stdout, re.M).group(1))
            self.assertAlmostEqual(softness / (adhesion / (1e5 * R)), 1, delta=0.006)
            impact = re.search(r"'block' moves at (\S+) m/s, so .* = (\S+) Pa; the contact holds (\S+) Pa", said.stdout)
            self.assertEqual(impact is None, speed == 0)
            if impact:
                expected = (speed, 1000 * c * speed, 500 * 100 * 0.375**2 / 0.2)  # the least gap is a quarter of `offset`
                np.testing.assert_allclose([float(x) for x in impact.groups()], expected, rtol=0.006)
            warnings = [line for line in said.stdout.splitlines() if line.startswith("warning:")]
            self.assertEqual([word for word in ("impact", "W/(mu R)") if any(word in w for w in warnings)],
                             list(warned), warnings)

    WALL = ('[[contact]]\nname = "wall"\nbodies = ["block"]\nadhesion = 500\nrange = 0.2\noffset = 0.1\n'
            '[contact.partner]\ntype = "half_space"\npoint = [0, 0, -0.9]\nnormal = [0, 0, 1]\n')

    def test_speed_of_an_impact(self):
        """The speed contains what gravity adds over the gap, and the largest speed of the partner towards the
        body."""
        fall = 0.4 - 0.1  # way to the gap at which the surface rests
        for change, speed in ((('["20*sin(40*t)*(1 + z)", "5*y*cos(11*t)", 0]', '[3, 0, -200]'), (2 * 200 * fall)**0.5),
                              (("normal = [0, 0, 1]\n", 'normal = [0, 0, 1]\ndisplacement = [0, "t", "5*t^2"]\n'), 4)):
            text = BLOCK + self.WALL
            self.assertEqual(text.count(change[0]), 1)
            said = self.call("check", self.scene(text.replace(*change))).stdout
            found = re.search(r"contact 'wall': 'block' is met, by its loads or the motion of the partner, at (\S+) m/s", said)
            self.assertIsNotNone(found, said)
            self.assertAlmostEqual(float(found[1]) / speed, 1, delta=0.006)
        self.assertNotIn("presses", self.call("check", self.scene(BLOCK + self.WALL)).stdout)

    def test_tabor_number(self):
        """(R W^2/(E*^2 g^3))^(1/3) of a Lennard-Jones contact, with the peak traction 1.026 W/g of half spaces."""
        law = self.WALL.replace("adhesion = 500\nrange = 0.2\noffset = 0.1", "adhesion = 500\nsigma0 = 0.4")
        said = self.call("check", self.scene(BLOCK + law)).stdout
        gap = float(re.search(r"equilibrium gap (\S+) m", said)[1])
        nu, R = 0.25, (3 / (4 * np.pi))**(1 / 3)
        modulus = 2e5 * (1 + nu) / (1 - nu**2)
        found = float(re.search(r"contact 'wall': Tabor number (\S+) ", said)[1])
        self.assertAlmostEqual(found / (R * 500**2 / modulus**2 / gap**3)**(1 / 3), 1, delta=0.02)
        # A cylinder of the same law, in the half plane.
        flat = SHEET.replace("dimension = 2", 'dimension = "axisymmetric"').replace("size = [1, 2]", "size = [1, 2]\ncorner = [0, 0]")
        said = self.call("check", self.scene(flat + law.replace('"block"', '"sheet"').replace("[0, 0, -0.9]", "[0, -0.9]").replace(
            "[0, 0, 1]", "[0, 1]"))).stdout
        R = (3 * 2 * np.pi / (4 * np.pi))**(1 / 3)
        found = float(re.search(r"contact 'wall': Tabor number (\S+) ", said)[1])
        self.assertAlmostEqual(found / (R * 500**2 / modulus**2 / gap**3)**(1 / 3), 1, delta=0.02)

    def test_rest_of_a_drop_whose_loads_change(self):
        """newton with fluids: the log calls the end a rest only if the loads are steady before."""
        drop = """
        dimension = "axisymmetric"
        time = { solver = "newton", end = 40, step = 5 }
        [[body]]
        name = "drop"
        shape = "cap"
        radius = 1
        contact_angle = 90
        core = 4
        rings = 1
        material = { type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 1 }
        [[surface_tension]]
        body = "drop"
        gamma = 1
        [[wetted]]
        body = "drop"
        face = "flat"
        contact_angle = 90
        [[body_force]]
        body = "drop"
        acceleration = [0, "-0.1*min(t, STEADY)/STEADY"]
        """
        for steady, words in ((5, "at rest at t = "), (40, "loads change until the end at t = 40 s, where bodies need not be at rest")):
            self.call("run", self.scene(drop.replace("STEADY", str(steady))), "--overwrite")
            self.assertIn(words, (self.directory / "results/scene/run.log").read_text())

    def test_drop_that_spreads_with_waves(self):
        """The warning appears only if viscosity is low, the way is long, and bodies have inertia."""
        drop = """
        dimension = 2
        [time]
        end = 1
        [[body]]
        name = "drop"
        shape = "disk"
        radius = 1
        core = 6
        rings = 3
        material = { type = "newtonian", density = 1, bulk_modulus = 200, viscosity = 0.02 }
        [[surface_tension]]
        body = "drop"
        gamma = 1
        [[contact]]
        name = "wall"
        bodies = ["drop"]
        contact_angle = 60
        offset = 0.1
        range = 0.2
        partner = { type = "half_space", point = [0, -1.1], normal = [0, 1] }
        """
        words = "the Ohnesorge number of 'drop' is 0.02 and it has far to spread"
        said = self.call("check", self.scene(drop)).stdout
        self.assertIn(words, said)
        self.assertIn("take 5 times the viscosity", said)
        for change in (("viscosity = 0.02", "viscosity = 0.2"), ("contact_angle = 60", "contact_angle = 170"),
                       ("end = 1", 'end = 1\nsolver = "relax"')):
            self.assertNotIn("has far to spread", self.call("check", self.scene(drop.replace(*change))).stdout)

    def test_solids_that_lock(self):
        """No warning by default; one from K/mu of 10 on where a key takes the remedy away."""
        def warnings(ratio, keys=""):
            text = BLOCK.replace("lambda = 1e5", f"lambda = {1e5 * (ratio - 2 / 3)}").replace("[body.material]", keys + "[body.material]")
            return re.findall("^warning: body 'block': bulk / shear modulus .*", self.call("check", self.scene(text)).stdout, re.M)
        self.assertEqual(warnings(2000), [])
        for key, text in (("volumetric", 'volumetric = "full"\n'), ("integration", 'integration = "gauss"\n')):
            self.assertEqual(warnings(9.9, text), [])
            self.assertEqual(len(warnings(10.1, text)), 1)
            self.assertIn(f"by up to 25 % where a beam has two cells across, by multiples where a closed wall has three; leave out {key}",
                          warnings(10.1, text)[0])

    def test_units_in_si(self):
        text = self.call("check", self.scene('units.system = "nm-ps-ag"\n' + DROP)).stdout
        self.assertIn("units: 1 ag/(nm ps^2) = 1e+12 Pa, 1 ag/(nm ps) = 1 Pa s, 1 ag/ps^2 = 1000 N/m, "
                      "1 ag nm/ps^2 = 1e-06 N, 1 ag nm^2/ps^2 = 1e-15 J\n", text)
        self.assertNotIn("\nunits:", self.call("check", self.scene(DROP)).stdout)

    def test_turning_director(self):
        """A warning appears if the director turns so much that one director per cell is too coarse."""
        text = """
        dimension = 3
        time.end = 1
        [[body]]
        name = "cube"
        shape = "box"
        size = [1, 1, 1]
        cells = [4, 4, 4]
        [body.material]
        type = "liquid_crystal_elastomer"
        director = "convected"
        density = 1
        mu = 1
        bulk_modulus = 10
        step_length = 2
        reference_director = ["cos({0}*x)", "sin({0}*x)", "0"]
        """
        said = "the director turns by up to 43 degrees from cell to cell"  # 3/4 rad
        self.assertIn(said, self.call("check", self.scene(text.format(3))).stdout)
        self.assertNotIn("turns", self.call("check", self.scene(text.format(0.9))).stdout)

    def test_overlap(self):
        """Bodies that overlap are refused. Bodies beside each other are named without a warning."""
        second = BLOCK[BLOCK.index("[[body]]"):BLOCK.index("[[body_force]]")].replace("block", "twin")
        for shift in 0, 0.5:
            moved = second.replace("[body.material]", f"move = [{shift}, 0, 0]\n[body.material]")
            self.refused(["check", self.scene(BLOCK + moved)], 3, "'block'", "'twin'", "nothing keeps them apart",
                         'bodies = ["block", "twin"]')
        beside = second.replace("[body.material]", "move = [1.05, 0, 0]\n[body.material]")
        said = self.call("check", self.scene(BLOCK + beside)).stdout
        self.assertIn("no [[contact]] keeps apart 'block' and 'twin'", said)
        self.assertNotIn("warning", said)

    def test_contact_that_nothing_reaches(self):
        """A drop at rest beyond the range of its wall stays there for ever, which gives a warning."""
        wall = """
        [[contact]]
        name = "wall"
        bodies = ["drop"]
        contact_angle = 90
        offset = 0.04
        range = 0.08
        [contact.partner]
        type = "half_space"
        point = [0, {}]
        normal = [0, 1]
        """
        drop = """
        dimension = 2
        time.end = 1
        [[body]]
        name = "drop"
        shape = "disk"
        radius = 1
        core = 6
        rings = 3
        {}
        material = {{ type = "newtonian", density = 1, bulk_modulus = 100, viscosity = 1 }}
        [[surface_tension]]
        body = "drop"
        gamma = 1
        """
        weight = '[[body_force]]\nbody = "drop"\nacceleration = [0, -1]\n'
        for height, velocity, more, idle in ((-1.5, "", "", True), (-1.06, "", "", False), (-1.5, "", weight, False),
                                             (-1.5, "initial_velocity = [0, -1]", "", False)):
            said = self.call("check", self.scene(drop.format(velocity) + wall.format(height) + more)).stdout
            self.assertEqual("nothing moves 'drop'" in said, idle, said)

    def test_keys(self):
        text = self.call("keys").stdout
        self.assertEqual(text, self.call("keys").stdout)
        tables = {heading.split(": ")[0]: keys
                  for heading, keys in re.findall(r"^(\S.*)\n((?:  .*\n)+)", text, re.M)}
        for heading, keys in {
                "top level": "title dimension", "[units]": "system", "[constants]": "NAME",
                "[functions]": "NAME",
                "[time]": "end step safety check_every viscosity solver force_tolerance shape_tolerance",
                "[output]": "frames_every history_every fields measures precision compression "
                            "restartable revolved checkpoint_minutes",
                "[[body]]": "name integration gauss_points volumetric window support_factor "
                            "support_by support_rank support_spacings initial_displacement initial_velocity",
                "[[body]] of any shape": "shape map rotate rotate_axis move imperfection "
                                          "imperfection_seed jitter jitter_seed",
                "[[surface_tension]]": "body face gamma form points coefficient_damping",
                "[[body_force]]": "body acceleration",
                "[[exact]]": "body displacement velocity rate",
                "[[cavity]]": "body surface pressure volume_target penalty ramp points",
                "[[profile]]": "body r z label",
                "[[remap]]": "body at condition nodes",
                "[contact.partner] of any type": "type displacement direction force stiffness base ramp",
                '[contact.partner] type = "frame" (2D)': "low high thickness",
                "[expect.NAME]": "of reduce at from to level value within within_relative order error_bar_within"}.items():
            rows = tables[heading].split("\n  example\n")[0]
            self.assertEqual([line.split()[0] for line in rows.splitlines()[1:]], keys.split(), heading)
        self.assertIn('  example\n    [[surface_tension]]\n    body = "drop"\n    gamma = 1\n', text)
        for shape in ("ball", "box", "cylinder", "ellipsoid", "disk", "ellipse", "rectangle"):
            self.assertIn(f'[[body]] shape = "{shape}"', text)
        for law in ("newtonian", "st_venant_kirchhoff", "neo_hookean", "mooney_rivlin"):
            self.assertIn(f'[body.material] type = "{law}"', text)

    def test_keys_of_a_word(self):
        """`keys WORD` finds tables, keys, and words in meanings."""
        def headings(*arguments):
            return [line for line in self.call("keys", *arguments).stdout.splitlines() if line[:1].strip()]

        self.assertEqual(headings("time"), ["[time]"])
        self.assertEqual(headings("[time]"), ["[time]"])
        contact = headings("contact")
        self.assertEqual(contact[0].split(":")[0], "[[contact]]")
        self.assertIn('[[contact]] interaction = "smooth_young"', {line.split(":")[0] for line in contact})
        law, = headings("neo_hookean")
        self.assertTrue(law.startswith('[body.material] type = "neo_hookean": W = mu/2 (I1 - 3 - 2 ln J)'), law)
        self.assertEqual({re.match('(.*?"ball")', line)[1] for line in headings("ball")},
                         {'[[body]] shape = "ball"', '[contact.partner] type = "ball"'})
        text = self.call("keys", "youngs_modulus").stdout
        self.assertEqual(re.findall(r"^  (\w+)", text, re.M), 4 * ["key", "youngs_modulus"])
        self.assertIn("  cutoff ", self.call("keys", "CUT-OFF").stdout)
        self.assertEqual([line.split(":")[0] for line in headings("gravity")], ["[[body_force]]"])
        self.assertEqual({line.split(" (")[0] for line in headings("cube")}, {'[[body]] shape = "box"'})
        self.assertEqual(headings("timestep"), headings("step"))
        self.refused(["keys", "gama"], 3, "'gama' is no table and no key", "did you mean 'gamma'?")
        self.refused(["keys", "[]"], 3, "'[]' is no table")
        self.refused(["keys", "time", "--json"], 2, "--json")

    def test_keys_as_markdown(self):
        text = self.call("keys", "--markdown").stdout
        plain = self.call("keys").stdout
        self.assertEqual(re.findall(r"^## `(.*)`$", text, re.M), re.findall(r"^(\S.*)\n  key ", plain, re.M))
        for line in text.splitlines():
            if line.startswith("|"):
                self.assertEqual(len(re.findall(r"(?<!\\)\|", line)), 7, line)
        self.assertIn("| `type` | text |  | ball \\| cavity", text)
        self.assertIn("## `[time]`", self.call("keys", "time", "--markdown").stdout)

    def test_schema(self):
        """Every scene of inputs/ satisfies the schema. Misspelt keys, wrong types and wrong signs violate it."""
        schema = json.loads(self.call("keys", "--json").stdout)
        for path in shipped.scenes():
            self.assertEqual(list(violations(schema, tomllib.loads(path.read_text()))), [], path.name)
        for old, new, what in (("check_every", "check_evry", "time: check_evry"),
                               ("dimension = 3", 'dimension = [3]', "dimension: type"),
                               ('shape = "box"', 'shape = "bxo"', "body[0].shape: enum"),
                               ("size = [1, 1, 1]", "size = [1]", "body[0].size: length"),
                               ('body = "block"\nacc', "acc", "body_force[0]: body is missing"),
                               ("density = 1000", "density = -1", "body[0].material.density: bound"),
                               ("[time]", "[timing]\n[time]", ": timing"),
                               ("[time]", "[constants]\nR = true\n[time]", "constants.R: type"),
                               ("[time]", "[expect.drop]\nwihtin = 1\n[time]", "expect.drop: wihtin"),
                               ("[time]", "[constants]\nR = 2\nS = '5 nm'\n[time]", None)):
            self.assertIn(old, BLOCK)
            found = list(violations(schema, tomllib.loads(BLOCK.replace(old, new))))
            self.assertEqual(found, [what] if what else [], new)

    def test_version(self):
        self.assertEqual(self.call("--version").stdout, self.call("version").stdout)
        self.assertRegex(self.call("version").stdout, r"^meniscus \d+\.\d+\.\d+\ngit \S+.*\ncompiler ")

    def test_help(self):
        for command in ("run", "check", "keys", "info", "version"):
            self.assertIn("Usage", self.call(command, "--help").stdout)
        text = self.call("--help").stdout
        for word in ("run", "check", "keys", "info", "version", "Exit codes", "130", "142"):
            self.assertIn(word, text)

    def test_progress(self):
        """On a terminal, progress is one line that is overwritten. Nothing of it is written to a file."""
        file = self.scene(DROP)
        self.assertNotIn("\r", self.call("run", file, "--output", "a").stdout)
        more = ["--set", "time.end='1 ms'", "--max-walltime", "3"]
        text = self.on_terminal("run", file, "--output", "b", *more)
        for word in ("\r\033[Kstep ", ", t = ", " of 0.001 s (0.0 %)", " dt = ", " steps/s", " left", "kinetic", "surface"):
            self.assertIn(word, text)
        # The progress line is cleared before other output.
        self.assertRegex(text, r"steps/s[^\n]*\r\033\[K(warning: [^\n]*\n\r\033\[K)?"
                               r"\d+ steps in [^\n]*\n(.*\n)*warning: stopped")
        self.assertNotIn("\r\033", self.on_terminal("run", file, "--output", "c", "--quiet", *more))

    def test_warnings_come_again_at_the_end(self):
        """Warnings are repeated together at the end, each once, if other output followed them; with --quiet
        only in the log."""
        file = self.scene(BLOCK.replace("[body.material]", 'integration = "nodal"\n[body.material]'))
        for options in ([], ["--quiet"]):
            done = self.call("run", file, "--output", "out", "--overwrite", "--until", "0.01", *options)
            said = re.findall(r"^warning: (.*)$", done.stderr, re.M)
            self.assertEqual(len(said), 1, done.stderr)
            self.assertIn("is unstable", said[0])
            self.assertEqual(done.stdout.endswith(f"results in out\n1 warning:\n  {said[0]}\n"), not options)
            log = (self.directory / "out/run.log").read_text()
            self.assertRegex(log, rf"info: 1 warning:\n\S+ info:   {re.escape(said[0])}\n")
        self.assertNotIn("warning", self.call("run", self.scene(SHEET), "--output", "calm").stdout)

    def on_terminal(self, *arguments):
        ours, theirs = pty.openpty()
        process = subprocess.Popen([program.PROGRAM, *arguments], cwd=self.directory, stdout=theirs,
                                   stderr=theirs, env=ENVIRONMENT)
        os.close(theirs)
        text = b""
        while select.select([ours], [], [], 60)[0]:
            try:
                text += os.read(ours, 65536)
            except OSError:  # the program has ended
                break
        process.wait()
        os.close(ours)
        return text.decode()


if __name__ == "__main__":
    program.main()
