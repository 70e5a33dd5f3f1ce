#!/usr/bin/env python3
"""Writes implants that are closed below, and the bone around them, as hexahedra of the second order for Shape = file:

    prm/meshes/in_socket.py tooth | stem

makes tooth.msh and tooth_bone.msh, or stem.msh and stem_bone.msh. Needs Gmsh (apt install python3-gmsh), which makes the cells of
three halves of cubes, one in the other, and writes the files; here their nodes are moved to where the body is. Another body is
another `surface'. Lengths are mm; all shapes are made up.
"""
import itertools
import math
import os
import sys

import gmsh

ACROSS, DEEP, CORE, IMPLANT, BONE = 4, 3, 0.4, 1, 3  # cells across and along; size of the core; layers around it, and in the bone

#: Half axes of the implant's ellipsoid, by how much it bends along x at its tip, edge lengths of the block of bone.
SHAPES = {"tooth": ((3.5, 2.6, 11.), 0., (16., 16., 18.)), "stem": ((7., 5., 50.), 8., (40., 36., 70.))}


def surface(axes, bend, u, v, w):
    """Place on the implant of the place on half a cube: u and v from -1 to 1, w from -1 at its bottom to 0 at its rim."""
    d = [math.tan(math.pi / 4 * x) for x in (u, v, w)]
    x, y, z = (a * x / math.hypot(*d) for a, x in zip(axes, d))
    return x + bend * (z / axes[2]) ** 2, y, z


def place(shape, x, y, z):
    """Of a node of the cubes: the core within level 1, then the implant up to 2, then the bone up to 3."""
    axes, bend, block = shape
    level = max(abs(x), abs(y), -z)
    core = lambda u, v, w: (CORE * axes[0] * u + bend * (CORE * w) ** 2, CORE * axes[1] * v, CORE * axes[2] * w)
    outside = lambda u, v, w: (block[0] / 2 * u, block[1] / 2 * v, block[2] * w)
    if level <= 1:
        return core(x, y, z)
    c = x / level, y / level, z / level
    inner, outer, part = ((core(*c), surface(axes, bend, *c), level - 1) if level <= 2 else
                          (surface(axes, bend, *c), outside(*c), level - 2))
    return [a + part * (b - a) for a, b in zip(inner, outer)]


def add_cubes():
    """Corners, edges, faces and volumes of the halves of cubes of sizes 1, 2 and 3; returns volumes and faces by place."""
    geo, n = gmsh.model.geo, {1: IMPLANT, 2: BONE}
    corners = {(s, *c): geo.addPoint(*(s * x for x in c)) for s in (1, 2, 3) for c in itertools.product((-1, 1), (-1, 1), (-1, 0))}
    lines, faces = {}, {}

    def line(a, b):
        """The edge between two corners, with its sign."""
        if (b, a) in lines:
            return -lines[b, a]
        if (a, b) not in lines:
            lines[a, b] = geo.addLine(corners[a], corners[b])
            cells = n[min(a[0], b[0])] if a[0] != b[0] else DEEP if a[3] != b[3] else ACROSS
            geo.mesh.setTransfiniteCurve(lines[a, b], cells + 1)
        return lines[a, b]

    def face(*around):
        key = frozenset(around)
        if key not in faces:
            loop = geo.addCurveLoop([line(a, b) for a, b in zip(around, around[1:] + around[:1])])
            faces[key] = geo.addPlaneSurface([loop])
            geo.mesh.setTransfiniteSurface(faces[key], cornerTags=[corners[a] for a in around])
            geo.mesh.setRecombine(2, faces[key])
        return faces[key]

    def volume(bottom, top):
        sides = [face(a, b, d, c) for a, b, c, d in zip(bottom, bottom[1:] + bottom[:1], top, top[1:] + top[:1])]
        result = geo.addVolume([geo.addSurfaceLoop([face(*bottom), face(*top), *sides])])
        geo.mesh.setTransfiniteVolume(result, [corners[a] for a in (*bottom, *top)])
        return result

    ring = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    below, above = ([(s, *c, z) for s in (1, 2, 3) for c in ring] for z in (-1, 0))
    parts = {"core": [volume(below[:4], above[:4])], 1: [], 2: []}
    for s in (1, 2):
        inner, outer = (slice(4 * k, 4 * k + 4) for k in (s - 1, s))
        parts[s].append(volume(below[outer], below[inner]))
        for i, j in ((0, 1), (1, 2), (2, 3), (3, 0)):
            quads = [[part[k][q] for q in (i, j)] for k in (inner, outer) for part in (below, above)]
            (a, b), (d, c), (e, f), (h, g) = quads
            parts[s].append(volume([e, f, g, h], [a, b, c, d]))
    return parts, faces, below, above


def write(name, shape, of_bone):
    gmsh.initialize(["", "-v", "1"])
    parts, faces, below, above = add_cubes()
    gmsh.model.geo.synchronize()
    ring = [(0, 1), (1, 2), (2, 3), (3, 0)]

    def around(k):
        """Bottom and sides of a cube."""
        b, a = below[4 * k:4 * k + 4], above[4 * k:4 * k + 4]
        return [faces[frozenset(b)], *(faces[frozenset((b[i], b[j], a[i], a[j]))] for i, j in ring)]

    volumes = parts[2] if of_bone else parts["core"] + parts[1]
    top = [faces[frozenset(above[:4])],
           *(faces[frozenset((above[i], above[j], above[4 + i], above[4 + j]))] for i, j in ring)]
    outside = around(2)
    groups = {"contact": around(1)}
    groups.update({"held": outside[:1], "slides y": outside[1::2], "slides x": outside[2::2]} if of_bone else {"held": top})
    gmsh.model.addPhysicalGroup(3, volumes)
    for group, tags in groups.items():
        gmsh.model.setPhysicalName(2, gmsh.model.addPhysicalGroup(2, tags), group)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.setOrder(2)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    for tag, *x in zip(tags, coordinates[::3], coordinates[1::3], coordinates[2::3]):
        gmsh.model.mesh.setNode(tag, place(shape, *x), [])
    gmsh.write(os.path.join(os.path.dirname(os.path.abspath(__file__)), name))
    gmsh.finalize()


if __name__ == "__main__":
    if sys.argv[1:2] == [] or sys.argv[1] not in SHAPES:
        sys.exit(__doc__)
    for suffix, of_bone in (("", False), ("_bone", True)):
        write(f"{sys.argv[1]}{suffix}.msh", SHAPES[sys.argv[1]], of_bone)
