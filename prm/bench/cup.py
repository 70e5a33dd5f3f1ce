#!/usr/bin/env python3
"""Writes the meshes of cup.prm: half a spherical shell whose wall is 2.3 mm at its rim and 4 mm at its pole, and the foam around it. Both
touch in two sectors, at +x and -x, of 90 degrees (cup.msh, cup_foam.msh) or 135 (cup_wide.msh, cup_foam_wide.msh); elsewhere the foam is
relieved. The chuck holds the rim at +x alone."""
import itertools
import math
import os
import sys

sys.path.append(os.path.join(os.path.dirname(__file__), '..', 'meshes'))
import gmsh_file  # noqa: E402

RADIUS, FOAM, RIM, POLE, HELD = 30., 50., 2.3, 4., 12.  # mm, degrees: half of what is held
N, WALL, DEEP = 8, 1, 2   # cells across, through the wall, through the foam
far, near = (RADIUS - RIM) ** 2 / (RADIUS - POLE), RADIUS - POLE
inner, shift = (far + near) / 2, (far - near) / 2  # radius of the inner sphere, whose centre is above the origin


def direction(i, j, k):
    """From a place on half a cube, of 0 to N across and -N/2 to 0 along z."""
    d = [math.tan(math.pi / 4 * x) for x in (2 * i / N - 1, 2 * j / N - 1, 2 * k / N)]
    return [x / math.hypot(*d) for x in d]


def quads():
    """Those of the half cube, their corners as places, seen from outside."""
    for a, b in itertools.product(range(N), range(N)):
        yield [(a, b, -N // 2), (a, b + 1, -N // 2), (a + 1, b + 1, -N // 2), (a + 1, b, -N // 2)]
    for a, k in itertools.product(range(N), range(-N // 2, 0)):
        yield [(a, 0, k), (a + 1, 0, k), (a + 1, 0, k + 1), (a, 0, k + 1)]
        yield [(a + 1, N, k), (a, N, k), (a, N, k + 1), (a + 1, N, k + 1)]
        yield [(0, a + 1, k), (0, a, k), (0, a, k + 1), (0, a + 1, k + 1)]
        yield [(N, a, k), (N, a + 1, k), (N, a + 1, k + 1), (N, a, k + 1)]


def write(name, levels, contact_level, held, sector):
    """levels: functions of a direction that are distances from the origin, from inside to outside; sector: half of its angle [deg]."""
    numbers, nodes, elements, n = {}, [], [], len(levels) - 1

    def node(place, level):
        if (place, level) not in numbers:
            d = direction(*place)
            nodes.append([levels[level](d) * x for x in d])
            numbers[place, level] = len(nodes)
        return numbers[place, level]

    def is_contact(quad):
        x, y, _ = (sum(direction(*place)[m] for place in quad) for m in range(3))
        return abs(y) <= math.tan(math.radians(sector)) * abs(x) * (1 + 1e-9)

    for quad in quads():
        for level in range(n):
            below, above = ([node(place, one) for place in quad] for one in (level, level + 1))
            elements.append(('5 2 3 3', [*below, *above]))
            rim = [place for place in quad if place[2] == 0]
            if held == 'rim' and len(rim) == 2 and all(place[0] == N and abs(math.degrees(math.atan2(*direction(*place)[1::-1]))) < HELD
                                                       for place in rim):
                elements.append(('3 2 2 2', [node(rim[0], level), node(rim[1], level), node(rim[1], level + 1), node(rim[0], level + 1)]))
        if held == 'outside':
            elements.append(('3 2 2 2', [node(place, n) for place in quad]))
        if is_contact(quad):
            elements.append(('3 2 1 1', [node(place, contact_level) for place in quad]))
    gmsh_file.write(os.path.join(os.path.dirname(__file__), name), nodes, elements, 10)


def wall(share):
    """Distance of a place between inner (0) and outer (1) face."""
    def distance(d):
        within = shift * d[2] + math.sqrt(inner ** 2 - shift ** 2 * (1 - d[2] ** 2))
        return within + share * (RADIUS - within)
    return distance


for wide, sector in (('', 45.), ('_wide', 67.5)):
    write('cup%s.msh' % wide, [wall(i / WALL) for i in range(WALL + 1)], WALL, 'rim', sector)
    write('cup_foam%s.msh' % wide, [lambda d, i=i: RADIUS * (FOAM / RADIUS) ** (i / DEEP) for i in range(DEEP + 1)], 0, 'outside', sector)
