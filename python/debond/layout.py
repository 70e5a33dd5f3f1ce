"""The table in a text of an instrument or a spreadsheet: where it begins, what separates its items, how its columns are
called. measured.py says what is understood."""

import csv
import functools
import re
import sys
from collections import Counter

from .errors import shortened
from .units import find_unit, unit_in, why_ambiguous

csv.field_size_limit(sys.maxsize)  # with a wrong separator a line is one long item
# blanks of any width; what is not seen; dashes and minus signs, also Windows' dash where Latin-1 has nothing; signs of a
# product; the Greek letter; an ordinal and a ring for degrees; apostrophes
_BLANKS = "\u00a0\u2002-\u200a\u202f\u205f\u3000"
_PLAIN = {"": "\u00ad\u200b\u200c\u200d\u2060\ufeff", "-": "\u2010\u2011\u2012\u2013\u2212\x96", "·": "\u22c5\u2219\u2022",
          "µ": "\u03bc", "°": "\u00ba\u02da", "'": "\u2019\u02bc\x92"}
_MARKS = str.maketrans({other: mark for mark, others in _PLAIN.items() for other in others})

_NUMBER = re.compile(r"[-+]?([0-9]+\.?|[0-9]*[.,][0-9]+)([eEdD][-+]?[0-9]+)?")
_TIME = re.compile(r"[0-9]{1,4}([-./])[0-9]{1,2}\1[0-9]{1,4}.*|[0-9]{1,2}:[0-9]{2}.*")
# what instruments and spreadsheets write for no value, and what is too large
_NOTHING = re.compile(r"[-*?]*|.*#.*|[-+]?[0-9]+[.,]?[0-9]*[ed][-+]?[0-9]+|[-+]?(nan|inf|infinity|∞|n/?a|none|null|"
                      r"o\.?l\.?|ovld?|ovf|over|over-?(load|flow|range)|underflow|err|error|invalid)", re.I)
_THOUSANDS = re.compile("[-+]?[0-9]{1,3}([ '.,][0-9]{3})+([.,][0-9]*)?")
_NUMBER_AND_UNIT = re.compile(r"[-+]?[0-9.,]+ *([A-Za-z%]|[^\t -~]).*")


def with_plain_marks(text: str) -> str:
    """The same text with plain blanks, minus signs, dots of a product and apostrophes."""
    if text.isascii():
        return text
    # a number with such a blank between thousands stays one word
    text = re.sub(f"(?<=[0-9])[{_BLANKS}](?=[0-9]{{3}}(?![0-9]))", "'", text)
    return re.sub(f"[{_BLANKS}]", " ", text).translate(_MARKS)


@functools.lru_cache(100000)  # instruments repeat themselves
def value_of(item: str):
    """The number that `item` is, with a decimal point or comma, or an exponent of Fortran; None if it is none."""
    if not _NUMBER.fullmatch(item):
        return None
    value = float(item.replace(",", ".").replace("d", "e").replace("D", "e"))
    if abs(value) < sys.float_info.min and re.match("[^eEdD]*[1-9]", item):
        return None  # so small that digits are lost
    # SCPI, the language of many instruments, has 9.9E37 for infinity and 9.91E37 for what is no number
    return value if abs(value) < 9.9e37 else None


@functools.lru_cache(100000)
def _kind(item: str) -> str:
    """"number", "nothing", "time" (a date or a time of day) or "text"."""
    return ("number" if value_of(item) is not None else "nothing" if _NOTHING.fullmatch(item) else
            "time" if _TIME.fullmatch(item) else "text")


def remark_on(item: str) -> str:
    """What to do with an item that is no number."""
    kind = _kind(item)
    return (": this formula has no value yet: save the workbook once with a program that computes it" if item[:1] == "=" else
            ": remove this row" if kind == "nothing" else
            ": it is a date or a time of day; expected is a column with a number" if kind == "time" else
            ": write thousands without a separator" if _THOUSANDS.fullmatch(item) else
            ": write its unit into the name of the column" if _NUMBER_AND_UNIT.fullmatch(item) else
            ": remove what is not part of the table")


