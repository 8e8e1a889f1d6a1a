#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The commands beside run, check, keys and info: help, new, sweep, completion, manual.
Usage: test_commands.py PROGRAM"""
import csv
import platform
import re
import shutil
import signal
import subprocess
import tempfile
import time
import tomllib
import unittest
from pathlib import Path


import program
from program import BLOCK, DROP, SHEET, ProgramTest, shipped

ROOT = Path(__file__).resolve().parents[2]
TOPICS = sorted(path.stem for path in (ROOT / "inputs" / "guide").glob("*.md"))
SCENES = shipped.scenes()
COMMANDS = ["run", "check", "keys", "info", "study", "plot", "report", "fit", "help", "new", "sweep", "converge", "revolve", "completion", "manual", "version"]


@unittest.skipUnless(platform.machine() == "x86_64" and shutil.which("objdump"), "reads the code of x86-64")
class Code(ProgramTest):
    def test_loops_over_stress_points_fetch_ahead(self):
        """Compilers may drop calls that seem to have no effect, here of prefetch. Forces would then take twice
        as long."""
        code = subprocess.run(["objdump", "-d", "--no-show-raw-insn", program.PROGRAM],
                              capture_output=True, text=True, check=True, errors="replace").stdout
        loops = [f for f in code.split("\n\n")
                 if re.match(r"\w+ <\S*InternalForce\S*CellRule\S*add_rows", f) and "prefetcht1" in f]
        self.assertGreater(len(loops), 10)


class Help(ProgramTest):
    def test_topics(self):
        listed = self.call("help").stdout
        for topic in TOPICS:
            text = self.call("help", topic).stdout
            title = (ROOT / "inputs" / "guide" / f"{topic}.md").read_text().splitlines()[0][2:]
            self.assertTrue(text.startswith(f"{title}\n{'=' * len(title)}\n"), text[:80])
            self.assertRegex(listed, rf"(?m)^  {topic} +{re.escape(title)}$")
            for sign in ("**", "```", "](", "!["):
                self.assertNotIn(sign, text)
        for topic in "contact units shells restart paraview python steps remaps faces".split():
            self.assertIn(topic, TOPICS)

    def test_commands(self):
        self.assertIn("--restart", self.call("help", "run").stdout)
        self.refused(["help", "contcat"], 3, "'contcat' is no topic and no command", "did you mean 'contact'?")
        self.refused(["halp"], 2, "did you mean 'help'?")


class New(ProgramTest):
    def test_every_scene_of_the_gallery(self):
        """A new scene from the gallery means the same as the original. It has comments and no lines for tests."""
        for path in SCENES:
            self.call("new", path.stem, "--like", path.stem)
            text = (self.directory / path.name).read_text()
            self.assertEqual(tomllib.loads(text), tomllib.loads(path.read_text()), path.name)
            self.assertGreater(text.count("#"), path.read_text().count("#") + 5)
            self.assertNotRegex(text, r"(?m)^# (test:|verify \w+:)")
        listed = self.call("new", "--list").stdout
        self.assertEqual(sorted(line.split()[0] for line in listed.splitlines()), [path.stem for path in SCENES])

    def test_it_says_what_keys_mean(self):
        self.call("new", "mine.toml", "--like", "ellipsoid_drop")
        text = (self.directory / "mine.toml").read_text()
        self.assertRegex(text, r'gamma = "72.8 mN/m" +# \w+')
        self.assertRegex(text, r"(?m)^\[\[surface_tension\]\] +# tension of the surface of a body")
        self.call("check", "mine.toml")

    def test_meshes_come_along(self):
        self.call("new", "mine", "--like", "mesh_drop")
        self.call("new", "other", "--like", "mesh_drop")
        self.assertEqual([path.name for path in (self.directory / "meshes").iterdir()], ["ball_tetrahedra.msh"])
        self.assertIn("tetrahedra of a mesh", self.call("check", "mine.toml").stdout)

    def test_refusals(self):
        self.call("new", "mine", "--like", "lame_cube")
        self.refused(["new", "mine", "--like", "lame_cube"], 5, "mine.toml")
        self.refused(["new", "other", "--like", "lame_qube"], 3, "did you mean 'lame_cube'?")
        self.refused(["new", "other"], 2, "--like")
        self.refused(["new"], 2, "--list")
        self.refused(["new", "nowhere/x", "--like", "lame_cube"], 5, "nowhere/x.toml")


class Sweep(ProgramTest):
    def table(self, path="results/scene-sweep/sweep.csv"):
        with open(self.directory / path, newline="", encoding="utf-8") as file:
            names, units, *rows = csv.reader(file)
        self.assertTrue(all(len(row) == len(names) == len(units) for row in rows))
        return [dict(zip(names, row)) for row in rows], dict(zip(names, units))

    def results(self, folder):
        """The rows of a sweep without the seconds that they took."""
        rows = self.table(f"{folder}/sweep.csv")[0]
        for row in rows:
            self.assertGreater(float(row.pop("seconds")), 0)
        return rows

    def test_all_combinations(self):
        scene = self.scene(SHEET + '[expect]\nrest = { of = "kinetic_energy", value = 0, within = 1 }\n')
        call = ["sweep", scene, "--set", "body.sheet.material.mu=1e5,2e5", "--set",
                "body.sheet.cells=[3,6], [5, 10]", "--threads", "1"]
        self.call(*call)
        rows, units = self.table()
        self.assertEqual([(r["body.sheet.material.mu"], r["body.sheet.cells"]) for r in rows],
                         [("1e5", "[3,6]"), ("1e5", "[5, 10]"), ("2e5", "[3,6]"), ("2e5", "[5, 10]")])
        self.assertEqual({r["exit_code"] for r in rows}, {"0"})
        self.assertEqual((units["time"], units["kinetic_energy"]), ("s", "N"))
        for row, name in zip(rows, ("mu=1e5,cells=_3_6_", "mu=1e5,cells=_5__10_",
                                    "mu=2e5,cells=_3_6_", "mu=2e5,cells=_5__10_")):
            name = name.replace("_3_6_", "_3,6_").replace("_5__10_", "_5,_10_")
            history = self.history(f"results/scene-sweep/{name}")
            for column, values in history.items():
                self.assertEqual(float(row[column]), values[-1])
            self.assertAlmostEqual(float(row["expect.rest"]), history["kinetic_energy"][-1], delta=1e-12)
        # A second call runs nothing. With another value, only the runs with this value are made.
        before = (self.directory / "results/scene-sweep/sweep.csv").read_text()
        self.assertEqual(self.call(*call).stdout.count("done before"), 4)
        self.assertEqual((self.directory / "results/scene-sweep/sweep.csv").read_text(), before)
        call[3] += ",4e5"
        self.assertEqual(self.call(*call).stdout.count("done before"), 4)
        self.assertEqual(len(self.table()[0]), 6)

    def test_a_random_sample(self):
        """A Latin hypercube: one value in each part of each interval; the same for the same request."""
        scene = self.scene(SHEET)
        call = ["sweep", scene, "--set", "body.sheet.material.mu=1e5,2e5", "--set", "time.end=1 ms,2 ms", "--random", "5",
                "--output", "out"]
        self.call(*call, "--parallel", "2")
        rows, _ = self.table("out/sweep.csv")
        for key, unit, low, high in (("body.sheet.material.mu", "", 1e5, 2e5), ("time.end", " ms", 1, 2)):
            values = [float(row[key].removesuffix(unit)) for row in rows]
            self.assertEqual(sorted(int(5 * (x - low) / (high - low)) for x in values), [0, 1, 2, 3, 4])
        for row in rows:
            self.assertAlmostEqual(float(row["time"]) / float(row["time.end"].split()[0]), 1e-3, delta=1e-12)
        self.assertEqual(self.call(*call).stdout.count("done before"), 5)
        for setting, words in (("time.end=1", "takes two bounds"), ("time.end=1 ms,2 s", "different units"),
                               ("time.end=2,1", "do not rise"), ("time.end=a,b", "is not a number")):
            self.refused(["sweep", scene, "--set", setting, "--random", "3", "--output", "x"], 3, words)
        self.refused(["sweep", scene, "--set", "time.end=1,2", "--random", "0", "--output", "x"], 2, "allowed is an integer >= 1")

    def test_runs_at_the_same_time(self):
        """They have the numbers of runs one after the other, in the same order, also after a signal."""
        scene = self.scene(DROP)
        call = ["sweep", scene, "--set", "body.drop.material.viscosity=0.6 mPa s,0.7 mPa s,0.8 mPa s", "--threads", "1"]
        self.call(*call, "--output", "one")
        self.scene(DROP.replace('end = "60 ps"', 'end = "60 ns"'), "long")  # is never finished
        self.stop(["sweep", "long.toml", *call[2:]], "long", all)
        self.assertEqual([r["exit_code"] for r in self.table("long/sweep.csv")[0]], ["143"] * 3)
        self.stop(call, "three", any)
        self.assertIn("143", [r["exit_code"] for r in self.table("three/sweep.csv")[0]])
        self.call(*call, "--output", "three", "--parallel", "2")
        self.assertEqual(self.results("three"), self.results("one"))

    def stop(self, call, output, begun):
        """Stops three runs at the same time when any of them, or all, have written records."""
        process = self.start(*call, "--output", output, "--parallel", "3")
        histories = [self.directory / output / f"viscosity=0.{k}_mPa_s" / "history.csv" for k in (6, 7, 8)]
        while not begun(h.exists() and h.read_text().count("\n") > 3 for h in histories):
            time.sleep(0.02)
        process.send_signal(signal.SIGTERM)
        said, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 128 + signal.SIGTERM, said)

    def test_a_failing_run_does_not_stop_the_others(self):
        scene = self.scene(BLOCK + '[expect]\nslow = { of = "kinetic_energy", value = 0, within = 1e-3 }\n')
        done = self.call("sweep", scene, "--set", "body_force[0].acceleration=[0,0,0],[1,0,0],[\"1e9*x\",0,0]",
                         "--set", "time.end=0.02, -1", "--output", "out", code=None)
        rows, _ = self.table("out/sweep.csv")
        self.assertEqual([row["exit_code"] for row in rows], ["0", "3", "7", "3", "4", "3"])
        self.assertEqual(done.returncode, 3)  # the most severe exit code
        self.assertIn("time.end", done.stderr)
        self.assertEqual(rows[1]["kinetic_energy"], "")
        # Runs with wrong input are tried again. Runs that would fail in the same way are not.
        again = self.call("sweep", scene, "--set", "body_force[0].acceleration=[0,0,0],[1,0,0],[\"1e9*x\",0,0]",
                          "--set", "time.end=0.02, -1", "--output", "out", code=3)
        self.assertEqual(again.stdout.count("done before"), 3)

    def test_it_goes_on_where_it_was_stopped(self):
        scene = self.scene(DROP)
        call = ["sweep", scene, "--set", "body.drop.material.viscosity=0.6 mPa s,0.7 mPa s", "--threads", "1"]
        self.call(*call, "--output", "whole")
        process = self.start(*call, "--output", "part")
        first = self.directory / "part" / "viscosity=0.6_mPa_s" / "history.csv"
        while not first.exists() or first.read_text().count("\n") < 6:
            time.sleep(0.02)
        process.send_signal(signal.SIGTERM)
        said, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 128 + signal.SIGTERM, said)
        self.assertIn("the same command goes on", said)
        self.assertEqual([r["exit_code"] for r in self.table("part/sweep.csv")[0]], ["143"])
        self.call(*call, "--output", "part")
        whole, part = (self.results(name) for name in ("whole", "part"))
        self.assertEqual(whole, part)
        # If the table is lost, it is rebuilt from the directories of the runs.
        (self.directory / "part" / "sweep.csv").unlink()
        self.call(*call, "--output", "part")
        self.assertEqual(self.results("part"), whole)

    def test_refusals(self):
        scene = self.scene(SHEET)
        for setting, word in (("time.end", "expected KEY=VALUE,VALUE"), ("time.end=1,,2", "a value is missing"),
                              ("title==1+1,x", "begins with '='"), ("title=@x", "begins with '@'"),
                              ("time.end=1,1", "named twice"), ("time.end=1_2,1 2", "differ in")):
            self.refused(["sweep", scene, "--set", setting, "--output", "x"], 3, word)
        self.refused(["sweep", scene, "--set", "time.end=1", "--set", "time.end=2"], 3, "named twice")
        self.refused(["sweep", scene], 2, "--set")
        self.refused(["sweep", "nowhere.toml", "--set", "time.end=1"], 5, "nowhere.toml")
        self.call("sweep", scene, "--set", "time.end=0.001", "--output", "x")
        self.refused(["sweep", scene, "--set", "time.step=1e-5", "--output", "x"], 3, "time.step", "--overwrite")
        self.scene(SHEET + "# changed\n")
        self.refused(["sweep", scene, "--set", "time.end=0.001", "--output", "x"], 3, "another scene")
        self.call("sweep", scene, "--set", "time.end=0.001", "--output", "x", "--overwrite")


class Pictures(ProgramTest):
    def test_plot_and_report(self):
        self.call("run", self.scene(SHEET), "--output", "out", "--until", "0.01")
        self.assertIn("out/plots/energies.pdf", self.call("plot", "out", "--format", "pdf").stdout)
        self.assertTrue((self.directory / "out/plots/energies.pdf").exists())
        self.call("report", "out")
        self.assertIn("<h2>History</h2>", (self.directory / "out/report.html").read_text())
        self.assertIn("usage: meniscus plot", self.call("plot", "--help").stdout)
        self.refused(["plot", "nowhere"], 5, "meniscus plot: ", "nowhere")
        self.call("sweep", "scene.toml", "--set", "time.end=0.001,0.002", "--output", "s")
        self.assertIn("s/plots/against_end.png", self.call("plot", "s").stdout)
        self.refused(["plot", "s", "--movie"], 5, "s has several runs; name one of them: end=0.001, end=0.002")
        self.refused(["report", "out", "--nonsense"], 2, "usage: meniscus report", "--nonsense")


class CommandLine(ProgramTest):
    def completed(self, *words):
        """The completions that bash offers for the last word."""
        (self.directory / "meniscus.bash").write_text(self.call("completion").stdout)
        script = f"""source ./meniscus.bash
