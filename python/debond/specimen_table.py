"""Tables of specimens: CSV, or the first sheet of a workbook, with a row for each.

    specimen;group;curve;Bone/Young modulus [MPa]
    A1;etched;A1.csv;17200

Columns: `specimen`, its name, which a directory gets; `curve`, the file of what was measured; `group`, if there are several;
any entry of the scene, with the value that this specimen has, in the entry's unit. A field that is empty leaves that of the
template. Files are named relative to the table. Semicolons, tabs or commas separate; lines that begin with # are comments.
"""

import difflib
import os
import re
from dataclasses import dataclass
from typing import Dict, List

import _debond

from .errors import InputError, shortened
from .layout import filled, split, value_of, with_plain_marks
from .measured import texts_of
from .unknowns import Unknowns
from .variants import Variant, variants_of

OWN = ("specimen", "curve", "group")
ALL = "all"  # what the mean of all groups is called
_NOT_HERE = ("Task", "Output / Directory", "Output / Reference curve")
FILES = ("parameters.csv", "pooled.csv", "specimens.json", "report.html")  # beside the directories of specimens
_NAME = re.compile(r"[^\W_][^/\\:*?\"<>|\x00-\x1f]{0,99}")


@dataclass
class Specimen:
    """A row of the table. curve: as it stands there; entries: {full name: text}, files among them found."""

    name: str
    group: str
    curve: str
    entries: Dict[str, str]
    place: str  # "specimens.csv: line 3", for messages


def _lines_of(filename):
    """(what the line is called, its items) of all lines that are not empty; and whether commas may be those of decimals."""

    def refuse(why):
        raise InputError(f"{filename}: {why}")

    sheet, text = texts_of(filename, refuse)[0]
    lines = [(number, line) for number, line in enumerate(text.lstrip("\ufeff").split("\n"), 1)
             if line.strip(" \t;,") and not line.lstrip().startswith("#")]
    if not lines:
        refuse(f"this table is empty: expected a line of names, {', '.join(OWN)} or entries, and a row for each specimen")
    # what separates most items of the line of names
    separator = "\t" if sheet else max(";\t,", key=lambda separator: len(split(lines[0][1], separator)))
    word = f"sheet '{sheet}', row" if sheet else "line"
    return [(f"{filename}: {word} {number}", split(line, separator)) for number, line in lines], separator != ","


def _column_of(name, known, place):
    """What a column holds: one of OWN, or the full name of an entry."""
    plain, _, unit = with_plain_marks(name).partition("[")
    plain, unit = plain.strip(), unit.rstrip("] ")
    if plain.lower() in OWN:
        return plain.lower()
    entry = " / ".join(part.strip() for part in plain.split("/"))
    if entry not in known or entry in _NOT_HERE:
        close = difflib.get_close_matches(entry, known, 1, 0.5)
        like = f", as {close[0]}" if close and close[0] not in _NOT_HERE else ""
        raise InputError(f"{place}: column '{shortened(name)}': expected specimen, curve, group, or an entry of the "
                         f"scene{like}")
    needed = _debond.unit_of(entry)
    if unit and unit.replace(" ", "") != needed.replace(" ", ""):
        raise InputError(f"{place}: column '{shortened(name)}': expected the unit of the entry, {needed or 'none'}")
    return entry


def _columns_of(names, known, place):
    columns = [_column_of(name, known, place) for name in names]
    for column in columns:
        if columns.count(column) > 1:
            raise InputError(f"{place}: column '{column}': there are two of them, expected one")
    for column in OWN[:2]:
        if column not in columns:
            raise InputError(f"{place}: column '{column}' is missing: read {', '.join(map(repr, names))}; expected specimen, "
                             "curve, and if need be group and entries of the scene")
    return columns


def _specimen(place, fields, known, has_decimal_commas, directory):
    """One row, {column: text}."""

    def refuse(column, expected):
        raise InputError(f"{place}, column '{column}': read '{shortened(fields[column])}': expected {expected}")

    name, group = fields["specimen"], fields.get("group", "")
    if not _NAME.fullmatch(name) or name.endswith(".") or name.lower() in FILES:
        refuse("specimen", "a name for a directory: a letter or a digit, then at most 99 signs but / \\ : * ? \" < > |; "
                           f"not {', '.join(FILES)}")
    if not fields["curve"]:
        refuse("curve", "the file of a measured curve")
    if group.lower() == ALL:
        refuse("group", f"another name: '{ALL}' is what the mean of all groups is called")
    entries = {}
    for column, text in fields.items():
        if column in OWN or not text:
            continue
        if os.path.isfile(os.path.join(directory, text)):
            text = os.path.join(directory, text)
        elif has_decimal_commas and "," not in known[column]:
            value = value_of(with_plain_marks(text))
            text = text if value is None else repr(value)
        entries[column] = text
    return Specimen(name, group, fields["curve"], entries, place)


def _scene_of(template, changes=()):
    """The scene with unknowns at their starts, without a measured curve. Raises SceneError."""
    entries = variants_of(_debond.changed(template, [*changes, "Output/Reference curve=none", "Task=calibrate"], ""))[0].entries
    unknowns = Unknowns([Variant(entries, {})])
    if not unknowns.list:
        raise InputError("the template has no unknowns: write <<START in LOWER..UPPER>> in the place of numbers that are to be "
                         "found")
    starts = [f"{entry}={value}" for entry, value in unknowns.entries(0, unknowns.starts).items()]
    return _debond.Scene(_debond.changed(entries, starts), "", _debond.Team(0))


def _check_entries(specimen, template):
    """Whether the scene may have these values."""
    try:
        _scene_of(template, [f"{column}={text}" for column, text in specimen.entries.items()])
    except InputError as error:
        raise InputError(f"{specimen.place}: {error}") from None


def read_specimens(filename, template) -> List[Specimen]:
    """The rows of a table, for a template: the entries of a scene with unknowns. Raises InputError, one line with file, line,
    column, what was read and what is allowed."""
    filename = os.fspath(filename)
    known = _scene_of(template).values
    ((place, names), *rows), has_decimal_commas = _lines_of(filename)
    columns, specimens = _columns_of(filled(names), known, place), []
    for place, items in rows:
        items = filled(items)
        if len(items) > len(columns):
            raise InputError(f"{place}: read {len(items)} items: expected at most {len(columns)}, as many as there are names")
        fields = {**dict.fromkeys(columns, ""), **dict(zip(columns, items))}
        specimen = _specimen(place, fields, known, has_decimal_commas, os.path.dirname(filename))
        for other in specimens:
            if other.name.lower() == specimen.name.lower():
                raise InputError(f"{place}, column 'specimen': read '{specimen.name}': expected another name: "
                                 f"{other.place.rsplit(': ', 1)[-1]} has this one")
        _check_entries(specimen, template)
        specimens.append(specimen)
    if not specimens:
        raise InputError(f"{filename}: there is no row below the names: expected one for each specimen")
    return specimens
