"""Maps of the contact face on pages of results: values on a grid as small pictures, linear between the places of the grid."""

import base64
import math
import struct
import zlib

from debond.page_curve import ticks
from debond.page_data import n_rows, numbers, read_table, short, with_unit

# colour maps from the lowest value to the highest, of each quantity the one that it has in all pictures of debond
VIRIDIS = ("#440154", "#46327e", "#365c8d", "#277f8e", "#1fa187", "#4ac16d", "#a0da39", "#fde725")
BROWNS = ("#ffffe5", "#fff7bc", "#fee391", "#fec44f", "#fe9929", "#ec7014", "#cc4c02", "#8c2d04")
BLUES = ("#f7fbff", "#deebf7", "#c6dbef", "#9ecae1", "#6baed6", "#4292c6", "#2171b5", "#084594")
REDS = ("#fff5f0", "#fee0d2", "#fcbba1", "#fc9272", "#fb6a4a", "#ef3b2c", "#cb181d", "#99000d")  # of pressures below 0
#: Columns, words, units, colours, and the ends of the range that do not depend on the values.
QUANTITIES = (("pressure_MPa", "Pressure", "MPa", BLUES, None, None),
              ("slip_mm", "Sliding distance gₛ", "mm", BROWNS, 0., None),
              ("phi", "Bonding state φ", "", VIRIDIS, 0., 1.), ("mu", "Friction coefficient μ", "", VIRIDIS, None, None),
              ("left_by_opening", "Bond left by opening or damage", "", VIRIDIS, 0., 1.),
              ("left_by_slip", "Bond left by slip", "", VIRIDIS, 0., 1.),
              ("mode_deg", "Mode of the traction: 0 opening, 90 sliding", "°", VIRIDIS, 0., 90.),
              ("crushed_mm", "Bone crushed to", "mm", BROWNS, 0., None), ("sheared_mm", "Distance slid in the bone", "mm", BROWNS, 0., None))
STATES = (("open", "#d8d8d8"), ("sticks", "#fde725"), ("slides", "#6fb3bf"), ("pulled, without friction", "#b5367a"),
          ("slides in the bone", "#cc4c02"))
FINER = 2    # pixels of a place of the grid, along each side
SAME = 1e-3  # what differs by less of the largest value is not told apart


class Grid:
    """Places of the maps: rows from y low to high of places from x low to high."""

    def __init__(self, xs, ys):
        self.nx, self.ny = len(set(xs)), len(set(ys))
        self.half_x, self.half_y = ((max(places) - min(places)) / 2 * n / (n - 1) for places, n in ((xs, self.nx), (ys, self.ny)))
        self.xs, self.ys = xs, ys

    def bar(self):
        """The text of a bar with a round length, and its share [%] of the width."""
        length, text = ticks(0, 2 * self.half_x, most=4)[1]
        return f"{text} mm", f"{50 * length / self.half_x:.4g}"

    def is_round(self, values):
        """Whether there are values at all places in a circle, and only there."""
        return math.isclose(self.half_x, self.half_y, rel_tol=1e-4) and math.isnan(values[0]) and all(
            math.isnan(value) == (math.hypot(x, y) > self.half_x) for x, y, value in zip(self.xs, self.ys, values))


def filled(grid, values, of_known):
    """The same, two places into the gaps: there, what is made of the known places around, the nearest first."""
    for _ in range(2):
        before, values = values, list(values)
        for k in (k for k, value in enumerate(before) if value != value):
            i, j = k % grid.nx, k // grid.nx
            known = [before[k + di + dj * grid.nx]
                     for di, dj in ((-1, 0), (1, 0), (0, -1), (0, 1), (-1, -1), (1, -1), (-1, 1), (1, 1))
                     if 0 <= i + di < grid.nx and 0 <= j + dj < grid.ny]
            known = [value for value in known if value == value]
            values[k] = of_known(known) if known else math.nan
    return values


def lines_of(grid, values):
    return [values[j * grid.nx:(j + 1) * grid.nx] for j in range(grid.ny)]


def finer(line):
    """Linear between places that are FINER pixels wide."""
    return [z for a, b, c in zip([line[0], *line], line, [*line[1:], line[-1]]) for z in ((a + 3 * b) / 4, (3 * b + c) / 4)]


