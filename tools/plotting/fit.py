# SPDX-License-Identifier: BSD-3-Clause
"""Fits parameters of scenes to measured data, and draws the data with the curves. Called by `meniscus fit`."""

import argparse
import os
import pathlib
import shutil
import signal
import sys

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt

import outside
import package  # noqa: F401  pylint: disable=unused-import
import style

from meniscus import FileError, InputError, SolveError, errors, fitting  # isort: skip
from meniscus.fit_model import OutOfReach  # isort: skip


def positive(kind):
    def number(text):
        value = kind(text)
        if not value > 0:
            raise argparse.ArgumentTypeError(f"{text} is not above 0")
        return value

    return number


def arguments():
    parser = argparse.ArgumentParser(
        prog=style.COMMAND,
        description="Finds the parameters with which runs of scenes agree best with measured data (meniscus help measurements).",
    )
    parser.add_argument("file", metavar="FIT", type=pathlib.Path, help="file that names scenes, data and parameters (TOML)")
    parser.add_argument("--output", metavar="DIR", type=pathlib.Path, help="results/FIT-fit by default")
    parser.add_argument("--parallel", metavar="N", type=positive(int), default=1, help="runs at the same time (default 1)")
    parser.add_argument("--threads", metavar="N", type=positive(int), default=0, help="threads of each run; by default all cores")
    parser.add_argument("--refine", metavar="K", type=positive(float),
                        help="also say by how much cells that are finer by this number would change the result")  # fmt: skip
    parser.add_argument("--iterations", metavar="N", type=positive(int), default=30, help="largest number (default 30)")
    parser.add_argument("--overwrite", action="store_true", help="begin anew; without it a fit that was stopped goes on")
    return parser.parse_args()


def lines_of(result):
    """The table of parameters, and what is to be said of it."""
    rows = [["parameter", "value", "+-", "unit"]]
    refined = any(p.by_resolution is not None for p in result.parameters)
    rows[0] += ["by finer cells"] if refined else []
    for p in result.parameters:
        rows.append([p.name, f"{p.value:.6g}", f"{p.deviation:.2g}", p.unit])
        rows[-1] += [f"{p.by_resolution:+.2g}"] if refined else []
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    lines = ["  ".join(cell.ljust(w) for cell, w in zip(row, widths)).rstrip() for row in rows]
    for k, p in enumerate(result.parameters[1:], 1):
        for j, q in enumerate(result.parameters[:k]):
            lines.append(f"correlation of {q.name} and {p.name}: {result.correlation[k, j]:.3f}")
    if result.chi_squared is None:
        lines.append(f"residuals: {100 * result.deviation:.2g} % of the largest values (root of the mean square)")
    else:
        lines.append(f"chi squared: {result.chi_squared:.4g} for {result.freedom} degrees of freedom")
    lines.append(f"{result.runs} runs in {result.seconds:.3g} s")
    return lines + [f"note: {note}" for note in result.notes]


def picture(result):
    """Measured curves and those of the fit, and single values relative to the measured ones."""
    curves = [c for c in result.curves if c.x is not None]
    values = [c for c in result.curves if c.x is None]
    count = len(curves) + bool(values)
    figure, axes = plt.subplots(1, count, figsize=(3.6 * count, 2.8), squeeze=False, layout="constrained")
    for axis, curve in zip(axes.flat, curves):
        axis.errorbar(curve.x, curve.measured, curve.error, fmt="o", ms=3, lw=0.8, label="measured")
        axis.plot(curve.x, curve.fitted, label="fit", zorder=3)
        axis.set_title(curve.name, fontsize=9, loc="left")
        axis.set_xlabel(style.label(style.column_name(curve.x_name.rpartition(".")[2]), style.pretty(curve.x_unit)))
        axis.set_ylabel(style.label(style.column_name(curve.y_name.rpartition(".")[2]), style.pretty(curve.y_unit)))
        axis.legend()
    if values:
        axis = axes.flat[-1]
        for k, curve in enumerate(values):
            size = abs(curve.measured[0]) or 1
            error = None if curve.error is None else curve.error / size
            axis.errorbar([k], curve.measured / size, error, fmt="o", ms=4, color=style.COLORS[0], capsize=3)
            axis.plot([k], curve.fitted / size, "_", ms=12, color=style.COLORS[1])
        axis.set_xticks(range(len(values)), [c.name for c in values], rotation=30, ha="right")
        axis.set_ylabel("value / |measured|")
    return figure


def main():
    args = arguments()
    folder = args.output or pathlib.Path("results") / f"{args.file.stem}-fit"
    if args.overwrite and (folder / "evaluations.json").exists():
        shutil.rmtree(folder)
    result = fitting.fit(
        args.file, directory=folder, program=os.environ.get("MENISCUS_PROGRAM"), parallel=args.parallel, threads=args.threads,
        refine=args.refine, most_iterations=args.iterations, told=lambda text: print(outside.printable(text), flush=True),
    )  # fmt: skip
    for line in lines_of(result):
        outside.say(line)
    with outside.new_file(folder / "fit.png") as made:
        outside.save(picture(result), made, dpi=style.DPI)
    outside.say(f"written to {folder / 'fit.json'}, {folder / 'fit.png'}")


def stop(number, _):
    raise KeyboardInterrupt(number)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, stop)
    signal.signal(signal.SIGINT, stop)
    try:
        main()
    except KeyboardInterrupt as stopped:
        print(f"stopped by signal {stopped.args[0]}; the same command goes on", flush=True)
        sys.exit(128 + stopped.args[0])
    except InputError as error:
        outside.end(style.COMMAND, error, 3)
    except SolveError as error:
        outside.end(style.COMMAND, error, 4)
    except OutOfReach as error:
        outside.end(style.COMMAND, f"{error}; expected is a run that reaches all of them from the start", 3)
    except (FileError, OSError) as error:
        outside.end(style.COMMAND, error, 5)
    except errors.Error as error:
        outside.end(style.COMMAND, error, 1)