def _lines_of(text):
    """Number from 1 and text of lines that are neither empty nor comments; comments by the number of the line below."""
    lines, comments, above = [], {}, None
    for number, line in enumerate(text.split("\n"), 1):
        if line.strip().startswith(("#", "%", "//")):
            above = line
        elif line.strip():
            lines.append((number, line.rstrip(" ")))
            comments[number], above = above, None
    return lines, comments


def split(line, separator):
    """The items of a line; with what separates behind the last one there are empty ones. What stands in quotes may hold it."""
    if separator == " ":
        return [] if "\t" in line else line.split()
    return [item.strip() for item in next(csv.reader([line], delimiter=separator, skipinitialspace=True))]


def filled(items):
    """The items without empty ones at the end."""
    return items[:max((i for i, item in enumerate(items, 1) if item), default=0)]


def _shape_of(items):
    """A letter for each item of a row, `t` for times and `x` for other texts; empty if it has less than two numbers, or
    something else without a letter, as what another separator would split."""
    kinds = [_kind(item) for item in filled(items)]
    if any(kind == "text" and not re.search("[A-Za-z]|[^\0-\x7f]", item) for kind, item in zip(kinds, items)):
        return ""
    return "".join({"time": "t", "text": "x"}.get(kind, "n") for kind in kinds) if kinds.count("number") >= 2 else ""


def refuse_thousands(rows, separator, refuse):
    """Of decimal points and commas in rows, (line, items), one may separate thousands."""
    marked = [(number, item) for number, items in rows for item in items
              if ("," in item or "." in item) and value_of(item) is not None]
    with_comma = [(number, item) for number, item in marked if "," in item]
    if not with_comma:
        return
    with_point = next((number for number, item in marked if "." in item), None)
    what_to_do = ": write decimals in one way, and thousands without a separator"
    if with_point:
        refuse(f"line {with_point} has a number with a point and line {with_comma[0][0]} one with a comma{what_to_do}")
    # semicolons go with decimal commas
    if separator != ";" and all(re.fullmatch("[-+]?[1-9][0-9]{0,2},[0-9]{3}", item) for _, item in with_comma):
        refuse(f"the comma in numbers, as in line {with_comma[0][0]}, may be that of decimals or of thousands"
               f"{what_to_do}; semicolons between the columns go with decimal commas")


