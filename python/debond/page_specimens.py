"""The page of fits of many specimens."""

import math
import os

from debond.page_curve import ticks
from debond.page_data import n_rows, number, read_json, read_table, short
from debond.page_run import files_of, origin_of

WIDTH, LEFT, RIGHT, TOP, ROW = 560, 132, 548, 10, 24  # of the viewBox, as that of curves: text has 17 units
ALL = "all"


def _rows_of(table):
    return [dict(zip(table, fields)) for fields in zip(*table.values())]


def _axis(values, ends_of_means, is_logarithmic):
    """Limits that hold all values, and ends of means as far as they let the values be seen; a function from a value to its
    place from 0 to 1; and round numbers between the limits with their texts."""
    to, back = (math.log, math.exp) if is_logarithmic else (float, float)
    low, high = to(min(values)), to(max(values))
    span = high - low or 0.1 * abs(high) or 1.0
    places = [low, high, *(min(max(to(value), low - span), high + span) for value in ends_of_means)]
    low, high = min(places) - 0.06 * span, max(places) + 0.06 * span
    if is_logarithmic and high - low > math.log(6):
        marks = [mantissa * 10.0**decade for decade in range(-30, 31) for mantissa in (1, 2, 5)]
        marks = [(mark, f"{mark:g}") for mark in marks if low < math.log(mark) < high]
        marks = marks[::-(-len(marks) // 6)]
    else:
        marks = ticks(back(low), back(high), most=5)
    return lambda value: (to(value) - low) / (high - low), marks


def _line(row, place, at, text, kind):
    """One line of the picture: text, dot and interval, as far as they are known."""
    value, low, high = (number(row[name]) for name in ("value" if kind == "one" else "mean", "lower_95", "upper_95"))
    is_told = row.get("told", "true") == "true" and math.isfinite(low) and math.isfinite(high)
    y = TOP + (at + 0.5) * ROW
    line = {"text": text, "y": y, "kind": kind, "title": f"{text}: {short(value, 5)}"
            + (f" ({short(low, 5)} to {short(high, 5)})" if is_told else ", not told")}
    if math.isfinite(value):
        line["x"] = place(value)
        line["ends"] = [place(low), place(high)] if is_told and high > low else None
    return line


def forest_of(unknown, parameters, pooled):
    """What the template draws of an unknown: a line for each specimen with its interval, by group, and below each group and
    below all their means. None without a value."""
    own = [row for row in parameters if row["unknown"] == unknown]
    means = {row["group"]: row for row in pooled if row["unknown"] == unknown}
    told = [row for row in own if row["told"] == "true"]
    is_logarithmic = own[0]["logarithmic"] == "true"

    def drawable(rows, *names):
        values = [number(row[name]) for row in rows for name in names]
        return [value for value in values if math.isfinite(value) and (value > 0 or not is_logarithmic)]

    ends = drawable(own, "value") + drawable(told, "lower_95", "upper_95")
    if not ends:
        return None
    share, marks = _axis(ends, drawable(means.values(), "mean", "lower_95", "upper_95"), is_logarithmic)

    def place(value):
        return round(LEFT + (RIGHT - LEFT) * min(1.0, max(0.0, share(value))), 1)

    lines, groups = [], list(dict.fromkeys(row["group"] for row in own))
    for group in groups:
        lines += [_line(row, place, len(lines) + i, row["specimen"], "one")
                  for i, row in enumerate(row for row in own if row["group"] == group)]
        if group in means:
            lines.append(_line(means[group], place, len(lines), group or "no group", "mean"))
    if ALL in means:
        lines.append(_line(means[ALL], place, len(lines), ALL, "mean"))
    bottom = TOP + len(lines) * ROW
    return {"unknown": unknown, "unit": own[0]["unit"], "lines": lines, "is_logarithmic": is_logarithmic,
            "size": (WIDTH, bottom + 30), "box": (LEFT, RIGHT, TOP, bottom),
            "ticks": [(place(value), text) for value, text in marks]}


def _values(row):
    low, high = short(row["lower_95"], 4), short(row["upper_95"], 4)
    return f"{low} to {high}" if low and high else "cannot be told"


def context_of_specimens(directory):
    """What the template specimens.html shows."""
    tables = [read_table(os.path.join(directory, name)) for name in ("parameters.csv", "pooled.csv")]
    parameters, pooled = map(_rows_of, tables)
    about = read_json(os.path.join(directory, "specimens.json"))
    names, failed = list(dict.fromkeys(row["specimen"] for row in parameters)), about.get("failures") or {}
    unknowns = list(dict.fromkeys(row["unknown"] for row in parameters if row["unknown"]))
    # a row of the table for each specimen: of each unknown value and interval
    rows = []
    for name in names:
        own = [row for row in parameters if row["specimen"] == name]
        by_unknown = {row["unknown"]: row for row in own}
        values = [text for unknown in unknowns for row in [by_unknown.get(unknown)]
                  for text in ((short(row["value"]), _values(row)) if row else ("", ""))]
        state = failed.get(name) and "failed" or ("" if own[0]["fits"] == "true" else "the model does not fit")
        link = "" if not os.path.exists(os.path.join(directory, name, "report.html")) else f"{name}/report.html"
        rows.append({"name": name, "link": link, "group": own[0]["group"], "values": values, "state": state,
                     "e_rel": short(100 * number(own[0]["e_rel"]), 3)})
    title, n = about.get("title", ""), len(names)
    units = {row["unknown"]: row["unit"] for row in parameters}
    return {"title": f"{title}: {n} specimens" if title else f"{n} specimens in {directory}", "finished": not failed,
            "reason": f"{n - len(failed)} of {n} specimens are fitted",
            "warnings": [f"{name}: {why}" for name, why in failed.items()],
            "specimens": rows, "unknowns": [(name, units[name]) for name in unknowns],
            "forests": list(filter(None, (forest_of(unknown, parameters, pooled) for unknown in unknowns))),
            "pooled": pooled, "n_left_out": sum(int(row["left_out"]) for row in pooled if row["group"] == ALL),
            "has_groups": n_rows(tables[0]) > 0 and any(tables[0]["group"]),
            "origin": origin_of(about), "files": files_of(directory)}
