"""Every shape of implant is fitted to every curve that it has: the curve of a scene with a known interface, of rigid bodies on
few cells, gives the stiffness of that interface back; and --check says how the fit will go.

    PYTHONPATH=python python3 tests/python/fits_of_shapes.py
"""

import importlib
import os
import sys
import tempfile

import numpy

import debond
from debond.calibrate import check_lines

fits = importlib.import_module("debond.fit")  # the module, not the function
TRUTH = 585
SLEEVE = "set Shape = sleeve\nset Outer radius = 6\nset Cells = 12, 1, 2\n"
BLOCK = "set Cells = 4, 4, 1\n"
# of each shape: entries of the implant, of the bone, and of the interface
SHAPES = {
    "coin": ("set Cells = 3, 1\n", BLOCK, ""),
    "ring": ("set Shape = ring\nset Inner radius = 1\nset Cells = 12, 1, 1\n", BLOCK, ""),
    "block": ("set Shape = block\nset Size = 3, 3, 3\nset Cells = 3, 3, 1\n", BLOCK, ""),
    "cap": ("set Shape = cap\nset Cap radius = 200\nset Cells = 3, 1\n", BLOCK, ""),
    "pin": ("set Shape = pin\nset Radius = 2\nset Height = 5\nset Cells = 12, 1, 2\n", SLEEVE, "set Interference = 0.02\n"),
    "taper": ("set Shape = taper\nset Radius = 2\nset Height = 5\nset Taper angle = 3\nset Cells = 12, 1, 2\n", SLEEVE + "set Height = 5\n",
              "set Interference = 0.02\n"),
    "screw": ("set Shape = screw\nset Radius = 2\nset Height = 4\nset Pitch = 1\nset Thread depth = 0.3\nset Cells = 16, 1, 16\n",
              "set Shape = sleeve\nset Outer radius = 6\nset Cells = 16, 1, 16\n", "set Interference = 0.02\n"),
    "cup": ("set Shape = cup\nset Radius = 26\nset Height = 26\nset Cells = 12, 1, 2\n",
            "set Shape = cavity\nset Outer radius = 36\nset Cells = 12, 1, 2\n", "set Interference = 0.02\n"),
}
# of each curve: what moves the chuck beside the push on a flat bone
CURVES = {
    "Rotation z, Moment z": ("Rotation z", "0.5 * max(t - 1, 0)"),
    "Translation z, Force z": ("Translation z", None),
    "Translation x, Force x": ("Translation x", "0.005 * max(t - 1, 0)"),
    "Rotation y, Moment y": ("Rotation y", "0.02 * max(t - 1, 0)"),
}
COIN = f"include {os.path.dirname(os.path.abspath(__file__))}/../coin.prm\n"
LAWS = {"friction": "", "adhesive": "set Law = adhesive\nsubsection Adhesive\nset Strength = 5\nset Gap at strength = 0.005\nend\n"}


def section(name, text):
    return f"subsection {name}\nset Material = rigid\n{text}end\n"


def scene_of(shape, curve, law):
    implant, bone, interface = SHAPES[shape]
    component, value = CURVES[curve]
    is_flat = not interface
    push = "-0.01 * min(t, 1)" if is_flat else "0"
    pull = f"{push} + 0.012 * max(t - 1, 0)"  # off the bone, in the end
    chuck = f"subsection Translation z\nset Value = {push if value else pull}\nend\n" + (
        f"subsection {component}\nset Value = {value}\nend\n" if value else "")
    return (COIN + section("Bone", bone) + section("Implant", implant) + f"subsection Chuck\n{chuck}end\n"
            f"subsection Interface\n{interface}{LAWS[law]}end\nsubsection Load steps\nset Times = 0, 1, 2\nset Steps = 2, 12\nend\n"
            f"subsection Output\nset Curve = {curve}\nend\n")


def check(shape, curve, law):
    """What is wrong with the fit of one curve, or nothing."""
    text = scene_of(shape, curve, law)
    scene = debond.Scene(None, {"Interface/Normal stiffness": TRUTH}, text=text)
    over, load = scene._read(debond.scene._team(None)).curve
    result = scene.run()
    rows = result.rows
    turning = rows["time"] > 1
    numpy.savetxt("curve.csv", numpy.column_stack([rows[name][turning] for name in (over, load)]), "%.15g", ",", header=f"{over},{load}",
                  comments="")
    unknown = debond.Scene(None, {"Interface/Normal stiffness": "<<eps: 400 in 100..3000 log>>", "Output/Reference curve": "curve.csv",
                                  "Expert/Calibration/Starts": 2}, text=text)
    problem = fits.problem_of(unknown)
    closed = not problem.why_no_closed_form
    says = "\n".join(check_lines(problem))
    if closed != ("searched with the closed form first" in says) or closed != (shape == "coin" and "Moment z" in curve and law == "friction"):
        return f"--check says {says}"
    best = fits.find_optima(problem)[0][0]
    return "" if abs(best.values[0] / TRUTH - 1) < 1e-3 and best.converged else f"{best.values[0]}, expected {TRUTH}"


def main():
    failures = []
    with tempfile.TemporaryDirectory() as directory:
        os.chdir(directory)
        for law in LAWS:
            for shape in SHAPES:
                for curve in CURVES if law == "friction" else list(CURVES)[:2]:
                    try:
                        why = check(shape, curve, law)
                    except (debond.SceneError, debond.RunError) as error:
                        why = str(error)
                    print(f"{shape}, {curve}, {law}: {why or 'yes'}", flush=True)
                    failures += [f"{shape}, {curve}, {law}"] * bool(why)
    sys.exit(f"{len(failures)} fits failed: {failures}" if failures else 0)


main()
