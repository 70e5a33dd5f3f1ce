"""python3 -m debond mesh: volumes and areas of a post in a block against closed forms, the meshes read by debond, whose scene asks for
what is missing; bone from a file of its own, in metres, with a gap; and what is wrong is refused in words.

    mesh.py build/release/debond
"""

import contextlib
import io
import math
import os
import re
import subprocess
import sys

import gmsh

from debond import __main__ as debond

A = 2.6 * 1.4 - (4 - math.pi) * 0.35**2  # of the bottom of the post [mm^2]
SIDE = 2 * (1.9 + 0.7) + 2 * math.pi * 0.35  # around it [mm]
failed = []


def expect(is_so, what):
    print(f"{what}: {'yes' if is_so else 'NO'}")
    if not is_so:
        failed.append(what)


def say(*words):
    """What a command says, and its exit code."""
    text = io.StringIO()
    with contextlib.redirect_stdout(text), contextlib.redirect_stderr(text):
        code = debond.main(["mesh", *words])
    return text.getvalue(), code


def number(pattern, text):
    return float(re.search(pattern, text).group(1))


def near(value, expected):
    return abs(value / expected - 1) < 1e-3  # as it is printed


def write(name, make, unit="MM"):
    """A STEP file of what `make` adds."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    make(gmsh.model.occ)
    gmsh.model.occ.synchronize()
    gmsh.write(name)
    gmsh.finalize()
    if unit != "MM":
        with open(name, encoding="utf-8") as file:
            text = file.read()
        with open(name, "w", encoding="utf-8") as file:
            file.write(text.replace("SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)"))


def colour(name, n, rgb):
    """Colours the n-th face of a file."""
    with open(name, encoding="utf-8") as file:
        text = file.read()
    face = re.findall(r"(#\d+) = ADVANCED_FACE", text)[n]
    context = re.search(r"(#\d+) = \( ?GEOMETRIC_REPRESENTATION_CONTEXT", text).group(1)
    style = (f"STYLED_ITEM('',(#9001),{face})", "PRESENTATION_STYLE_ASSIGNMENT((#9002))", "SURFACE_STYLE_USAGE(.BOTH.,#9003)", "SURFACE_SIDE_STYLE('',(#9004))",
             "SURFACE_STYLE_FILL_AREA(#9005)", "FILL_AREA_STYLE('',(#9006))", "FILL_AREA_STYLE_COLOUR('',#9007)", f"COLOUR_RGB('',{rgb})",
             f"MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#9000),{context})")
    head, end = text.rsplit("ENDSEC;", 1)
    with open(name, "w", encoding="utf-8") as file:
        file.write(head + "".join(f"#{9000 + i} = {one};\n" for i, one in enumerate(style)) + "ENDSEC;" + end)


def main(program, post) -> int:
    text, code = say(post, "--bone", "8x8x4", "--out", "post")
    expect(code == 0, "a post in a block")
    expect(near(number(r"implant: (\S+) mm", text), 1.8 * A), "volume of the post")
    expect(near(number(r"bone: (\S+) mm", text), 256 - 1.8 * A), "volume of the bone")
    for body in ("implant", "bone"):
        expect(near(number(body + r":.* contact (\S+) mm", text), A + 1.8 * SIDE), f"contact face of the {body}")
    expect(near(number(r"implant:.* held (\S+) mm", text), A), "top of the post")
    expect(near(number(r"bone:.* held (\S+) mm", text), 64 + 4 * 32), "bottom and sides of the bone")
    with open("post.prm", encoding="utf-8") as file:
        expect("set Coarser mesh file = post_bone_coarser.msh" in file.read(), "the scene names larger cells for the error")
    expect(2 * os.path.getsize("post_bone_coarser.msh") < 1.5 * os.path.getsize("post_bone.msh"), "which are fewer")
    checked = subprocess.run([program, "post.prm", "--check"], capture_output=True, text=True, check=False)
    expect(checked.returncode == 1 and "  set Young modulus =" in checked.stderr and "15000 to 23000" in checked.stderr, "the scene asks for what is missing")
    complete = [program, "post.prm", "--check", *(word for entry in (
        "Bone/Young modulus=1000", "Interface/Normal stiffness=600", "Interface/Friction coefficient broken=0.3",
        "Interface/Friction coefficient unbroken=0.5", "Interface/Characteristic slip distance=0.02", "Interface/Bonding/Bonding degree=1", "Interface/Adhesive/Strength=2",
        "Interface/Adhesive/Gap at strength=0.01") for word in ("--set", entry))]
    checked = subprocess.run(complete, capture_output=True, text=True, check=False)
    if checked.returncode:
        print(checked.stderr)
    expect(checked.returncode == 0, "and is complete with it")
    checked = subprocess.run([*complete, "--set", "Expert/Bone/Coarser mesh file=none"], capture_output=True, text=True, check=False)
    expect("expected a file, as the other body has one" in checked.stderr, "larger cells of one body alone are refused")

    write("peg.step", lambda occ: occ.addCylinder(0, 0, -3, 0, 0, 4, 1), "M")

    def bone(occ):
        occ.cut([(3, occ.addBox(-3, -3, -5, 6, 6, 5))], [(3, occ.addCylinder(0, 0, -3, 0, 0, 4, 1))])

    write("bone.step", bone)
    text, code = say("peg.step", "bone.step", "--out", "peg", "--size", "0.4")
    expect(code == 1 and "warning: peg.step is 4000 mm long" in text, "a file in metres is noticed")
    write("peg.step", lambda occ: occ.addCylinder(0, 0, -3, 0, 0, 4, 1))
    text, code = say("peg.step", "bone.step", "--out", "peg", "--size", "0.4")
    expect(code == 0 and near(number(r"implant:.* contact (\S+) mm", text), math.pi * (1 + 2 * 3)), "bodies of two files that touch")

    write("ball.step", lambda occ: occ.fuse([(3, occ.addCylinder(0, 0, -3, 0, 0, 4, 1))], [(3, occ.addSphere(0, 0, 1, 1.4))]))
    text, code = say("ball.step", "--bone", "6x6x5", "--depth", "3", "--held", "above=0", "--out", "ball")
    ball = 2 * math.pi * 1.4 * (1.4 + math.sqrt(1.4**2 - 1))  # without the cap in the peg
    expect(code == 0 and near(number(r"implant:.* held (\S+) mm", text), ball + 2 * math.pi * (1 - math.sqrt(1.4**2 - 1))), "a round head held above a plane")
    write("boss.step", lambda occ: occ.fuse([(3, occ.addBox(-3, -3, -6, 6, 6, 5))], [(3, occ.addBox(-2, -3, -1, 4, 6, 1))]))
    text, code = say("peg.step", "boss.step", "--out", "boss")
    expect(code == 0 and near(number(r"bone:.* held (\S+) mm", text), 36 + 4 * 30 + 2 * 4), "upright faces are sides, a shoulder is none")
    write("spline.step", lambda occ: occ.dilate([(3, occ.addCylinder(0, 0, -3, 0, 0, 4, 1))], 0, 0, 0, 0.9999, 1, 1))
    text, code = say("spline.step", "--bone", "6x6x5", "--depth", "3", "--held", "above=0", "--out", "spline")
    expect(code == 0 and "2 x 2 x 4 mm" in text and near(number(r"bone:.* held (\S+) mm", text), 36 + 4 * 30), "a spline has the size of its points")
    text, code = say("peg.step", "--bone", "60x60x50", "--depth", "30", "--scale", "10", "--out", "large")
    expect(code == 0 and near(number(r"implant: (\S+) mm", text), 4000 * math.pi), "a file in another unit")
    text, code = say("peg.step", "--bone", "6x6x5", "--depth", "3", "--size", "0.03", "--out", "fine")
    expect(code == 1 and "expected a larger --size" in text, "cells that are too many")
    colour("peg.step", 1, "1.,0.,0.")
    text, code = say("peg.step", "--bone", "6x6x5", "--depth", "3", "--held", "colour=ff0000", "--out", "red")
    expect(code == 0 and near(number(r"implant:.* held (\S+) mm", text), math.pi), "the face of a colour held")

    text, code = say("peg.step", "--bone", "6x4", "--bone-held", "sides", "--out", "through")
    expect(code == 0 and near(number(r"bone:.* contact (\S+) mm", text), 8 * math.pi), "a hole all the way through")

    write("two.step", lambda occ: (occ.addBox(0, 0, 0, 1, 1, 1), occ.addBox(3, 0, 0, 1, 1, 1)))
    write("far.step", lambda occ: occ.addBox(50, 0, 0, 1, 1, 1))
    with open("no.step", "w", encoding="utf-8") as file:
        file.write("solid\n")
    for words, why in (((post,), "there is no bone"), ((post, "--bone", "8by8"), "a length in mm"), (("two.step", "--bone", "8x8x4"), "2 solids"),
                       (("gone.step", "--bone", "8x8x4"), "a STEP file that is there"), (("no.step", "--bone", "8x8x4"), "cannot be read"),
                       ((post, "far.step"), "bodies in place"), ((post, "--bone", "8x8x4", "--held", "roof"), "top, bottom"),
                       ((post, "--bone", "8x8x4", "--held", "bottom"), "none that is flat"),
                       ((post, "--bone", "8x8x4", "--out", "gone/post"), "a directory that is there"), ((post, "peg.step", "--bone", "8x8x4"), "no block beside"),
                       ((post, "--bone", "8x8x4", "--held", "above=x"), "a place along z"), ((post, "--bone", "8x8x4", "--held", "colour=00ff00"), "have no colour"), ((post, "--bone", "1x1x1"), "")):
        text, code = say("--out", "wrong", *words)
        expect(code == 1 and why in text and text.count("\n") <= 4, " ".join(map(os.path.basename, words)))
    return len(failed)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