def picture(grid, values, low, high, palette, is_round):
    """A PNG file of the values as a data URI; the page cuts round faces out."""
    scale = 254.99 / (high - low)
    rows = map(finer, lines_of(grid, filled(grid, values, lambda known: sum(known) / len(known))))
    lines = [bytearray(min(254, max(0, int((z - low) * scale))) if z == z else 255 for z in line)
             for line in zip(*map(finer, zip(*rows)))]
    for k in () if is_round else (k for k, value in enumerate(values) if value != value):
        for line in lines[k // grid.nx * FINER:(k // grid.nx + 1) * FINER]:
            line[k % grid.nx * FINER:(k % grid.nx + 1) * FINER] = b"\xff" * FINER
    return png(lines, palette)


def picture_of_states(grid, values, is_round):
    """The same of states, each of which has its colour."""
    if is_round:
        values = filled(grid, values, lambda known: known[0])
    return png([bytearray(255 if value != value else int(value) for value in line) for line in lines_of(grid, values)],
               [colour for _, colour in STATES])


def palette_of(colours, low, high):
    """The colours of 255 values between both ends of a range. White is 0 where pressures are below it, and colours are as
    strong on both of its sides."""
    first, last = 0., 1.
    if colours is BLUES and low < 0:
        colours, largest = (*REDS[:0:-1], "#ffffff", *BLUES[1:]), max(-low, high)
        first, last = (low / largest + 1) / 2, (high / largest + 1) / 2
    channels = [[int(colour[k:k + 2], 16) for k in (1, 3, 5)] for colour in colours]

    def mixed(t):
        i = min(int(t), len(channels) - 2)
        return "#" + "".join(f"{round(a + (b - a) * (t - i)):02x}" for a, b in zip(*channels[i:i + 2]))
    return [mixed((first + (last - first) * k / 254) * (len(channels) - 1)) for k in range(255)]


def png(lines, palette):
    """A PNG file with a palette as a data URI; lines from below, 255 is transparent."""
    chunks = ((b"IHDR", struct.pack(">IIBBBBB", len(lines[0]), len(lines), 8, 3, 0, 0, 0)),
              (b"PLTE", bytes.fromhex("".join(palette).replace("#", "")).ljust(765, b"\0") + b"\xff" * 3),
              (b"tRNS", b"\xff" * 255 + b"\0"),
              (b"IDAT", zlib.compress(b"".join(b"\0" + line for line in lines[::-1]), 6)), (b"IEND", b""))
    return "data:image/png;base64," + base64.b64encode(
        b"\x89PNG\r\n\x1a\n" + b"".join(struct.pack(">I", len(content)) + kind + content +
                                        struct.pack(">I", zlib.crc32(kind + content)) for kind, content in chunks)).decode()


def maps_of(path, places, without=()):
    """What the page shows of maps.csv, which has rows for each event: for each quantity its pictures, and in words the maps
    that need none; not of some columns. places: {step: that of the chuck, with its unit}."""
    table = read_table(path)
    if not n_rows(table):
        return []
    events = list(dict.fromkeys(zip(table["event"], table["step"], table["time"])))
    size = n_rows(table) // len(events)
    grid = Grid(*(numbers(table[name][:size]) for name in ("x_mm", "y_mm")))
    places = [(places.get(step, f"time {short(time)}"), event) for event, step, time in events]
    result = []
    for name, *about in QUANTITIES:
        if name in table and name not in without:
            values = numbers(table[name])
            result.append(maps_of_quantity(grid, places, [values[k * size:(k + 1) * size] for k in range(len(events))], *about))
    if "state" in table:
        states = numbers(table["state"])
        result.append(maps_of_states(grid, places, [states[k * size:(k + 1) * size] for k in range(len(events))]))
    return result


def maps_of_quantity(grid, places, maps, words, unit, colours, least, most):
    """The pictures of one quantity at all events, without those that are all of one value or the same as the one before. All
    have the same range of colours."""
    figures, notes, before = [], {}, None
    all_known = [value for values in maps for value in values if value == value] or [0.]
    least, most = min(all_known) if least is None else least, max(all_known) if most is None else most
    palette = palette_of(colours, least, most) if most > least else []
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
            figures.append({"place": place, "event": event, "low": short(low, 3), "high": with_unit(high, unit, 3),
                            "round": is_round, "image": picture(grid, values, least, most, palette, is_round)})
    notes = [f"At {', '.join(at)} it {text}." for text, at in notes.items()]
    if figures and colours is BLUES and least < 0:
        notes.append("Red is tension.")
    return {"words": words, "unit": unit, "figures": figures, "notes": notes,
            "low": short(least, 3), "high": with_unit(most, unit, 3),
            "gradient": ", ".join(palette[254 * k // 32] for k in range(33 if palette else 0)),
            "ratio": f"{grid.half_x:.6g} / {grid.half_y:.6g}", "bar": grid.bar(),
            "events": [f"{place}: {event}" for place, event in places], "states": []}


def maps_of_states(grid, places, maps):
    """What points do at all events, but for those at which they do the same as before."""
    figures, notes, before = [], [], None
    for (place, event), values in zip(places, maps):
        if before and all(a == b for a, b in zip(before, values) if a == a):
            notes.append(f"At {place} it is the same.")
        elif any(value == value for value in values):
            before = values
            is_round = grid.is_round(values)
            figures.append({"place": place, "event": event, "round": is_round, "image": picture_of_states(grid, values, is_round)})
    met = sorted({int(value) for values in maps for value in values if value == value})
    return {"words": "State", "unit": "", "figures": figures,
            "notes": [*notes, "A cell of one colour is the area of a quadrature point."], "events": [],
            "ratio": f"{grid.half_x:.6g} / {grid.half_y:.6g}", "bar": grid.bar(), "states": [STATES[k] for k in met]}
