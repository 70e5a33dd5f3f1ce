"""Curves of pages of results: SVG that is a picture by itself, and data from which the script of the page reads out values."""

import math
import re

from debond.page_data import with_unit

# the area of the data in a viewBox of width 560; text has 17 units, which are 11 px where the page is 400 px wide
LEFT, TOP, WIDE, HIGH = 66, 30, 482, 292
FEW = ("#c03028", "#2c1e5c", "#e08a1e", "#3a7d44", "#2a78b0", "#8e4585", "#6b6b6b", "#a0522d", "#20a0a0", "#d868a8", "#98982a",
       "#000000")


def colour(i, n):
    """Of curve i of n: a few are told apart by their colours, many by where they are between dark and light."""
    if n <= len(FEW):
        return FEW[i]
    t, ends = i / (n - 1), ((44, 208, 240), (30, 74, 190), (92, 98, 90))
    return "#" + "".join(f"{round(a + (b - a) * 2 * t if t < 0.5 else b + (c - b) * (2 * t - 1)):02x}" for a, b, c in ends)


def ticks(low, high, most=7):
    """Round numbers between two limits, and their texts."""
    step = 10 ** math.floor(math.log10((high - low) / most))
    step *= next(factor for factor in (1, 2, 5, 10) if (high - low) / (factor * step) <= most)
    places = [k * step for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    plain = digits <= 4 and max(map(abs, (low, high))) < 1e6
    return [(place, f"{place:.{digits}f}" if plain else f"{place:.3g}") for place in places]


def at(xs, ys, x):
    """The ordinate of a curve at x, linear between its rows; NaN beyond them."""
    for i in range(1, len(xs)):
        if min(xs[i - 1], xs[i]) <= x <= max(xs[i - 1], xs[i]) and xs[i] != xs[i - 1]:
            return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1])
    return math.nan


def finite(*columns):
    """Columns without the rows that hold a number that is not finite."""
    rows = [row for row in zip(*columns) if all(map(math.isfinite, row))]
    return [list(column) for column in zip(*rows)] if rows else [[] for _ in columns]


def thinned(xs, ys, most):
    """The numbers of at most so many rows: of each of the parts of a longer curve the lowest, the highest and the first."""
    if len(xs) <= most:
        return range(len(xs))
    size = math.ceil(3 * len(xs) / most)
    return sorted({k for i in range(0, len(xs), size) for part in [range(i, min(i + size, len(xs)))]
                   for k in (i, min(part, key=ys.__getitem__), max(part, key=ys.__getitem__))} | {len(xs) - 1})


