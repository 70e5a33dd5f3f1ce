"""Measured curves as instruments, spreadsheets and debond itself write them.

    from debond.measured import read_measured
    angle_deg, torque_Nmm = read_measured("measured.csv", ("angle_deg", "torque_Nmm"), "2 [deg], 3 [-N m]")

    python3 -m debond measured FILE [--columns LIST] [--curves angle_deg,torque_Nmm] > plain.csv

Semicolons, tabs, commas or blanks separate items, in the way that makes most lines rows of numbers; these have a point or a
comma, where commas separate in quotes. The first such line begins the table. The one or two lines above, if they have as many
items and no numbers, or else a comment right above, name the columns and their units; what stands before them is not read,
nor are comments: lines that begin with `#`, `%` or `//`. What may be read in two ways is refused. Text is UTF-8, UTF-16 or
Latin-1. Of a workbook (xlsx) the first sheet with numbers that is not hidden is read, in the same way.
"""

import io
import json
import os
import re
import sys
from typing import List, Mapping, Sequence, Tuple, Union

import numpy

from .errors import InputError, shortened
from .files import say
from .layout import Table, filled, remark_on, value_of, with_plain_marks
from .units import EXAMPLES, UNITS, unit_in, unit_text_in, why_ambiguous

CURVE_ENTRY, COLUMNS_ENTRY = "Output / Reference curve", "Output / Reference columns"
_LARGEST_MB = 200


def plain_name(name):
    """A name as it is compared: without its unit in brackets."""
    return re.split(r"[\[(]", name)[0].strip()


def is_turned(item):
    """Whether a minus stands before the unit in brackets of a chosen column."""
    return re.search(r"[\[(]\s*-", item) is not None


def _chosen_column(table, item, quantity, refuse):
    """Number from 0, factor, what is said of the unit, and what names it, of the column that is meant by `item`: a name or a
    number from 1, with its unit in brackets, if that is given, behind a minus if values of the other sign are meant."""
    name, bracket = plain_name(item), re.sub(r"^[^\[(]*", "", item)
    called = [i for i, other in enumerate(table.names) if name in (other, plain_name(other))]
    if len(called) > 1:
        refuse(f"there are two columns '{name}': give the number of one")
    if not called and re.fullmatch(r"\+?[0-9]+(\.0*)?", name) and 1 <= float(name) <= table.width:
        called = [int(float(name)) - 1]
    if not called:
        refuse(f"there is no column '{name}': {table.described()}")
    at = called[0]
    says = item if bracket or at >= len(table.names) else table.names[at]
    unit = unit_in(says) if bracket or at < len(table.names) else None
    if unit is None or unit.quantity != quantity:
        why = why_ambiguous(says)
        refuse(f"the column '{name}' needs a unit, {UNITS[quantity]}, in brackets behind its name{why and f' ({why})'}")
    return at, -unit.factor if is_turned(item) else unit.factor, bracket and " as " + bracket, says


def _recognised_column(table, name, quantity, example, columns_entry):
    """The same of the column called `name`, else of the only one with a unit of its quantity. example: of a choice."""
    units = [unit_in(other) for other in table.names]
    found = ([(i, 1.0, "", name) for i, other in enumerate(table.names) if other == name] or
             [(i, unit.factor, "", table.names[i]) for i, unit in enumerate(units) if unit and unit.quantity == quantity])
    if len(found) != 1:
        section, _, entry = columns_entry.rpartition(" / ")
        choice = f"'set {entry} = {example}'" + f" in {section}" * section.startswith("Expert")
        if columns_entry.startswith("--"):
            choice = f'{columns_entry} "{example}"'
        table.refuse(f"{'more than one' if found else 'no'} column has a unit that says {UNITS[quantity]}: "
                     f"{table.described()}; say which, as in {choice}")
    return found[0]


