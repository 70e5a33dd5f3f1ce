"""The page of one run."""

import math
import os

from debond.page_curve import Plot, at, finite
from debond.page_data import (MACHINES, curve_file, curve_columns, machine_compliance, number, numbers, read_entries, read_json,
                              read_table, rows_file, short, unique, with_unit)
from debond.page_maps import maps_of
from debond.reductions import reduced, sizes_of

#: Words and units of columns.
LABELS = {"angle_deg": ("Rotation angle", "°"), "torque_Nmm": ("Torque T", "N mm"), "time": ("Time", ""),
          "displacement_mm": ("Displacement", "mm"), "force_N": ("Force", "N"),
          "machine_angle_deg": ("Rotation angle of the machine", "°"), "machine_uz_mm": ("Displacement along z of the machine", "mm"),
          **{f"chuck_{letter}{axis}_{end}": (f"{words} {axis}", unit)
             for letter, end, words, unit in (("u", "mm", "Displacement along", "mm"), ("r", "deg", "Rotation about", "°"),
                                              ("F", "N", "Force along", "N"), ("M", "Nmm", "Moment about", "N mm"))
             for axis in "xyz"}}


def labels_of(axes):
    return [LABELS[name] for name in axes]


def columns_of(file, axes):
    """Two columns of a file of a curve; empty ones where there are none."""
    table = read_table(file)
    return [numbers(table.get(name, [])) for name in axes]


def machine_axes(directory, axes):
    """The same with what the machine shows, in a list; an empty one where the machine is rigid."""
    return [(MACHINES.get(axes[0], axes)[0], axes[1])] * bool(machine_compliance(directory, axes[0]))


def curve_and_jumps(directory, axes):
    """Both columns of the curve of a run, also over what a machine shows, and 1 for rows that a jump leads to, else 0."""
    over = next((over for over, (machine, _) in MACHINES.items() if machine == axes[0]), axes[0])
    xs, ys, times, loads = columns_of(curve_file(directory), (over, axes[1], "time", MACHINES.get(over, axes)[1]))
    if over != axes[0]:  # the curve between the rows has no place of the machine
        compliance = machine_compliance(directory, over)
        xs = [x + compliance * load for x, load in zip(xs, loads)]
    ends, released = columns_of(rows_file(directory), ("time", "released_energy_Nmm"))
    jumps, row = [0] * len(xs), 0
    for i, time in enumerate(times if released else []):
        jumps[i] = int(row > 0 and released[row] > released[row - 1])
        row = min(row + (time == ends[row]), len(ends) - 1)
    return xs, ys, jumps


def reference_of(directory, axes):
    """The reference that the program left in the directory, in the units of its name."""
    return columns_of(os.path.join(directory, "reference.csv"), axes)


def add_mark(plot, words, x, y):
    """A dot on the curve, with a label."""
    if math.isfinite(x) and math.isfinite(y):
        plot.add(words, "marks", [x], [y], "#222222")
        plot.label(words, x, y)


def add_marks_of_torque(plot, xs, ys, over, summary, reference):
    """Angles of the summary as dots on the curve, reference marks of the scene as dashed lines. over: angles of the implant."""
    for member, words in (("theta_max_deg", "largest torque"), ("theta_full_deg", "end of flat peak"),
                          ("theta_debonding_deg", "bond begins to break")):
        angle = number(summary.get(member))
        add_mark(plot, words, at(over, xs, angle), at(over, ys, angle))
    kinds = (("Tₘₐₓ", "y"), ("T∞", "y"), ("θₗᵢₙ", "x"), ("θₘₐₓ", "x"))
    for (symbol, axis), value in zip(kinds, map(number, reference.split(","))):
        if value == value:
            name = f"reference {symbol} = {with_unit(value, getattr(plot, axis)[1])}"
            plot.level(name, "#888888", **{axis: value})
            plot.label(name, **{axis: value})


def in_order(curves):
    """What is drawn over the place of the chuck and over that of a machine with a spring: the second one first, unless there is
    a reference, with which the program compares the other. Empty without rows."""
    curves = list(filter(None, curves))
    if len(curves) > 1:
        curves[0]["x"] = (curves[0]["x"][0] + " of the implant", curves[0]["x"][1])
        if all(shape["name"] != "reference" for shape in curves[0]["shapes"]):
            curves.reverse()
    return curves


