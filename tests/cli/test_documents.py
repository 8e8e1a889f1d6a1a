#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The documents agree with the program, with the scenes of inputs/ and with each other.
Usage: test_documents.py PROGRAM"""
import re
import shutil
import subprocess
import sys
from decimal import Decimal
from pathlib import Path

import program
from program import ProgramTest, shipped

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
import results_table  # noqa: E402  pylint: disable=wrong-import-position

README, GALLERY = ROOT / "README.md", ROOT / "inputs" / "README.md"
SCENES = [path.stem for path in shipped.scenes()]
DOCUMENTS = [README, GALLERY, ROOT / "tests" / "README.md", ROOT / "src" / "README.md",
             *sorted((ROOT / "inputs" / "guide").glob("*.md")), *sorted((ROOT / "src" / "theory").glob("*.md")),
             *sorted((ROOT / ".github").glob("*.md"))]  # fmt: skip


def text_of(path):
    return path.read_text(encoding="utf-8")


class Documents(ProgramTest):
    def test_what_they_link_to_is_there(self):
        for path in DOCUMENTS:
            for target in re.findall(r"\]\(([^)#\s]+)", re.sub(r"`[^`]*`", "", text_of(path))):
                if not target.startswith("http"):
                    self.assertTrue((path.parent / target).exists(), f"{path}: {target}")

    def test_readme_is_short(self):
        self.assertLessEqual(len(text_of(README).splitlines()), 200)

    def test_every_scene_is_in_both_galleries(self):
        rows = re.findall(r"^\| \[[\w ]+\]\(inputs/(\w+)\) \| (.+) \|$", text_of(README), re.MULTILINE)
        self.assertEqual([field for field, _ in rows], list(shipped.FIELDS))
        for field, text in rows:
            scenes = sorted(path.stem for path in (shipped.INPUTS / field).glob("*.toml"))
            self.assertEqual(sorted(re.findall(r"`(\w+)`", text)), scenes)
        self.assertEqual(sorted(results_table.gallery(text_of(GALLERY))), SCENES)

    def test_every_scene_has_a_picture(self):
        pictures = re.findall(r"!\[(\w+)\]\(pictures/gallery/(\w+)\.png\)", text_of(GALLERY))
        self.assertEqual(sorted(pictures), [(scene, scene) for scene in SCENES])

    def test_results_are_of_what_scenes_expect(self):
        rows = results_table.rows_of_table(text_of(GALLERY))
        self.assertGreater(len(rows), 250)
        for scene, name, expected, within, obtained in rows:
            wanted = results_table.asked(shipped.scene(scene))
            self.assertIn(wanted.get(name, ""), (None, (expected, within)), f"{scene}: {name}")
            self.assertLessEqual(abs(float(obtained) - float(expected)), float(within) * 1.001, f"{scene}: {name}")

    def test_accuracy_is_that_of_the_results(self):
        results = {tuple(row[:2]): row[2:] for row in results_table.rows_of_table(text_of(GALLERY))}
        rows = re.findall(r"^\| [^|`]+ \| `(\w+)` \| `(\w+)` \| (\S+) \| (\S+) \|$", text_of(README), re.MULTILINE)
        self.assertGreaterEqual(len(rows), 12)
        for scene, name, expected, obtained in rows:
            value, _, exactly = results[scene, name]
            self.assertEqual(expected, value)
            last_digit = 10.0 ** Decimal(obtained).as_tuple().exponent
            self.assertLessEqual(abs(float(obtained) - float(exactly)), 0.51 * last_digit, f"{scene}: {name}")

    def test_the_first_scene_runs(self):
        scene = re.search(r"```toml\n(.*?)```", text_of(README), re.DOTALL).group(1)
        self.call("run", self.scene(scene, "drop"), "--until", "0.2 ps")
        lines = re.search(r"```python\n(.*?)```", text_of(README), re.DOTALL).group(1)
        self.assertEqual(len(lines.splitlines()), 5)
        (self.directory / "src").symlink_to(ROOT / "src")
        done = subprocess.run([sys.executable, "-B", "-c", lines], cwd=self.directory, text=True,
                              capture_output=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class GuideScenes(ProgramTest):
    """Every scene of the guide, a block of TOML with a [[body]]."""

    def test_they_run(self):
        """A scene with expected values is run to its end, others by a few steps."""
        (self.directory / "meshes").symlink_to(ROOT / "inputs" / "cells" / "meshes")
        scenes = 0
        for path in sorted((ROOT / "inputs" / "guide").glob("*.md")):
            blocks = re.findall(r"^```toml\n(.*?)^```", text_of(path), re.DOTALL | re.MULTILINE)
            for text in (block for block in blocks if "[[body]]" in block):
                name = f"{path.stem}_{text_of(path)[:text_of(path).index(text)].count(chr(10)) + 1}"  # page and line
                with self.subTest(name):
                    self.call("check", self.scene(text, name))
                    part = [] if re.search(r"^\w+ = {.*\bvalue = ", text, re.MULTILINE) else ["--until", "1e-9"]
                    self.call("run", f"{name}.toml", "--quiet", "--threads", "1", *part)
                scenes += 1
        self.assertGreater(scenes, 15)


class ResultsTable(ProgramTest):
    def table(self, *arguments, code=0):
        done = subprocess.run([sys.executable, ROOT / "tools/results_table.py", *map(str, arguments)],
                              cwd=self.directory, text=True, capture_output=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout if code == 0 else done.stderr

    def test_it_is_sorted_as_the_gallery_is(self):
        self.assertIn(results_table.BEGIN + self.table() + results_table.END, text_of(GALLERY))

    def test_rows_are_renewed(self):
        """Only rows of results that the run has reached are renewed."""
        scene = shipped.scene("ellipsoid_drop")
        self.call("run", scene, "--output", "out", "--until", "1 ps", "--quiet")
        before = self.table()
        self.assertEqual(self.table("out"), before)  # the run reaches no result
        log = self.directory / "out" / "run.log"
        line = re.search(r"^.*aspect_25ps.*$", text_of(log), re.MULTILINE).group()
        reached = line.replace("not reached", "met").replace("  - ", "  1.328712345 ")
        self.assertNotEqual(line, reached)
        log.write_text(text_of(log).replace(line, reached))
        gallery = self.directory / "gallery.md"
        shutil.copy(GALLERY, gallery)
        self.table("out", "--write", "--file", gallery)
        old, new = text_of(GALLERY).splitlines(), text_of(gallery).splitlines()
        changed = [(a, b) for a, b in zip(old, new, strict=True) if a != b]
        self.assertEqual([b for _, b in changed],
                         ["| `ellipsoid_drop` | `aspect_25ps` | 1.3297 | 0.002 | 1.32871 |"])

    def test_other_runs_are_refused(self):
        self.call("run", self.scene(program.SHEET, "nobodys"), "--output", "out", "--until", "1e-3")
        self.assertIn("no run of a scene", self.table("out", code=1))
        self.assertIn("run.log", self.table("nowhere", code=1))
        self.call("run", shipped.scene("drop_2d"), "--output", "changed", "--until", "1e-3",
                  "--set", "body.drop.core=3", "--quiet")
        self.assertIn("changed by --set", self.table("changed", code=1))

    def test_rounding(self):
        for obtained, within, text in (("1.329638", "0.002", "1.32964"), ("89.39386", "1.5", "89.39"),
                                       ("2.797034e+10", "8.54e+08", "2.797e+10"), ("5.4e-16", "1e-11", "5e-16"),
                                       ("-0.0014", "0.3", "-0.001"), ("3", "0", "3"), ("0", "1", "0")):
            self.assertEqual(results_table.rounded(obtained, within), text)


if __name__ == "__main__":
    program.main()