class Plot:
    """Curves over common axes, whose labels and units are given: ("Rotation angle", "°")."""

    def __init__(self, x, y, about, high=HIGH):
        self.x, self.y, self.about, self.high, self.series, self.levels, self.labels = x, y, about, high, [], [], []
        self.sign = 1

    def add(self, name, kind, xs, ys, colour, most=4000, errors=(), jumps=()):
        """Adds a "line", "points", single large "marks", or a "band" between the first half of the rows and the second. Errors
        of the ordinates are read out with them. A line is dashed to rows that a jump leads to: jumps has 1 for these, else 0."""
        xs, ys, jumps, *errors = finite(xs, ys, jumps or [0] * len(xs), *[errors] * bool(errors))
        if kind == "line":
            rows = sorted({*thinned(xs, ys, most), *(k for j, jump in enumerate(jumps) if jump for k in (j - 1, j))})
            xs, ys, jumps, *errors = ([values[k] for k in rows] for values in (xs, ys, jumps, *errors))
            kind = kind if len(xs) > 1 else "points"
        if xs:
            self.series.append({"name": name, "kind": kind, "x": xs, "y": ys, "colour": colour, "jumps": jumps,
                                **{"e": one for one in errors}})

    def band(self, name, xs, lower, upper, colour):
        xs, lower, upper = finite(xs, lower, upper)
        self.add(name, "band", xs + xs[::-1], lower + upper[::-1], colour)

    def level(self, name, colour, x=None, y=None):
        """A dashed line all across at one x or one y."""
        self.levels.append({"name": name, "kind": "level", "x": x, "y": y, "colour": colour})

    def label(self, text, x=None, y=None):
        """A text at a mark, or along a line at one x or one y. What has one is not in the legend."""
        self.labels.append({"text": text, "x": x, "y": y})

    def placed_labels(self, px, py):
        """The texts with places, and where they are from there: those of lines along these, those of marks one below the
        other, that of the last mark on top."""
        placed, lowest, foot = [], 0., self.high - 8
        for one in sorted(self.labels, key=lambda one: -math.inf if one["x"] is None else -one["x"]):
            x, y = WIDE if one["x"] is None else px(one["x"]), self.high if one["y"] is None else py(one["y"])
            is_at_mark, to_left = None not in (one["x"], one["y"]), x > 0.6 * WIDE
            if is_at_mark:
                lowest = min(max(y + 26, lowest + 20), self.high - 8)
                dy = lowest - y
            elif one["x"] is None:
                dy = -6
            else:
                dy, foot = foot - y, foot - 20
            placed.append({**one, "px": LEFT + x, "py": TOP + y, "dx": -5 if to_left else 5, "dy": round(dy, 1),
                           "anchor": "end" if to_left else "start", "leads": is_at_mark})
        return placed

    def limits(self):
        """Those of the axes: all that is drawn, from 0 where nothing is negative."""
        xs = [x for one in self.series for x in one["x"]] + [one["x"] for one in self.levels if one["x"] is not None]
        ys = [y for one in self.series for y in one["y"]] + [one["y"] for one in self.levels if one["y"] is not None]
        left, right, low, high = min(xs), max(xs), min(ys), max(ys)
        gap = 0.08 * (high - low) or 0.1 * abs(high) or 1.
        low = 0. if -1e-3 * high < low < 0.5 * high or low == high == 0 else low - gap
        left, room = 0. if 0 < left < 0.1 * right else left, 0.02 * (right - left) or 1.
        return (left - room if left < -0.5 * room else left, right + room), (low, high + gap)

    def turn(self):
        """A load along the way that goes mainly below 0, as of a push along z, is drawn along -z: from left to right."""
        axes = [re.search(" (along|about) ([xyz])", words) for words, _ in (self.x, self.y)]
        xs = [x for one in self.series for x in one["x"]]
        if all(axes) and axes[0][2] == axes[1][2] and -min(xs) > max(xs):
            self.sign = -1
            self.x, self.y = ((re.sub("( along| about) ", r"\1 −", words), unit) for words, unit in (self.x, self.y))
            for one in self.series:
                one.update({axis: [-value for value in one[axis]] for axis in "xy"})
            for one in self.levels + self.labels:
                one.update({axis: one[axis] and -one[axis] for axis in "xy"})

    def context(self):
        """What the template curve.html draws; None without any data."""
        if not self.series:
            return None
        self.turn()
        (left, right), (low, high) = limits = self.limits()
        fx, fy = WIDE / (right - left), self.high / (high - low)
        shapes = []
        for one in self.series:
            places = [f"{(x - left) * fx:.2f} {(high - y) * fy:.2f}" for x, y in zip(one["x"], one["y"])]
            is_dots, jumps = one["kind"] in ("points", "marks"), one["jumps"]
            path = "".join(f"M{place}h.01" if is_dots else f"{'L' if k and not jumps[k] else 'M'}{place}"
                           for k, place in enumerate(places))
            if one["kind"] == "marks":
                one["name"] += f": {with_unit(one['y'][0], self.y[1])} at {with_unit(one['x'][0], self.x[1])}"
            shapes.append({**one, "path": path + "Z" * (one["kind"] == "band")})
            if any(jumps):
                shapes.append({**one, "name": "jump", "kind": "jump", "path": "".join(
                    f"M{places[k - 1]}" * (not jumps[k - 1]) + f"L{places[k]}" for k in range(1, len(places)) if jumps[k])})
        # names, places and values from which the script reads out; seven digits are more than it shows
        data = {"x": limits[0], "y": limits[1], "box": (LEFT, TOP, WIDE, self.high), "units": (self.x[1], self.y[1]), "series": [
            {"name": one["name"], **{axis: [float(f"{value:.7g}") for value in one[axis]] for axis in "xye" if axis in one}}
            for one in self.series if one["kind"] in ("line", "points")]}
        return {"x": self.x, "y": self.y, "about": self.about, "shapes": shapes, "levels": self.levels, "data": data,
                "sign": self.sign, "labels": self.placed_labels(lambda x: (x - left) * fx, lambda y: (high - y) * fy),
                "ticks": (ticks(left, right), ticks(low, high, most=7 * self.high / HIGH)), "many": False, "drawn": 0, "of": 0}
