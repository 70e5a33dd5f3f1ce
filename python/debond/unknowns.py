"""Unknowns of a scene, which stand in its entries in the place of numbers:

    <<0.022 in 0.002..0.2>>         starts from 0.022, between these bounds
    <<0.022 in 0.002..0.2 log>>     the same, searched by its logarithm
    <<mu_b: 0.4 in 0.1..0.8>>       with a name
    <<1.45 * mu_b>>                 no unknown of its own: follows from others
"""

import math
import re
from dataclasses import dataclass, field

import numpy

import _debond

from .errors import shortened
from .page_data import number

_EXPECTED = ("expected <<START in LOWER..UPPER>>, <<START in LOWER..UPPER log>>, <<NAME: START in LOWER..UPPER>> or "
             "<<EXPRESSION>> in such names")
_UNKNOWN = re.compile(r"(?P<start>.*?) in (?P<lower>.*?)\.\.(?P<upper>.*?)(?P<log> log)?$", re.S)


@dataclass
class Unknown:
    """A number that a fit is to find, in the unit of its entry."""

    name: str
    start: float
    lower: float
    upper: float
    logarithmic: bool
    unit: str = field(default="", compare=False)
    entry: object = field(default=None, compare=False)  # that says so, for messages


def _read(entry, text):
    match = _UNKNOWN.match(text)
    start, lower, upper = map(number, match.group("start", "lower", "upper")) if match else [math.nan] * 3
    if not math.isfinite(abs(start) + abs(lower) + abs(upper)):
        entry.refuse(f"'{shortened(text)}': {_EXPECTED}")
    if not lower < upper or not lower <= start <= upper:
        entry.refuse(f"'{shortened(text)}': expected LOWER < UPPER and START between them")
    if match["log"] and lower <= 0:
        entry.refuse(f"'{shortened(text)}': a logarithm needs bounds above 0")
    return Unknown("", start, lower, upper, bool(match["log"]), "", entry)


class Unknowns:
    """Those of all experiments of a scene. `list`: of Unknown; `names`, and `starts`, `lower`, `upper` and `logarithmic`, which
    are arrays as all values are, in its order.

    An unknown that has a name, or whose entry has one value for all experiments, is the same in all of them; else each has
    its own."""

    def __init__(self, experiments):
        """`experiments`: of each its Variant, by which they differ. Raises SceneError."""
        self.list = []
        self._named = {}  # index -> name
        self._n_experiments = len(experiments)
        self._varied = []  # of each experiment: (entry, texts, marks, whether one mark is all)
        for i, own in enumerate(experiments):
            self._varied.append([self._read_entry(i, entry, entry.name not in own.values)
                                 for entry in own.entries if "<<" in entry.value])
        names = ", ".join(self._named.values())
        for entry, _, marks, _ in (one for varied in self._varied for one in varied):
            for i, mark in enumerate(marks):
                if isinstance(mark, str):
                    marks[i] = self._expression(entry, names, mark)
        self.names = [unknown.name for unknown in self.list]
        self.starts, self.lower, self.upper, self.logarithmic = (
            numpy.array([getattr(unknown, member) for unknown in self.list], dtype=kind)
            for member, kind in (("start", float), ("lower", float), ("upper", float), ("logarithmic", bool)))

    def _read_entry(self, experiment, entry, is_shared):
        pieces = re.split(r"<<(.*?)>>", entry.value, flags=re.S)
        texts, marks = pieces[::2], []
        if any("<<" in text for text in texts):
            entry.refuse(f"the << is not closed by >>: {_EXPECTED}")
        alone = len(texts) == 2 and not texts[0].strip() and not texts[1].strip()
        for mark in map(str.strip, pieces[1::2]):
            name, colon, rest = mark.partition(":")
            name = name.strip()
            if colon and not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]{0,99}", name):
                entry.refuse(f"'{shortened(name)}' is no name of letters, digits and _: {_EXPECTED}")
            if not colon and " in " not in mark:
                marks.append(mark)  # an expression, read once all names are known
                continue
            unknown = _read(entry, (rest if colon else mark).strip())
            unknown.unit = _debond.unit_of(entry.name) if alone else ""
            which = f" (experiment {experiment + 1})" if self._n_experiments > 1 and not is_shared else ""
            unknown.name = name if colon else entry.name + which + (f" #{len(marks) + 1}" if marks else "")
            marks.append(self._add(unknown, bool(colon)))
        return entry, texts, marks, alone

    def _add(self, unknown, has_name):
        for i, other in enumerate(self.list):
            if other.name == unknown.name:
                if other != unknown:
                    unknown.entry.refuse(f"the unknown '{unknown.name}' is described differently in {other.entry.name} = "
                                         f"'{shortened(other.entry.value)}'")
                other.unit = other.unit or unknown.unit
                return i
        if has_name:
            self._named[len(self.list)] = unknown.name
        self.list.append(unknown)
        return len(self.list) - 1

    @staticmethod
    def _expression(entry, names, text):
        if math.isfinite(number(text)):
            entry.refuse(f"<<{text}>> has no bounds: {_EXPECTED}")
        try:
            return text, _debond.expression(names, text)
        except ValueError as error:
            entry.refuse(f"<<{shortened(text)}>>: {error}; {_EXPECTED}")

    def to_search(self, values):
        """What a search takes: numbers, or their logarithms."""
        return numpy.where(self.logarithmic, numpy.log(numpy.where(self.logarithmic, values, 1)), values)

    def values_of(self, searched):
        """The opposite of to_search(), also beyond the bounds."""
        with numpy.errstate(over="ignore"):
            return numpy.where(self.logarithmic, numpy.exp(numpy.where(self.logarithmic, searched, 0)), searched)

    def from_search(self, searched):
        """The same within the bounds, over which rounding must not lead."""
        return numpy.clip(self.values_of(searched), self.lower, self.upper)

    def entries(self, experiment, values):
        """The entries of an experiment that hold unknowns, as {full name: text}. Raises SceneError where an expression has no
        finite value."""
        named = [float(values[i]) for i in self._named]
        result = {}
        for entry, texts, marks, alone in self._varied[experiment]:
            text = texts[0]
            for mark, after in zip(marks, texts[1:]):
                if isinstance(mark, tuple):
                    value = mark[1](named)
                    if not math.isfinite(value):
                        place = ", ".join(f"{name} = {values[i]:.6g}" for i, name in self._named.items())
                        entry.refuse(f"<<{mark[0]}>> has no finite value at {place}; if(condition, a, b) leaves out "
                                     "what has none")
                else:
                    value = float(values[mark])
                exact = repr(value).removesuffix(".0")
                # in an expression of the scene a minus may stand before it
                text += (exact if alone or value >= 0 else f"({exact})") + after
            result[entry.name] = text
        return result
