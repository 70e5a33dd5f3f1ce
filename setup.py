"""Builds the module of Python with CMake, in build/python; see pyproject.toml."""

import os
import re
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        root = os.path.dirname(os.path.abspath(__file__))
        tree, release = os.path.join(root, "build", "python"), os.path.join(root, "build", "release")
        module = os.path.abspath(self.get_ext_fullpath(extension.name))
        os.makedirs(os.path.dirname(module), exist_ok=True)
        if os.path.exists(os.path.join(release, "python", os.path.basename(module))):
            tree = release  # ./quickstart has built it for this version of Python
        else:
            subprocess.run(["cmake", "-S", root, "-B", tree, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DDEBOND_NATIVE=ON",
                            f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", tree, "--parallel", "2", "--target", "debond_python"], check=True)
        self.copy_file(os.path.join(tree, "python", os.path.basename(module)), module)


with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "CMakeLists.txt"), encoding="utf-8") as lists:
    version = re.search(r"project\(debond VERSION ([\d.]+)", lists.read()).group(1)

setup(version=version, package_dir={"": "python"}, packages=["debond"], package_data={"debond": ["templates/*.html"]},
      ext_modules=[Extension("_debond", [])],
      cmdclass={"build_ext": CMakeBuild})
