"""Tables of specimens: CSV, or the first sheet of a workbook, with a row for each.

    specimen;group;curve;Bone/Young modulus [MPa]
    A1;etched;A1.csv;17200

Columns: `specimen`, its name, which a directory gets; `curve`, the file of what was measured; `group`, if there are several;
any entry of the scene, with the value that this specimen has, in the entry's unit. A field that is empty leaves that of the
template. Files are named relative to the table. Semicolons, tabs or commas separate; lines that begin with # are comments.
In the place of `curve` there may be a column with a unit of moment or force in its name, the largest load of each specimen, "peak
[N cm]", and another one whose name says SD or error, with the standard deviation of its error. `animal`, if there are several
specimens of one, makes groups be compared by animals.
"""

import difflib
import math
import os
import re
from dataclasses import dataclass
from typing import Dict, List, Optional

import _debond

from .errors import InputError, shortened
from .layout import filled, refuse_thousands, remark_on, split, value_of, with_plain_marks
from .measured import texts_of
from .units import unit_in, unit_text_in
from .unknowns import Unknowns
from .variants import Variant, variants_of

OWN = ("specimen", "curve", "group", "animal")
_WORDS = {"probe": "specimen", "sample": "specimen", "gruppe": "group", "kurve": "curve", "tier": "animal"}
ALL = "all"  # what the mean of all groups is called
_NOT_HERE = ("Task", "Output / Directory", "Output / Reference curve")
FILES = ("parameters.csv", "pooled.csv", "differences.csv", "specimens.json", "report.html")  # beside the directories of specimens
_OF_ERRORS = re.compile(r"(?<![a-z])(sd|s\.d\.|std|stdev|standard deviation|error|uncertainty|standardabweichung|fehler|unsicherheit)"
                        "(?![a-z])|±", re.I)
_NAME = re.compile(r"[^\W_][^/\\:*?\"<>|\x00-\x1f]{0,99}")


@dataclass
class Specimen:
    """A row of the table. curve: as it stands there; entries: {full name: text}, files among them found. peak and sd of its error
    [N mm or N], in the place of a curve; None: the table does not say it."""

    name: str
    group: str
    curve: str
    entries: Dict[str, str]
    place: str  # "specimens.csv: line 3", for messages
    peak: Optional[float] = None
    sd: Optional[float] = None
    animal: str = ""


class Table:
    """A line of names, and a row for each specimen: names; rows, pairs of what they are called and as many items. Raises InputError."""

    def __init__(self, filename):
        self.filename = os.fspath(filename)
        sheet, text = texts_of(self.filename, self._refuse)[0]
        lines = [(number, line) for number, line in enumerate(text.lstrip("\ufeff").split("\n"), 1)
                 if line.strip(" \t;,") and not line.lstrip().startswith("#")]
        if not lines:
            self._refuse("this table is empty: expected a line of names, and a row for each specimen")
        # what separates most items of the line of names
        self.separator = "\t" if sheet else max(";\t,", key=lambda separator: len(split(lines[0][1], separator)))
        word = f"{self.filename}: " + (f"sheet '{sheet}', row" if sheet else "line")
        (self.place, names), *self.rows = [(f"{word} {number}", filled(split(line, self.separator))) for number, line in lines]
        self.names = list(map(with_plain_marks, names))
        for place, items in self.rows:
            if len(items) > len(names):
                raise InputError(f"{place}: read {len(items)} items: expected at most {len(names)}, as many as there are names")
            items += [""] * (len(names) - len(items))

    def _refuse(self, why):
        raise InputError(f"{self.filename}: {why}")

    def numbers(self, i, nothing=None, positive=True):
        """The values of a column, `nothing` where nothing stands."""
        texts = [with_plain_marks(items[i]) for _, items in self.rows]
        refuse_thousands([(place.rpartition(" ")[2], [text]) for (place, _), text in zip(self.rows, texts)], self.separator, self._refuse)
        values = [nothing if text.lower() in ("", "nan") else value_of(text) for text in texts]
        for (place, _), text, value in zip(self.rows, texts, values):
            if value is None or positive and value <= 0:
                raise InputError(f"{place}, column '{shortened(self.names[i])}': read '{shortened(text)}': expected a number"
                                 + " above 0, of loads their magnitude" * positive + ", or nothing" * (nothing is not None)
                                 + (remark_on(text) if text and value is None else ""))
        return values


def _load_in(name):
    """"peak", or "sd" of its error, if the name of a column has a unit of moment or force and is not that of an entry; else nothing."""
    unit, text = unit_in(name), unit_text_in(name)
    if not unit or unit.quantity not in ("moment", "force") or "/" in name[:name.rfind(text)].rstrip(" /[("):
        return ""
    return "sd" if _OF_ERRORS.search(name) else "peak"


def has_peaks(filename) -> bool:
    """Whether a table has peaks in the place of curves. Raises InputError."""
    return "peak" in map(_load_in, Table(filename).names)


