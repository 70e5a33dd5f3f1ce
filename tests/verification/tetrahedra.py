#!/usr/bin/env python3
"""Writes the meshes of patch_of_tetrahedra.prm, chamfer.prm, post_of_facets.prm and pin_of_facets.prm beside this file. Needs Gmsh (apt install python3-gmsh).

Two boxes of 4 x 3 x 2 mm, one on the other, with tetrahedra of ten nodes that do not match. A bone with a hole of 3 x 2 mm, 1.5 mm
deep, and a chamfer of 0.4 mm along its side at x = 1.5 mm; a box of 2.8 x 1.8 x 1 mm above it, whose side at x = 1.7 mm is over the
chamfer: tetrahedra of four nodes. The post of prm/cad/post.step and its socket, whose rounded edges have flat facets of 9 and 7.5
degrees, four and five of them from end to end: tetrahedra of four nodes. Prisms of 24 sides around circles of radius 2 and 1.93 mm
in a hole of 17 sides and radius 2 mm, 3 mm high: of four nodes, too."""
import math
import os

import gmsh

HERE = os.path.dirname(os.path.abspath(__file__))


def write(name, make, groups, size, order, prepare=lambda: None):
    """The body that `make` adds; `groups`: of each name what a face with this centre and box is asked [mm]; `prepare` is called
    before it is filled."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    solid = make(gmsh.model.occ)
    gmsh.model.occ.synchronize()
    for option, value in (("MeshSizeMin", size), ("MeshSizeMax", size), ("ElementOrder", order)):
        gmsh.option.setNumber("Mesh." + option, value)
    gmsh.model.addPhysicalGroup(3, [solid])
    for group, is_one in groups.items():
        faces = [face for _, face in gmsh.model.getEntities(2)
                 if is_one(gmsh.model.occ.getCenterOfMass(2, face), gmsh.model.getBoundingBox(2, face))]
        gmsh.model.setPhysicalName(2, gmsh.model.addPhysicalGroup(2, faces), group)
    prepare()
    gmsh.model.mesh.generate(3)
    gmsh.write(os.path.join(HERE, name))
    gmsh.finalize()


def at(d, value):
    return lambda centre, box: abs(centre[d] - value) < 1e-3


def bone_with_chamfer(occ):
    corners = [occ.addPoint(*x) for x in ((1.5, -1, 0), (1.9, -1, 0), (1.5, -1, -0.4))]
    sides = [occ.addLine(corners[i], corners[(i + 1) % 3]) for i in range(3)]
    wedge = occ.extrude([(2, occ.addPlaneSurface([occ.addCurveLoop(sides)]))], 0, 2, 0)
    tools = [(3, occ.addBox(-1.5, -1, -1.5, 3, 2, 1.5))] + [made for made in wedge if made[0] == 3]
    left, _ = occ.cut([(3, occ.addBox(-3, -2.5, -3, 6, 5, 3))], tools)
    return left[0][1]


def post(occ):
    bottom = occ.addRectangle(-1.3, -0.7, -1.8, 2.6, 1.4, roundedRadius=0.35)
    return next(tag for dimension, tag in occ.extrude([(2, bottom)], 0, 0, 1.8) if dimension == 3)


def socket(occ):
    left, _ = occ.cut([(3, occ.addBox(-1.8, -1.2, -2.2, 3.6, 2.4, 2.2))], [(3, post(occ))])
    return left[0][1]


def prism(occ, sides, radius):
    corners = [occ.addPoint(radius * math.cos(2 * math.pi * k / sides), radius * math.sin(2 * math.pi * k / sides), -3) for k in range(sides)]
    bottom = occ.addPlaneSurface([occ.addCurveLoop([occ.addLine(corners[k - 1], corners[k]) for k in range(sides)])])
    return next(tag for dimension, tag in occ.extrude([(2, bottom)], 0, 0, 3) if dimension == 3)


def bored_box(occ):
    left, _ = occ.cut([(3, occ.addBox(-3, -3, -3, 6, 6, 3))], [(3, prism(occ, 17, 2))])
    return left[0][1]


def facets(around, along):
    """Prepares the rounded edges of the post: facets in a quarter of a circle, and from end to end."""
    for _, face in gmsh.model.getEntities(2):
        box = gmsh.model.getBoundingBox(2, face)
        if max(abs(box[3] - box[0] - 0.35), abs(box[4] - box[1] - 0.35), abs(box[5] - box[2] - 1.8)) < 1e-3:
            for _, curve in gmsh.model.getBoundary([(2, face)], oriented=False):
                ends = gmsh.model.getBoundingBox(1, curve)
                gmsh.model.mesh.setTransfiniteCurve(curve, 1 + (along if ends[5] - ends[2] > 1 else around))
            gmsh.model.mesh.setTransfiniteSurface(face)


SIDES = {f"slides {name}": lambda centre, box, d=d, width=width: abs(abs(centre[d]) - width / 2) < 1e-3 for name, d, width in (("x", 0, 4), ("y", 1, 3))}
write("patch_bone.msh", lambda occ: occ.addBox(-2, -1.5, -2, 4, 3, 2), {"contact": at(2, 0), "held": at(2, -2), **SIDES}, 1.3, 2)
write("patch_implant.msh", lambda occ: occ.addBox(-2, -1.5, 0, 4, 3, 2), {"contact": at(2, 0), "held": at(2, 2), **SIDES}, 1, 2)
write("chamfer_bone.msh", bone_with_chamfer,
      {"contact": lambda centre, box: box[0] > -1.6 and box[3] < 1.95 and box[1] > -1.01 and box[4] < 1.01, "held": at(2, -3)}, 1, 1)
write("chamfer_implant.msh", lambda occ: occ.addBox(-1.1, -0.9, 0, 2.8, 1.8, 1),
      {"contact": lambda centre, box: at(2, 0)(centre, box) or at(0, 1.7)(centre, box), "held": at(2, 1)}, 0.35, 1)
write("post_of_facets_bone.msh", socket,
      {"contact": lambda centre, box: box[2] < -1e-3 and max(abs(box[0]), abs(box[3])) < 1.31 and max(abs(box[1]), abs(box[4])) < 0.71,
       "held": at(2, -2.2)}, 0.7, 1, lambda: facets(12, 4))
write("post_of_facets_implant.msh", post, {"contact": lambda centre, box: centre[2] < -1e-3, "held": at(2, 0)}, 0.6, 1, lambda: facets(10, 5))
WALL = {"contact": lambda centre, box: box[5] - box[2] > 1 and max(map(abs, box[:2] + box[3:5])) < 2.5}
write("pin_of_facets_bone.msh", bored_box, {**WALL, "held": lambda centre, box: box[5] - box[2] > 1 and max(map(abs, box[:2] + box[3:5])) > 2.5}, 1.5, 1)
write("pin_of_facets_implant.msh", lambda occ: prism(occ, 24, 2), {**WALL, "held": at(2, 0)}, 1.5, 1)
write("pin_of_facets_thin.msh", lambda occ: prism(occ, 24, 1.93), {**WALL, "held": at(2, 0)}, 1.5, 1)