COMP_WORDS=(meniscus {' '.join(f"'{word}'" for word in words)}) COMP_CWORD={len(words)}
_meniscus
printf '%s\\n' "${{COMPREPLY[@]}}" """
        done = subprocess.run(["bash", "-c", script], cwd=self.directory, text=True, capture_output=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_completion(self):
        self.assertEqual(sorted(self.completed("")), sorted([*COMMANDS, "--help"]))
        self.assertEqual(self.completed("sw"), ["sweep"])
        options = self.completed("run", "--")
        for option in ("--output", "--overwrite", "--set", "--threads", "--until", "--restart", "--frame",
                       "--max-walltime", "--quiet", "--help"):
            self.assertIn(option, options)
        self.scene(SHEET)
        (self.directory / "out").mkdir()
        self.assertEqual(sorted(self.completed("run", "")), ["out", "scene.toml"])
        self.assertEqual(self.completed("run", "scene.toml", "--output", ""), ["out"])
        self.assertEqual(self.completed("new", "x", "--like", "lame"), ["lame_cube"])
        self.assertEqual(self.completed("help", "para"), ["paraview"])
        self.assertIn("neo_hookean", self.completed("keys", "ne"))

    def test_the_manual_page(self):
        page = self.call("manual").stdout
        for command in COMMANDS:
            self.assertIn(f"\n.SH {command}\n", page)
        self.assertIn("128 + n stopped by signal", page)
        if shutil.which("groff"):
            done = subprocess.run(["groff", "-man", "-ww", "-Tutf8"], input=page, text=True, capture_output=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("--max-walltime H:M:S", re.sub(".\b", "", done.stdout))


class LibrarySettings(ProgramTest):
    VARIABLES = ("GLIBC_TUNABLES", "GOMP_SPINCOUNT", "OMP_WAIT_POLICY")

    def settings_of_a_run(self, **given):
        """Name of the process and environment variables of a run that is started with the given variables."""
        environment = {key: value for key, value in program.ENVIRONMENT.items() if key not in self.VARIABLES} | given
        results = Path(tempfile.mkdtemp(dir=self.directory)) / "results"
        process = subprocess.Popen([program.PROGRAM, "run", self.scene(BLOCK), "--set", "time.end=1e9", "--output", results],
                                   cwd=self.directory, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment)
        self.addCleanup(process.__exit__, None, None, None)
        self.addCleanup(process.kill)
        for _ in range(1000):  # until the run makes steps
            if (results / "run.h5").exists():
                break
            time.sleep(0.02)
        of_process = Path(f"/proc/{process.pid}")
        values = dict(entry.split("=", 1) for entry in (of_process / "environ").read_text().split("\0") if "=" in entry)
        return (of_process / "comm").read_text().strip(), *map(values.get, self.VARIABLES)

    def test_a_run_has_its_own_unless_told_otherwise(self):
        name, pages = Path(program.PROGRAM).name[:15], "glibc.malloc.hugetlb=1"
        self.assertEqual(self.settings_of_a_run(), (name, pages, "5000", None))
        self.assertEqual(self.settings_of_a_run(GLIBC_TUNABLES="", GOMP_SPINCOUNT="5"), (name, "", "5", None))
        self.assertEqual(self.settings_of_a_run(OMP_WAIT_POLICY="active"), (name, pages, None, "active"))


if __name__ == "__main__":
    program.main()
