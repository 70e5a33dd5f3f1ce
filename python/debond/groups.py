"""Groups of specimens: means, and differences of each two, with 95 % intervals, of any table with a row for each specimen.

    python3 -m debond groups TABLE --value "peak [N]" [--by group] [--animal animal] [--out DIR]
                             [--diameter D --length L | --area A [--radius R]]

TABLE is CSV or the first sheet of a workbook. Columns are called as in it, with or without the unit in brackets. --value may be
repeated; --by "limb, kind" makes a group of each pair. pooling.py says what intervals are; values of one animal go together, where a
column `animal`, or what --animal says, names it. Rows with a text in the column `mark`, as records.csv has them, and those without a value or a group are left out. With
sizes, numbers in mm and mm2 or columns, loads become strengths (reductions.py). DIR gets groups.csv, differences.csv, groups.json
and report.html.
"""

import collections
import math

from .errors import InputError, shortened
from .files import say
from .layout import value_of
from .measured import plain_name
from .page import write_results
from .page_data import short, split_unit
from .page_specimens import difference_in_words, in_words
from .pooling import compare_groups
from .reductions import STRENGTHS
from .specimen_table import Table
from .units import Unit, unit_in, unit_text_in

GROUPS = ("unknown", "group", "values", "animals", "mean", "sd", "lower_95", "upper_95", "unit")
DIFFERENCES = ("unknown", "group", "minus", "difference", "lower_95", "upper_95", "ratio", "ratio_lower_95", "ratio_upper_95", "unit")
SIZES = {"area": ("mm2", "mm²", "mm^2"), "diameter": ("mm",), "length": ("mm",), "radius": ("mm",)}  # and their units


def _column(table, wanted, option):
    """The number of a column. Raises InputError."""
    found = [i for i, name in enumerate(table.names) if wanted == name] or [
        i for i, name in enumerate(table.names) if wanted == plain_name(name)]
    if len(found) != 1:
        raise InputError(f"{table.place}: {option} '{shortened(wanted)}': expected one of the columns '{shortened(', '.join(table.names))}'")
    return found[0]


def _texts(table, wanted, option):
    i = _column(table, wanted, option)
    return [items[i] for _, items in table.rows]


def _sizes(table, size, text):
    """Of each row [mm or mm2], from a number or the name of a column."""
    if (number := value_of(text)) is not None:
        if number <= 0:
            raise InputError(f"--{size} {text}: expected a size above 0")
        return [number] * len(table.rows)
    i = _column(table, text, "--" + size)
    if unit_text_in(table.names[i]) not in ("", *SIZES[size]):
        raise InputError(f"{table.place}: --{size} '{table.names[i]}': expected {SIZES[size][0]}")
    return table.numbers(i, math.nan)


def _values_of(table, wanted, options):
    """What is compared: its words, unit and values, and a remark; with sizes a strength."""
    i = _column(table, wanted, "--value")
    name, values, given = table.names[i], table.numbers(i, math.nan, positive=False), [size for size in SIZES if options["--" + size]]
    words, unit = split_unit(name)
    words, unit = plain_name(words), unit or unit_text_in(name)
    if not given:
        return words, unit, values, []
    load = unit_in(name) or Unit("", 1.0)
    if (load.quantity, *given) not in STRENGTHS:
        raise InputError(f"--value '{name}' with {', '.join('--' + size for size in given)}: expected a force with --diameter and "
                         "--length, or --area; or a torque with --diameter and --length, or --area and --radius")
    formula, strength, left_out = STRENGTHS[load.quantity, *given]
    sizes = [_sizes(table, size, options["--" + size]) for size in given]
    return (f"{words} as {formula}", "MPa", [strength(load.factor * value, *own) for value, *own in zip(values, *sizes)],
            [f"{formula} is {left_out}."])


def _compared(rows, words, unit):
    """Means, differences, [value's words, group, value] of what is used, and notes, of rows (value, group, animal, mark)."""
    reasons = [f"marked '{mark.partition(':')[0]}'" if mark else "without a value" if math.isnan(value) else "" if group else "without a group"
               for value, group, _, mark in rows]
    used, counts = [row[:3] for row, why in zip(rows, reasons) if not why], collections.Counter(filter(None, reasons))
    if not used:
        raise InputError(f"{words}: no row has a value and a group, and no mark")
    n_shared = sum(n > 1 for n in collections.Counter(animal for _, animal in {row[1:] for row in used} if animal).values())
    notes = [f"{words}: {sum(counts.values())} of {len(rows)} rows are left out, "
             + ", ".join(f"{n} {why}" for why, n in counts.items()) + "."] * bool(counts)
    notes += [f"{words}: {n_shared} animals are in more than one group."] * bool(n_shared)
    alone = [group for group, n in collections.Counter(group for _, group, _ in used).items() if n == 1]
    notes += [f"{words}: {', '.join(alone)} with one value alone: no interval, and no difference from the others."] * bool(alone)
    notes += [f"{words}: some are above 0 and some below: do all have the same direction?"] * (min(row[0] for row in used) < 0 < max(row[0] for row in used))
    means, differences = ([{"unknown": words, "unit": unit, **row} for row in found] for found in compare_groups(*zip(*used)))
    return means, differences, [[words, group, value] for value, group, _ in used], notes


def main(filename, options) -> None:
    """The command."""
    table, results = Table(filename), ([], [], [], [])
    if not options["--value"]:
        raise InputError(f"{table.place}: expected --value with one of the columns '{shortened(', '.join(table.names))}'")
    groups = [", ".join(filter(None, own)) for own in zip(*(_texts(table, name.strip(), "--by") for name in options["--by"].split(",")))]
    animals, marks = (_texts(table, name, "--animal") if name else [""] * len(groups)
                      for name in (options["--animal"] or "animal" * ("animal" in table.names), "mark" * ("mark" in table.names)))
    animals = [None if animal in ("", "none") else animal for animal in animals]
    for wanted in options["--value"]:
        words, unit, values, remarks = _values_of(table, wanted, options)
        for rows, more in zip(results, _compared(list(zip(values, groups, animals, marks)), words, unit)):
            rows += more
        results[3].extend(remarks)
    means, differences, values, notes = results
    results[3].append("Intervals of differences are " + ("of a mixed model: values of one animal go together." if any(animals) else
                                                          "Welch's: each value is one of its own. Where animals repeat, say --animal."))
    for row in means:
        say(f"{row['unknown']}, {row['group']}: mean {in_words(row, 'mean', row['unit'], digits=4)[0]}, SD {short(row['sd'], 3) or 'not known'}, "
            f"n = {row['animals']}" + f" animals, {row['values']} values" * (row["values"] > row["animals"]))
    for text in (*(f"{row['unknown']}, {difference_in_words(row)}" for row in differences), *notes):
        say(text)
    if directory := options["--out"]:
        write_results(directory, "groups", {"table": filename, "by": options["--by"], "notes": notes, "values": values},
                      {"groups": (GROUPS, means), "differences": (DIFFERENCES, differences)})
        say(f"Results are in {directory}/groups.csv, differences.csv and report.html")
