#!/usr/bin/env python3
"""Draws prm/paper/data/bonding_pattern_b.png, our stand-in for pattern (b) of the paper's Fig. 7.

The paper reconstructs its pattern (b) from a photograph that is not published as data. This one is invented: bonded
mostly inside, with a ragged edge, islands and holes, and little at the rim. What it shares with the paper's is the mean
of 0.55 of the disk's area and that every one of the 20 x 20 elements of the implant's contact face is bonded (white) or
not (black). Borders between the two are therefore drawn along borders of elements.

    doc/paper/draw_pattern_b.py [FILE]
"""
import math
import random
import struct
import sys
import zlib

N = 20           # elements across the disk
PIXELS = 800     # across the disk
FRACTION = 0.55  # of the area
SIDE_POINTS = 8  # of the polygon that stands for a curved element
SEED = 13


def disk(u, v):
    """Point (x, y) of the unit disk at the parameters u, v in [0, 1]: the rational biquadratic patch of the program."""
    s = math.sqrt(0.5)
    places = (-1, 0, 1)
    x = y = weight = 0.0
    for j, b_v in enumerate(((1 - v) ** 2, 2 * v * (1 - v), v * v)):
        for i, b_u in enumerate(((1 - u) ** 2, 2 * u * (1 - u), u * u)):
            corner = i != 1 and j != 1
            w = b_u * b_v * (s if (i == 1) != (j == 1) else 1.0)
            reach = s if corner else 1 / s
            x += w * reach * places[i]
            y += w * reach * places[j]
            weight += w
    return x / weight, y / weight


def element_polygon(i, j):
    """Vertices (x, y) around the element i, j, counterclockwise, on its curved borders."""
    steps = [k / SIDE_POINTS for k in range(SIDE_POINTS)]
    around = [(k, 0) for k in steps] + [(1, k) for k in steps] + [(1 - k, 1) for k in steps] + [(0, 1 - k) for k in steps]
    return [disk((i + a) / N, (j + b) / N) for a, b in around]


def area(polygon):
    """Area of a polygon."""
    return 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(polygon, polygon[1:] + polygon[:1]))


def bumpy_field():
    """A smooth function of x, y on the unit disk: high inside, low at the rim, with bumps and dents."""
    numbers = random.Random(SEED)
    bumps = []
    for _ in range(200):
        r, angle = math.sqrt(numbers.random()), 2 * math.pi * numbers.random()
        bumps.append((r * math.cos(angle), r * math.sin(angle), 2 * numbers.random() - 1))

    def field(x, y):
        noise = sum(h * math.exp(-((x - a) ** 2 + (y - b) ** 2) / (2 * 0.07 ** 2)) for a, b, h in bumps)
        return noise - 2.2 * math.hypot(x - 0.04, y + 0.03) ** 2

    return field


def bonded_elements(polygons):
    """The elements with the highest values of the field that make up the bonded fraction of the area."""
    field = bumpy_field()
    centre = {e: (sum(x for x, _ in p) / len(p), sum(y for _, y in p) / len(p)) for e, p in polygons.items()}
    order = sorted(polygons, key=lambda e: -field(*centre[e]))
    bonded, missing = set(), FRACTION * sum(map(area, polygons.values()))
    while area(polygons[order[0]]) < missing:
        missing -= area(polygons[order[0]])
        bonded.add(order.pop(0))
    # what is missing is less than an element: of the next ones that whose area is closest to it, if that is better
    # than none
    last = min(order[:40], key=lambda e: abs(area(polygons[e]) - missing))
    if abs(area(polygons[last]) - missing) < missing:
        bonded.add(last)
    return bonded


def paint(image, polygon):
    """Makes the pixels white whose centres lie inside the polygon."""
    points = [((x + 1) / 2 * PIXELS, (1 - y) / 2 * PIXELS) for x, y in polygon]
    top, bottom = min(y for _, y in points), max(y for _, y in points)
    for row in range(max(0, math.ceil(top - 0.5)), min(PIXELS, math.ceil(bottom - 0.5))):
        y = row + 0.5
        crossings = sorted(x0 + (y - y0) / (y1 - y0) * (x1 - x0)
                           for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1]) if (y0 <= y) != (y1 <= y))
        for begin, end in zip(crossings[::2], crossings[1::2]):
            for column in range(max(0, math.ceil(begin - 0.5)), min(PIXELS, math.ceil(end - 0.5))):
                image[row][column] = 255


def write_png(filename, image):
    """An 8 bit grey PNG from rows of bytes."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", len(image[0]), len(image), 8, 0, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + bytes(row) for row in image), 9)
    with open(filename, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b""))


def main():
    filename = sys.argv[1] if len(sys.argv) > 1 else "prm/paper/data/bonding_pattern_b.png"
    polygons = {(i, j): element_polygon(i, j) for j in range(N) for i in range(N)}
    bonded = bonded_elements(polygons)
    image = [bytearray(PIXELS) for _ in range(PIXELS)]
    for element in sorted(bonded):
        paint(image, polygons[element])
    write_png(filename, image)
    share = sum(area(polygons[e]) for e in bonded) / sum(map(area, polygons.values()))
    print(f"{filename}: {len(bonded)} of {N * N} elements, {share:.5f} of the area")


if __name__ == "__main__":
    main()
