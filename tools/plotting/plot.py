# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of a run, a study, a sweep or a convergence. Called by tools/plot."""

import argparse
import pathlib

import matplotlib

matplotlib.use("Agg")

import cells
import comparison
import contacts
import drop_decay
import grounds
import histories
import movies
import nematics
import outside
import probes
import sections
import series
import studies
import style
import surfaces
import wetting
from results import Results


def positive(text):
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{number} is below 1")
    return number


def arguments():
    parser = argparse.ArgumentParser(
        prog=style.COMMAND, description="Draws pictures of a run, a study, a sweep or a convergence into DIR/plots."
    )
    parser.add_argument("dir", metavar="DIR", type=pathlib.Path, help="directory of the run, study, sweep or convergence")
    parser.add_argument(
        "--field",
        help="field that colours cross-sections, surfaces and movie (default: the first scalar); "
        "error of a study that is drawn (default: the first two)",
    )
    parser.add_argument(
        "--frames", type=positive, metavar="N",
        help="number of cross-sections and lines (default 5), of surfaces (3), of the movie (all)",
    )  # fmt: skip
    parser.add_argument(
        "--movie", nargs="?", const="best", choices=("best", *movies.FORMATS), metavar="FORMAT",
        help="writes a movie instead: mp4 or gif; if not said, mp4 where ffmpeg is installed",
    )  # fmt: skip
    parser.add_argument(
        "--format", choices=("png", "pdf", "svg"), default="png", help="of the pictures (default png)"
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
    if series.is_series(args.dir):
        return series.draw(args.dir)
    if args.beside:
        runs = {d.resolve().name: Results(d) for d in (args.dir, *args.beside)}
        return comparison.draw(runs, args.measure)
    return pictures_of_run(Results(args.dir), args.field, args.frames)


def pictures_of_run(run, field, frames):
    """Figures by name; `field` colours `frames` of them; None: their defaults."""
    return {
        **histories.draw(run),
        **probes.draw(run, frames or 5),
        **contacts.draw(run),
        **drop_decay.draw(run),
        **cells.draw(run),
        **sections.draw(run, field, frames or 5),
        **surfaces.draw(run, field, frames or 3),
        **wetting.draw(run, frames or 5),
        **grounds.draw(run, frames or 5),
        **nematics.draw(run, frames or 5),
    }


def main():
    args = arguments()
    if args.movie:
        run = Results(args.dir)
        outside.say(movies.write(run, outside.folder_in(args.dir, "plots"), args.movie, args.field, args.frames))
        return
    pictures = pictures_of(args)
    folder = outside.folder_in(args.dir, "plots")
    for name, figure in pictures.items():
        path = folder / f"{outside.file_name(name)}.{args.format}"
        with outside.new_file(path) as made:
            outside.save(figure, made, dpi=style.DPI)
        outside.say(path)


if __name__ == "__main__":
    outside.call(main, style.COMMAND)
