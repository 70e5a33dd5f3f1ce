"""Groups of specimens: means, and differences of each two, with 95 % intervals, of any table with a row for each specimen.

    python3 -m debond groups TABLE --value "peak [N]" [--by group] [--animal animal] [--out DIR]
                             [--diameter D --length L | --area A [--radius R]]

TABLE is CSV or the first sheet of a workbook. Columns are called as in it, with or without the unit in brackets. --value may be
repeated; --by "limb, kind" makes a group of each pair. pooling.py says what intervals are; with --animal values of one animal go
together. Rows with a text in the column `mark`, as records.csv has them, and those without a value or a group are left out. With
sizes, numbers in mm and mm2 or columns, loads become strengths (reductions.py). DIR gets groups.csv, differences.csv, groups.json
and report.html.
"""

import collections
import math
import os

import _debond

from .errors import InputError, shortened
from .files import csv_text, make_directory, say, write_json, write_whole
from .layout import filled, refuse_thousands, remark_on, value_of, with_plain_marks
from .measured import plain_name
from .page import write_page_if_possible
from .page_data import short, split_unit
from .page_specimens import difference_in_words
from .pooling import compare_groups
from .reductions import STRENGTHS
from .specimen_table import lines_of
from .units import unit_in, unit_text_in

GROUPS = ("unknown", "group", "values", "animals", "mean", "sd", "lower_95", "upper_95", "unit")
DIFFERENCES = ("unknown", "group", "minus", "difference", "lower_95", "upper_95", "ratio", "ratio_lower_95", "ratio_upper_95", "unit")
SIZES = {"area": ("mm2", "mm²", "mm^2"), "diameter": (), "length": (), "radius": ()}  # and units but for those of length


class _Table:
    """Columns of texts, with what their rows are called."""

    def __init__(self, filename):
        ((self.place, names), *rows), self.separator = lines_of(filename, "a line of names, and a row for each specimen")
        self.names, self.places = [with_plain_marks(name) for name in filled(names)], [place for place, _ in rows]
        self.columns = [[with_plain_marks(items[i]) if i < len(items) else "" for _, items in rows] for i in range(len(self.names))]

    def find(self, wanted, option):
        """Name and texts of a column. Raises InputError."""
        found = [i for i, name in enumerate(self.names) if wanted == name] or [
            i for i, name in enumerate(self.names) if wanted == plain_name(name)]
        if len(found) != 1:
            raise InputError(f"{self.place}: {option} '{shortened(wanted)}': expected one of the columns '{shortened(', '.join(self.names))}'")
        return self.names[found[0]], self.columns[found[0]]

    def numbers(self, wanted, option):
        """Name and values of a column, NaN where nothing stands."""
        name, texts = self.find(wanted, option)

        def refuse(why):
            raise InputError(f"{self.place.rpartition(': ')[0]}: {why}")

        refuse_thousands([(place.rpartition(" ")[2], [text]) for place, text in zip(self.places, texts)], self.separator, refuse)
        values = [math.nan if text.lower() in ("", "nan") else value_of(text) for text in texts]
        for place, text, value in zip(self.places, texts, values):
            if value is None:
                raise InputError(f"{place}, column '{name}': read '{shortened(text)}': expected a number, or nothing{remark_on(text)}")
        return name, values

    def sizes(self, name, text):
        """Of each row, mm or mm2, from a number or the name of a column."""
        column, values = ("", [value_of(text)] * len(self.places)) if value_of(text) else self.numbers(text, "--" + name)
        unit, says = unit_in(column), unit_text_in(column)
        if says and says not in SIZES[name] and (SIZES[name] or not unit or unit.quantity != "length"):
            raise InputError(f"{self.place}: --{name} '{column}': expected {SIZES[name][0] if SIZES[name] else 'a unit of length'}")
        for place, value in zip(self.places, values):
            if value <= 0:
                raise InputError(f"{place}, --{name}: read {value:g}: expected a size above 0")
        return [value * (unit.factor if unit else 1) for value in values]


