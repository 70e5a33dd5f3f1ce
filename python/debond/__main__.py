"""Commands of debond that are written in Python: python3 -m debond COMMAND ..., which the program `debond` calls.

bench RIG.csv         compare a published test with its scene, over the ranges of what is not known
calibrate SCENE.prm   find the unknowns of a scene with Task = calibrate
compare DIR CURVE     compare results with a measured curve
ensemble DIR          statistics of a study over its random members
groups TABLE          means of groups and differences of each two, with intervals
mesh IMPLANT.step [BONE.step]   meshes and a scene from CAD
measured FILE         read a table of a laboratory, write it as plain CSV
nifti FILE.nii FILE.mha   write a NIfTI image as a MetaImage, which scenes read
page DIR              write report.html of the results in a directory
records FOLDER        peaks and curves of a folder of raw records, one file a specimen
specimens SCENE TABLE fit many specimens
study SCENE.prm       run all variants of a scene whose entries hold several values
"""

import importlib
import os
import sys

from .errors import InputError, Interrupted, RunError
from .files import say

PROCESSORS = os.cpu_count()
#: Of each command what it is given, how many files, and its options with their values where they are not said: a text, a number
#: from 1 on, a list of texts, or False of what has no value.
COMMANDS = {
    "bench": ("RIG.csv [--out DIR] [--jobs N] [--force]", 1, {"--out": "", "--jobs": PROCESSORS, "--force": False}),
    "calibrate": ("SCENE.prm [--set ENTRY=VALUE]... [--threads N] [--force] [--check]", 1,
                  {"--set": [], "--threads": PROCESSORS, "--force": False, "--check": False}),
    "compare": ("DIR CURVE [--columns LIST] [--over machine_angle_deg], a directory of results and a measured curve", 2,
                {"--columns": "", "--over": ""}),
    "ensemble": ("DIR, a finished study", 1, {}),
    "groups": ('TABLE --value "peak [N]" [--by group] [--animal animal] [--diameter D --length L | --area A [--radius R]] [--out DIR]', 1,
               {"--value": [], "--by": "group", "--animal": "", "--diameter": "", "--length": "", "--area": "", "--radius": "", "--out": ""}),
    "measured": ("FILE [--columns LIST] [--curves angle_deg,torque_Nmm]", 1,
                 {"--columns": "", "--curves": "angle_deg,torque_Nmm", "--entry": "FILE", "--columns-entry": "--columns"}),
    "mesh": ("IMPLANT.step [BONE.step | --bone 12x12x8 [--depth 5]] --out NAME [--size 0.5] [--edge-size 0.25] [--held top] [--bone-held bottom,sides] [--scale 25.4]", (1, 2),
             {"--size": "", "--edge-size": "", "--out": "", "--bone": "", "--depth": "", "--held": "top", "--bone-held": "bottom,sides", "--scale": ""}),
    "nifti": ("FILE.nii FILE.mha, an image to read and one to write", 2, {}),
    "page": ("DIR, a directory of results", 1, {}),
    "records": ('FOLDER --columns "displacement mm, force N" [--names "{animal}{limb}[-{trial}]"] [--by FIELDS] [--back 0.5] [--out DIR]', 1,
                {"--columns": "", "--names": "", "--by": "", "--back": "0.5", "--out": ""}),
    "specimens": ("TEMPLATE.prm TABLE [--out DIR] [--jobs N]", 2, {"--out": "", "--jobs": PROCESSORS}),
    "study": ("SCENE.prm [--set ENTRY=VALUE]... [--jobs N] [--threads N] [--force] [--check]", 1,
              {"--set": [], "--jobs": PROCESSORS, "--threads": 0, "--force": False, "--check": False}),
}


def _read(words, usage, n_files, options):
    """Files and options of a command line. Raises InputError."""
    files, options, words = [], dict(options), list(words)
    while words:
        word = words.pop(0)
        name, equals, value = word.partition("=")
        before = options.get(name)
        if before is False and not equals:
            options[name] = True
        elif name in options and (equals or words):
            value = value if equals else words.pop(0)
            if isinstance(before, int) and not (value.isascii() and value.isdigit() and int(value) > 0):
                raise InputError(f"{name} {value}: expected a number from 1 on")
            options[name] = [*before, value] if isinstance(before, list) else type(before)(value)
        elif word.startswith("-"):
            raise InputError(f"{word}: expected {usage}")
        else:
            files.append(word)
    if len(files) not in (n_files if isinstance(n_files, tuple) else (n_files,)):
        raise InputError(f"expected {usage}")
    return files, options


def main(words) -> int:
    """Runs a command; returns the exit code: 1 if something wrong was given, 2 if it could not be finished or written."""
    if not words or words[0] not in COMMANDS:
        say(__doc__, sys.stderr)
        return 1
    try:
        files, options = _read(words[1:], *COMMANDS[words[0]])
        return importlib.import_module("debond." + words[0]).main(*files, options) or 0
    except ImportError as error:
        needed = "pybind11-dev python3-dev, and build debond again" if error.name == "_debond" else f"python3-{error.name}"
        say(f"debond: '{words[0]}' needs the module {error.name} of Python: apt install {needed}", sys.stderr)
        return 1
    except (InputError, OSError) as error:
        say(error, sys.stderr)
        return 1
    except RunError as error:
        say(error, sys.stderr)
        return 2
    except Interrupted as error:
        number, text = error.args
        say(text, sys.stderr)
        return 128 + number
    except KeyboardInterrupt:
        say("interrupted: the same command goes on, without --force", sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
