"""Maps of the contact face on pages of results: values on a grid as small pictures, smooth between the places of the grid."""

import base64
import functools
import itertools
import math
import struct
import zlib

from debond.page_data import n_rows, number, numbers, read_table, short, with_unit

QUANTITIES = (("pressure_MPa", "Pressure", "MPa"), ("slip_mm", "Sliding distance g_s", "mm"), ("phi", "Bonding state phi", ""),
              ("mu", "Friction coefficient mu", ""), ("left_by_opening", "Bond left by opening", ""),
              ("left_by_slip", "Bond left by slip", ""),
              ("mode_deg", "Mode of the traction: 0 opening, 90 sliding", "°"))
STATES = (("open", (208, 208, 208)), ("sticks", (44, 30, 92)), ("slides", (224, 138, 30)), ("pulled, without friction", (58, 125, 68)))
COLOURS = ((44, 30, 92), (208, 74, 98), (251, 233, 160))    # of the lowest, the middle and the highest value
FINER = 2                                                   # pixels of a place of the grid, along each side
SAME = 1e-3                                                 # what differs by less of the largest value is not told apart


class Grid:
    """Places of the maps: rows from y low to high of places from x low to high."""

    def __init__(self, xs, ys):
        self.nx, self.ny = len(set(xs)), len(set(ys))
        self.half_x, self.half_y = ((max(places) - min(places)) / 2 * n / (n - 1) for places, n in ((xs, self.nx), (ys, self.ny)))
        self.xs, self.ys = xs, ys

    def is_round(self, values):
        """Whether there are values at all places in a circle, and only there."""
        return math.isclose(self.half_x, self.half_y, rel_tol=1e-4) and math.isnan(values[0]) and all(
            math.isnan(value) == (math.hypot(x, y) > self.half_x) for x, y, value in zip(self.xs, self.ys, values))


@functools.lru_cache(maxsize=None)
def windows(n, width):
    """Of the pixels of n places: the first and the last place of the window around each, and the shares of these."""
    pad = math.ceil(width / 2) + 1
    ends = [[(k + 0.5) / FINER + pad + side * width / 2 for side in (-1, 1)] for k in range(n * FINER)]
    return pad, [(int(low), int(high), low - int(low), high - int(high)) for low, high in ends]


def summed(values, width):
    """Sums over this many places around each pixel. Values that stand at the nearest places around points so far apart become
    those that are linear between the points, if divided by how many there are."""
    pad, ends = windows(len(values), width)
    padded = [*[0.] * pad, *values, *[0.] * pad]
    sums = list(itertools.accumulate(padded, initial=0.))
    return [sums[j] + padded[j] * t - sums[i] - padded[i] * s for i, j, s, t in ends]


def widths_of(grid, maps):
    """Over how many places, along x and along y, all values stay the same in the middle of the face: the nearest points of the
    interface lie so far apart."""
    def width(indices):
        rows = [row for row in zip(*([values[k] for k in indices] for values in maps)) if row[0] == row[0]]
        changes = sum(a != b for a, b in zip(rows, rows[1:]))
        return max(1, min(len(rows) / (changes + 1), len(indices) / 6))
    i, j = grid.nx // 2, grid.ny // 2
    return width(range(j * grid.nx, (j + 1) * grid.nx)), width(range(i, grid.nx * grid.ny, grid.nx))


