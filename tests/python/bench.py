"""bench.py SOURCE SCRATCH: published tests as scenes, on a rig that is made up and whose results are known in closed form.

A rigid disk on springs turns until all of it slides, but for a core that is nothing: T = 2/3 pi mu p R^3. Bands, verdicts, intervals
and what moves results most follow from it by hand; wrong rigs are refused in one line; all rigs of prm/bench can be read.
Ends with 1 and a message at the first thing that is wrong.
"""

import contextlib
import glob
import io
import json
import math
import os
import re
import sys

import _debond

from debond import bench
from debond.__main__ import main as main_of_package

source, scratch = (os.path.abspath(path) for path in sys.argv[1:3])
SCENE = """set Model = foundation
set Accuracy = none
subsection Implant
  set Radius = 2
end
subsection Interface
  set Normal stiffness = 600
  set Tangential stiffness = 1e6
  set Friction law = coulomb
  set Friction coefficient = 0.3
end
subsection Closed form
  set Pressure = 3
end
subsection Expert
  subsection Closed form
    set Normal stiffness    = 600
    set Torsional stiffness = 1e6
  end
end
subsection Chuck
  subsection Rotation z
    set Value = 10 * t
  end
end
subsection Load steps
  set Times = 0, 1
  set Steps = 20
end
"""
RIG = """# title: A made-up disk
# source: nobody, 2000
# read: nothing
# scene: disk.prm
# taken: Implant/Radius [mm] = 2; made up
# assumed: Interface/Friction coefficient = 0.3 | 0.2 | 0.36; made up
# assumed: Closed form/Pressure [MPa] = press: 3 | 3.3; made up
# case small: Interface/Normal stiffness [MPa/mm] = 600; made up
# case large: Implant/Radius [mm] = 4; made up
# left out: nothing
group,computed,kind,mean,sd,n,low,high,unit,from
in the band,small_T_max_Nmm,predicted,16,,,,,N mm,made up
an interval,small_T_max_Nmm,fitted,9,1.6,10,,,N mm,made up
a narrow interval,small_T_max_Nmm,predicted,9,1.4,10,,,N mm,made up
a range,small_T_max_Nmm,consistent,1,,,1,10.1,N mm,made up
a digit,large_T_max_Nmm / small_T_max_Nmm,predicted,8.0,,,,,,made up
a digit too many,large_T_max_Nmm / small_T_max_Nmm,predicted,8.01,,,,,,made up
nothing,small_max_torque_Nmm / (2 * pi * small_Implant_Radius ** 2),predicted,,,,,,,made up
"""


def check(is_so, message):
    if not is_so:
        sys.exit(f"bench: {message}")


def command(text, code=0):
    """Runs a rig with this text; what the command says."""
    with open("rig.csv", "w", encoding="utf-8") as file:
        file.write(text)
    with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as errors:
        returned = main_of_package(["bench", "rig.csv", "--out", "out", "--jobs", "1", "--force"])
    check(returned == code, f"ends with {returned}, not {code}: {out.getvalue()}{errors.getvalue()}")
    return out.getvalue() + errors.getvalue()