def _text_of(content, refuse):
    """The text of a file of bytes, with plain ends of lines."""
    encoding = json.detect_encoding(content)  # also without a mark
    try:
        text = content.decode(encoding)
    except UnicodeDecodeError:
        if not encoding.startswith("utf-8"):
            refuse(f"this text begins as {encoding.upper()}, but is none")
        text = content.decode("latin-1")  # German Excel, for one, writes it where it says CSV
    if re.search("[\0-\x08\x0b\x0e-\x1f\x7f]", text):
        refuse("this is not a text file")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _sheets_of(content, refuse):
    """(name, text) of the sheets of a workbook that are not hidden, with a line per row and tabs between cells. Dates are
    texts, and so are formulas that no program has computed."""
    try:
        import openpyxl
    except ImportError:
        refuse("this is a workbook, which needs openpyxl: apt install python3-openpyxl, or save it as CSV")
    try:
        book = computed = openpyxl.load_workbook(io.BytesIO(content))
        if any(cell.data_type == "f" for sheet in book.worksheets for row in sheet.iter_rows() for cell in row):
            computed = openpyxl.load_workbook(io.BytesIO(content), data_only=True)
    except Exception as error:  # of many kinds, from the ZIP archive on
        refuse(f"this workbook cannot be read: {shortened(str(error)).split(chr(10))[0]}; save it as .xlsx or as CSV")

    def text_of(cell, value):
        if value is None and cell.data_type == "f":
            value = getattr(cell.value, "text", cell.value)
        text = "" if value is None else repr(value) if isinstance(value, float) else str(value)
        return " ".join(text.replace('"', "''").split())

    return [(sheet.title, "\n".join("\t".join(map(text_of, *rows)) for rows in
                                    zip(sheet.iter_rows(), computed[sheet.title].iter_rows(values_only=True))))
            for sheet in book.worksheets if sheet.sheet_state == "visible"]


def _read_bytes(filename, refuse):
    try:
        with open(filename, "rb") as file:  # some have no end, and no size that could be asked for
            content = file.read(_LARGEST_MB * 1000000 + 1)
    except OSError as error:
        refuse(f"this file cannot be read: {error.strerror}")
    if len(content) > _LARGEST_MB * 1000000:
        refuse(f"this file has more than {_LARGEST_MB} MB")
    return content


def texts_of(filename, refuse) -> List[Tuple[str, str]]:
    """(name, text) of each sheet of a workbook, with tabs between cells; of any other file ("", text). refuse: raises
    InputError with what is wrong with the file."""
    content = _read_bytes(filename, refuse)
    if content.startswith(b"\xd0\xcf\x11\xe0"):
        refuse("this is a workbook of Excel before 2007 (.xls), or one with a password: save it as .xlsx without one, or as CSV")
    return _sheets_of(content, refuse) if content.startswith(b"PK\x03\x04") else [("", _text_of(content, refuse))]


def _read_table(filename, refuse):
    """The table in a file, and the sheet that it is in, "sheet 'A', " or nothing, and whether others have one, too."""
    sheets = [(name, with_plain_marks(text)) for name, text in texts_of(filename, refuse)]
    if [name for name, _ in sheets] == [""]:
        return Table(sheets[0][1], refuse), ""
    full = [sheet for sheet in sheets if Table.has_rows(sheet[1], "\t")]
    name, text = (full or sheets or [("", "")])[0]
    others = f"the first of {len(full)} with numbers, " * (len(full) > 1)
    return Table(text, lambda why: refuse(f"sheet '{name}': {why}"), "\t"), f"sheet '{name}', {others}"


def _values_of(table, found):
    """The values in the columns `found` (number, factor, ...) of all rows: an array (columns, rows)."""
    rows = []
    for number, items in table.rows:
        n = len(filled(items))
        if n > table.width:
            table.refuse(f"line {number}: {n} values for {table.width} columns: remove the line if it is not part of the "
                         "table, or separate with semicolons if a comma is that of a number")
        row = []
        for at, factor, *_ in found:
            item = items[at] if at < n else ""
            value = value_of(item)
            if value is None:
                what = f"'{shortened(item)}' in column {at + 1} is no number" if item else f"no value in column {at + 1}"
                table.refuse(f"line {number}: {what}" + (remark_on(item) if at < n else ""))
            row.append(factor * value)
        rows.append(row)
    return numpy.array(rows).T


