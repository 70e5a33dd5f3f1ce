"""Files of a directory of results, as pages of results read them."""

import csv
import json
import math
import os
import re

from debond.errors import InputError

CHANCE = "Interface / Bonding / Seed"  # a study over it is an ensemble
#: Ends of the names of columns and members, and their units.
UNITS = (("_Nmm_per_rad", "N mm/rad"), ("_MPa_per_mm", "MPa/mm"), ("_N_per_m", "N/m"), ("_N_per_mm", "N/mm"), ("_Nmm_per_deg", "N mm/°"),
         ("_mJ", "mJ"), ("_Nmm", "N mm"), ("_MPa", "MPa"),
         ("_deg", "°"), ("_mm2", "mm²"), ("_mm", "mm"), ("_MB", "MB"), ("_N", "N"))

#: Over what a machine with a spring shows the place of the chuck, and the load along it.
MACHINES = {"angle_deg": ("machine_angle_deg", "torque_Nmm"), "chuck_uz_mm": ("machine_uz_mm", "chuck_Fz_N")}

#: What `auto` stands for, but for what Accuracy chooses.
USUAL = {"Bone / Cells": "15, 15, 2", "Implant / Cells": "3, 2", "Load steps / Steps": "1, 1000", "Load steps / Adaptive": "false",
         "Load steps / Tolerance": "0.001", **{entry.format(body): text for body in ("Bone", "Implant") for entry, text in
                                               (("{} / Material", "neo-hookean"), ("{} / Element", "trilinear"), ("Expert / {} / Layer grading", "1"))}}


class NoResults(InputError):
    """A directory has no results, or some that cannot be read; the text is one line."""


def read_json(path):
    """The object in a JSON file; an empty one if there is no such file."""
    if not os.path.exists(path):
        return {}
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except ValueError as error:
        raise NoResults(f"{path} cannot be read: {error}") from None


def read_table(path):
    """The columns of a CSV file, {name: texts}; without any if there is no such file. A last line that is not whole, as a run
    at work leaves it, is left out."""
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8", errors="replace", newline="") as file:
        rows = list(csv.reader(file))
    if not rows:
        return {}
    names = rows[0]
    rows = [row for row in rows[1:] if len(row) == len(names)]
    return dict(zip(names, map(list, zip(*rows)))) if rows else {name: [] for name in names}


def rows_file(directory):
    """The rows of a run: reactions.csv where the curve is no torque."""
    forces = os.path.join(directory, "reactions.csv")
    return forces if os.path.exists(forces) else os.path.join(directory, "torque.csv")


def curve_file(directory):
    """The curve between the rows if there is one, otherwise the rows."""
    fine = os.path.join(directory, "curve.csv")
    return fine if os.path.exists(fine) else rows_file(directory)


def curve_columns(summary):
    """The columns of the curve that a run is about: what it is drawn over, and the load."""
    curve = summary.get("curve") or {"over": "angle_deg", "load": "torque_Nmm"}
    return curve["over"], curve["load"]


def machine_compliance(directory, over):
    """What the machine shows more than the chuck, by the load along that, from the row with the largest [deg/(N mm) or mm/N];
    0 of a rigid machine."""
    table = read_table(rows_file(directory))
    machine, load = MACHINES.get(over, ("", ""))
    rows = zip(*(numbers(table.get(name, [])) for name in (machine, over, load)))
    shown, place, load = max(rows, key=lambda row: abs(row[2]), default=(0, 0, 0))
    return (shown - place) / load if load and shown != place else 0


def n_rows(table):
    return len(next(iter(table.values()), []))


def rows_of(table):
    return [dict(zip(table, fields)) for fields in zip(*table.values())]


def number(text):
    """A number; NaN for what is none."""
    try:
        return float(text)
    except (TypeError, ValueError):
        return math.nan


def numbers(texts):
    return list(map(number, texts))


