#!/usr/bin/env python3
"""Writes tibial_peg.step: the peg below the tray of a knee's tibial component, 6 mm thick with a round tip and four fins of 1.5 mm,
15 mm long, its top at z = 0. The shape is made up. Needs Gmsh (apt install python3-gmsh).

    prm/cad/tibial_peg.py
    python3 -m debond mesh prm/cad/tibial_peg.step --bone 30x20 --out prm/cad/tibial_peg
"""
import math
import os

import gmsh

RADIUS, LENGTH, FINS, WIDTH, DEPTH = 3, 12, 12, 1.5, 9  # to the tip's centre; from fin to fin, of a fin, and how deep it is [mm]

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
occ = gmsh.model.occ
parts = [(3, occ.addSphere(0, 0, -LENGTH, RADIUS))]
for angle in (0, math.pi / 2):
    parts.append((3, occ.addBox(-FINS / 2, -WIDTH / 2, -DEPTH, FINS, WIDTH, DEPTH)))
    occ.rotate(parts[-1:], 0, 0, 0, 0, 0, 1, angle)
occ.fuse([(3, occ.addCylinder(0, 0, -LENGTH, 0, 0, LENGTH, RADIUS))], parts)
occ.synchronize()
gmsh.write(os.path.join(os.path.dirname(os.path.abspath(__file__)), "tibial_peg.step"))
gmsh.finalize()