def _column_of(name, known, place):
    """What a column holds: one of OWN, "peak", "sd", or the full name of an entry."""
    plain, _, unit = name.partition("[")
    plain, unit = plain.strip(), unit.rstrip("] ")
    if (own := _WORDS.get(plain.lower(), plain.lower())) in OWN:
        return own
    entry = " / ".join(part.strip() for part in plain.split("/"))
    if entry not in known and _load_in(name):
        return _load_in(name)
    if entry not in known or entry in _NOT_HERE:
        close = difflib.get_close_matches(entry, known, 1, 0.5)
        like = f", as {close[0]}" if close and close[0] not in _NOT_HERE else ""
        raise InputError(f"{place}: column '{shortened(name)}': expected specimen, curve, group, or an entry of the "
                         f"scene{like}; or a load with its unit, as 'peak [N cm]'")
    needed = _debond.unit_of(entry)
    if unit and unit.replace(" ", "") != needed.replace(" ", ""):
        raise InputError(f"{place}: column '{shortened(name)}': expected the unit of the entry, {needed or 'none'}")
    return entry


def _columns_of(table, known):
    columns = [_column_of(name, known, table.place) for name in table.names]
    for column in columns:
        if columns.count(column) > 1:
            raise InputError(f"{table.place}: column '{column}': there are two of them, expected one")
    if "specimen" not in columns or ("curve" in columns) == ("peak" in columns) or "sd" in columns and "curve" in columns:
        raise InputError(f"{table.place}: read {', '.join(map(repr, table.names))}: expected specimen, either curve or a peak with its unit, as "
                         "'peak [N cm]', with a peak the SD of its error if that is known, and if need be group and entries of the scene")
    return columns


def _loads_of(table, i, curve):
    """The numbers of a column in N mm or N, 0 where nothing stands. curve: what the scene's is over, and its load."""
    name, quantity, is_peak = table.names[i], "moment" if curve[1].endswith("Nmm") else "force", _load_in(table.names[i]) == "peak"
    if unit_in(name).quantity != quantity:
        raise InputError(f"{table.place}: column '{shortened(name)}': this scene is about {curve[1]} over {curve[0]}: expected a {quantity}, "
                         "or another Output / Curve")
    return [unit_in(name).factor * value if value == value else 0.0 for value in table.numbers(i, None if is_peak else math.nan)]


def _specimen(place, fields, known, has_decimal_commas, directory):
    """One row, {column: text}."""

    def refuse(column, expected):
        raise InputError(f"{place}, column '{column}': read '{shortened(fields[column])}': expected {expected}")

    name, group = fields["specimen"], fields.get("group", "")
    if not _NAME.fullmatch(name) or name.endswith(".") or name.lower() in FILES:
        refuse("specimen", "a name for a directory: a letter or a digit, then at most 99 signs but / \\ : * ? \" < > |; "
                           f"not {', '.join(FILES)}")
    if fields.get("curve") == "":
        refuse("curve", "the file of a measured curve")
    if group.lower() == ALL:
        refuse("group", f"another name: '{ALL}' is what the mean of all groups is called")
    entries = {}
    for column, text in fields.items():
        if column in (*OWN, "peak", "sd") or not text:
            continue
        if os.path.isfile(os.path.join(directory, text)):
            text = os.path.join(directory, text)
        elif has_decimal_commas and "," not in known[column]:
            value = value_of(with_plain_marks(text))
            text = text if value is None else repr(value)
        entries[column] = text
    return Specimen(name, group, fields.get("curve", ""), entries, place, animal=fields.get("animal", ""))


def _scene_of(template, changes=()):
    """The scene with unknowns at their starts, without a measured curve. Raises SceneError."""
    entries = variants_of(_debond.changed(template, [*changes, "Output/Reference curve=none", "Task=calibrate"], ""))[0].entries
    unknowns = Unknowns([Variant(entries, {})])
    if not unknowns.list:
        raise InputError("the template has no unknowns: write <<START in LOWER..UPPER>> in the place of numbers that are to be "
                         "found")
    starts = [f"{entry}={value}" for entry, value in unknowns.entries(0, unknowns.starts).items()]
    return _debond.Scene(_debond.changed(entries, starts), "", _debond.Team(0))


def read_specimens(filename, template) -> List[Specimen]:
    """The rows of a table, for a template: the entries of a scene with unknowns. Raises InputError, one line with file, line,
    column, what was read and what is allowed."""
    scene, table, specimens = _scene_of(template), Table(filename), {}
    columns = _columns_of(table, scene.values)
    loads = {column: _loads_of(table, i, scene.curve) for i, column in enumerate(columns) if column in ("peak", "sd")}
    for i, (place, items) in enumerate(table.rows):
        specimen = _specimen(place, dict(zip(columns, items)), scene.values, table.separator != ",", os.path.dirname(table.filename))
        specimen.peak, specimen.sd = (loads[column][i] if column in loads else None for column in ("peak", "sd"))
        other = specimens.setdefault(specimen.name.lower(), specimen)
        if other is not specimen:
            raise InputError(f"{place}, column 'specimen': read '{specimen.name}': expected another name: "
                             f"{other.place.rsplit(': ', 1)[-1]} has this one")
        try:  # whether the scene may have these values
            _scene_of(template, [f"{column}={text}" for column, text in specimen.entries.items()])
        except InputError as error:
            raise InputError(f"{place}: {error}") from None
    if not specimens:
        raise InputError(f"{table.filename}: there is no row below the names: expected one for each specimen")
    return list(specimens.values())