def read_entries(path):
    """The entries of a file of parameters that say more than `auto` or `none`, {"Chuck / Rotation z / Value": text}."""
    entries, sections = {}, []
    if os.path.exists(path):
        with open(path, encoding="utf-8", errors="replace") as file:
            for line in map(str.strip, file):
                if line.startswith("subsection "):
                    sections.append(line[len("subsection "):].strip())
                elif line == "end" and sections:
                    sections.pop()
                elif line.startswith("set "):
                    name, _, value = line[len("set "):].partition("=")
                    name, value = " / ".join([*sections, name.strip()]), value.strip()
                    value = USUAL.get(name, value) if value == "auto" else value
                    if value not in ("auto", "none"):
                        entries[name] = value
    return entries


def short(value, digits=4):
    """A number with so many digits, but 17795 rather than 1.78e+04; "" for what is none."""
    value = number(value)
    if not math.isfinite(value):
        return ""
    return f"{round(value)}" if 10**digits <= abs(value) < 1e9 else f"{value:.{digits}g}"


def shown(text, digits=4):
    """What a field of a table is on a page: numbers are short, unknown ones left out."""
    value = number(text)
    return short(value, digits) if not isinstance(text, str) or math.isfinite(value) or text in ("nan", "-nan") else text


def split_unit(name):
    """The words and the unit of a column or a member: ("work", "N mm") of "work_Nmm"; the unit may be empty."""
    for ending, unit in UNITS:
        if name.endswith(ending):
            return name[:-len(ending)], unit
    return name, "s" if "seconds" in name else ""


def with_unit(value, unit, digits=4):
    """"53.8 N mm"; "" if the value is no finite number."""
    text = short(value, digits)
    return text and text + (unit if unit in ("", "°") else f" {unit}")


def members(summary, rows, least=0.):
    """Words, term and text of the members of a summary that have a value: rows are (name, words, term) with the unit that is
    in the name, or (name, words, term, factor, unit). Values below that share of the largest are left out."""
    values = [(row[3] if len(row) > 3 else 1) * number(summary.get(row[0])) for row in rows]
    largest = max((abs(value) for value in values if math.isfinite(value)), default=0)
    return [(row[1], row[2], with_error(value, number(summary.get(row[0] + "_error")), row[4] if len(row) > 3 else split_unit(row[0])[1]))
            for row, value in zip(rows, values) if math.isfinite(value) and abs(value) >= least * largest]


def with_error(value, error, unit):
    """"53.80 ± 0.03 N mm", two digits of the error; the value alone if there is none."""
    if not error > 1e-9 * abs(value):
        return with_unit(value, unit)
    decimals = 1 - math.floor(math.log10(error))
    texts = [f"{one:.{decimals}f}" if decimals >= 0 else f"{round(one, decimals):.0f}" for one in (value, error)]
    return " ± ".join(texts) + (unit if unit in ("", "°") else f" {unit}")


def symbols(text):
    """Names of quantities as a page shows them: "T_max" with a subscript, "phi" as a Greek letter."""
    greek = {"theta": "θ", "phi": "φ", "mu": "μ"}
    return re.sub(r"(?<![-\w])(theta|phi|mu|[TgabeDWw])(?:_(\w+))?(?!\w)", lambda name: greek.get(name[1], name[1]) + (
        f"<sub>{'∞' if name[2] == 'inf' else name[2]}</sub>" if name[2] else ""), text)


def unique(texts):
    return list(dict.fromkeys(str(text) for text in texts))


def varied_in(table):
    """The columns that hold entries of the scene: these have a subsection, or are one of a few."""
    return [name for name in table if " / " in name or name in ("Model", "Title")]


def table_of(table, columns=None):
    """Head and rows of these columns, (name, words), as far as a table has them and they are not empty; entries of the scene
    stand as they were given, and values with their estimated errors."""
    def cells(name):
        errors = numbers(table.get(name + "_error", [""] * n_rows(table)))
        return [text if name in varied_in([name]) else with_error(number(text), error, "") if error > 0 else shown(text)
                for text, error in zip(table[name], errors)]

    fields = [(words, cells(name))
              for name, words in columns or [(name, name) for name in table] if name in table]
    fields = [(words, texts) for words, texts in fields if any(texts)]
    return [words for words, _ in fields], list(zip(*(texts for _, texts in fields)))