def _values_of(table, wanted, options):
    """What is compared: its words, unit and values, and a remark; with sizes a strength."""
    name, values = table.numbers(wanted, "--value")
    words, unit = split_unit(name)
    words, unit = (words, unit) if unit else (plain_name(name), unit_text_in(name))
    given, load = [size for size in SIZES if options["--" + size]], unit_in(name)
    if not given:
        return words, unit, values, ""
    if load is None or (load.quantity, *given) not in STRENGTHS:
        raise InputError(f"--value '{name}' with {', '.join('--' + size for size in given)}: expected a force with --diameter and "
                         "--length, or --area; or a torque with --diameter and --length, or --area and --radius")
    formula, strength, left_out = STRENGTHS[load.quantity, *given]
    sizes = [table.sizes(size, options["--" + size]) for size in given]
    return (f"{words} as {formula}", "MPa", [strength(load.factor * value, *own) for value, *own in zip(values, *sizes)],
            f"{formula} is {left_out}.")


def _compared(rows, words, unit):
    """Means, differences, [value's words, group, value] of what is used, and notes, of rows (value, group, animal, mark)."""
    reasons = [f"marked '{mark.partition(':')[0]}'" if mark else "without a value" if math.isnan(value) else "" if group else "without a group"
               for value, group, _, mark in rows]
    used, counts = [row[:3] for row, why in zip(rows, reasons) if not why], collections.Counter(filter(None, reasons))
    if not used:
        raise InputError(f"{words}: no row has a value and a group, and no mark")
    groups_of = collections.Counter(animal for _, animal in {row[1:] for row in used} if animal)
    n_shared, about = sum(n > 1 for n in groups_of.values()), {"unknown": words, "unit": unit}
    notes = [f"{words}: {sum(counts.values())} of {len(rows)} rows are left out, "
             + ", ".join(f"{n} {why}" for why, n in counts.items()) + "."] * bool(counts)
    notes += [f"{words}: {n_shared} animals are in more than one group."] * bool(n_shared)
    means, differences = ([{**about, **row} for row in found] for found in compare_groups(*zip(*used)))
    return means, differences, [[words, group, value] for value, group, _ in used], notes


def main(filename, options) -> None:
    """The command."""
    table = _Table(filename)
    if not options["--value"]:
        raise InputError(f"{table.place}: expected --value with one of the columns '{shortened(', '.join(table.names))}'")
    groups = [", ".join(filter(None, own)) for own in zip(*(table.find(name.strip(), "--by")[1] for name in options["--by"].split(",")))]
    animals = table.find(options["--animal"], "--animal")[1] if options["--animal"] else [""] * len(groups)
    animals = [None if animal in ("", "none") else animal for animal in animals]
    marks = table.find("mark", "")[1] if "mark" in table.names else [""] * len(groups)
    results = [], [], [], []
    for wanted in options["--value"]:
        words, unit, values, remark = _values_of(table, wanted, options)
        found = _compared(list(zip(values, groups, animals, marks)), words, unit)
        for rows, more in zip(results, (*found[:3], [remark] * bool(remark) + found[3])):
            rows += more
    means, differences, values, notes = results
    _show(means, differences, notes)
    if directory := options["--out"]:
        make_directory(directory)
        for name, columns, rows in (("groups.csv", GROUPS, means), ("differences.csv", DIFFERENCES, differences)):
            write_whole(os.path.join(directory, name), csv_text(columns, [[row[column] for column in columns] for row in rows]))
        write_json(os.path.join(directory, "groups.json"), {"table": filename, "by": options["--by"], "notes": notes, "values": values,
                                                            "version": _debond.version, "provenance": _debond.provenance()})
        write_page_if_possible(directory)
        say(f"Results are in {directory}/groups.csv, differences.csv and report.html")


def _show(means, differences, notes):
    """All in words."""
    for row in means:
        ends = " to ".join(filter(None, (short(row[end]) for end in ("lower_95", "upper_95"))))
        say(f"{row['unknown']}, {row['group']}: mean {short(row['mean'])} {row['unit']}".rstrip() + (f" ({ends})" if ends else "")
            + f", SD {short(row['sd'], 3) or 'not known'}, n = {row['animals']}"
            + f" animals, {row['values']} values" * (row["values"] > row["animals"]))
    for row in differences:
        say(f"{row['unknown']}, {difference_in_words(row)}")
    for note in notes:
        say(note)
