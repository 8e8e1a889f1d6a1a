#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes as dictionaries: all scenes of inputs/ survive, and runs of them have the same bits.
Usage: test_scenes.py PROGRAM, with the package on PYTHONPATH"""
import math
import sys
import tomllib
import unittest
from pathlib import Path

import numpy as np

import meniscus
from scenes import DROP, SHEET, sheet, shipped


class Scenes(unittest.TestCase):
    def test_every_scene_of_the_gallery_is_written_back(self):
        scenes = shipped.scenes()
        self.assertGreater(len(scenes), 40)
        for path in scenes:
            scene = tomllib.loads(path.read_text(encoding="utf-8"))
            self.assertEqual(tomllib.loads(meniscus.to_toml(scene)), scene, path.name)

    def test_a_dictionary_runs_as_its_file_does(self):
        for path in (DROP, shipped.scene("tension_test")):
            scene = tomllib.loads(path.read_text(encoding="utf-8"))
            runs = meniscus.Run(path), meniscus.Run(scene), meniscus.Run.from_text(path.read_text(encoding="utf-8"))
            for run in runs:
                run.step()
            self.assertEqual(len({run.snapshot().hash for run in runs}), 1, path.name)

    def test_values(self):
        scene = {
            "text": 'a "b" \\ \n \t \x7f é', "numbers": [1, -2, True, 0.1, 1e300, math.inf, -math.inf],
            "path": Path("meshes/drop.msh"), "table": {"empty": {}, "none": [], "inner": {"x.y": 1, "": "2 nm"}},
            "rows": [{"a": 1, "b": [{"c": 2}, {"c": 3, "d": {"e": "f"}}]}, {}], "mixed": [1, {"a": [2]}],
            "array": np.arange(6.0).reshape(3, 2), "scalar": np.float64(0.1), "whole": np.int32(7), "flag": np.bool_(1),
        }  # fmt: skip
        plain = {**scene, "path": "meshes/drop.msh", "array": [[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]], "scalar": 0.1,
                 "whole": 7, "flag": True}  # fmt: skip
        self.assertEqual(tomllib.loads(meniscus.to_toml(scene)), plain)
        again = tomllib.loads(meniscus.to_toml({"x": np.float64(1) / 3}))
        self.assertEqual(again["x"], 1 / 3)

    def test_values_that_scenes_do_not_have(self):
        for scene, message in (
            ({"body": [{"radius": None}]}, r"body\[0\].radius is of type NoneType; .*leave out a key"),
            ({"time": {"end": 1j}}, "time.end is of type complex"),
            ({"a": [1, {2}]}, r"a\[1\] is of type set"),
            ({1: 2}, "the scene has a key of type int"),
            ([], "the scene is of type list; expected is a dictionary"),
        ):  # fmt: skip
            with self.assertRaisesRegex(TypeError, message):
                meniscus.Run(scene)

    def test_changes(self):
        run = meniscus.Run(SHEET, set={"time.end": "20 ms", "body.sheet.cells": np.array([4, 8]),
                                       "body[0].initial_velocity": ["y", 0]})  # fmt: skip
        self.assertEqual(len(run.field("sheet", "mass")), 45)
        run.advance_to(1)
        self.assertAlmostEqual(run.time, 0.02, delta=1e-12)
        self.assertGreater(run.energies()["kinetic"], 1)

    def test_places_of_problems(self):
        with self.assertRaisesRegex(meniscus.InputError, r"^scene:\d+:\d+: body\[0\].size: "):
            meniscus.Run(sheet(), set={}) and meniscus.Run({**SHEET, "body": [{**SHEET["body"][0], "size": [1]}]})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
