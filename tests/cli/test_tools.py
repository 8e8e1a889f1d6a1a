#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of tools/ say how they are called, do nothing where they do not know an argument, and run
nothing that a file contains; neither does the package of src/python."""
import ast
import os
import subprocess
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools"
SCRIPTS = sorted(file for file in TOOLS.iterdir() if file.is_file() and os.access(file, os.X_OK))


# Functions and modules that can execute the content of a file which somebody else may have written.
RUNNERS = {"eval", "exec", "compile", "__import__", "system", "popen", "getoutput", "getstatusoutput"}
LOADERS = {"pickle", "cPickle", "marshal", "shelve", "dill", "joblib", "yaml", "code"}
ALLOWED = {("re", "compile")}


def python_sources():
    for path in sorted([*TOOLS.rglob("*"), *(TOOLS.parent / "src/python/meniscus").iterdir()]):
        if path.is_file() and (path.suffix == ".py" or path.read_bytes().startswith(b"#!/usr/bin/python3")):
            yield path


def runs_content(source):
    """Lines of a Python source that may execute the content of a file, with the name of the function."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, a.name) for a in node.names if a.name.split(".")[0] in LOADERS)
        elif isinstance(node, ast.ImportFrom):
            names = {(node.module or "").split(".")[0]} & LOADERS or {a.name for a in node.names} & RUNNERS
            yield from ((node.lineno, name) for name in names)
        elif isinstance(node, ast.Name) and node.id in RUNNERS:  # called, or bound to another name
            yield node.lineno, node.id
        elif isinstance(node, ast.Attribute) and node.attr in RUNNERS:
            owner = node.value.id if isinstance(node.value, ast.Name) else ""
            if (owner, node.attr) not in ALLOWED:
                yield node.lineno, node.attr
        elif isinstance(node, ast.keyword) and node.arg in ("shell", "allow_pickle"):
            if not (isinstance(node.value, ast.Constant) and node.value.value is False):
                yield node.value.lineno, node.arg
        elif isinstance(node, ast.List) and len(node.elts) > 1:  # bash -c TEXT
            words = [e.value if isinstance(e, ast.Constant) else None for e in node.elts]
            if words[0] in ("bash", "sh", "/bin/sh", "/bin/bash") and "-c" in words:
                script = words.index("-c") + 1
                if script == len(words) or not isinstance(words[script], str):
                    yield node.lineno, "a shell with a text that is not constant"


def call(script, *arguments):
    return subprocess.run([script, *arguments], text=True, capture_output=True, timeout=60)


class ToolsTest(unittest.TestCase):
    def test_help_is_their_usage(self):
        self.assertGreater(len(SCRIPTS), 8)
        for script in SCRIPTS:
            with self.subTest(script.name):
                done = call(script, "--help")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertRegex(done.stdout, rf"^(usage: )?(tools/)?{script.name}\b")

    def test_unknown_arguments_are_refused(self):
        for script in SCRIPTS:
            if script.name != "run":  # it builds the program first and passes the arguments on
                with self.subTest(script.name):
                    done = call(script, "--nonsense")
                    self.assertEqual((done.returncode, done.stdout), (2, ""))
                    self.assertIn(script.name, done.stderr)

    def test_nothing_runs_what_a_file_contains(self):
        sources = list(python_sources())
        self.assertGreater(len(sources), 25)
        for path in sources:
            for line, what in runs_content(path.read_text()):
                self.fail(f"{path}:{line}: {what}")
        for source in ("eval(text)", "f = exec", "import pickle", "from os import system", "os.popen(text)",
                       "builtins.eval(text)", "subprocess.run(text, shell=True)", "np.load(f, allow_pickle=x)",
                       "subprocess.run(['bash', '-c', text])", "import yaml", "from pickle import loads"):
            self.assertTrue(list(runs_content(source)), source)
        for source in ("re.compile(text)", "subprocess.run(['bash', '-c', 'true', text], shell=False)"):
            self.assertFalse(list(runs_content(source)), source)

    def test_install_comes_before_the_imports(self):
        """tools/peers --install, on a machine without numpy: what it installs, and in what order."""
        code = ("import runpy, subprocess, sys\n"
                "sys.modules['numpy'] = None\n"
                "def run(command, **options):\n"
                "    print('install', command[-1].name, command[4])\n"
                "    del sys.modules['numpy']\n"
                "subprocess.run = run\n"
                f"sys.argv = ['peers', '--install', '--program', '/nowhere']\n"
                f"runpy.run_path({str(TOOLS / 'peers')!r}, run_name='__main__')\n")
        done = subprocess.run(["/usr/bin/python3", "-B", "-c", code], text=True, capture_output=True)
        self.assertIn("install setup.sh source \"$1\" && need run plot peers", done.stdout)
        self.assertIn("there is no /nowhere", done.stderr)

    def test_options_that_lack_their_value_are_refused(self):
        self.assertEqual(call(TOOLS / "verify", "-R").returncode, 2)
        self.assertEqual(call(TOOLS / "verification_table.py", "/nowhere").returncode, 2)
        self.assertEqual(call(TOOLS / "count_instructions.py", "/nowhere").returncode, 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
