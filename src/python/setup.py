# SPDX-License-Identifier: BSD-3-Clause
"""Lets CMake build the extension module; pyproject.toml has all else."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(meniscus VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build = Path(os.environ.get("MENISCUS_BUILD", ROOT / "build"))
        options = ["-DMENISCUS_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"]
        if not (build / "CMakeCache.txt").exists():
            options += ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON", "-DMENISCUS_TESTS=OFF", "-G", "Ninja"]
        subprocess.run(["cmake", "-S", ROOT, "-B", build, *options], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "meniscus_python"], check=True)
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(next((build / "python/meniscus").glob("_meniscus*.so")), target)


setup(version=VERSION, ext_modules=[Extension("meniscus._meniscus", [])], cmdclass={"build_ext": CMakeBuild})
