#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""check.py BUILD COMPILER [python]: installs the build tree, compiles each installed header alone, builds
the example against what is installed, and compares what it prints with the history of the installed
program, and its own material law with the law of the program that has the same energy. With `python`,
the installed package makes the same run.
"""

import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SCENE = HERE.parent / "data/drop.toml"
SCRIPT = f"""
import meniscus
run = meniscus.Run({str(SCENE)!r})
run.advance_to(1)
print(run.steps, repr(run.measure("drop.area")))
"""


def run(*command, **environment):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True,
                          env={**os.environ, **environment})  # fmt: skip
    if done.returncode:
        sys.exit(f"{command}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def main():
    build, compiler, *options = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        installed = folder / "installed"
        run("cmake", "--install", build, "--prefix", installed)
        run("cmake", "-S", HERE, "-B", folder / "example", "-G", "Ninja",
            f"-DCMAKE_PREFIX_PATH={installed}", f"-DCMAKE_CXX_COMPILER={compiler}")  # fmt: skip
        run("cmake", "--build", folder / "example")
        example = folder / "example/example"
        step, measure = run(example, SCENE, "drop.area").split()

        law = run(example, HERE / "own.toml", "block.extent_y").split()
        same = run(example, HERE / "own.toml", "block.extent_y",
                   "body.block.material.type=st_venant_kirchhoff").split()  # fmt: skip
        rest = run(example, HERE / "own.toml", "block.extent_y", "time.end=1e-9").split()
        if law[0] != same[0] or abs(float(law[1]) - float(same[1])) > 1e-9:
            sys.exit(f"the law of the example gives {law}, the same of the program {same}")
        if abs(float(law[1]) - float(rest[1])) < 1e-3:
            sys.exit(f"the block of own.toml has not deformed: {law}, {rest} at its beginning")

        program = installed / "bin/meniscus"
        for shipped in ("man/man1/meniscus.1", "bash-completion/completions/meniscus",
                        "meniscus/python/meniscus/results.py", "meniscus/plotting/plot.py", "meniscus/inputs/guide/contact.md"):  # fmt: skip
            if not (installed / "share" / shipped).stat().st_size:
                sys.exit(f"share/{shipped} is empty")
        run(program, "run", SCENE, "--output", folder / "out", "--quiet")
        run(program, "plot", folder / "out")  # by what is installed beside it
        lines = (folder / "out/history.csv").read_text().splitlines()
        columns = lines[0].lstrip("# ").split(",")
        last = dict(zip(columns, lines[-1].split(",")))
        if (float(last["step"]), float(last["drop.area"])) != (float(step), float(measure)):
            sys.exit(f"the library says step {step}, area {measure}; the program {last}")
        if options == ["python"]:
            package = installed / "share/meniscus/python"
            of_python = run("/usr/bin/python3", "-c", SCRIPT, PYTHONPATH=str(package)).split()
            if of_python != [step, repr(float(measure))]:
                sys.exit(f"the package says {of_python}, the library step {step}, area {measure}")


if __name__ == "__main__":
    main()
