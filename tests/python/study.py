"""Studies, as the program runs them: variants and how entries vary together (worked out by hand), one that fails, what is skipped
when a study is run again, repetitions and their medians, the comparison of curves, bodies that variants inherit (curves are, digit
for digit, those of runs alone), warnings before anything is run.

    PYTHONPATH=... python3 tests/python/study.py DEBOND SCRATCH
"""

import csv
import glob
import json
import math
import os
import shutil
import statistics
import subprocess
import sys
from unittest import TestCase

import _debond
from debond.errors import SceneError
from debond.study import Queue, Variant
from debond.variants import variants_of

program, scratch = (os.path.abspath(path) for path in sys.argv[1:3])
same = TestCase().assertEqual
COIN = f"include {os.path.dirname(os.path.abspath(__file__))}/../coin.prm\n" + """
subsection Bone
  set Material = linear
end
subsection Implant
  set Material = linear
end
subsection Chuck
  subsection Press
    set Control = force
    set Value   = 51.88 * min(t, 1)
  end
  subsection Rotation z
    set Value = 10 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps = 1 , 100
end
subsection Output
  set Fields every = 100
end
"""
# The block of the implant's chuck moves sideways, so that the bone needs further contact unknowns and condenses anew.
BLOCK = f"include {os.path.dirname(os.path.abspath(__file__))}/../coin.prm\n" + """
subsection Interface
  subsection Bonding
    set Pattern = expression
  end
end
subsection Chuck
  subsection Translation x
    set Value = 0.9 * max(t - 1, 0)
  end
  subsection Press
    set Value = 0.0049 * min(t, 1)
  end
  subsection Rotation z
    set Value = 2 * max(t - 1, 0)
  end
end
subsection Load steps
  set Steps = 1, 6
end
subsection Output
  set Fields every = none
end
subsection Expert
  subsection Interface
    set Quadrature points = 3
  end
end
"""
FOUR = "set A = {{1|2|3}}\nset B = {{m: x|y}}\nset C = {{m: p|q}}\nset D = {{u|v}}"
NO_RANGE = "is no range: expected FIRST..LAST with whole numbers of at most nine digits, FIRST <= LAST"
BRACES = "the braces of several values do not match: expected {{a|b|c}}, {{a||b||c}} or {{name: a|b|c}}, once"
TOO_MANY = "this makes a study of more than 100000 variants"


def write(name, text):
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)
    return name


