# SPDX-License-Identifier: BSD-3-Clause
"""Makes the package meniscus known: the one that is installed beside these scripts, or that of the source
tree."""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
FOLDERS = (HERE.parent / "python", HERE.parents[1] / "src" / "python")
sys.path.insert(0, str(next(folder for folder in FOLDERS if (folder / "meniscus").is_dir())))
