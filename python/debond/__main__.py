"""Commands of debond that are written in Python: python3 -m debond COMMAND ..., which the program `debond` calls.

calibrate SCENE.prm   find the unknowns of a scene with Task = calibrate
compare DIR CURVE     compare results with a measured curve
ensemble DIR          statistics of a study over its random members
measured FILE         read a table of a laboratory, write it as plain CSV
page DIR              write report.html of the results in a directory
specimens SCENE TABLE fit many specimens
"""

import importlib
import sys

COMMANDS = ("calibrate", "compare", "ensemble", "measured", "page", "specimens")
PACKAGES = {"_debond": "build debond with pybind11, apt install pybind11-dev python3-dev"}


def main(words) -> int:
    if not words or words[0] not in COMMANDS:
        print(__doc__, file=sys.stderr)
        return 1
    try:
        return importlib.import_module("debond." + words[0]).main(words[1:])
    except ImportError as error:
        needed = PACKAGES.get(error.name, f"apt install python3-{error.name}")
        print(f"debond: '{words[0]}' needs the module {error.name} of Python: {needed}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