class Table:
    """The table in a text: where it begins, what separates its items, how its columns are called.

    separator; n_columns of rows; rows: (line, items); names of columns, or none; line_above: with another number of items.
    refuse: raises InputError with what is no table, or may be read in two ways. separators: to choose from."""

    def __init__(self, text, refuse, separators=";\t, "):
        self.rows, self.names, self.line_above, self.refuse = [], [], None, refuse
        lines, self._comments = _lines_of(text)
        shape, self.separator = self._choose(lines, separators)
        if not shape:
            self._refuse_no_row(lines, separators)
        self.n_columns = len(shape)
        self._read_rows([(number, split(line, self.separator)) for number, line in lines], shape)
        self._refuse_decimal_commas()
        refuse_thousands(self.rows, self.separator, self.refuse)

    @property
    def width(self):
        """How many columns can be read."""
        return max(self.n_columns, len(self.names))

    @staticmethod
    def has_rows(text, separators):
        return bool(Table._choose(_lines_of(text)[0], separators)[0])

    @staticmethod
    def _choose(lines, separators):
        """The shape and the separator with which most of the first lines are rows of the same shape."""
        weights = Counter()
        for separator in separators:
            for _, line in lines[:1000]:
                if separator in line and (shape := _shape_of(split(line, separator))):
                    # with a wrong separator there are numbers and texts, too
                    weights[shape, separator] += 1 if "x" in shape else 2
        return max(weights, key=lambda key: (weights[key], -separators.index(key[1]), -len(key[0])), default=("", ";"))

    def _refuse_no_row(self, lines, separators):
        cells = [(number, item) for number, line in lines for separator in separators for item in split(line, separator)]
        odd = next((f"; '{shortened(item)}' in line {number}{remark_on(item)}" for number, item in cells
                    if item[:1] == "=" or
                    _kind(item) == "text" and (_THOUSANDS.fullmatch(item) or _NUMBER_AND_UNIT.fullmatch(item))), "")
        first = f", and its first line is '{shortened(lines[0][1])}'" if lines else ""
        self.refuse("this file holds no row of numbers; expected are two columns or more, separated by commas, semicolons, "
                    f"tabs or blanks{first}{odd}")

    def _first_row(self, lines, shape, begin):
        """The first line from `begin` on that is a row of this shape."""
        return next((i for i in range(begin, len(lines)) if _shape_of(lines[i][1]) == shape), len(lines))

    def _may_be_names(self, items, row):
        """Whether a line has no numbers, and as many items as rows."""
        return (self.n_columns <= len(filled(items)) <= max(self.n_columns, len(row)) and
                all(value_of(item) is None for item in items) and any(_kind(item) == "text" for item in items))

    def _read_rows(self, lines, shape):
        first = self._first_row(lines, shape, 0)
        # rows that lack a value, or have one too many
        while first > 0 and {"number"} <= set(map(_kind, filled(lines[first - 1][1]))) <= {"number", "nothing"}:
            first -= 1
        self._find_names(lines, first)
        for i, (number, items) in enumerate(lines):
            if i < first or not filled(items):
                continue
            if self.rows and self._may_be_names(items, self.rows[0][1]):
                # numbers above the names are a date, say
                first = self._first_row(lines, shape, i)
                if self.names or first == len(lines):
                    self.refuse(f"line {number} has names in the place of numbers: keep one table in the file, and remove what "
                                "is not part of it")
                self.rows = []
                self._find_names(lines, first)
            else:
                self.rows.append((number, items))

    def _find_names(self, lines, first):
        """Names, or names and units below, right above the row `first`; else those in a comment there."""
        number, row = lines[first]
        self.line_above = None
        for line in reversed(lines[:first]):
            above = filled(line[1])
            if not self._may_be_names(above, row):
                self.line_above = None if self.names else line
                break
            if self.names:  # these are units
                above += [""] * (len(self.names) - len(above))
                self.names = [f"{name} [{unit}]".strip() if find_unit(unit) else f"{name} {unit}".strip()
                              for name, unit in zip(above, self.names)]
                return
            self.names = above
            if not any(find_unit(name) or find_unit(name.strip("[]()")) for name in above):
                break
        comment = self._comments[number]
        if not self.names and comment:
            items = split(comment.strip().lstrip("#%/ "), self.separator)
            if self._may_be_names(items, row):
                self.names = items

    def _refuse_decimal_commas(self):
        """Of `0,5,12,3` nobody knows whether these are two numbers or four, unless there are as many names."""
        if self.separator == " ":
            return
        what_to_do = ": expected as many"
        if self.separator == ",":
            what_to_do = ": if decimals have commas, separate the columns with semicolons"
        first, n_first = self.rows[0][0], len(filled(self.rows[0][1]))
        line, above = self.line_above or (0, [])
        names = [item for item in above if item and value_of(item) is None]
        if not self.names and len(above) > 1 and any(map(unit_in, names)):
            self.refuse(f"line {line} names {len(names)} columns, line {first} has {n_first} values{what_to_do}")
        if self.separator != ",":
            return
        for number, items in self.rows:
            if len(items) < self.n_columns:
                self.refuse(f"line {number} has {len(items)} values, other lines {self.n_columns}{what_to_do}")
        are_whole = (re.fullmatch("[-+]?[0-9]+", item) for _, items in self.rows for item in filled(items))
        if not self.names and self.n_columns > 2 and all(are_whole):
            self.refuse(f"line {first} and all others hold whole numbers only{what_to_do}, else write the names of the "
                        "columns above")

    def described(self):
        """The columns that there are, for messages."""
        if not self.names:
            above = shortened(self.separator.join(self.line_above[1])) if self.line_above else ""
            above = above and f", since the line above the numbers, '{above}', does not name as many"
            return f"this file has {self.n_columns} columns without names{above}"
        why = next(filter(None, map(why_ambiguous, self.names)), "")
        return "the columns of this file are '" + "', '".join(self.names) + "'" + (f" ({why})" if why else "")
