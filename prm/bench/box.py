#!/usr/bin/env python3
"""Writes prm/bench/box.msh, the bone of cement_bone.prm: a box of 10 x 5 x 8.75 mm below z = 0, whose bottom is held and whose sides
are free, as hexahedra that become thinner towards its top."""
import itertools
import os
import sys

sys.path.append(os.path.join(os.path.dirname(__file__), '..', 'meshes'))
import gmsh_file  # noqa: E402

SIZE, CELLS = (10., 5., 8.75), (10, 4, 5)

number, nodes = {}, []
for k, j, i in itertools.product(*(range(n + 1) for n in CELLS[::-1])):
    number[i, j, k] = len(nodes) + 1
    nodes.append((SIZE[0] * (i / CELLS[0] - 0.5), SIZE[1] * (j / CELLS[1] - 0.5), -SIZE[2] * (k / CELLS[2]) ** 1.5))
ring = ((0, 0), (1, 0), (1, 1), (0, 1))
elements = []
for group, k in ((1, 0), (2, CELLS[2])):
    elements += [('3 2 %d %d' % (group, group), [number[i + a, j + b, k] for a, b in ring])
                 for i, j in itertools.product(range(CELLS[0]), range(CELLS[1]))]
elements += [('5 2 3 3', [number[i + a, j + b, k + c] for c in (1, 0) for a, b in ring])
             for i, j, k in itertools.product(*map(range, CELLS))]
gmsh_file.write(os.path.join(os.path.dirname(__file__), 'box.msh'), nodes, elements, 10)
