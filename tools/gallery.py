#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of the gallery in inputs/README.md from runs of scenes of inputs/: the last
frame of each run, as in a movie, into inputs/pictures/gallery.
"""

import argparse
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from PIL import Image

import results_table

# results_table has put tools/plotting on the path.
import movies  # isort: skip
from results import Results  # isort: skip
from runlog import Log  # isort: skip

DPI = 60  # gives pictures of 340 pixels
COLOURS = 64  # size of the palette; files are a third as large


def draw(folder, pictures):
    """Draws the run in `folder`. Returns the path. Raises OSError or ValueError if it is not such a run."""
    scene = results_table.scene_of(Log(folder / "run.log"), folder)
    run = Results(folder)
    last = len(run.frames) - 1
    figure, show = (movies.in_the_plane if run.dimension == 2 else movies.in_space)(
        run, [last], run.field_of(None)
    )
    show(last)
    path = pictures / f"{scene.stem}.png"
    figure.savefig(path, dpi=DPI)
    plt.close(figure)
    Image.open(path).convert("RGB").quantize(COLOURS).save(path, optimize=True)
    return path


def main():
    parser = argparse.ArgumentParser(prog="gallery.py", description=__doc__)
    parser.add_argument("folders", type=pathlib.Path, nargs="+", metavar="DIR", help="of a finished run")
    parser.add_argument("--pictures", type=pathlib.Path, metavar="DIR",
                        default=results_table.ROOT / "inputs" / "pictures" / "gallery",
                        help="where they go; inputs/pictures/gallery if not given")  # fmt: skip
    arguments = parser.parse_args()
    arguments.pictures.mkdir(parents=True, exist_ok=True)
    for folder in arguments.folders:
        try:
            print(draw(folder, arguments.pictures))
        except (OSError, ValueError) as error:
            sys.exit(f"gallery.py: {error}")


if __name__ == "__main__":
    main()
