"""The table of influence: each entry that a scene accepts is changed alone, and a result changes, or the program refuses the
value, or warns of it. In runs these are rows and summary, in fits the predicted and measured values and their weights.

    PYTHONPATH=python python3 tests/python/influence.py SOURCE [broad | some [KIND ...]]

SOURCE: where doc/reference/parameters.md says what entries allow. broad: all kinds of scenes, with bodies that deform. KIND: only
these, as "fit of pull"
"""

import importlib
import os
import re
import sys
import tempfile

import numpy

import debond

fits = importlib.import_module("debond.fit")  # the module, not the function

# What only makes the same result faster, says where it goes, or is read after the search.
OTHERS = ("Title|Task|Output / (?!Observed|Friction energy)|Study / |Load steps / (Smallest step|Residual)|.* / Solver"
          "|Calibration / (Starts|Largest misfit|Profiles|Smallest share)")
COIN = f"include {os.path.dirname(os.path.abspath(__file__))}/../coin.prm\n"
RIGID = COIN + "subsection Bone\nset Material = rigid\nset Cells = 4, 4, 1\nend\nsubsection Implant\nset Material = rigid\nset Cells = 2, 1\nend\n"
LINEAR = RIGID.replace("rigid", "linear")
PRESSED = "subsection Chuck\nsubsection Press\nset Value = 0.0049 * min(t, 1)\nend\nsubsection {}\nset Value = {} * max(t - 1, 0)\nend\nend\n"
STEPS = "subsection Load steps\nset Times = 0, 1, 2\nset Steps = 1, 6\nend\n"
ADHESIVE = "subsection Interface\nset Law = adhesive\nsubsection Adhesive\nset Strength = 5\nset Gap at strength = 0.005\nend\nend\n"
PIN = (COIN + "subsection Bone\nset Shape = sleeve\nset Outer radius = 6\nset Material = rigid\nset Cells = 12, 1, 1\nend\nsubsection Implant\n"
       "set Shape = pin\nset Radius = 2\nset Height = 5\nset Material = rigid\nset Cells = 12, 1, 1\nend\n"
       "subsection Interface\nset Interference = 0.02\nend\nsubsection Chuck\nsubsection Rotation z\nset Value = 2 * t\nend\nend\n"
       "subsection Load steps\nset Times = 0, 1\nset Steps = 6\nend\n")
LAWS = {"coulomb": "set Friction law = coulomb\n", "frictionless": "set Friction law = frictionless\n",
        "rate and state": "set Friction law = rate and state\n", "mixed mode": "set Law = mixed mode\n", "dilatant": "set Law = dilatant\n"}
TWISTED = PRESSED.format("Rotation z", "2") + STEPS
PULL = "subsection Chuck\nsubsection Translation z\nset Value = 0.02 * t\nend\nend\nsubsection Load steps\nset Times = 0, 1\nset Steps = 6\nend\n"
RUNS = {"coin": RIGID + TWISTED, "pulled": RIGID + ADHESIVE + PULL}
BROAD_RUNS = {"pin": PIN, "foundation": "set Model = foundation\n" + RIGID + TWISTED, "linear coin": LINEAR + TWISTED, "linear coin, adaptive": (LINEAR + TWISTED).replace("1, 6", "1, 6\nset Adaptive = true"),
              "crack": "set Model = crack\n" + RIGID + TWISTED, "prescribed angles": "set Model = prescribed angles\n" + RIGID + TWISTED,
              "random patches": RIGID + TWISTED + "subsection Interface\nsubsection Bonding\nset Pattern = random\nset Bonded fraction = 0.5\nend\nend\n",
              "disk": RIGID + TWISTED + "subsection Interface\nsubsection Bonding\nset Pattern = disk\nset Bonded fraction = 0.5\nend\nend\n",
              "pulled by a soft machine": RIGID + ADHESIVE + PULL.replace("0.02 * t", "0.02 * t\nset Stiffness = 1e5"),
              "coulomb, along a path": RIGID + TWISTED.replace("1, 6", "1, 6\nset Path following = slip") +
              "subsection Expert\nsubsection Load steps\nset Path ends at slip = 0.002\nend\nend\n"
              f"subsection Interface\n{LAWS['coulomb']}end\n",
              **{law: RIGID + TWISTED + f"subsection Interface\n{text}end\n" for law, text in LAWS.items()}}
