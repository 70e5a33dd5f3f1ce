"""Pages of studies, ensembles and calibrations."""

import os
import re

from debond.page_curve import Plot, colour
from debond.page_data import (curve_columns, numbers, n_rows, read_entries, read_json, read_table, rows_of, split_unit,
                              unique, varied_in)
from debond.page_run import LABELS, curve_and_jumps, files_of, in_order, labels_of, machine_axes, origin_of, reference_of

MOST_CURVES = 40    # more would hide each other, and make the page large
MOST_BANDS = 8      # that can still be told apart
MOST_COLOURS = 12   # of curves that a legend names


def short_name(entry, entries):
    """The end of the name of an entry that no other one has; `Value` alone says nothing."""
    parts = entry.split(" / ")
    for k in range(len(parts) - 1, 0, -1):
        end = " / ".join(parts[k:])
        if sum(other.endswith(" / " + end) for other in entries) < 2 and end != "Value":
            return end
    return entry


def names_of(entries, values, name_of=None, separator=", "):
    """Names of variants, brief ones if it is not said how an entry is called, and whether they have only what differs from the
    first variant: where four or more entries vary, or none changes all of them."""
    name_of = name_of or (lambda entry: short_name(entry, entries))
    changes = max((sum(a != b for a, b in zip(row, values[0])) for row in values), default=0)
    only_changes = changes > 0 and (len(entries) >= 4 or changes < len(entries))
    return [separator.join(f"{name_of(name)} = {value}" for name, value, first in zip(entries, row, values[0])
                           if not only_changes or value != first) or "first values" * bool(entries) for row in values], only_changes


