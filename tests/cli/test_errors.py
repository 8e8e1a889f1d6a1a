#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong is said where it is wrong, before anything is computed or overwritten, with the
exit code of its kind. Usage: test_errors.py PROGRAM"""
import json
import math
import os
import re
import resource
import shutil
from pathlib import Path

import h5py
import numpy as np

import program
from program import BLOCK, DROP, RELAXING_SHEET, SHEET, ProgramTest, with_output


class Usage(ProgramTest):
    def test_refused(self):
        file = self.scene(BLOCK)
        for arguments in ([], ["walk"], ["run"], ["run", file, "--threads", "0"],
                          ["run", file, "--frame", "1"], ["run", file, "--max-walltime", "soon"],
                          ["run", file, "--max-walltime", "0"], ["run", file, "--frame", "-1"],
                          ["check", file, "--overwrite"], ["info"]):
            done = self.call(*arguments, code=2)
            self.assertNotIn("0000", done.stderr)  # limits of number types are no help

    def test_unknown_command(self):
        self.refused(["chek", self.scene(BLOCK)], 2, "'chek' is no command", "run, check, keys",
                     "did you mean 'check'?")

    def test_numbers(self):
        file = self.scene(BLOCK)
        self.refused(["run", file, "--restart", "out", "--frame", "-1"], 2, "--frame", "'-1'", "an integer >= 0")
        self.refused(["run", file, "--threads", "9999"], 2, "--threads", "<= 4096")

    def test_empty_values(self):
        """An empty value, as from an unset shell variable, is refused."""
        file = self.scene(BLOCK)
        self.call("run", file, "--output", "out", "--until", "0.01")
        before = (self.directory / "out/history.csv").read_bytes()
        for option in ("--restart", "--output", "--until"):
            self.refused(["run", file, "--output", "out", "--overwrite", option, ""][:8], 2, option, "is empty")
        for arguments in (["run", ""], ["check", ""], ["info", ""], ["sweep", ""],
                          ["sweep", file, "--set", "time.end=1", "--output", ""]):
            self.refused(arguments, 2, "is empty")
        self.assertEqual((self.directory / "out/history.csv").read_bytes(), before)

    def test_check_until(self):
        whole = self.call("check", self.scene(BLOCK)).stdout
        half = self.call("check", self.scene(BLOCK), "--until", "0.2").stdout
        steps = [int(re.search(r"^(\d+) steps", text, re.M).group(1)) for text in (whole, half)]
        self.assertEqual((steps[0] + 1) // 2, steps[1])
        self.refused(["check", self.scene(BLOCK), "--until", "soon"], 3, "--until", "allowed is a time > 0")


class Scenes(ProgramTest):
    def assert_refused(self, text, *words, code=3):
        """`check` and `run` refuse the scene with all of `words`, and nothing is written."""
        file = self.scene(text)
        for command in (["check", file], ["run", file, "--output", "out"]):
            done = self.refused(command, code, *words)
            self.assertNotIn("internal error", done.stderr)
        self.assertFalse((self.directory / "out").exists())
        return done.stderr

    def change(self, text, *pairs):
        for old, new in pairs:
            self.assertIn(old, text)
            text = text.replace(old, new)
        return text

    def test_files(self):
        (self.directory / "directory.toml").mkdir()
        (self.directory / "garbage.toml").write_bytes(bytes(range(256)) * 10)
        for name, code, word in (("missing.toml", 5, "No such file"), ("directory.toml", 5, "directory"),
                                 ("garbage.toml", 3, "garbage.toml:1:")):
            self.refused(["run", name], code, word)
        self.assert_refused("", "scene.toml:1:1", "empty")
        self.assert_refused("dimension = 3", "[[body]]", "time: missing")

    def test_all_problems_at_once(self):
        text = self.change(DROP, ('"60 ps"', '"60 pm"'), ("viscosity", "viscosty"),
                           ('body = "drop"', 'body = "dorp"'), ("layers = 2", "layers = 0.5"))
        report = self.assert_refused(text, "scene.toml:4:7: time.end", "did you mean 'drop'?",
                                     "did you mean 'viscosity'?", "body[0].layers")
        self.assertEqual(len(report.splitlines()), 4, report)  # that viscosity is missing follows

    def test_wrong_measures_beside_other_problems(self):
        """A measure that no scene can have, or of what the scene does not have, hides behind no other problem."""
        text = self.change(DROP, ('"60 ps"', '"60 pm"'), ('"drop.p2"', '"drop.aspct", "dorp.p2"')) + """
        [[probe]]
        name = "tip"
        body = "drop"
        at = ["5 nm", 0, 0]
        fields = ["pressure"]
        [expect]
        film = { of = "drop.flim", value = 1, within = 1 }
        "drop.area" = { value = 1, within = 1 }
        "tip.pressure" = { value = 1, within = 1 }
        step = { value = 1, within = 1e9 }
        """
        report = self.assert_refused(text, "time.end", "output.measures: 'drop.aspct' is unknown: no measure is called",
                                     "did you mean 'aspect'?", "nothing of this scene is called 'dorp'; did you mean",
                                     "expect.film.of: 'drop.flim' is unknown", "did you mean 'film'?")
        self.assertEqual(len(report.splitlines()), 4, report)
        # What has the name may be in a table that is called wrongly.
        wrong = self.assert_refused(text.replace("[[probe]]", "[[prob]]").replace("60 pm", "60 ps"),
                                    "prob: unknown key", "'drop.aspct'")
        self.assertNotIn("nothing of this scene", wrong)
        self.assertNotIn("tip", wrong)

    def test_one_message_for_one_mistake(self):
        for old, new, *words in (("[[body]]", "[body]", "body: is a table; allowed is an array of tables, [[body]]"),
                                 ("[[body]]", "[[Body]]", "Body: unknown key", "did you mean 'body'?"),
                                 ("density", "desnity", "unknown key", "did you mean 'density'?"),
                                 ("end = 0.4", 'end = "0,4 s"', "time.end", "decimals take a point"),
                                 ("[1, 1, 1]", '["0,5 m", 1, 1]', "size[0]", "decimals take a point")):
            text = BLOCK[:BLOCK.index("[[body_force]]")].replace(old, new)
            report = self.assert_refused(text.replace("[body.material]", "[Body.material]" if "B" in new else
                                                      "[body.material]"), *words)
            self.assertEqual(len(report.splitlines()), 1, report)
        self.assert_refused(SHEET.replace('shape =', 'initial_velocity = ["z", 0]\nshape ='), "scene.toml:8",
                            "body[0].initial_velocity[0]: ", "formula 'z': a 2D scene (dimension = 2) has no z")

    def test_bodies_far_away(self):
        """Where numbers do not tell the particles apart; not where they are large."""
        for line in 'centre = [1e12, 0, 0]', 'initial_displacement = ["1e12 m", 0, 0]':
            self.assert_refused(BLOCK.replace("[1, 1, 1]", f"[1, 1, 1]\n{line}"), "scene.toml:", "body", "its places reach 1e",
                                "move it towards the origin")
        large = BLOCK.replace("[1, 1, 1]", "[1e12, 1e12, 1e12]\ncentre = [1e13, 0, 0]")
        self.call("check", self.scene(large[:large.index("[[body_force]]")]))
        self.assert_refused(BLOCK.replace("[1, 1, 1]", "[1e11, 1e11, 1]"), "body[0].shape: its places reach 5e+10",
                            "its shortest edge of a cell is 0.25 m", "make its cells more even")

    def test_held_without_a_face(self):
        """A whole surface is not held by mistake."""
        held = BLOCK + '[[held]]\nbody = "block"\n'
        line = BLOCK.count("\n") + 1
        self.assert_refused(held, f"scene.toml:{line}:1: held[0].face: missing; the face that is held is named",
                            "x_min", "z_max", "or where")
        for key in 'face = "x_min"', 'where = "z < -0.4"':
            self.call("check", self.scene(held + key + "\n"))

    def test_wrong_constant_alone(self):
        """A wrong constant gives one message. Consequences of its stand-in are not reported."""
        ring = """
        dimension = 2
        [constants]
        T = "0.1 mmm"
        U = "2*T"
        [functions]
        "wide(a)" = "a*U"
        [time]
        end = "U"
        [[body]]
        name = "ring"
        shape = "ring"
        radius = 0.5
        thickness = "{}"
        material = {{ type = "neo_hookean", density = 1, mu = 1, lambda = 1 }}
        [[cavity]]
        body = "ring"
        surface = "inner"
        [expect]
        late = {{ of = "ring.volume", at = 3, value = 1, within = 1 }}
        """
        for thickness in "T", "U + T", "wide(2)":
            report = self.assert_refused(ring.format(thickness), "constants.T", "mmm")
            self.assertEqual(len(report.splitlines()), 1, report)
        late = ring.format("0.1 m").replace('"0.1 mmm"', "1").replace('end = "U"', 'end = "2 pm"')
        report = self.assert_refused(late, "time.end")
        self.assertEqual(len(report.splitlines()), 1, report)

    def test_long_lists_once(self):
        """The first line about an unknown name lists the allowed names; later lines do not repeat them."""
        names = [f"drop.measure_{k}" for k in range(12)] + ["drop.volme"]
        text = re.sub("measures = .*", "measures = " + json.dumps(names), DROP)
        report = self.assert_refused(text, *names, "drop.volume",
                                     "the names listed above; did you mean 'drop.volume'?")
        self.assertEqual(report.count("allowed are the names listed above"), 12, report)
        self.assertEqual(len(report.splitlines()), 13, report)

    def test_overlap_of_bodies_in_contact(self):
        disk = """
        [[body]]
        name = "{}"
        shape = "disk"
        radius = 1
        core = 4
        rings = 2
        centre = [{}, 0]
        material = {{ type = "neo_hookean", density = 1, mu = 1, lambda = 1 }}
        """
        text = "dimension = 2\ntime.end = 1\n" + disk.format("one", 0) + disk.format("two", 2.05)
        text += '[[contact]]\nbodies = ["one", "two"]\nepsilon = 1\nsigma0 = 0.4\nbeta = 1\n'
        self.assert_refused(text, "contact[0]", "surfaces overlap", "'one' and 'two'",
                            "move the bodies apart")

    CONTACT = """
    dimension = 2
    time.end = 1
    [[body]]
    name = "one"
    shape = "disk"
    radius = 1
    core = 4
    rings = 2
    material = { type = "neo_hookean", density = 1, mu = 1, lambda = 1 }
    [[contact]]
    bodies = ["one"]
    epsilon = 1
    sigma0 = 0.4
    beta = 1
    partner = PARTNER
    """

    def test_partners(self):
        """Numbers of a partner that make no shape are refused with their key."""
        for partner, *words in (
                ('{ type = "half_space", point = [0, -2], normal = [0, 0] }', "partner.normal", "no direction"),
                ('{ type = "frame", low = [2, -2], high = [-2, 2] }', "partner.high", "x: -2 is not above 2"),
                ('{ type = "ball", centre = [0, -3], radius = 1, normal = [0, 1] }', "partner.normal",
                 "unknown key"),
                ('{ type = "half_space", point = [0, -2], normal = [0, 1], radius = 1 }', "partner.radius",
                 "unknown key")):
            report = self.assert_refused(self.CONTACT.replace("PARTNER", partner), "contact[0].", *words)
            self.assertEqual(len(report.splitlines()), 1, report)

    def test_names_of_contacts(self):
        """Names of contacts become parts of names in the history, as names of bodies do."""
        partner = '{ type = "half_space", point = [0, -2], normal = [0, 1] }'
        for name in ("a/b", "a b", "a,b", "a.b"):
            text = self.CONTACT.replace("PARTNER", partner).replace("epsilon", f'name = "{name}"\nepsilon')
            self.assert_refused(text, "contact[0].name", "cannot be a name")

    def test_body_that_cannot_be_made(self):
        """If a body cannot be made, problems that concern its stand-in are not reported."""
        shell = """
        dimension = 3
        time.end = 1
        [[body]]
        name = "cell"
        shape = "sphere_shell"
        radius = 1
        thickness = 3
        layers = 4
        spacing = 0.8
        [body.material]
        type = "liquid_crystal_elastomer"
        density = 1
        mu = 1
        bulk_modulus = 8
        step_length = 2
        [[cavity]]
        body = "cell"
        volume_target = 0.9
        penalty = 10
        [[profile]]
        body = "cell"
        r = [0, 1]
        z = [0.5, 0]
        """
        report = self.assert_refused(shell, "body[0].shape")
        self.assertEqual(len(report.splitlines()), 1, report)
        wide = self.change(shell, ("thickness = 3", "thickness = 0.5"), ("spacing = 0.8", "spacing = 1e10"))
        self.assert_refused(wide, "body[0].shape: the shape folds cell 0")

    def test_two_laws_on_a_surface(self):
        """Two laws of one kind on a surface are refused, since their measures would have equal names."""
        self.assert_refused(DROP + '[[surface]]\nbody = "drop"\nlaw = { type = "tension", gamma = 1 }\n',
                            "surface", "the surface of 'drop' has a law already")

    def test_numbers_of_surface_laws(self):
        line = DROP.count("\n") + 5
        for law, *words in (
                ('type = "gurtin_murdok"', f"scene.toml:{line - 1}:8: surface[0].law.type", "'gurtin_murdok' is unknown",
                 "did you mean 'gurtin_murdoch'?"),
                ('type = "gurtin_murdoch"\nlambda = 1\nmue = 1', f"scene.toml:{line + 1}:1: surface[0].law.mue: unknown key",
                 "did you mean 'mu'?"),
                ('type = "neo_hookean_skin"\nlambda = "1 Pa"\nmu = 1', f"scene.toml:{line}:10: surface[0].law.lambda",
                 "'1 Pa' is a pressure", "expected a tension"),
                ('type = "neo_hookean_skin"\nlambda = -3\nmu = 1', f"scene.toml:{line - 4}:1: surface[0]", "'drop'",
                 "least modulus in the surface -1 N/m", "expected are mu >= 0 and lambda + mu >= 0\n"),
                ('type = "boussinesq_scriven"\nshear = -0.1\ndilatational = 0',
                 f"scene.toml:{line}:9: surface[0].law.shear: -0.1", "allowed is >= 0"),
                ('type = "varying_tension"\ngamma = "1 + q"', f"scene.toml:{line}:9: surface[0].law.gamma",
                 "unknown name 'q' at character 5", "allowed are x, y, z, t"),
                ('type = "varying_tension"\ngamma = 1\nof = "space"', f"scene.toml:{line + 1}:6: surface[0].law.of",
                 "'space' is unknown; allowed are material, place"),
                ('type = "varying_tension"\ngamma = "log(x)"', f"scene.toml:{line}:9: surface[0].law.gamma",
                 "'log(x)' is not a number at x = -")):
            self.assert_refused(DROP + f'[[surface]]\nbody = "drop"\n[surface.law]\n{law}\n', *words)

    def test_profiles_of_plane_shells(self):
        profile = '[[profile]]\nbody = "sheet"\nr = [1]\nz = [0]\n'
        self.assert_refused(SHEET + profile, "scene.toml:17:8: profile[0].body", "'sheet' is not a shell")
        shell = SHEET.replace('"rectangle"\nsize = [1, 2]\ncells = [5, 10]',
                              '"sphere_shell"\nradius = 1\nthickness = 0.4\nspacing = 0.3')
        self.assert_refused(shell + profile, "scene.toml:18:8: profile[0].body", "'sheet' is in the plane",
                            "allowed are bodies in space or of revolution")

    def test_long_formulas_are_not_repeated(self):
        """A message about a long formula has the begin and the end of the formula, the place and the reason."""
        long = "1 + " * 25000
        for value, reason in ((f'"{long}"', "it is longer than 20000 characters"), (f'"{long[:5000]}"', "ends too early"),
                              (f'"{long[:5000]}q"', "unknown name 'q'"), (f'"{"q" * 200000}"', "(200000 characters)")):
            file = self.scene(self.change(BLOCK, ("mu = 1e5", f"mu = {value}")))
            done = self.refused(["check", file], 3, "scene.toml:", "body[0].material.mu", reason, "characters) ...")
            self.assertLess(len(done.stderr), 4000)
        done = self.call("check", self.scene(BLOCK), "--set", "time.end=" + long, code=3)
        self.assertLess(len(done.stderr), 4000)

    def test_texts_do_not_command_the_terminal(self):
        """Printed texts have no C1 control characters and no characters that change the direction of writing."""
        evil, seen = "\x9b2J\u202egnp.\u2066\u200f", "?2J?gnp.??"
        title = self.scene(f"title = 'A{evil}'\n" + BLOCK)
        self.assertIn(f"A{seen}", self.call("check", title).stdout)
        for text in (BLOCK.replace('"block"', f'"{evil}"'), BLOCK.replace("mu =", f'"{evil}" ='),
                     BLOCK.replace("[[body_force]]", f"[[body_force]]\nname{evil} = 1")):
            done = self.call("check", self.scene(text, "evil"), code=3)
            for c in "\x9b\u202e\u2066\u200f":
                self.assertNotIn(c, done.stderr)
        for arguments in (["run", evil], ["chek" + evil], ["check", title, "--set", f"time.end={evil}"],
                          ["run", title, "--threads", evil], ["keys", evil], ["info", evil]):
            done = self.call(*arguments, code=None)
            self.assertIn(done.returncode, (2, 3, 5))
            self.assertIn("?2J?gnp", done.stderr)
        self.assertIn("µm", self.call("help", "units").stdout + "µm")

    def test_counted_falls_need_a_level(self):
        expect = "[expect]\nkinetic_energy = {{ reduce = \"{}\", value = 1, within = 0{} }}\n"
        self.assert_refused(DROP + expect.format("falls", ""), "level", "is missing")
        self.assert_refused(DROP + expect.format("max", ", level = 1"), "level", "falls")

    def test_names_of_outputs(self):
        text = self.change(DROP, ('"J"]', '"presure", "J", "J"]'), ('"drop.p2"', '"drop.aspct"'))
        text += """
        [expect]
        kinetic_enery = { value = 0, within = 1 }
        here = { of = "drop.areas", value = 0, within = 1 }
        step = { value = 1, within = 1e9 }
        """
        report = self.assert_refused(
            text, "output.fields: 'presure' is unknown", "did you mean 'pressure'?",
            "'J' is named twice", "output.measures: 'drop.aspct'", "did you mean 'drop.aspect'?",
            "expect.kinetic_enery: ", "did you mean 'kinetic_energy'?", "expect.here.of: ",
            "did you mean 'drop.area'?")
        self.assertEqual(len(report.splitlines()), 5, report)

    def test_expectations(self):
        text = BLOCK + """
        [expect]
        a = { of = "step", within_relative = 1 }
        b = { of = "step", value = 0, within_relative = 1 }
        c = { of = "step", value = 1, within = 1, at = 0.5 }
        d = { of = "step", value = 1, within = 1, reduce = "max", from = 0.4 }
        e = { of = "step", value = 1, within = 1, from = 0.1 }
        f = { of = "step", value = 1, within = 1, reduce = "max", at = 0.1 }
        g = { of = "step", value = 1, within = 1, reduce = "max", from = 0.2, to = 0.1 }
        """
        report = self.assert_refused(text, *(f"expect.{name}" for name in "abcdefg"))
        self.assertEqual(len(report.splitlines()), 7, report)

    def test_names_of_expectations(self):
        """Names of expectations are plain words; other names could hide or forge a column of sweep.csv."""
        for name in ("a b", "a\\nb 1 1 1 met", "a,b", "", "=1+1", "a\\u202eb"):
            self.assert_refused(BLOCK + f'[expect."{name}"]\nof = "step"\nvalue = 1\nwithin = 1\n', "scene.toml:",
                                "expect.", "cannot be a name; allowed are letters, digits, _, - and .")

    def test_units_of_expectations(self):
        expect = '[expect]\n"block.extent_x" = {{ value = {}, within = {} }}\n'
        self.call("check", self.scene(BLOCK + expect.format('"1000 mm"', '"0.5 mm"')))
        self.call("check", self.scene(BLOCK + '[constants]\nsize = "1 m"\n' + expect.format('"size"', '"size/10"')))
        for value, within, key in (('"1 s"', "1", "value"), ("1", '"1 mPa"', "within"), ('"1 deg"', "1", "value")):
            self.assert_refused(BLOCK + expect.format(value, within), f'expect."block.extent_x".{key}: is in ',
                                "the column 'block.extent_x' is in m")
        self.assert_refused(BLOCK + '[expect]\nstep = { value = "1 m", within = 1 }\n', "is in plain numbers")
        self.assert_refused(BLOCK + expect.format('"1 parsec"', "1"), "unknown unit 'parsec'")

    def test_bodies(self):
        self.assert_refused(self.change(DROP, ("dimension = 3", "dimension = 2")), "'ellipsoid'", "disk")
        self.assert_refused(self.change(SHEET, ("dimension = 2", "dimension = 3")), "'rectangle'", "box")
        self.assert_refused(self.change(SHEET, ("dimension = 2", "dimension = 4")), "dimension")
        for name in ("", "a b", "a/b", "a,b", "a.b", "\\n"):
            self.assert_refused(self.change(SHEET, ('"sheet"', f'"{name}"')), "body[0].name")
        self.assert_refused(self.change(BLOCK, ("[[body]]", '[[body]]\ninitial_velocity = [1, 2]')),
                            "body[0].initial_velocity", "2 components", "3")
        self.assert_refused(self.change(BLOCK, ("*cos(11*t)\", 0]", '"]')), "acceleration", "3")
        self.assert_refused(DROP + '[[surface_tension]]\nbody = "drop"\ngamma = 1\n', "surface_tension[1]",
                            "already")
        self.assert_refused(self.change(BLOCK, ("[[body]]", "[[body]]\njitter = 0.6")), "body[0].jitter")

    def test_regions(self):
        """Materials of the physical surfaces of a mesh: the bar is pulled to 1.2 times its length."""
        mesh = Path(__file__).resolve().parents[1] / "data/two_regions.msh"
        soft, stiff = (f'[[body.material]]\nregion = "{name}"\ntype = "neo_hookean"\ndensity = 1\nmu = {mu}\n'
                       "lambda = 1.5\n" for name, mu in (("soft", 1), ("stiff", 4)))
        head = f"""dimension = 2
        [time]
        solver = "newton"
        end = 1
        step = 1
        [[body]]
        name = "bar"
        shape = "mesh"
        file = "{mesh}"
        """
        held = "".join(f'[[held]]\nbody = "bar"\nface = "{face}"\ncomponents = ["{axis}"]\n' for face, axis in
                       (("left", "x"), ("bottom", "y"), ("top", "y"), ("right", "x")))
        pulled = held + """displacement = [0.4, 0]
        ramp = [0, 1]
        [expect]
        force = { of = "bar-right.force_x", value = 0.481644, within_relative = 0.04 }
        """
        # mu (s - 1/s) + lambda (s - 1) of both, s = 1.29435 and 1.10565: 0.963288 times the section 1/2
        right = head + soft + stiff + pulled
        self.call("run", self.scene(right), "--output", "out")
        for region, cells in (("soft", 16), ("stiff", 16)):
            self.assertIn(f"body 'bar': region '{region}' has {cells} cells",
                          self.call("check", self.scene(right)).stdout)
        shutil.rmtree(self.directory / "out")
        for text, *words in (
                (right.replace('"soft"', '"sofd"'), "scene.toml:11:10: body[0].material[0].region",
                 "the mesh has no region 'sofd'; allowed are soft, stiff"),
                (right.replace('"soft"', '"stiff"'), "scene.toml:17:10: body[0].material[1].region",
                 "region 'stiff' has a material already; allowed is one"),
                (right.replace('region = "stiff"\n', ""), "body[0].material[1].region: missing; allowed is a text"),
                (head + soft + pulled, "body[0].material", "region 'stiff' of the mesh has no material",
                 'give it a [[body.material]] with region = "stiff"'),
                (head + soft + stiff.replace("neo_hookean", "st_venant_kirchhoff") + pulled,
                 "body[0].material[1].type", "allowed is the same mooney_rivlin, neo_hookean or st_venant_kirchhoff"),
                (head + "material = []\n" + pulled, "body[0].material: has no table"),
                (SHEET.replace("[body.material]", '[body.material]\nregion = "soft"'), "body[0].material.region",
                 "the body has no regions", "or one [body.material] without it")):
            self.assert_refused(text, *words)

    def test_parts_of_a_mesh(self):
        """Kernels would reach from one part to the other."""
        lines = (Path(__file__).resolve().parents[1] / "data/two_regions.msh").read_text().splitlines()
        # Without the cells between x = 0.75 and 1.25.
        begin = lines.index("$Elements") + 2
        kept = [line for line in lines[begin:-1]
                if line.split()[1] != "3" or (int(line.split()[5]) - 1) % 9 not in (3, 4)]
        (self.directory / "parts.msh").write_text(
            "\n".join([*lines[:begin - 1], str(len(kept)), *kept, "$EndElements", ""]))
        self.assert_refused(self.change(SHEET, ('"rectangle"', '"mesh"\nfile = "parts.msh"'), ("size = [1, 2]\n", ""),
                                        ("cells = [5, 10]\n", "")),
                            "body[0].shape", "parts.msh: the cells are 2 parts that do not touch each other",
                            "at (0.125, 0.0625)", "at (1.375, 0.0625)", "give each part a file and a [[body]]")

    def test_tension_above_the_bulk_modulus(self):
        tension = "gamma = %s\n"
        drop = DROP.replace('gamma = "72.8 mN/m"\n', tension)
        said = self.assert_refused(drop % 9999999999, "surface_tension[0]", "'drop'", "bulk modulus of 2.2e+09 Pa")
        bound = float(re.search(r"gamma below (\S+) N/m", said).group(1))
        volume = 4 / 3 * math.pi * 5 * 7.5 * 5 * 1e-27
        self.assertGreater(bound, 2.2e9 * 3 * volume / self.area_of_ellipsoid(5e-9, 7.5e-9) * 0.99)
        self.assertLess(bound, 2.2e9 * 3 * volume / self.area_of_ellipsoid(5e-9, 7.5e-9) * 1.01)
        self.assert_refused(drop % (1.01 * bound), "surface_tension[0]")
        solid = SHEET + '[[surface_tension]]\nbody = "sheet"\ngamma = 1e12\n'
        self.assert_refused(solid, "surface_tension[0]", "'sheet'", "bulk modulus")

    @staticmethod
    def area_of_ellipsoid(a, c):
        """Surface area of a prolate ellipsoid with the semi-axes a, a, c."""
        e = math.sqrt(1 - (a / c) ** 2)
        return 2 * math.pi * a * a * (1 + c / (a * e) * math.asin(e))

    def test_support_too_small(self):
        self.assert_refused(self.change(BLOCK, ("[[body]]", "[[body]]\nsupport_factor = 0.5")),
                            "body[0].support_factor")
        self.assert_refused(self.change(BLOCK, ("[[body]]", '[[body]]\nsupport_rank = 20\nsupport_by = "cells"')),
                            "body[0].support_rank", "leave one of them out")
        text = self.change(BLOCK, ("[[body]]", "[[body]]\nsupport_spacings = 0.9"))
        file = self.scene(text)
        done = self.call("check", file)
        self.assertIn("warning: body 'block': the supports of", done.stdout)

    def test_step(self):
        text = self.change(BLOCK, ("[time]", "[time]\nstep = 1"))
        self.assert_refused(text, "scene.toml:4:8: time.step", "stable step", "allowed is <=")

    def test_expectations_are_tables(self):
        """Every entry under [expect] is checked."""
        for text, where in (("[expect]\ngap = 0.001\n", "expect.gap: is a decimal number"),
                            ('[expect]\ngap = "banana"\n', "expect.gap: is a text"),
                            ("[[expect.gap]]\nvalue = 1\n", "expect.gap: is an array"),
                            ("[[expect]]\n", "expect: is an array"),
                            ("[expect.gap.deep]\nvalue = 1\n", "expect.gap.deep: unknown key")):
            self.assert_refused(BLOCK + text, where)

    def test_one_cause_is_one_problem(self):
        for old, new, word in (('shape = "box"', 'shape = "sphere"', "a sphere is a 'ball'"),
                               ('shape = "box"', 'shape = "bxo"', "did you mean 'box'?"),
                               ('type = "neo_hookean"', 'type = "neo_hook"', "'neo_hook' is unknown")):
            report = self.assert_refused(self.change(BLOCK, (old, new)), word)
            self.assertEqual(len(report.splitlines()), 1, report)

    def test_words_of_other_programs(self):
        text = self.change(BLOCK, ("mu = 1e5", "young_modulus = 1e5"), ("lambda = 1e5", "poisson_ratio = 0.3"),
                           ("check_every", "dt = 1\ncheck_every"), ("[time]", "gravity = [0, 0, -9.81]\n[time]"))
        self.assert_refused(text, "[[body_force]]", "[time] step",
                            "isotropic solids have youngs_modulus and poissons_ratio")
        self.assert_refused(self.change(BLOCK, ("end = 0.4", "end = 10 ms")), "scene.toml:4:", 'write "10 ms"')

    def test_start(self):
        """A state that cannot start is an error of the scene and has a place in it."""
        moved = '[[body]]\ninitial_displacement = ["-2*x", 0, 0]'
        self.assert_refused(self.change(BLOCK, ("[[body]]", moved)), "scene.toml:9:1: body[0]", "J = det F")
        self.assert_refused(self.change(BLOCK, ('"20*sin(40*t)*(1 + z)"', '"1/t"')),
                            "scene.toml:21:16: body_force[0].acceleration[0]", "'1/t' is infinite", "t = 0")
        self.assert_refused(self.change(BLOCK, ("[[body]]", '[[body]]\ninitial_velocity = ["log(x - 9)", 0, 0]')),
                            "body[0].initial_velocity[0]", "not a number")
        for formula in ("x*t", "t"):
            self.assert_refused(self.change(BLOCK, ("[[body]]", f'[[body]]\ninitial_velocity = ["{formula}", 0, 0]')),
                                "body[0].initial_velocity[0]", "does not know the time")
        for size in ([1, 1, 1], [2, 1, 1], [1, 4, 4]):
            text = self.change(BLOCK, ("cells = [4, 4, 4]", f"cells = {size}"))
            done = self.call("check", self.scene(text), code=None)
            if done.returncode != 0:
                self.assertEqual(done.returncode, 3)
                self.assertRegex(done.stderr, r"^scene.toml:\d+:\d+: body\[0\]")

    def test_formula_that_breaks_in_a_run(self):
        text = self.change(BLOCK, ('"20*sin(40*t)*(1 + z)"', '"1/(0.1 - t) > 50 ? log(-1 - 0*t) : 0"'))
        done = self.refused(["run", self.scene(text), "--output", "out"], 4, "scene.toml:21:16",
                            "not a number", "t = 0.0")
        self.assertIn(done.stderr.strip().split(": ", 1)[1], (self.directory / "out/run.log").read_text())

    def test_memory(self):
        """Too large scenes are refused before their memory is allocated."""
        text = self.change(BLOCK, ("cells = [4, 4, 4]", "cells = [300, 300, 300]"))
        limits = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))}
        done = self.call("check", self.scene(text), code=3, **limits)
        self.assertRegex(done.stderr, r"body\[0\].shape: .*2.7e\+07 cells.* GB of memory, 3\.\d* GB are there")

    def test_memory_of_all_bodies(self):
        """Each body may fit into the memory although all together do not."""
        big = self.change(BLOCK, ("cells = [4, 4, 4]", "cells = [50, 50, 50]"))
        body = big[big.index("[[body]]"):big.index("[[body_force]]")]
        text = big + body.replace('"block"', '"second"')
        limits = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))}
        done = self.call("check", self.scene(text), code=3, **limits)
        self.assertRegex(done.stderr, r"body\[1\].shape: the bodies up to this one would have 2.6\d*e\+05 particles")

    def test_settings(self):
        file = self.scene(BLOCK)
        self.refused(["run", file, "--set", "time.ent=3"], 3, "--set 'time.ent=3'", "did you mean 'end'")
        self.refused(["run", file, "--set", "nothing"], 3, "nothing")
        for time in ("never", "-1", "0", "1 m", "inf", "nan", "1 ps ps"):
            self.refused(["run", file, f"--until={time}"], 3, "--until", "allowed")


class Files(ProgramTest):
    def setUp(self):
        super().setUp()
        self.file = self.scene(with_output(BLOCK, "restartable = true"))
        self.call("run", self.file, "--output", "out", "--until", "0.1")

    def test_no_overwriting(self):
        before = (self.directory / "out/history.csv").read_bytes()
        self.refused(["run", self.file, "--output", "out"], 5, "--overwrite", "--restart")
        self.assertEqual((self.directory / "out/history.csv").read_bytes(), before)
        self.call("run", self.file, "--output", "out", "--until", "0.05", "--overwrite")
        self.assertLess(len((self.directory / "out/history.csv").read_bytes()), len(before))

    def test_bad_scene_deletes_nothing(self):
        self.call("run", self.scene(BLOCK.replace("mu = 1e5", "mu = 0"), "bad"), "--output", "out",
                  "--overwrite", code=3)
        self.assertTrue((self.directory / "out/run.h5").exists())

    def test_unwritable(self):
        (self.directory / "a_file").write_text("")
        for output in ("a_file", "a_file/below", "/proc/nowhere"):
            self.refused(["run", self.file, "--output", output], 5, output)

    def test_restart_files(self):
        checkpoint = self.directory / "out/checkpoint-a.h5"
        good = checkpoint.read_bytes()
        bad = bytearray(good)
        bad[len(bad) // 2] ^= 1
        for content in (bytes(bad), good[:1000], b""):
            checkpoint.write_bytes(content)
            for path in ("out", "out/checkpoint-a.h5"):
                self.refused(["run", self.file, "--restart", path, "--output", "out"], 5, "checkpoint-a")
        self.refused(["run", self.file, "--restart", "nowhere"], 5, "nowhere")
        self.refused(["run", self.file, "--restart", "out", "--frame", "99"], 5, "frame 99")
        self.refused(["run", self.file, "--restart", "out/run.h5"], 5, "frame")
        self.refused(["run", self.file, "--restart", self.file, "--frame", "1"], 5, self.file)
        self.call("run", self.file, "--restart", "out", "--frame", "1")

    def test_what_is_no_file(self):
        """Refuses devices and pipes, which would never end, and names and links that the system refuses."""
        os.mkfifo(self.directory / "pipe")
        os.symlink("loop", self.directory / "loop")
        (self.directory / "mixed").mkdir()
        os.mkfifo(self.directory / "mixed/checkpoint-a.h5")
        os.symlink("/dev/zero", self.directory / "mixed/checkpoint-b.h5")
        long = "x" * 300
        for path in ("/dev/zero", "pipe", "mixed", "loop", "loop/x", long, f"{long}/x", f"{self.file}/x"):
            for command in (["run", self.file, "--restart", path], ["info", path]):
                done = self.refused(command, 5, path)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for output in ("loop", "loop/x", long, f"{self.file}/x"):
            self.refused(["run", self.file, "--output", output], 5, output)
            self.refused(["run", self.file, "--output", output, "--restart", "out"], 5, output)
            self.refused(["sweep", self.file, "--set", "time.end=0.01", "--output", output], 5, output)
        self.refused(["new", long, "--like", "lame_cube"], 5, long)
        (self.directory / "mixed/sweep.csv").symlink_to("/dev/zero")
        shutil.copy(self.directory / self.file, self.directory / "mixed/scene.toml")
        self.refused(["sweep", self.file, "--set", "time.end=0.01", "--output", "mixed"], 5, "sweep.csv")

    def test_nothing_is_written_through_links(self):
        """Somebody else may have put links into a folder in which a run continues."""
        precious = self.directory / "precious"
        precious.write_text("precious")
        for name in ("run.log", "history.csv", "run.h5", "run.vtkhdf"):
            kept = (self.directory / "out" / name).read_bytes()
            (self.directory / "out" / name).unlink()
            (self.directory / "out" / name).symlink_to(precious)
            self.refused(["run", self.file, "--restart", "out"], 5, name, "is a link")
            self.assertEqual(precious.read_text(), "precious")
            (self.directory / "out" / name).unlink()
            (self.directory / "out" / name).write_bytes(kept)
        (self.directory / "new").mkdir()
        (self.directory / "new/run.log").symlink_to(precious)
        self.refused(["run", self.file, "--output", "new"], 5, "run.log", "is a link")
        self.assertEqual(precious.read_text(), "precious")
        self.call("run", self.file, "--restart", "out")

    def test_other_columns_or_fields(self):
        """Other columns or fields are refused before rows or frames are deleted."""
        before = (self.directory / "out/history.csv").read_bytes()
        frames = len(self.frames("out"))
        for change in ('output.measures=["block.aspect"]', 'output.fields=["J"]'):
            self.refused(["run", self.file, "--restart", "out", "--frame", "1", "--set", change], 5,
                         "--output")
        self.assertEqual((self.directory / "out/history.csv").read_bytes(), before)
        self.assertEqual(len(self.frames("out")), frames)


PUSHED = BLOCK.replace("[[body]]", '[[body]]\ninitial_velocity = ["-60*x", 0, 0]')


class Failures(ProgramTest):
    def assert_fails(self, text, *words):
        """The run ends with exit code 4 and prints all of `words`; every number that was written is finite."""
        file = self.scene(text)
        done = self.refused(["run", file, "--output", "out"], 4, *words)
        *warnings, error = done.stderr.strip().splitlines()
        self.assertTrue(all(line.startswith("warning: ") for line in warnings), done.stderr)
        self.assertIn(error.split(": ", 1)[1], (self.directory / "out/run.log").read_text())
        for name, column in self.history("out").items():
            self.assertTrue(np.isfinite(column).all(), name)
        for frame in self.frames("out"):
            for name, values in frame.items():
                self.assertTrue(np.isfinite(values).all(), name)
        return done.stderr

    def test_inversion(self):
        """A block is compressed far too fast for its step."""
        text = PUSHED.replace("[time]", "[time]\nstep = 0.008")
        text = with_output(text, 'restartable = true\nfields = ["velocity", "J", "force"]')
        message = self.assert_fails(text, "body 'block', particle ", "reference position", "now (",
                                    "J = det F", "F = [", "dt = ", "step ", "t = ")
        step = int(re.search(r"step (\d+)", message).group(1))
        frames = self.frames("out")
        self.assertEqual(frames[-1]["step"], step - 1)
        self.assertGreater(frames[-1]["J"].min(), 0)
        self.assertEqual(len({frame["step"] for frame in frames}), len(frames))
        with h5py.File(self.directory / "out/run.h5") as file:
            self.assertIn("state", file["steps/0"])
            self.assertNotIn("state", file[f"steps/{len(frames) - 1}"])

    def test_collapse_of_the_step(self):
        """Shorter and shorter steps follow the block until the step has collapsed. The run then ends at once."""
        self.assert_fails(PUSHED.replace("-60*x", "-80*x"), "the stable time step has collapsed from",
                          " % of the stiffness is that of the internal force of 'block': ", "finer cells",
                          "body 'block', particle ", "reference position", "now (", "dt = ", "step ", "t = ")

    def test_steps_that_do_not_change_the_time(self):
        """A force throws a disk so far that its shape is lost in round-off, where steps would be halved for
        ever. Round-off decides whether steps or a folded cell end the run."""
        text = SHEET[:SHEET.index("[time]")] + """
        time.end = 0.004
        [[body]]
        name = "disk"
        shape = "disk"
        radius = 1
        core = 3
        rings = 2
        material = { type = "neo_hookean", density = 1, mu = 1, lambda = 1 }
        [[body_force]]
        body = "disk"
        acceleration = [0, 1e20]
        [[contact]]
        bodies = ["disk"]
        adhesion = 0.01
        partner = { type = "half_space", point = [0, -1.2], normal = [0, 1] }
        """
        message = self.assert_fails(text, "body 'disk', particle ", "reference position", "now (")
        self.assertTrue("do not change the time any more" in message or
                        "J = det F = " in message, message)

    GRIPPED = SHEET[:SHEET.index("[output]")] + """
    [[body]]
    name = "sheet"
    shape = "rectangle"
    size = [1, 1]
    cells = [4, 4]
    material = { type = "neo_hookean", density = 1, mu = 1, lambda = 2 }
    [[held]]
    body = "sheet"
    face = "x_min"
    [[held]]
    body = "sheet"
    face = "x_max"
    displacement = [0.01, 0]
    ramp = RAMP
    """

    def test_ramps(self):
        """A problem of a ramp is reported once. A ramp after the end of the scene has no effect."""
        for ramp, lines, *words in (("[1, 0.5]", 1, "held[1].ramp: the ramp ends before it begins"),
                                    ("[-2, -1]", 2, "held[1].ramp[0]: -2 s is out of range", "ramp[1]: -1 s"),
                                    ("[-0.5, 0.5]", 1, "held[1].ramp[0]: -0.5 s is out of range; allowed is >= 0")):
            report = self.refused(["check", self.scene(self.GRIPPED.replace("RAMP", ramp))], 3, *words).stderr
            self.assertEqual(len(report.splitlines()), lines, report)
        self.assertIn("the scene is in order", self.call("check", self.scene(self.GRIPPED.replace("RAMP", "[2, 3]"))).stdout)

    def test_loads_that_never_rest(self):
        """Loads that change forever are refused for the solver relax; the message names the load and the
        helpful key."""
        text = BLOCK.replace("[time]", '[time]\nsolver = "relax"')
        grip = '[[held]]\nbody = "block"\nface = "z_min"\ndisplacement = [0, 0, DISPLACEMENT]\n'
        steady = text[:text.index("[[body_force]]")]
        for scene, *words in ((text, "body force on 'block' changes as long as the scene lasts", "without t"),
                              (steady + grip.replace("DISPLACEMENT", '"0.1*sin(t)"'),
                               "a displacement of [[held]] changes as long as the scene lasts", "ramp"),
                              (steady + grip.replace("DISPLACEMENT", "0.1") + "ramp = [0, 3]\n",
                               "a displacement of [[held]] changes until t = 3, not before the end 0.4",
                               "end its ramp earlier, or raise time.end")):
            self.refused(["check", self.scene(scene)], 3, "scene.toml:4:10: time.solver", 'solver = "dynamics"', *words)

    def test_unstable_initial_state(self):
        text = BLOCK.replace("[[body]]", '[[body]]\ninitial_displacement = ["-2*x", 0, 0]')
        self.refused(["run", self.scene(text)], 3, "body[0]", "body 'block'", "J = det F")

    def test_impossible_area(self):
        text = DROP.replace("gamma =", 'form = "weak"\npoints = 2\ngamma =')
        text = text.replace("core = 3\nlayers = 2", "core = 2\nlayers = 1").replace("60 ps", "400 ps")
        self.assert_fails(text, "body 'drop' has the isoperimetric ratio 0.99", "least possible")

    def test_not_at_rest(self):
        text = RELAXING_SHEET.replace("end = 20", "end = 0.1")
        self.assert_fails(text, "not at rest at t = 0.1 s", "force residual", "allowed 1e-05",
                          "later time.end")
        self.assertEqual(self.frames("out")[-1]["time"], 0.1)

    def test_never_at_rest(self):
        text = RELAXING_SHEET + """
        [[body_force]]
        body = "sheet"
        acceleration = ["sin(t)", 0]
        """
        for command in ("check", "run"):
            self.refused([command, self.scene(text)], 3, "scene.toml:5:10: time.solver",
                         "body force on 'sheet'", "no rest")

    def test_net_force(self):
        """For an unbalanced net force, the message names the force and does not suggest a longer run."""
        text = SHEET.replace("end = 0.1", 'end = 0.1\nsolver = "relax"') + """
        [[body_force]]
        body = "sheet"
        acceleration = [0, -2]
        """
        message = self.assert_fails(text, "not at rest at t = 0.1 s", "net force (0, -", "on body 'sheet'",
                                    "nothing balances")
        self.assertNotIn("more time", message)

    def test_unstable_rest(self):
        """A straight strut far beyond Euler's load. Relaxation stays straight; Newton's method leaves this
        state, with a note."""
        text = """
        dimension = 2
        [time]
        {}
        [[body]]
        name = "strut"
        shape = "rectangle"
        size = [10, 0.5]
        cells = [40, 2]
        material = {{ type = "st_venant_kirchhoff", density = 1, mu = 0.5, lambda = 0 }}
        [[held]]
        name = "left"
        body = "strut"
        face = "x_min"
        [[held]]
        name = "right"
        body = "strut"
        face = "x_max"
        displacement = {}
        """
        relaxed = text.format('solver = "relax"\nend = 4000', "[-0.14, 0]\nramp = [0, 10]")
        self.assert_fails(relaxed, "the equilibrium at t = ", "is not stable: its least stiffness is -", "newton",
                          "initial_displacement")
        newton = text.format('solver = "newton"\nend = 1\nstep = 0.125', '["-0.14*t", 0]')
        self.call("run", self.scene(newton), "--output", "newton")
        self.assertIn("an equilibrium was found that is not stable", (self.directory / "newton/run.log").read_text())

    def test_body_in_another(self):
        """The points of two surfaces miss each other, and their repulsion is weak."""
        disk = """
        [[body]]
        name = "{}"
        shape = "disk"
        radius = 1
        core = 6
        rings = 3
        centre = {}
        initial_velocity = {}
        material = {{ type = "neo_hookean", density = 1, mu = 400, lambda = 300 }}
        """
        text = "dimension = 2\ntime.end = 0.4\n[output]\n"
        text += disk.format("left", [-1.2, 0], [1.5, 0]) + disk.format("right", [1.2, 0.3], [-1.5, 0])
        text += '[[contact]]\nbodies = ["left", "right"]\nepsilon = 1\nsigma0 = 0.05\nbeta = 1\npoints = 2\n'
        self.assert_fails(text, "particle ", "the surface goes through body 'right'", "[[contact]] does not hold them")


class Expectations(ProgramTest):
    SCENE = BLOCK + """
    [expect]
    late = { of = "time", value = 0.4, within = 1e-12 }
    early = { of = "time", at = 0.1, value = 0.1, within = 1e-12 }
    """

    def test_met(self):
        done = self.call("run", self.scene(self.SCENE), "--quiet")
        self.assertEqual(done.stdout.count(" met"), 2)
        self.assertEqual(done.stderr, "")

    def test_missed(self):
        done = self.call("run", self.scene(self.SCENE), "--set", "expect.late.value=0.41", code=7)
        self.assertRegex(done.stdout, r"late +0.4 +0.41 .* MISSED")

    def test_too_few_rows(self):
        text = self.SCENE.replace("[expect]", '[expect]\nrate = { of = "time", reduce = "decay_rate", '
                                  'from = 0.1, to = 0.105, value = 1, within = 1 }')
        self.assertIn("MISSED", self.call("run", self.scene(text), code=7).stdout)

    def test_not_reached(self):
        done = self.call("run", self.scene(self.SCENE), "--until", "0.2")
        self.assertRegex(done.stdout, r"late .* not reached\nearly .* met")
        # In another directory, the history lacks the begin of the run.
        done = self.call("run", self.scene(self.SCENE), "--restart", "results/scene", "--output", "b")
        self.assertRegex(done.stdout, r"late .* met\nearly .* not reached")
        # In the same directory, the history is complete.
        done = self.call("run", self.scene(self.SCENE), "--restart", "results/scene")
        self.assertEqual(done.stdout.count(" met"), 2)


if __name__ == "__main__":
    program.main()
