"""Looks at the pixels of the picture that debonding_front.py makes of quarter.prm at 0.4 and 4 degrees."""

import sys

from vtkmodules.vtkIOImage import vtkPNGReader

WHITE, BONDED, BROKEN = (255, 255, 255), (0xFD, 0xE7, 0x25), (0x44, 0x01, 0x54)
R = 2.5  # mm

reader = vtkPNGReader()
reader.SetFileName(sys.argv[1])
reader.Update()
image = reader.GetOutput()
width, height = image.GetDimensions()[:2]


def colour(i, j):
    """Of a pixel, counted from the lower left corner."""
    return tuple(int(image.GetScalarComponentAsDouble(i, j, 0, c)) for c in range(3))


def expect(what, found, expected):
    ok = all(abs(f - e) <= 4 for f, e in zip(found, expected))
    print("%s: %s" % (what, "yes" if ok else "NO, %s instead of %s" % (found, expected)))
    return ok


def faces():
    """Centre and radius of the two disks: the widest parts that are not white."""
    parts = {}
    for j in range(height):
        begin = None
        for i in range(width):
            if colour(i, j) != WHITE:
                begin = i if begin is None else begin
            elif begin is not None:
                parts.setdefault(j, []).append((begin, i - 1))
                begin = None
    row = max(parts, key=lambda j: sum(sorted(end - begin for begin, end in parts[j])[-2:]))
    widest = sorted(sorted(parts[row], key=lambda part: part[0] - part[1])[:2])
    return [((begin + end) / 2, (end - begin) / 2) for begin, end in widest]


def rows_of(centre):
    """Upper and lower end of the disk in this column of pixels: the longest part that is not white."""
    longest, begin = (0, 0), None
    for j in range(height + 1):
        if j < height and colour(round(centre), j) != WHITE:
            begin = j if begin is None else begin
        elif begin is not None:
            longest = max(longest, (begin, j - 1), key=lambda part: part[1] - part[0])
            begin = None
    return longest


# at 0.4 degrees the bond is whole up to 0.022 mm / (0.4 pi / 180) = 3.2 mm, everywhere, and at 4 degrees gone beyond
# (0.0546 + 0.003) mm / (4 pi / 180) = 0.83 mm; at 0.2 mm it has slid at most 0.014 mm and is whole
PLACES = [
    ("0.4 degrees, right and up", 0, 1.5, 1.5, BONDED),
    ("0.4 degrees, left and up", 0, -1.5, 1.5, BROKEN),
    ("0.4 degrees, left and down", 0, -1.5, -1.5, BROKEN),
    ("0.4 degrees, right and down", 0, 1.5, -1.5, BROKEN),
    ("4 degrees, right and up", 1, 1.5, 1.5, BROKEN),
    ("4 degrees, right and up near the centre", 1, 0.14, 0.14, BONDED),
    ("4 degrees, left and down near the centre", 1, -0.14, -0.14, BROKEN),
]

ok = expect("size", (width, height), (500, round(500 * 1.33 / 2.81)))
ok = expect("corner", colour(0, 0), WHITE) and ok
(first, radius), (second, other_radius) = faces()
ok = expect("equal disks", (radius, radius), (other_radius, 500 / 2.81 / 2)) and ok
for what, column, x, y, expected in PLACES:
    centre = (first, second)[column]
    lower, upper = rows_of(centre)
    pixel = round(centre + x / R * radius), round((lower + upper) / 2 + y / R * radius)
    ok = expect(what, colour(*pixel), expected) and ok
sys.exit(not ok)