def picture(grid, values, low, high, widths, is_round):
    """A PNG file of the values as a data URI; the page cuts round faces out."""
    def smooth(column_of):
        rows = (summed(list(map(column_of, values[j * grid.nx:(j + 1) * grid.nx])), widths[0]) for j in range(grid.ny))
        return zip(*(summed(column, widths[1]) for column in zip(*rows)))
    scale = 254.99 / (high - low)
    heights = smooth(lambda value: (value - low) * scale if value == value else 0.)
    lines = [bytearray(255 if n < 1e-6 else min(254, max(0, int(z / n))) for z, n in zip(*both))
             for both in zip(heights, smooth(lambda value: float(value == value)))]
    for k in () if is_round else (k for k, value in enumerate(values) if value != value):
        for line in lines[k // grid.nx * FINER:(k // grid.nx + 1) * FINER]:
            line[k % grid.nx * FINER:(k % grid.nx + 1) * FINER] = b"\xff" * FINER
    return "data:image/png;base64," + base64.b64encode(png(grid.nx * FINER, lines[::-1], colours_of_values())).decode()


def picture_of_states(grid, values):
    """The same of states, each of which has its colour."""
    lines = [bytearray(255 if value != value else int(value) for value in values[j * grid.nx:(j + 1) * grid.nx])
             for j in range(grid.ny)]
    palette = b"".join(bytes(colour) for _, colour in STATES)
    return "data:image/png;base64," + base64.b64encode(png(grid.nx, lines[::-1], palette.ljust(765, b"\0"))).decode()


def colours_of_values():
    """A palette of 255 colours, from that of the lowest value to that of the highest."""
    palette = bytearray()
    for k in range(255):
        i, t = min(k // 127, 1), (k - 127 * min(k // 127, 1)) / 127
        palette += bytes(round(a + (b - a) * min(t, 1)) for a, b in zip(COLOURS[i], COLOURS[i + 1]))
    return bytes(palette)


def png(width, lines, palette):
    """A PNG file with a palette, and 255 as a transparent colour."""
    chunks = ((b"IHDR", struct.pack(">IIBBBBB", width, len(lines), 8, 3, 0, 0, 0)),
              (b"PLTE", palette + b"\xff" * 3), (b"tRNS", b"\xff" * 255 + b"\0"),
              (b"IDAT", zlib.compress(b"".join(b"\0" + line for line in lines), 6)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(struct.pack(">I", len(content)) + kind + content +
                                          struct.pack(">I", zlib.crc32(kind + content)) for kind, content in chunks)


def maps_of(path):
    """What the page shows of maps.csv, which has rows for each event: for each quantity its pictures, and in words the maps
    that need none."""
    table = read_table(path)
    if not n_rows(table):
        return []
    events = list(dict.fromkeys(zip(table["event"], table["angle_deg"], table["time"])))
    size = n_rows(table) // len(events)
    grid = Grid(*(numbers(table[name][:size]) for name in ("x_mm", "y_mm")))
    turns = any(number(angle) for _, angle, _ in events)
    places = [(f"{short(angle, 3)}°" if turns else f"time {short(time)}", event) for event, angle, time in events]
    shown = [one for one in QUANTITIES if one[0] in table]
    quantities = [[numbers(table[name][k * size:(k + 1) * size]) for k in range(len(events))] for name, _, _ in shown]
    widths = widths_of(grid, [values for maps in quantities for values in maps])
    result = [maps_of_quantity(grid, places, maps, widths, words, unit) for maps, (_, words, unit) in zip(quantities, shown)]
    if "state" in table:
        states = numbers(table["state"])
        result.append(maps_of_states(grid, places, [states[k * size:(k + 1) * size] for k in range(len(events))]))
    return result


def maps_of_quantity(grid, places, maps, widths, words, unit):
    """The pictures of one quantity at all events, without those that are all of one value or the same as the one before."""
    figures, notes, before = [], {}, None
    for (place, event), values in zip(places, maps):
        known = [value for value in values if value == value]
        if not known:
            continue
        low, high = min(known), max(known)
        largest = max(abs(low), abs(high))
        if high - low <= SAME * largest:
            notes.setdefault(f"is {with_unit(high, unit)} everywhere", []).append(place)
        elif before and all(abs(a - b) <= SAME * largest for a, b in zip(before[1], values) if a == a and b == b):
            notes.setdefault(f"is the same, to 0.1 %, as at {before[0]}", []).append(place)
        else:
            before, is_round = (place, values), grid.is_round(values)
            figures.append({"place": place, "event": event, "low": short(low, 3), "high": short(high, 3), "unit": unit,
                            "round": is_round, "image": picture(grid, values, low, high, widths, is_round)})
    if len(notes) == 1 and not figures:
        notes = [f"It {text}{' at all of these times' * (len(maps) > 1)}." for text in notes]
    else:
        notes = [f"At {', '.join(at)} it {text}." for text, at in notes.items()]
    return {"words": words, "unit": unit, "figures": figures, "notes": notes, "ratio": f"{grid.half_x:.6g} / {grid.half_y:.6g}",
            "events": [f"{place}: {event}" for place, event in places], "states": []}


def maps_of_states(grid, places, maps):
    """What points do at all events, but for those at which they do the same as before."""
    figures, notes, before = [], [], None
    for (place, event), values in zip(places, maps):
        if before and all(a == b for a, b in zip(before, values) if a == a):
            notes.append(f"At {place} it is the same.")
        elif any(value == value for value in values):
            before = values
            figures.append({"place": place, "event": event, "round": grid.is_round(values), "image": picture_of_states(grid, values)})
    met = sorted({int(value) for values in maps for value in values if value == value})
    return {"words": "State", "unit": "", "figures": figures, "notes": notes, "ratio": f"{grid.half_x:.6g} / {grid.half_y:.6g}",
            "events": [], "states": [(STATES[k][0], "#%02x%02x%02x" % STATES[k][1]) for k in met]}
