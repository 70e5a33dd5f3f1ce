"""The page of one run."""

import os

from debond.page_curve import Plot, at
from debond.page_data import curve_file, number, numbers, read_entries, read_json, read_table, short, unique, with_unit
from debond.page_maps import maps_of

#: What is drawn over what: columns, and their words and units. First the torque of an implant that turns.
TORQUE = ("angle_deg", "torque_Nmm", ("Rotation angle", "°"), ("Torque T", "N mm"))
COMPONENTS = [(f"chuck_{way}{axis}_{way_end}", f"chuck_{load}{axis}_{load_end}", (f"{words} {axis}", unit),
               (f"{load_words} {axis}", load_unit))
              for way, way_end, words, unit, load, load_end, load_words, load_unit in
              (("u", "mm", "Displacement along", "mm", "F", "N", "Force along", "N"),
               ("r", "deg", "Rotation about", "°", "M", "Nmm", "Moment about", "N mm")) for axis in "xyz"]


def axes_of(table):
    """Torque over angle of an implant that turns; otherwise load over way of the component of the chuck that moves most."""
    def way(name):
        values = [value for value in numbers(table.get(name, [])) if value == value]
        # a degree at a radius of some mm
        return (max(values) - min(values)) * (0.05 if name.endswith("_deg") else 1) if values else 0
    most = max(COMPONENTS, key=lambda component: way(component[0]))
    return most if way("angle_deg") < 1e-10 < way(most[0]) else TORQUE


def reference_of(directory):
    """Angles [deg] and torques [N mm] of the reference that the program left in the directory."""
    table = read_table(os.path.join(directory, "reference.csv"))
    return numbers(table.get("angle_deg", [])), numbers(table.get("torque_Nmm", []))


def add_marks_of_torque(plot, xs, ys, summary, published):
    """Angles of the summary as dots on the curve, published values as dashed lines."""
    for member, words, colour in (("theta_max_deg", "largest torque", "#2c1e5c"),
                                  ("theta_full_deg", "end of the flat peak", "#e08a1e"),
                                  ("theta_debonding_deg", "the bond has begun to break", "#3a7d44")):
        angle = number(summary.get(member))
        torque = at(xs, ys, angle)
        plot.add(f"{words}: {with_unit(torque, 'N mm')} at {short(angle)}°", "marks", [angle], [torque], colour)
    kinds = (("T_max", "y", "N mm", "#2c1e5c"), ("T_inf", "y", "N mm", "#2a78b0"), ("theta_lin", "x", "°", "#8e4585"),
             ("theta_max", "x", "°", "#6b6b6b"))
    for (symbol, axis, unit, colour), value in zip(kinds, map(number, published.split(","))):
        if value == value:
            plot.level(f"published {symbol} = {with_unit(value, unit)}", colour, **{axis: value})


def curve_of(directory, summary, entries):
    """The curve of a run with its marks and the reference; None without rows."""
    table = read_table(curve_file(directory))
    x, y, x_label, y_label = axes_of(table)
    plot, xs, ys = Plot(x_label, y_label, "curve of the run"), numbers(table.get(x, [])), numbers(table.get(y, []))
    if x == TORQUE[0]:
        plot.add("reference", "points", *reference_of(directory), "#555555")
    plot.add("debond", "line", xs, ys, "#c03028")
    if x == TORQUE[0]:
        add_marks_of_torque(plot, xs, ys, summary, entries.get("Output / Published values", ""))
    elif plot.series:
        way, load = max(zip(plot.series[0]["x"], plot.series[0]["y"]), key=lambda row: abs(row[1]))
        plot.add(f"largest: {with_unit(load, y_label[1])} at {with_unit(way, x_label[1])}", "marks", [way], [load], "#2c1e5c")
    return plot.context()


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
    entries = read_entries(os.path.join(directory, "parameters.prm"))
    return {"title": entries.get("Title") or f"Results in {directory}", "finished": summary.get("converged") is True,
            "reason": summary.get("reason") or "the run is at work, or was ended from outside" * (not summary),
            "warnings": unique([*(summary.get("warnings") or []), *(summary.get("remarks") or [])]),
            "summary": summary, "entries": entries,
            "curve": curve_of(directory, summary, entries), "maps": maps_of(os.path.join(directory, "maps.csv")),
            "levels": read_table(os.path.join(directory, "auto.csv")),
            "origin": origin_of(summary, summary.get("wall_seconds")), "files": files_of(directory)}