def check_results():
    said = command(RIG)
    with open("out/bench.json", encoding="utf-8") as file:
        results = json.load(file)
    torque = 2 / 3 * math.pi * 0.3 * 3 * 8  # 15.08 N mm, from 10.05 (mu 0.2) to 18.10 (mu 0.36); p 3.3: 16.59
    rows = {row["group"]: row for row in results["rows"]}
    for name, nominal, least, most in (("in the band", torque, torque / 1.5, 1.2 * torque), ("a digit", 8, 8, 8),
                                       ("nothing", torque / (8 * math.pi), torque / (12 * math.pi), torque / (20 / 3 * math.pi))):
        for which, value in (("nominal", nominal), ("least", least), ("most", most)):
            check(abs(rows[name][which] / value - 1) < 1e-4, f"{name}: {which} is {rows[name][which]}, not {value}")
    # t of 9 degrees of freedom is 2.2622: 9 +- 1.145 comes to 10.14, 9 +- 1.0015 to 10.0015, below 10.05
    for name, verdict in (("in the band", "predicted"), ("an interval", "fitted"), ("a narrow interval", "missed"), ("a range", "consistent"),
                          ("a digit", "predicted"), ("a digit too many", "missed"), ("nothing", "not published")):
        check(rows[name]["verdict"] == verdict, f"{name}: {rows[name]['verdict']}, not {verdict}")
        check(re.search(f"^{name}: .*: {verdict}$", said, re.M), f"{name} is not said: {said}")
    moved = {one["entry"]: one["moved"] for one in results["settings"]}
    check(abs(moved["Interface/Friction coefficient"] - 1 / 3) < 1e-4 and abs(moved["Closed form/Pressure"] - 0.1) < 1e-4 and
          moved["Implant/Radius"] is None, f"results are moved by {moved}")
    with open("out/report.html", encoding="utf-8") as file:
        page = file.read()
    others = set(re.findall(r"<td[^>]*>([^<]*)</td>\s*<td[^>]*>[^<]*</td>\s*<td[^>]*>assumed, not varied</td>", page))
    check({"Interface / Tangential stiffness", "Chuck / Rotation z / Value"} <= others and not others & {"Implant / Radius", "Interface / Friction coefficient"},
          f"the page says of others that they are assumed: {others}")
    check("in a wide band" in command(RIG.replace("0.2 | 0.36", "0.17 | 0.36")), "a band of more than a factor of 2 is not said to be wide")


def check_wrong():
    for old, new, words in (
            ("# source: nobody, 2000\n", "", "rig.csv: expected a line '# source: ...'"),
            ("= 2; made up", "= 2", "rig.csv:5: 'Implant/Radius [mm] = 2': expected"),
            (",made up\nan", ",\nan", "rig.csv:12: from = '': expected"),
            ("fitted,9", "guessed,9", "rig.csv:13: kind = 'guessed': expected predicted"),
            ("predicted,16", "predicted,16 or so", "rig.csv:12: mean = '16 or so': expected a number"),
            ("high,unit,from", "high,unit,whence", "rig.csv:11: column from: expected"),
            ("high,unit,from", "high,units,from", "rig.csv:11: column units: expected"),
            ("in the band,small_T_max_Nmm", "in the band,small_T_min", "rig.csv:12: computed = 'small_T_min': cannot be computed"),
            ("in the band,small_T_max_Nmm", "in the band,small_T_max_Nmm.mean()", "expected a formula"),
            ("in the band,small_T_max_Nmm", "in the band,@sys", "expected a formula"),
            ("large: Implant/Radius [mm] = 4", "large: Interface/Friction coefficient = 0.3", "the same variants in all cases")):
        check(old in RIG, f"the rig has no '{old}'")
        said = command(RIG.replace(old, new), 1)
        check(words in said and said.count("\n") == 1, f"{new} is refused with other words: {said}")


def check_shipped():
    os.chdir(source)  # files of scenes are relative to it
    rigs = [bench.Rig(path) for path in glob.glob("prm/bench/*.csv") if not path.endswith("_softening.csv")]
    check(len(rigs) >= 6, f"there are {len(rigs)} rigs")
    for rig in rigs:
        for case in rig.cases:
            first = [f"{name}={one.value.split(':')[-1].split('|')[0].strip()}" for name, one in rig.given(case).items()]
            _debond.Scene(_debond.changed(_debond.read_file(rig.scene(case)), first, "--set"), rig.scene(case), _debond.Team(0))


os.makedirs(scratch, exist_ok=True)
os.chdir(scratch)
with open("disk.prm", "w", encoding="utf-8") as file:
    file.write(SCENE)
check_results()
check_wrong()
check_shipped()
