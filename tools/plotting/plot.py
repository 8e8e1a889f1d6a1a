# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of a run or of a convergence study. Called by tools/plot."""

import argparse
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")

import cells
import comparison
import contacts
import drop_decay
import histories
import sections
import studies
import style
import surfaces
import wetting
from results import Results


def arguments():
    parser = argparse.ArgumentParser(
        prog="tools/plot", description="Draws pictures of a run or a study into DIR/plots."
    )
    parser.add_argument("dir", metavar="DIR", type=pathlib.Path, help="directory of the run or study")
    parser.add_argument(
        "--field",
        help="field that colours the cross-sections (default: the first scalar); "
        "error of a study that is drawn (default: the first two)",
    )
    parser.add_argument(
        "--frames", type=int, default=5, help="number of cross-sections (default 5)"
    )
    parser.add_argument(
        "--beside", metavar="DIR", type=pathlib.Path, nargs="+", default=[],
        help="draws only measures over time, those of DIR and of these runs together",
    )  # fmt: skip
    parser.add_argument(
        "--measure", action="append", help="measure to compare, e.g. drop.ca (default: all)"
    )
    return parser.parse_args()


def pictures_of(args):
    if (args.dir / "study.json").exists():
        return studies.draw(studies.Study(args.dir), args.field)
    if args.beside:
        runs = {d.resolve().name: Results(d) for d in (args.dir, *args.beside)}
        return comparison.draw(runs, args.measure)
    return pictures_of_run(Results(args.dir), args.field, args.frames)


def pictures_of_run(run, field, frames):
    """Figures by name; `field` colours `frames` cross-sections."""
    return {
        **histories.draw(run),
        **contacts.draw(run),
        **drop_decay.draw(run),
        **cells.draw(run),
        **sections.draw(run, field, frames),
        **surfaces.draw(run),
        **wetting.draw(run, frames),
    }


def main():
    args = arguments()
    try:
        pictures = pictures_of(args)
    except (OSError, ValueError) as error:
        sys.exit(f"tools/plot: {error}")
    folder = args.dir / "plots"
    folder.mkdir(exist_ok=True)
    for name, figure in pictures.items():
        figure.savefig(
            folder / f"{name}.png", dpi=style.DPI, bbox_inches="tight", pad_inches=0.04
        )
        print(folder / f"{name}.png")


if __name__ == "__main__":
    main()