def read_measured_and_say(filename, wanted: Sequence[str], columns: Union[str, Sequence[str]] = (), entry: str = CURVE_ENTRY,
                          columns_entry: str = COLUMNS_ENTRY) -> Tuple[numpy.ndarray, str, List[str]]:
    """As read_measured(), which columns have been read, for people: "column 1 'angle [deg]', column 3 as [-N m]", and a choice
    of `columns` that reads the same."""
    filename = os.fspath(filename)
    if isinstance(columns, str):
        columns = columns.split(",") if columns.strip() else []
    choice = [with_plain_marks(item).strip() for item in columns]
    quantities = [unit.quantity for unit in map(unit_in, wanted) if unit]
    if len(quantities) < len(wanted):
        raise InputError(f"{', '.join(wanted)}: expected names of columns of torque.csv with units, as chuck_Fz_N")

    def refuse(why):
        raise InputError.of_entry(entry, why, filename)

    def refuse_choice(why):
        raise InputError.of_entry(columns_entry, why, ", ".join(choice))

    table, said = _read_table(filename, refuse)
    if choice and len(choice) != len(wanted):
        refuse_choice(f"expected {len(wanted)} columns, separated by commas")
    if choice:
        found = [_chosen_column(table, item, quantity, lambda why: refuse_choice(f"{why} ({filename})"))
                 for item, quantity in zip(choice, quantities)]
    else:
        example = ", ".join(f"{i} [{EXAMPLES[quantity]}]" for i, quantity in enumerate(quantities, 1))
        found = [_recognised_column(table, *column, example, columns_entry) for column in zip(wanted, quantities)]
    said += ", ".join(f"column {at + 1}" + (f" '{table.names[at]}'" if table.names else "") + unit for at, _, unit, _ in found)
    return _values_of(table, found), said, [f"{at + 1} [{unit_text_in(says)}]" for at, *_, says in found]


def read_measured(filename, wanted: Sequence[str], columns: Union[str, Sequence[str]] = (), entry: str = CURVE_ENTRY,
                  columns_entry: str = COLUMNS_ENTRY) -> numpy.ndarray:
    """Columns of a measured table in the units of debond: an array (columns, rows).

    wanted: names as in torque.csv, "angle_deg", "torque_Nmm", "time", "chuck_Fz_N" ..., which also say the quantity.
    columns: those of the file in the same order, "2 [deg], 3 [-N m]" or a sequence, each by its name in the file or its number
    from 1, with a unit in brackets where the file has none; a minus before the unit turns the sign. Empty: the column of the
    file called as the wanted one, else the only one with a unit of its quantity.
    entry, columns_entry: what gave the file and the columns, for messages.

    Raises InputError, whose line names entry, file, line and column, and what was read and is needed."""
    return read_measured_and_say(filename, wanted, columns, entry, columns_entry)[0]


def main(filename: str, options: Mapping[str, str]) -> int:
    """Writes the columns of a measured table as plain CSV to the standard output; returns the exit code."""
    names = [name.strip() for name in options["--curves"].split(",")]
    try:
        values, said, _ = read_measured_and_say(filename, names, options["--columns"], options["--entry"], options["--columns-entry"])
    except InputError as error:
        if error.why is None or options["--entry"] == "FILE":
            raise
        # the program asks, and says it with the place of the entry
        say("\n".join((error.entry, error.value or "", error.why)))
        return 1
    if "the first of" in said and options["--entry"] == "FILE":  # runs ask for each variant of a study
        say(f"{filename}: {said}", sys.stderr)
    say("\n".join(",".join(row) for row in [names, *(map(repr, row) for row in values.T.tolist())]))
    return 0