def curve_of(directory, axes, own, summary, entries):
    """The curve of a run with its marks and the reference, over its own place or that of the machine; None without rows."""
    x, y = labels_of(axes)
    plot, (xs, ys, jumps) = Plot(x, y, "curve of the run"), curve_and_jumps(directory, axes)
    over = xs if axes == own else curve_and_jumps(directory, own)[0]
    plot.add("reference", "points", *reference_of(directory, own), "#555555")
    errors = read_table(os.path.join(directory, "errors.csv"))
    errors = numbers(errors.get(own[1] + "_error", []))
    errors = errors if len(errors) == len(xs) else []
    if errors:
        plot.band("estimated error", xs, [y - e for y, e in zip(ys, errors)], [y + e for y, e in zip(ys, errors)], "#0072b2")
    plot.add("debond", "line", xs, ys, "#0072b2", errors=errors, jumps=jumps)
    if "curve" not in summary:
        add_marks_of_torque(plot, xs, ys, over, summary, entries.get("Expert / Output / Reference marks", ""))
    elif xs:
        add_mark(plot, "largest", at(over, xs, number(summary["curve"]["at"])), number(summary["curve"]["largest"]))
    first = number(summary.get("beyond_strength_time"))
    if first == first:
        times, _ = columns_of(curve_file(directory), ("time", own[1]))
        i = min(range(len(times)), key=lambda i: abs(times[i] - first))
        if xs[i] != xs[0]:  # else it happened before the curve begins
            add_mark(plot, "bone beyond its strength", xs[i], ys[i])
    return plot.context()


def reductions_of(directory, axes, entries):
    """Rows of the table of numbers to which tests are usually reduced, for curves of torques and of forces."""
    quantity = {("°", "N mm"): "moment", ("mm", "N"): "force"}.get(tuple(unit for _, unit in labels_of(axes)))
    sizes, is_along_axis = sizes_of(entries), axes[1] == "torque_Nmm" or "z" in axes[1]
    sizes = sizes if is_along_axis or quantity == "force" and "area" in sizes else {}
    rows = reduced(*finite(*curve_and_jumps(directory, axes)[:2]), quantity, sizes) if quantity else []
    return [(words, with_unit(value, unit), left_out) for words, value, unit, left_out in rows]


def origin_of(summary, seconds=None):
    """Where results come from: version, commit, date, host, command, run time [s]."""
    provenance = summary.get("provenance")
    rows = list(provenance.items()) if isinstance(provenance, dict) else []
    return rows + [("run time", with_unit(seconds, "s", 3))] * bool(short(seconds))


def files_of(directory):
    """Names of files of results that a page links to; of series only the file that names the others."""
    return sorted(name for name in os.listdir(directory) if os.path.isfile(os.path.join(directory, name))
                  and name.endswith((".csv", ".json", ".jsonl", ".prm", ".pvd", ".svg", ".png")))


def context_of_run(directory):
    """What the template run.html shows of a directory."""
    summary = read_json(os.path.join(directory, "summary.json"))
    if abs(number(summary.get("force_end_N"))) < 1e-8:
        del summary["force_end_N"]  # of a chuck that is free, but for rounding
    entries = read_entries(os.path.join(directory, "parameters.prm"))
    # their coefficient is phi on another scale
    is_mu_phi = entries.get("Interface / Friction law") in ("modified coulomb", "table")
    own = curve_columns(summary)
    curves = in_order([curve_of(directory, axes, own, summary, entries) for axes in [own, *machine_axes(directory, own)]])
    sign, (steps, places) = curves[0]["sign"] if curves else 1, columns_of(rows_file(directory), ("step", own[0]))
    places = {short(step): with_unit(sign * place, LABELS[own[0]][1], 3) for step, place in zip(steps, places)} if any(places) else {}
    return {"title": entries.get("Title") or f"Results in {directory}", "finished": summary.get("converged") is True,
            "reason": summary.get("reason") or "the run is at work, or was ended from outside" * (not summary),
            "warnings": unique([*(summary.get("warnings") or []), *(summary.get("remarks") or [])]),
            "summary": summary, "entries": entries,
            "curves": curves, "sign": sign, "reductions": reductions_of(directory, own, entries), "is_mu_phi": is_mu_phi,
            "maps": maps_of(os.path.join(directory, "maps.csv"), places, without=["mu"] * is_mu_phi),
            "origin": origin_of(summary, summary.get("wall_seconds")), "files": files_of(directory)}
