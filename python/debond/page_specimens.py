"""The page of fits of many specimens."""

import math
import os

from debond.page_curve import Plot, colour, ticks
from debond.page_data import number, read_json, read_table, rows_of, short, with_unit
from debond.page_run import files_of, origin_of

ALL = "all"


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


def forest_of(unknown, parameters, pooled, as_dots=False):
    """What the template draws of an unknown: a line for each specimen with its interval, by group, and below each group and
    below all their means; or, as dots, one line for all of a group. None without a value."""
    own = [row for row in parameters if row["unknown"] == unknown]
    means = {row["group"]: row for row in pooled if row["unknown"] == unknown}
    told = [row for row in own if row["told"] == "true"]
    is_logarithmic = own[0]["logarithmic"] == "true"

    def drawable(rows, *names):
        values = [number(row.get(name)) for row in rows for name in names]
        return [value for value in values if math.isfinite(value) and (value > 0 or not is_logarithmic)]

    ends = drawable(own, "value") + drawable(told, "lower_95", "upper_95")
    if not ends:
        return None
    share, marks = _axis(ends, drawable(means.values(), "mean", "lower_95", "upper_95"), is_logarithmic)

    def place(text):
        """From 0 to 1; None of what is not known."""
        return min(1.0, max(0.0, share(number(text)))) if math.isfinite(number(text)) else None

    def line(name, row, kind, rows=()):
        value, is_told = row["value" if kind == "one" else "mean"], row.get("told", "true") == "true"
        ends = [place(row[end]) if is_told else None for end in ("lower_95", "upper_95")]
        return {"text": name, "kind": kind, "value": value, "at": place(value), "row": row, "is_told": is_told,
                "dots": [place(one["value"]) for one in rows], "ends": None if None in ends or ends[0] == ends[1] else ends}

    lines = []
    for group in dict.fromkeys(row["group"] for row in own):
        rows = [row for row in own if row["group"] == group]
        lines += [line(row["specimen"], row, "one") for row in rows if not as_dots]
        lines += [line(group or "no group", row, "mean", rows * as_dots) for name, row in means.items() if name == group]
    lines += [line(ALL, row, "mean") for name, row in means.items() if name == ALL and not as_dots]
    return {"unknown": unknown, "unit": own[0].get("unit"), "lines": lines, "is_logarithmic": is_logarithmic,
            "ticks": [(share(value), text) for value, text in marks]}


def in_words(row, name, unit, ends=("lower_95", "upper_95"), digits=3):
    """"12.3 N mm (3.1 to 21.5)" of a row of a table, in a list; an empty one where it has no such number."""
    low, high = (short(row[end], digits) for end in ends)
    return [with_unit(row[name], unit, digits) + (f" ({low} to {high})" if low and high else " (interval cannot be told)")] * bool(short(row[name]))


def difference_in_words(row):
    """"etched minus machined: 12.3 N mm (3.1 to 21.5); 1.1 times (1.02 to 1.19)", of what is known."""
    difference = in_words(row, "difference", row["unit"])
    return f"{row['group']} {'minus' if difference else 'over'} {row['minus']}: " + "; ".join(
        difference + in_words(row, "ratio", "times", ("ratio_lower_95", "ratio_upper_95")))


def context_of_groups(directory):
    """What the template groups.html shows."""
    means, differences = (rows_of(read_table(os.path.join(directory, name))) for name in ("groups.csv", "differences.csv"))
    about = read_json(os.path.join(directory, "groups.json"))
    values = [dict(zip(("unknown", "group", "value", "told", "logarithmic"), (*own, "true", "false"))) for own in about["values"]]
    unknowns = {row["unknown"]: row["unit"] for row in means}
    return {"title": f"Groups of {about['table']}", "finished": True, "problem": "", "reason": f"by {about['by']}", "warnings": [],
            "forests": [{**forest_of(name, values, means, True), "unit": unit} for name, unit in unknowns.items()],
            "means": means, "differences": differences, "unknowns": list(unknowns), "notes": about["notes"],
            "origin": origin_of(about), "files": files_of(directory)}


def _plot_of_peaks(peaks, parameters):
    """The peak over the unknown, of each set of entries, and the specimens."""
    plot = Plot((peaks["unknown"], peaks["unit"]), ("Peak", peaks["load_unit"]), "the peak over " + peaks["unknown"] + ", and specimens")
    sets = peaks["peaks"]
    for i, own in enumerate(sets):
        plot.add("model" if i == 0 else "", "line", peaks["values"], own, colour(1, 2) if len(sets) == 1 else colour(i, max(13, len(sets))))
    rows = [row for row in parameters if row["peak"]]
    plot.add("specimens", "points", *([number(row[name]) for row in rows] for name in ("value", "peak")), colour(0, 2))
    return plot.context()


def context_of_specimens(directory):
    """What the template specimens.html shows."""
    parameters, pooled = (rows_of(read_table(os.path.join(directory, name))) for name in ("parameters.csv", "pooled.csv"))
    about = read_json(os.path.join(directory, "specimens.json"))
    peaks = about.get("peaks") or {}
    names, failed = list(dict.fromkeys(row["specimen"] for row in parameters)), about.get("failures") or {}
    unknowns = list(dict.fromkeys(row["unknown"] for row in parameters if row["unknown"]))
    of_specimens = {name: [row for row in parameters if row["specimen"] == name] for name in names}
    title, n = about.get("title", ""), len(names)
    misfits = [name for name in names if name not in failed and of_specimens[name][0]["fits"] != "true"]
    problem = (f"{len(failed)} failed" if failed else f"{len(misfits)} do not fit" if misfits else
               f"{peaks['beyond']} beyond the model" if peaks.get("beyond") else "")
    n_told = sum(any(row["told"] == "true" for row in rows) for rows in of_specimens.values())
    units = {row["unknown"]: row["unit"] for row in parameters}
    return {"title": f"{title}: {n} specimens" if title else f"{n} specimens in {directory}", "finished": True, "problem": problem,
            "reason": f"{n_told} of {n} peaks tell their specimen" if peaks else f"{n - len(failed)} of {n} specimens are fitted" + (
                f"; the model does not fit {len(misfits)} of them" if misfits else ""),
            "warnings": [f"{name}: {why}" for name, why in failed.items()] + peaks.get("warnings", []),
            "specimens": of_specimens, "failed": failed,
            "with_page": [name for name in names if os.path.exists(os.path.join(directory, name, "report.html"))],
            "unknowns": [(name, units[name]) for name in unknowns],
            "forests": list(filter(None, (forest_of(unknown, parameters, pooled) for unknown in unknowns))),
            "pooled": pooled, "differences": rows_of(read_table(os.path.join(directory, "differences.csv"))),
            "n_left_out": sum(int(row["left_out"]) for row in pooled if row["group"] == ALL),
            "peaks": peaks, "curve": peaks and _plot_of_peaks(peaks, parameters),
            "has_groups": any(row["group"] for row in parameters),
            "origin": origin_of(about), "files": files_of(directory)}