def chosen(items):
    """Some of many, evenly chosen."""
    return items[::-(-len(items) // MOST_CURVES) or 1]


def curves_of_study(directory, curves):
    """The curves of variants, given as directories and names."""
    some, own = chosen(curves), curve_columns(next(filter(None, (read_json(variant + "/summary.json") for variant, _ in curves)), {}))
    several = []
    for axes in [own, *(machine for variant, _ in some[:1] for machine in machine_axes(variant, own))]:
        plot = Plot(*labels_of(axes), "curves of the variants")
        for i, (variant, name) in enumerate(some):
            xs, ys, jumps = curve_and_jumps(variant, axes)
            plot.add(name, "line", xs, ys, colour(i, len(some)), most=20000 // len(some), jumps=jumps)
        several.append(with_reference(plot, own, [directory, *(variant for variant, _ in some[:1])], len(some), len(curves), "variants"))
    return in_order(several)


def with_reference(plot, axes, directories, n_drawn, n, what):
    """What is drawn of a plot with the reference, and what it does not say itself."""
    for one in directories:
        if not any(series["name"] == "reference" for series in plot.series):
            plot.add("reference", "points", *reference_of(one, axes), "#555555")
    context = plot.context()
    return context and {**context, "many": n_drawn > MOST_COLOURS, "drawn": n_drawn, "of": n, "what": what}


def bands_of_ensemble(directory, table, variants):
    """The mean curve of each group of an ensemble, and the band that holds 5 to 95 % of its members."""
    entries, groups = varied_in(table), {}
    for row in rows_of(table):
        groups.setdefault(tuple(row[name] for name in entries), []).append(row)
    all_groups = list(zip(names_of(entries, list(groups))[0], groups.values()))
    some, axes = chosen(all_groups), curve_columns({})
    plot = Plot(*labels_of(axes), "mean curves of the groups")
    for i, (name, rows) in enumerate(some):
        xs, mean, low, high = (numbers(row[column] for row in rows) for column in (
            "angle_deg", "torque_mean_Nmm", "torque_p05_Nmm", "torque_p95_Nmm"))
        if len(some) <= MOST_BANDS:
            plot.band("5 to 95 %" + (f", {name}" if name else " of the members"), xs, low, high, colour(i, len(some)))
        plot.add(f"mean, {name}" if name else "mean", "line", xs, mean, colour(i, len(some)), most=20000 // len(some))
    return in_order([with_reference(plot, axes, [directory, *variants[:1]], len(some), len(all_groups), "groups")])


def warnings_of_study(rows, names):
    """Variants that failed, and what variants warn of; texts that differ in their numbers only are said once."""
    texts, said = [], {}
    for row, name in zip(rows, names):
        if row.get("converged") != "true":
            texts.append(f"variant {row['variant']}, {name}: {row.get('reason') or 'not done'}")
        for text in filter(None, map(row.get, ("warnings", "remarks"))):
            said.setdefault(re.sub(r"\d[\d.e+-]*", "", text), []).append((row["variant"], text))
    for several in said.values():
        some = ", ".join(variant for variant, _ in several[:8]) + f" and {len(several) - 8} others" * (len(several) > 8)
        numbers_of = f" (numbers of variant {several[0][0]})" * (len({text for _, text in several}) > 1)
        texts.append(f"variant{'s' * (len(several) > 1)} {some}: {several[0][1]}{numbers_of}")
    return texts


def context_of_study(directory):
    """What the template study.html shows of a study or an ensemble."""
    table = read_table(os.path.join(directory, "study.csv"))
    rows, entries = rows_of(table), varied_in(table)
    names, only_changes = names_of(entries, [[row[name] for name in entries] for row in rows])
    places = [os.path.join(directory, "variant-" + row["variant"].zfill(3)) for row in rows]
    done = [(place, name) for place, name, row in zip(places, names, rows) if row.get("converged") == "true"]
    ensemble = read_table(os.path.join(directory, "ensemble.csv"))
    curves = bands_of_ensemble(directory, ensemble, [place for place, _ in done]) if n_rows(ensemble) else \
        curves_of_study(directory, done)
    scene = next(filter(None, (read_entries(os.path.join(place, "parameters.prm")) for place in places)), {})
    title, n = scene.get("Title"), len(rows)
    return {"title": f"{title}: study of {n} variants" if title else f"Study of {n} variants in {directory}",
            "finished": len(done) == n, "reason": f"{len(done)} of {n} variants are done",
            "warnings": warnings_of_study(rows, names), "curves": curves,
            "turns": all("angle" in one["x"][0] for one in curves), "statistics": read_table(os.path.join(directory, "ensemble_summary.csv")),
            "variants": {**table, "changed": names},
            "first": ["changed"] if only_changes else entries, "entries": scene,
            "origin": origin_of(read_json(os.path.join(done[0][0], "summary.json")) if done else {}),
            "files": files_of(directory)}


def fits_of(directory):
    """For each measured curve the picture with its fit, and that of what lies between them."""
    pictures = []
    files = [name for name in os.listdir(directory) if re.fullmatch(r"fit(-\d+)?\.csv", name)]
    for file in sorted(files, key=lambda name: (len(name), name)):
        table = read_table(os.path.join(directory, file))
        over, *others = table
        for column in [name[:-len("_measured")] for name in others if name.endswith("_measured")]:
            x, y = (LABELS.get(name) or (split_unit(name)[0].replace("_", " ").capitalize(), split_unit(name)[1])
                    for name in (over, column))
            xs, measured, fitted, low, high = (numbers(table[name]) for name in (
                over, *(f"{column}_{kind}" for kind in ("measured", "fitted", "lower_95", "upper_95"))))
            plot = Plot(x, y, f"fit of {column}")
            rest = Plot(x, (f"Measured - fitted {y[0][0].lower()}{y[0][1:]}", y[1]), f"residuals of {column}", high=150)
            plot.band("95 % band", xs, low, high, "#c03028")
            plot.add("measured", "points", xs, measured, "#555555")
            plot.add("fitted", "line", xs, fitted, "#c03028")
            rest.add("residuals", "points", xs, [a - b for a, b in zip(measured, fitted)], "#555555")
            rest.level("", "#c03028", y=0)
            pictures.append({"file": file if len(files) > 1 else "", "curve": plot.context(), "residuals": rest.context()})
    return pictures


def context_of_calibration(directory):
    """What the template calibration.html shows."""
    json = read_json(os.path.join(directory, "calibration.json"))
    title, n = json["title"], json["evaluations"]
    reason = f"{json['measured_values']} measured values, " + (f"{n} evaluations" if n else "closed form")
    entries = read_entries(os.path.join(directory, "parameters.prm"))
    misfits = [one["curve"] for one in json["curves"] if not one["fits"]]
    problem = "failed" if json.get("failed") else "does not fit" if misfits else ""
    return {"title": f"{title}: calibration" if title else f"Calibration in {directory}", "finished": True, "problem": problem,
            "reason": f"{json.get('failed')} ({reason})" if json.get("failed") else reason,
            "warnings": unique([*json["cannot_be_told"], *json["warnings"]]), "json": json, "names": list(json["unknowns"]),
            "fits": fits_of(directory), "origin": origin_of(json, json["seconds"]),
            "entries": entries, "where": {name: [entry for entry, text in entries.items() if re.search(rf"<<{re.escape(name)}[:>]", text)]
                                          for name in json["unknowns"]}, "files": files_of(directory)}


def context_of_bench(directory):
    """What the template bench.html shows of a published test."""
    bench = read_json(os.path.join(directory, "bench.json"))
    verdicts = [row["verdict"].partition(",")[0] for row in bench["rows"]]
    return {"title": bench["title"], "bench": bench, "finished": True, "warnings": [], "origin": [], "files": files_of(directory),
            "reason": ", ".join(f"{verdicts.count(one)} {one}" for one in dict.fromkeys(verdicts))}