def debond(*words):
    """What the program says, and its exit code."""
    end = subprocess.run([program, *words], capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    return end.stdout + end.stderr, end.returncode


def study(scene, directory, *changes, jobs=2, force=False, code=0):
    sets = [word for change in (f"Output/Directory={directory}", *changes) for word in ("--set", change)]
    said, end = debond(scene, *sets, "--jobs", str(jobs), *["--force"] * force)
    same(end, code, said)
    return said


def table(directory):
    with open(f"{directory}/study.csv", encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def content(name):
    with open(name, encoding="utf-8") as file:
        return file.read()


def values_of(text, at_once=0):
    """Values of each variant as one word, or the message."""
    try:
        return " ".join(",".join(one.values.values()) for one in variants_of(_debond.read_text(text, "study"), at_once))
    except SceneError as error:
        return str(error)


def check_variants():
    for text, expected in (
            ("set A = {{1|2}}\nset B = {{x|y|z}}", "1,x 2,x 1,y 2,y 1,z 2,z"),
            ("set A = {{1||2||3}}\nset B = f{{x||y||z}}.csv", "1,fx.csv 2,fy.csv 3,fz.csv"),
            ("set A = {{1|2}}\nset B = {{x||y}}", "1,x 2,y"),
            ("set A = {{m: 1|2}}\nset B = {{x|y}}\nset C = {{m: 3|4}}", "1,x,3 2,x,4 1,y,3 2,y,4"),
            ("set A = {{1|2}}\nset B = {{x||y||z}}",
             "study:2: B = '{{x||y||z}}': 3 values for 2 variants: {{a||b}} needs one for each"),
            ("set A = {{m: 1|2}}\nset B = {{m: x|y|z}}",
             "study:2: B = '{{m: x|y|z}}': 3 values, but an entry before has 2 for 'm'"),
            ("set A = {{1|2", "study:1: A = '{{1|2': " + BRACES),
            ("set A = {{1|2}} {{3|4}}", "study:1: A = '{{1|2}} {{3|4}}': " + BRACES),
            ("set A = {{1..3}}\nset B = {{m: -1..0|5}}\nset C = {{m: x|y|z}}", "1,-1,x 2,-1,x 3,-1,x 1,0,y 2,0,y 3,0,y 1,5,z 2,5,z 3,5,z"),
            ("set A = f{{8..10}}.csv\nset B = {{p||q||../r}}", "f8.csv,p f9.csv,q f10.csv,../r"),
            ("set A = {{4..4}}", "4"),
            ("set A = {{5..1}}", "study:1: A = '{{5..1}}': '5..1' " + NO_RANGE),
            *((f"set A = {{{{{text}}}}}", f"study:1: A = '{{{{{text}}}}}': '{text}' {NO_RANGE}") for text in ("1..2.5", "1...5", "1..")),
            ("set A = {{0..100000}}", "study:1: A = '{{0..100000}}': " + TOO_MANY),
            ("set A = {{1..1000}}\nset B = {{1..101}}", "study:2: B = '{{1..101}}': " + TOO_MANY),
            ("set A = {{a|b|a}}", "study:1: A = '{{a|b|a}}': 'a' is there twice")):
        same(values_of(text), expected)
    same(values_of(FOUR, 1), "1,x,p,u 2,x,p,u 3,x,p,u 1,y,q,u 1,x,p,v")
    same(values_of(FOUR, 2), "1,x,p,u 2,x,p,u 3,x,p,u 1,y,q,u 2,y,q,u 3,y,q,u 1,x,p,v 2,x,p,v 3,x,p,v 1,y,q,v")
    same(values_of(FOUR, 3), values_of(FOUR))
    assert "cannot be one of the factors of Expert / Study / Factors varied at once" in values_of("set A = {{1|2}}\nset B = {{x||y}}", 1)


def check_repetitions():
    """Every variant is run three times; seconds are the middle ones. A repetition that is missing is made up for, and no other."""
    changes = ("Model=foundation", "Interface/Friction coefficient broken={{0.3|0.4}}", "Expert/Study/Repetitions=3")
    study("coin.prm", "repetitions", *changes)
    files = [f"repetitions/variant-002/repetition-{i}.json" for i in (1, 2, 3)]
    same(sorted(glob.glob("repetitions/variant-002/repetition-*")), files)

    def check_medians():
        for name in ("wall_seconds", "seconds_stepping"):
            median = statistics.median(json.loads(content(file))[name] for file in files)
            assert abs(float(table("repetitions")[1][name]) - median) <= 1e-9 * median

    check_medians()
    os.remove(files[2])
    before = [os.stat(name).st_mtime_ns for name in (files[0], "repetitions/variant-001/summary.json")]
    study("coin.prm", "repetitions", *changes)
    same(before, [os.stat(name).st_mtime_ns for name in (files[0], "repetitions/variant-001/summary.json")])
    check_medians()
    same(study("coin.prm", "repetitions", *changes, "Expert/Output/Console=quiet"), "")
    row = table("repetitions")[0]
    assert 0 < float(row["seconds_before_steps"]) < float(row["wall_seconds"]) and 0 < float(row["seconds_stepping"])


def check_lacking():
    """A variant that lacks an entry is named, whichever it is; a mistake with a place has that alone (tests/bad_scenes)."""
    coin = os.path.dirname(os.path.abspath(__file__)) + "/../../prm/tutorial/implant.prm"
    for shapes, name in (("coin|ring", "variant-002: Implant / Shape = ring: "), ("ring|coin", "variant-001: ")):
        said, code = debond(coin, "--check", "--set", f"Implant/Shape={{{{{shapes}}}}}", "--set", "Output/Directory=lacking")
        same(code, 1)
        assert said.startswith(name + coin + ": it does not say all") and "set Inner radius =" in said, said


def check_errors():
    """Values with their estimated errors, two digits of these, on console and page."""
    said = study("coin.prm", "errors", "Accuracy=5 %", "Bone/Material=rigid", "Implant/Material=linear", "Load steps/Steps=1, 10",
                 "Interface/Friction coefficient broken={{0.3|0.4}}")
    page = content("errors/report.html")
    for row in table("errors"):
        value, error = float(row["T_max_Nmm"]), float(row["T_max_Nmm_error"])
        decimals = 1 - math.floor(math.log10(error))
        text = f"{value:.{decimals}f} ± {error:.{decimals}f}"
        assert text in page and f"T_max {text.replace('±', '+-')} N mm" in said, (text, said)


def check_table():
    """One variant of four fails; the foundation with the stiffness of the bodies is close to them."""
    changes = ("Model={{finite elements|foundation}}", "Chuck/Rotation x/Value={{0|1e-3 * t}}", "Study/Reference variant=1")
    assert "1 of 4 variants failed: study/study.csv says why" in study("coin.prm", "study", *changes, code=2)
    rows = table("study")
    same([row["variant"] for row in rows], ["1", "2", "3", "4"])
    same([row["Model"] for row in rows], 2 * ["finite elements", "foundation"])
    same([row["converged"] for row in rows], ["true", "true", "true", "false"])
    same([row["dofs"] for row in rows], ["3390", "0", "3390", "nan"])
    same(rows[3]["reason"], "--set: Chuck / Rotation x / Value = '1e-3 * t': closed forms know Press (or Translation z) and Rotation z only "
                            "(Model = finite elements can do more)")
    assert float(rows[0]["difference_max"]) < 1e-15 and float(rows[1]["difference_max"]) < 0.01
    same(rows[0]["bone_tension_at_mm"].count(";"), 2)
    assert os.path.exists("study/variant-003/torque.csv")

    before = os.stat("study/variant-001/summary.json").st_mtime_ns
    same(study("coin.prm", "study", *changes, code=2).splitlines()[0], "4 variants in study, 3 of them done already")
    same(before, os.stat("study/variant-001/summary.json").st_mtime_ns)
    assert "study/variant-001 holds results of another scene (compare its parameters.prm): choose another directory, or " \
           "overwrite them with --force" in study("coin.prm", "study", "Model={{foundation|finite elements}}", code=1)


def check_shared_bodies():
    """The second of three variants fails, since a file is in the way of its directory."""
    expressions = ("0.5 + 0.1 * x", "0.5", "y > 0 ? 1 : 0")
    for material in ("linear", "neo-hookean"):
        materials = (f"Bone/Material={material}", f"Implant/Material={material}")
        os.makedirs(material)
        write(f"{material}/variant-002", "in the way of its directory\n")
        study("block.prm", material, *materials, "Interface/Bonding/Expression={{" + "|".join(expressions) + "}}", code=2)
        for i in (0, 2):
            place = f"{material}/variant-00{i + 1}"
            study("block.prm", "alone", *materials, "Interface/Bonding/Expression=" + expressions[i], force=True)
            alone = content("alone/torque.csv")
            same(alone.count("\n"), 9)
            same(content(place + "/torque.csv"), alone)
            assert "shared_set_up" in content(place + "/summary.json") and "shared_set_up" not in content("alone/summary.json")


class Waiting(Variant):
    """A variant that is not run."""

    def __init__(self, name, changes, repetitions=1):
        entries = _debond.changed(_debond.read_file("block.prm"), list(changes))
        self.name, self.scene, self.n_repetitions = name, _debond.Scene(entries, "block.prm", _debond.Team(0)), repetitions


SMALL = ("Bone/Cells=6, 6, 1", "Bone/Material=linear", "Implant/Cells=2, 1", "Implant/Material=linear", "Expert/Interface/Quadrature points=2")
SPLINES = ("Bone/Element=spline", "Bone/Cells=16, 16, 1", "Bone/Material=linear", "Implant/Cells=2, 1", "Implant/Material=linear",
           "Expert/Interface/Quadrature points=4")


def check_queue():
    """Variants with the same bodies follow each other and have them; those that are repeated build their own."""
    waiting = [Waiting(name, ["Bone/Cells=" + cells], repetitions) for name, cells, repetitions in (
        ("a", "15, 15, 2", 1), ("b", "13, 13, 2", 1), ("c", "11, 11, 1", 2), ("d", "15, 15, 2", 1), ("e", "13, 13, 2", 1),
        ("f", "11, 11, 1", 2), ("g", "9, 9, 1", 1))]
    queue, found = Queue(waiting, 2), []
    while queue.groups:
        found.append(queue.next())
    same([one.name for one, _ in found], ["a", "d", "b", "e", "c", "f", "g"])
    same([bodies is not None for _, bodies in found], [True] * 4 + [False] * 3)
    assert found[0][1] is found[1][1] and found[2][1] is found[3][1] and found[1][1] is not found[2][1] and queue.bodies is None


def check_what_is_shared():
    def share(change, entries=SMALL):
        keys = {_debond.what_bodies_depend_on(Waiting("", changes).scene) for changes in (entries, [*entries, change])}
        assert "" not in keys
        return len(keys) == 1

    for change in ("Interface/Friction coefficient unbroken=1", "Interface/Normal stiffness=1000", "Interface/Bonding/Bonding degree=0.5",
                   "Load steps/Steps=1, 7", "Output/Directory=elsewhere"):
        assert share(change), change
    for change in ("Bone/Young modulus=17000", "Expert/Bone/Layer grading=1.5", "Implant/Young modulus=100000", "Implant/Height=2",
                   "Implant/Radius=2", "Implant/Cells=3, 1", "Expert/Interface/Slave=bone", "Expert/Interface/Quadrature points=3",
                   "Chuck/Translation x/Value=0.1 + t"):
        assert not share(change), change
    # whether the lattice solver takes the bone depends on what moves the implant
    assert share("Chuck/Rotation z/Value=t", SPLINES)
    for change in ("Chuck/Translation x/Value=3 * max(t - 1, 0)", "Chuck/Translation x/Control=force", "Load steps/Path following=slip"):
        assert not share(change, SPLINES), change


def check_reference():
    """Torques of the opposite sign are said before anything is run, once."""
    write("opposite.csv", "angle_deg,torque_Nmm\n" + "".join(f"{i},{-30 * (1 - 0.01 * (i - 5) ** 2)}\n" for i in range(1, 11)))
    said, code = debond("--check", "coin.prm", "--set", "Output/Reference curve=opposite.csv", "--set", "Bone/Young modulus={{17000|18000}}")
    same(said.splitlines(), ["2 variants", "variant-001: Bone / Young modulus = 17000",
                             "warning: opposite.csv: the torques of the reference curve have the opposite sign: a minus before their "
                             "unit, as in [-N m], turns them", "variant-002: Bone / Young modulus = 18000"])
    same(code, 0)


shutil.rmtree(scratch, ignore_errors=True)
os.makedirs(scratch)
os.chdir(scratch)
write("coin.prm", COIN)
write("block.prm", BLOCK)
check_variants()
check_what_is_shared()
check_queue()
check_reference()
check_repetitions()
check_table()
check_lacking()
check_errors()
check_shared_bodies()
