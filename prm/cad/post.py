#!/usr/bin/env python3
"""Writes post.step: a rectangular implant with rounded edges along z and a flat bottom, 2.6 x 1.4 x 1.8 mm, its top at z = 0. The shape is
made up; the implants of animal tests of osseointegration are like it. Needs Gmsh (apt install python3-gmsh).

    prm/cad/post.py
    python3 -m debond mesh prm/cad/post.step --bone 8x8x4 --out prm/cad/post
"""
import os

import gmsh

WIDTH, BREADTH, HEIGHT, EDGE = 2.6, 1.4, 1.8, 0.35  # mm

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
post = gmsh.model.occ.addBox(-WIDTH / 2, -BREADTH / 2, -HEIGHT, WIDTH, BREADTH, HEIGHT)
gmsh.model.occ.synchronize()
upright = [tag for _, tag in gmsh.model.getEntities(1) if gmsh.model.getBoundingBox(1, tag)[5] - gmsh.model.getBoundingBox(1, tag)[2] > HEIGHT / 2]
gmsh.model.occ.fillet([post], upright, [EDGE])
gmsh.model.occ.synchronize()
gmsh.write(os.path.join(os.path.dirname(os.path.abspath(__file__)), "post.step"))
gmsh.finalize()
