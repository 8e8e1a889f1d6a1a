#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The notebooks of inputs/notebooks run, and check their results themselves.
Usage: test_notebooks.py PROGRAM, with the package on PYTHONPATH"""
import os
import sys
import tempfile
import unittest

import nbformat
from nbclient import NotebookClient

from scenes import ROOT

NOTEBOOKS = sorted((ROOT / "inputs/notebooks").glob("*.ipynb"))


class Notebooks(unittest.TestCase):
    def test_they_run(self):
        self.assertEqual([path.stem for path in NOTEBOOKS], ["convergence", "drop", "fit"])
        for path in NOTEBOOKS:
            with self.subTest(path.stem), tempfile.TemporaryDirectory() as directory:
                os.environ |= {name: directory for name in ("IPYTHONDIR", "JUPYTER_RUNTIME_DIR")}
                notebook = nbformat.read(path, as_version=4)
                nbformat.validate(notebook)
                cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
                self.assertFalse(any(cell.outputs or cell.execution_count for cell in cells), "outputs are stored")
                self.assertTrue(any("assert" in cell.source for cell in cells))
                NotebookClient(notebook, timeout=120, resources={"metadata": {"path": directory}}).execute()
                outputs = [output for cell in cells for output in cell.outputs]
                self.assertTrue(any("image/png" in output.get("data", {}) for output in outputs), "no picture")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