# scene, Over, Curves
FITS = {"torque": (RIGID + TWISTED, "auto", "auto"), "torque and force": (RIGID + TWISTED, "auto", "torque_Nmm, chuck_Fz_N"),
        "pull": (RIGID + ADHESIVE + PULL, "auto", "auto"),
        "pull by a soft machine": (RUNS["pulled"].replace("0.02 * t", "0.02 * t\nset Stiffness = 1e5"), "machine_uz_mm", "auto"),
        "pin": (PIN, "auto", "auto"), "tilt": (RIGID + PRESSED.format("Rotation y", "0.02") + STEPS + "subsection Output\nset Curve = Rotation y, Moment y\nend\n", "auto", "auto"),
        "angle over time": (RIGID + TWISTED, "time", "chuck_rz_deg"), "clockwise": (RIGID + TWISTED.replace("2 * max", "-2 * max"), "auto", "auto"),
        "foundation": (BROAD_RUNS["foundation"], "auto", "auto")}
# What scenes do not come to: nothing opens while it is pressed, what looks the same from all sides stays on its axis, and what is
# pulled straight off slides nowhere, and is not pressed.
OPENS = "Interface / Opening breaks bond|Output / Friction energy"
ON_AXIS = OPENS + "|Chuck / (Translation|Rotation) [xy] / (Control|Stiffness)"
SLIDES_NOWHERE = "Output / Friction energy|Interface / (Characteristic|Friction coefficient|Transition|Crushing|Bone shear)"
ONE_LAYER = ON_AXIS + "|(Bone|Implant) / Layer grading"
STATE = {"linear coin": ONE_LAYER, "linear coin, adaptive": ONE_LAYER,
         "random patches": OPENS,
         "foundation": ON_AXIS + "|Interface / Bonding / Pattern",  # a disk is the whole face
         # nothing pushes along the axis, and the sleeve is rigid
         "pin": ON_AXIS + "|Chuck / (Press|Translation z) / (Control|Stiffness)|Bone / (Ends|Outer radius)",
         "frictionless": ON_AXIS + "|Bone / Cells",  # rigid and plane
         "mixed mode": ON_AXIS + "|Interface / Mixed mode / (Criterion|Exponent|Normal)",  # of one mode
         "pulled": SLIDES_NOWHERE + "|Chuck / (Translation [xy]|Rotation [xyz]) / (Control|Stiffness)",
         "pulled by a soft machine": SLIDES_NOWHERE}  # others: ON_AXIS
failures = []


def allowed_values(source):
    """{entry: what it allows}, from the reference."""
    with open(os.path.join(source, "doc", "reference", "parameters.md"), encoding="utf-8") as file:
        return dict(re.findall(r"^### (.*)\n(?:\n|- Default.*\n)*- Allowed: (.*)", file.read(), re.M))


def candidates(allowed, value):
    """Other values to try in turn."""
    if "expression in t" in allowed:
        return [f"({value}) * 1.1"] * (value != "0") + [f"({value}) + 1e-4 * t"]
    result = [choice for choice in re.findall("`([^`]*)`", allowed) if choice != value] if "`" in allowed else []
    numbers = re.findall(r"[-+0-9.e]+", value) if re.fullmatch(r"[-+0-9.e, ]+", value) else []
    whole = "whole number" in allowed
    for factor in (1.1, 0.9, 2, 0.5) if any(float(number) for number in numbers) else ():
        changed = [float(number) * factor for number in numbers]
        result.append(", ".join(str(round(one + 0.5 * (factor > 1))) if whole else f"{one:.6g}" for one in changed))
    return result + ["1", "2", "3", "0.5", "0.1", "0.01", "1e-3", "1e-4", "0, 0.5", "1, 1.5", "0, 0.007", "0, 0, 1", "missing.csv", "1, 2", "chuck_Mx_Nmm", "x"]


def is_same(a, b):
    return a.keys() == b.keys() and all(numpy.array_equal(a[name], b[name], equal_nan=True) for name in a)


