#!/usr/bin/env python3
"""Writes half_space.msh: bone that is large against the disk it is bonded to, as hexahedra for Bone / Shape = file.

    prm/meshes/half_space.py [FILE]

Lengths are mm. Cells have 20 nodes. Of the top face, in z = 0, the disk and a ring around it are named contact; the bottom is
held, all else is free. Seen from above there is a square of cells in the middle and rings of cells around it, of which one ends at
the edge of the disk. Rings and layers become thinner towards this edge.
"""
import math
import sys

from gmsh_file import write

RADIUS, SIZE = 2.5, 25.         # of the disk; radius and height of the bone
SQUARE = 0.9                    # half the side of the square
ACROSS = 2                      # cells across the square; a ring has four times as many
MARGIN = 1                      # rings of the contact face outside of the disk
THINNEST = 0.01                 # the rings on both sides of the edge, and the first layer
ALIKE = 6                       # rings within the edge that are as thin
INWARDS, OUTWARDS, DOWNWARDS = 2., 3., 2.5  # by what the next ring or layer is thicker


def graded(length, ratio, alike=1):
    """Distances from the edge, the last of them `length'."""
    result = [k * THINNEST for k in range(alike + 1)]
    width = THINNEST * ratio
    while result[-1] + 1.5 * width < length:
        result.append(result[-1] + width)
        width *= ratio
    return result + [length]


WITHIN = [RADIUS - d for d in reversed(graded(RADIUS - 1.3 * SQUARE, INWARDS, ALIKE))]  # from the square to the edge
RADII = WITHIN + [RADIUS + d for d in graded(SIZE - RADIUS, OUTWARDS)[1:]]
DEPTHS = graded(SIZE, DOWNWARDS)


def between(values, i):
    """Of a list at half numbers, too; i counts halves."""
    return (values[i // 2] + values[(i + 1) // 2]) / 2.


def place(i, j, ring, layer):
    """Node i, j of the square's grid, moved outwards by `ring' where it is on the border. All numbers count halves of cells."""
    s, t = i / ACROSS - 1., j / ACROSS - 1.
    length = max(abs(s), abs(t))
    x, y = SQUARE * s, SQUARE * t
    if length > 0.:  # sides that bulge, with nodes at equal angles
        angle = math.pi / 4. * t / s if abs(s) >= abs(t) else math.pi / 2. - math.pi / 4. * s / t
        angle += math.pi if (s if abs(s) >= abs(t) else t) < 0. else 0.
        circle = SQUARE * 1.2 * length
        x, y = [(1. - length) * a + length * (0.4 * a + 0.6 * circle * b) for a, b in ((x, math.cos(angle)), (y, math.sin(angle)))]
        f = min(ring / 2., 1.)
        r = between(RADII, max(ring, 2))
        x, y = (1. - f) * x + f * r * math.cos(angle), (1. - f) * y + f * r * math.sin(angle)
    return x, y, -between(DEPTHS, layer)


EDGES = ((0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7))  # order of Gmsh


def main():
    n = 2 * ACROSS
    border = ([(i, 0) for i in range(n)] + [(n, j) for j in range(n)] +
              [(n - i, n) for i in range(n)] + [(0, n - j) for j in range(n)])
    number, nodes = {}, []

    def node(*key):
        if key not in number:
            number[key] = len(nodes) + 1
            nodes.append(place(*key))
        return number[key]

    # cells seen from above: a function from (a, b), halves from 0 to 2, to i, j and ring
    cells = [(lambda a, b, i=i, j=j: (i + a, j + b, 0)) for j in range(0, n, 2) for i in range(0, n, 2)]
    for ring in range(0, 2 * len(RADII) - 2, 2):
        for k in range(0, len(border), 2):
            cells.append(lambda a, b, k=k, ring=ring: (*border[(k + b) % len(border)], ring + a))
    square = ((0, 0), (2, 0), (2, 2), (0, 2))
    n_contact = ACROSS ** 2 + 4 * ACROSS * (len(WITHIN) - 1 + MARGIN)

    elements = []  # type and physical group, nodes
    for number_of_cell, cell in enumerate(cells):
        sides = list(square) + [(1, 0), (2, 1), (1, 2), (0, 1)]
        if number_of_cell < n_contact:
            elements.append(('16 2 1 1', [node(*cell(*ab), 0) for ab in sides]))
        elements.append(('16 2 2 2', [node(*cell(*ab), 2 * len(DEPTHS) - 2) for ab in sides]))
        for layer in range(0, 2 * len(DEPTHS) - 2, 2):
            corners = [(a, b, 2) for a, b in square] + [(a, b, 0) for a, b in square]
            middles = [tuple((p + q) // 2 for p, q in zip(corners[v], corners[w])) for v, w in EDGES]
            elements.append(('17 2 3 3', [node(*cell(a, b), layer + c) for a, b, c in corners + middles]))

    write(sys.argv[1] if len(sys.argv) > 1 else __file__.replace('.py', '.msh'), nodes, elements, digits=7)


main()
