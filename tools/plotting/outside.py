# SPDX-License-Identifier: BSD-3-Clause
"""Results may come from anybody: how scripts write beside them and end when they cannot be drawn."""

import contextlib
import os
import pathlib
import re
import sys
import tempfile
import traceback

import style

LONGEST = 600  # longest message, in characters
MOST_PIXELS = 1e8  # largest picture, in pixels


def printable(text):
    """The text without control characters and without those that turn the direction of writing."""
    return "".join(c if c.isprintable() or c == "\n" else "?" for c in str(text))


def say(text):
    print(printable(text))


def file_name(name):
    """A name from a result as a part of a file name: without separators."""
    return re.sub(r"[^\w.,=+-]", "_", name)


def folder_in(parent, name):
    """The folder of that name, made if it is missing. Raises OSError if it is a link: what it points to
    was not chosen by whoever draws."""
    folder = parent / name
    if folder.is_symlink():
        raise OSError(f"{folder} is a link, through which nothing is written; remove it")
    folder.mkdir(exist_ok=True)
    return folder


@contextlib.contextmanager
def new_file(path):
    """A path at which a file is written that then takes the place of `path`, never through a link."""
    with tempfile.TemporaryDirectory(prefix=".new-", dir=path.parent) as folder:
        made = pathlib.Path(folder) / path.name
        yield made
        os.replace(made, path)


def require_reasonable(figure, dpi=style.DPI):
    width, height = figure.get_size_inches() * dpi
    if not 0 < width * height < MOST_PIXELS:
        raise ValueError(f"a picture would have {width:.3g} x {height:.3g} pixels")


def save(figure, target, dpi, **options):
    require_reasonable(figure, dpi)
    figure.savefig(target, dpi=dpi, bbox_inches="tight", pad_inches=0.04, **options)


def call(work, command):
    """Calls work() and ends the program: with exit code 2 after style.UsageError; with 5 and one
    sentence after anything else that results can raise which are not as a run writes them."""
    try:
        work()
    except style.UsageError as error:
        end(command, error, 2)
    except (OSError, ValueError) as error:
        end(command, error, 5)
    except Exception as error:  # pylint: disable=broad-exception-caught
        place = traceback.extract_tb(error.__traceback__)
        own = [f for f in place if pathlib.Path(f.filename).parent == pathlib.Path(__file__).parent][-1]
        reason = f"{type(error).__name__} {error} in {pathlib.Path(own.filename).name}:{own.lineno}"
        end(command, f"the results are not as a run writes them: {reason}", 5)


def end(command, reason, code):
    text = printable(" ".join(str(reason).split()))
    if len(text) > LONGEST:
        text = text[: LONGEST - 4] + " ..."
    print(f"{command}: {text}", file=sys.stderr)
    sys.exit(code)
