#!/usr/bin/env python3
"""Writes threaded.step: a dental implant, a core of 3.2 mm and 7 mm long, with a right-handed thread of 4 turns, pitch 1.2 mm, to a
diameter of 4 mm, the flanks inclined by 32 degrees, its top at z = 0. The shape is made up. Needs Gmsh (apt install python3-gmsh).

    prm/cad/threaded.py
    python3 -m debond mesh prm/cad/threaded.step --bone 10x10x9 --size 1 --out prm/cad/threaded
"""
import math
import os

import gmsh

CORE, LENGTH, PITCH, TURNS, BOTTOM = 1.6, 7.0, 1.2, 4, -6.1  # radius, ..., height where the thread begins [mm]
INNER = CORE - 0.1  # the thread begins within the core
PROFILE = (INNER, -0.4), (2.0, -0.15), (2.0, 0.15), (INNER, 0.4)  # radius and height [mm]
PER_TURN = 8  # points of the helix

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
occ = gmsh.model.occ
turns = [k / PER_TURN for k in range(PER_TURN * TURNS + 1)]
helix = occ.addSpline([occ.addPoint(INNER * math.cos(2 * math.pi * t), INNER * math.sin(2 * math.pi * t), BOTTOM + PITCH * t) for t in turns])
corners = [occ.addPoint(r, 0, BOTTOM + z) for r, z in PROFILE]
sides = [occ.addLine(corners[i], corners[(i + 1) % 4]) for i in range(4)]
section = occ.addPlaneSurface([occ.addCurveLoop(sides)])
thread = occ.addPipe([(2, section)], occ.addWire([helix]), "Frenet")
core = occ.addCylinder(0, 0, -LENGTH, 0, 0, LENGTH, CORE)
occ.rotate([(3, core)], 0, 0, 0, 0, 0, 1, 1)  # its seam away from the ends of the thread
(_, implant), = occ.fuse([(3, core)], thread)[0]
occ.synchronize()
own = {face for _, face in gmsh.model.getBoundary([(3, implant)], oriented=False)}
occ.remove([(2, face) for _, face in gmsh.model.getEntities(2) if face not in own], True)  # the section
occ.synchronize()
gmsh.write(os.path.join(os.path.dirname(os.path.abspath(__file__)), "threaded.step"))
gmsh.finalize()
