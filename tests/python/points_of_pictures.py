#!/usr/bin/env python3
"""Sums over points.pvd are the columns of torque.csv: what the code of doc/howto/paraview.md reads, and profiles.csv.

    points_of_pictures.py DEBOND TOP SCRATCH

Over shapes, slaves, laws and motions; 1e-6 of the sum of magnitudes is what numbers of 7 digits allow."""
import csv
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import numpy as np

program, top, scratch = map(os.path.abspath, sys.argv[1:])
os.chdir(top)
with open("doc/howto/paraview.md", encoding="utf-8") as page:
    recipe = re.search(r"^```python\n(.*?)^points = ", page.read(), re.M | re.S)[1]
exec(recipe)

COARSE = {"Bone/Cells": "10, 10, 3", "Implant/Cells": "3, 2", "Load steps/Steps": "1, 5", "Load steps/Adaptive": "false", "Output/Fields every": 2}
TURNED = {"Chuck/Rotation z/Value": "4 * max(t - 1, 0)"}
SHEARED = {**TURNED, "Chuck/Translation x/Value": "0.02 * max(t - 1, 0)", "Chuck/Rotation y/Value": "0.05 * max(t - 1, 0)",
           "Chuck/Point": "0.4, -0.3, 2"}
BONE = {"Expert/Interface/Slave": "bone"}
PATCHES = {"Interface/Bonding/Pattern": "random", "Interface/Bonding/Bonded fraction": 0.55}
PIN = {"Output/Fields every": 2, "Load steps/Steps": 3}
CASES = [("prm/coin_mode3_fast.prm", {**COARSE, **TURNED}), ("prm/coin_mode3_fast.prm", {**COARSE, **SHEARED, **PATCHES}),
         ("prm/coin_mode3_fast.prm", {**COARSE, **SHEARED, **BONE}), ("prm/coin_mode3_spline.prm", {**COARSE, **TURNED, "Implant/Cells": "4, 2"}),
         ("prm/shapes/pin_twisted.prm", PIN), ("prm/shapes/pin_twisted.prm", {**PIN, **BONE}), ("prm/adhesion/mixed_mode.prm", {}),
         ("prm/adhesion/mixed_mode.prm", BONE), ("prm/adhesion/coin_peeled.prm", {"Output/Fields every": 10})]


def columns(file):
    with open(file, encoding="utf-8") as table:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(line for line in table if line[0] != "#")]


def compare(case, what, parts, expected):
    """Sums over the rows of parts against what torque.csv has."""
    global worst
    off = np.abs(parts.sum(axis=0) - expected) / max(np.abs(parts).sum(), 1e-6)
    worst = max(worst, np.max(off))
    if not np.max(off) < 1e-6:
        sys.exit(f"{case}: {what}: {parts.sum(axis=0)} and {expected}, off by {np.max(off):.1e} of the sum of magnitudes")


for scene, changes in CASES:
    worst, n_files = 0., 0
    shutil.rmtree(scratch, ignore_errors=True)
    changes = {**changes, "Output/Report": "false", "Expert/Output/Profile angles": 1.6, "Output/Directory": scratch, "Expert/Output/Console": "quiet"}
    command = [program, scene] + [word for entry in changes.items() for word in ("--set", "%s=%s" % entry)]
    if subprocess.run(command, check=False).returncode:
        sys.exit("this failed: %s" % command)
    rows = columns(scratch + ("/torque.csv" if os.path.exists(scratch + "/torque.csv") else "/reactions.csv"))
    for one in ElementTree.parse(scratch + "/points.pvd").iter("DataSet"):
        row = min(rows, key=lambda row: abs(row["time"] - float(one.get("timestep"))))
        points, n_files = arrays_of(scratch + "/" + one.get("file")), n_files + 1
        area = points["area_mm2"]
        compare(scene, "force", points["force_N"], [row[f"chuck_F{k}_N"] for k in "xyz"])
        compare(scene, "moment", points["moment_Nmm"], [row[f"chuck_M{k}_Nmm"] for k in "xyz"])
        compare(scene, "energy", points["energy_Nmm"], row["energy_interface_Nmm"])
        if changes.get("Expert/Interface/Slave") != "bone":  # means are those over the implant's face
            compare(scene, "bonding", area * points["phi"] / area.sum(), row["phi_mean"])
            compare(scene, "sliding", area * (points["state"] == 2) / area.sum(), row["share_slip"])
    if os.path.exists(scratch + "/profiles.csv") and "coin_mode3" in scene and "Chuck/Point" not in changes:
        lines = columns(scratch + "/profiles.csv")
        row = next(row for row in rows if row["angle_deg"] == lines[0]["angle_deg"])
        compare(scene, "profile", np.array([line["pressure_MPa"] * line["area_mm2"] for line in lines]), row["force_N"])
    print(f"{scene}, {n_files} files, off by {worst:.1e} at most")
    if n_files < 2:
        sys.exit("too few files")
