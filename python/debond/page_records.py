"""The page of a folder of raw records."""

import os

from debond.page_curve import FEW, Plot
from debond.page_data import read_json, read_table, rows_of, shown, split_unit
from debond.page_run import files_of, labels_of, origin_of


def context_of_records(directory):
    """What the template records.html shows: curves by group over the same axes, those of records with a mark in red on top."""
    about, table = read_json(os.path.join(directory, "records.json")), read_table(os.path.join(directory, "records.csv"))
    rows, groups, kinds, whole = rows_of(table), {}, {}, Plot("", "", "")
    n, n_marked = len(rows), sum(row["mark"] != "" for row in rows)
    for row, (x, y) in sorted(zip(rows, about["curves"]), key=lambda one: one[0]["mark"] != ""):
        name = ", ".join(f"{field} {row[field] or 'unknown'}" for field in about["by"])
        plot, marks = groups.setdefault(name, (Plot(*labels_of(about["axes"]), f"records, {name}"), []))
        plot.add(row["specimen"], "line", x, y, FEW[0] if row["mark"] else FEW[1])
        plot.limits = whole.limits
        marks.append(row["mark"])
        for mark in filter(None, row["mark"].split("; ")):
            kinds.setdefault(mark.split(":")[0], []).append(row["specimen"])
    whole.series = [one for plot, _ in groups.values() for one in plot.series]
    units = {name: split_unit(name) for name in ("specimen", "mark", *(name for name in table if name not in ("specimen", "mark", "file")))}
    return {"title": f"{n} records of {about['folder']}", "finished": True, "problem": f"{n_marked} marked" * (n_marked > 0),
            "reason": f"{n - n_marked} of {n} records have no mark",
            "warnings": [f"{mark}: {', '.join(names)}" for mark, names in kinds.items()],
            "pictures": [(name, len(marks), sum(map(bool, marks)), plot.context()) for name, (plot, marks) in sorted(groups.items())],
            "head": [words.replace("_", " ") + f" [{unit}]" * bool(unit) for words, unit in units.values()],
            "rows": [[shown(row[name]) if unit or row[name] == "nan" else row[name] for name, (_, unit) in units.items()]
                     for row in rows],
            "origin": origin_of(about), "files": files_of(directory)}