def result_of_run(text, entries):
    """Numbers, and warnings."""
    result = debond.Scene(None, entries, text=text).run()
    numbers = {**result.rows, **{name: value for name, value in result.summary.items() if isinstance(value, float)}}
    for name in ("wall_seconds", "peak_memory_MB"):
        numbers.pop(name, None)
    return numbers, result.warnings


def result_of_fit(text, entries):
    problem = fits.problem_of(debond.Scene(None, entries, text=text))
    curve = problem.curves([problem.unknowns.starts], not problem.why_no_closed_form)[0]
    if curve is None:
        raise debond.RunError(problem.runs.last_failure)
    experiment = problem.experiments[0]
    numbers = {"curve": curve, "measured": problem.measured, "weights": problem.weights, "weights of measure": problem.weights_of_measure}
    return numbers, [*experiment.scene.warnings, *experiment.remarks]


def check(kind, text, given, result_of, allowed):
    """Changes each entry of a scene alone."""
    known = {name: value for name, value in given.items() if "<<" not in str(value) and "Reference" not in name}
    values = debond.Scene(None, known, text=text)._read(debond.scene._team(None)).values
    base, _ = result_of(text, given)
    n = 0
    for entry, value in values.items():
        plain = entry.replace("Expert / ", "")
        general = re.sub("Chuck / (Translation|Rotation) .", r"Chuck / \1 x", entry)
        if re.match(OTHERS, plain) or re.match(STATE.get(kind, ON_AXIS), plain) or (result_of is result_of_fit and not plain.startswith("Calibration / ")):
            continue
        assert general in allowed, f"{entry} is not in the reference"
        has_no_effect = ""
        for other in candidates(allowed[general], value):
            if other == value:
                continue
            try:
                numbers, warnings = result_of(text, {**given, entry.replace(" / ", "/"): other})
            except (debond.SceneError, debond.RunError):
                continue  # refused, or it ends loudly
            is_warned = any(f"{entry} = " in warning for warning in warnings)
            if not is_same(numbers, base) and any(f"{entry} = " in warning and "has no effect" in warning for warning in warnings):
                failures.append(f"{kind}: {entry} = {other} (it was {value}) has an effect, and a warning says that it has none")
            if not is_same(numbers, base) or is_warned:
                has_no_effect = ""
                break
            has_no_effect = has_no_effect or f"{kind}: {entry} = {other} (it was {value})"
        n += 1
        failures.extend([has_no_effect] * bool(has_no_effect))
    print(f"{kind}: {n} entries", flush=True)


def fit_of(kind, text, over, curves):
    """Entries of a fit, and its measured curve, written from a run."""
    scene = debond.Scene(None, {"Calibration/Over": over, "Calibration/Curves": curves}, text=text)
    axes = scene._read(debond.scene._team(None)).curve
    names = [axes[0] if over == "auto" else over, *(axes[1:] if curves == "auto" else curves.split(", "))]
    rows = debond.Scene(None, {"Interface/Normal stiffness": 500}, text=text).run().rows
    moving = rows["time"] > rows["time"][-1] - 0.99
    columns = numpy.column_stack([rows[name][moving] for name in names])
    numpy.savetxt(f"{kind}.csv", columns, "%.15g", ",", header=",".join(names), comments="")
    return {"Task": "calibrate", "Interface/Normal stiffness": "<<eps: 400 in 100..3000 log>>", "Output/Reference curve": f"{kind}.csv",
            "Calibration/Over": over, "Calibration/Curves": curves}


def main():
    source, broad, only = os.path.abspath(sys.argv[1]), sys.argv[2:3] == ["broad"], sys.argv[3:]
    allowed = allowed_values(source)
    with tempfile.TemporaryDirectory() as directory:
        os.chdir(directory)
        for kind, text in {**RUNS, **(BROAD_RUNS if broad else {})}.items():
            if only and kind not in only:
                continue
            check(kind, text, {}, result_of_run, allowed)
        for kind, (text, over, curves) in FITS.items():
            if only and f"fit of {kind}" not in only:
                continue
            check(f"fit of {kind}", text, fit_of(kind, text, over, curves), result_of_fit, allowed)
    sys.exit("\n".join(["changed alone these change nothing, and nothing says so, or what is said is false:", *failures]) if failures else 0)


main()
