#!/usr/bin/env python3
"""Writes bone_core.msh: a drilled core of bone, a cylinder, as hexahedra for Bone / Shape = file.

    prm/meshes/bone_core.py [FILE]

Lengths are mm. Its top face, in z = 0, is named contact, its bottom held; its side is free. Seen from above there is a square
of cells in the middle and rings of cells around it. Another body is another `place': numbers and names of cells stay.
"""
import math
import sys

from gmsh_file import write

RADIUS, HEIGHT = 6., 5.         # of the core
SQUARE = 2.2                    # half the diagonal of the square, over sqrt(2)
ACROSS, RINGS, LAYERS = 12, 8, 5  # cells across the square, rings around it, layers
THINNER_ABOVE = 1.6             # exponent of the layers' depths, from the top


def place(i, j, ring, layer):
    """Node i, j of the square's grid, moved outwards by `ring' where it is on the border."""
    s, t = 2. * i / ACROSS - 1., 2. * j / ACROSS - 1.
    # a square whose sides bulge half way to the circle through its corners
    angle = math.atan2(t, s) if abs(s) + abs(t) > 0. else 0.
    length = max(abs(s), abs(t))
    square = SQUARE * math.hypot(s, t)
    circle = SQUARE * math.sqrt(2.) * length
    r = length * (0.5 * circle + 0.5 * square) + (1. - length) * square
    f = ring / RINGS
    r = (1. - f) * r + f * RADIUS
    depth = HEIGHT * (layer / LAYERS) ** THINNER_ABOVE
    return r * math.cos(angle), r * math.sin(angle), -depth


def main():
    square = [(i, j) for j in range(ACROSS + 1) for i in range(ACROSS + 1)]
    n = ACROSS
    border = ([(i, 0) for i in range(n)] + [(n, j) for j in range(n)] +
              [(n - i, n) for i in range(n)] + [(0, n - j) for j in range(n)])
    columns = [(i, j, 0) for i, j in square] + [(i, j, ring) for ring in range(1, RINGS + 1) for i, j in border]
    number = {column: k for k, column in enumerate(columns)}
    quads = [[(i, j, 0), (i + 1, j, 0), (i + 1, j + 1, 0), (i, j + 1, 0)] for j in range(n) for i in range(n)]
    for ring in range(RINGS):
        for (i, j), (k, l) in zip(border, border[1:] + border[:1]):
            quads.append([(i, j, ring), (i, j, ring + 1), (k, l, ring + 1), (k, l, ring)])

    nodes = [place(*column, layer) for layer in range(LAYERS + 1) for column in columns]

    def node(column, layer):
        return 1 + number[column] + layer * len(columns)

    elements = []  # type and physical group, nodes
    for quad in quads:
        elements.append(('3 2 1 1', [node(column, 0) for column in quad]))
        elements.append(('3 2 2 2', [node(column, LAYERS) for column in quad]))
        for layer in range(LAYERS):
            elements.append(('5 2 3 3', [node(column, layer + 1) for column in quad] + [node(column, layer) for column in quad]))

    write(sys.argv[1] if len(sys.argv) > 1 else __file__.replace('.py', '.msh'), nodes, elements, digits=6)


main()
