"""The variants of a study: what braces in the values of entries stand for.

{{a|b|c}}         every value with every combination of the others; the entry that comes first in the scene varies fastest
{{a||b||c}}       variant i takes value i: as many values as variants, whose number such entries set if there are no others
{{name: a|b|c}}   all entries with this name take the values of the same position, in every combination with the others

The notation resembles that of deal.II's MultipleParameterLoop. In all of them the item 1..200 stands for the whole numbers from
1 to 200, and text around the braces belongs to every value.
"""

import re
from collections import Counter
from dataclasses import dataclass
from typing import Any, Dict, List

import _debond

from .errors import shortened

MOST = 100000
TOO_MANY = "this makes a study of more than 100000 variants"


def is_varied(entry):
    """Whether it has several values."""
    return "{{" in entry.value


@dataclass
class Variant:
    """One combination: all entries, each with one value; the values of those that are varied, by full name."""

    entries: List[Any]
    values: Dict[str, str]


@dataclass
class Choice:
    """The values of one varied entry. name: of {{name: ...}}, or empty; by_run: {{a||b}}; stride: variants between two values;
    is_factor: whether the entry is the first one with this name, or has none."""

    entry: Any
    values: List[str]
    name: str
    by_run: bool
    stride: int = 1
    is_factor: bool = True

    def index(self, variant):
        return variant // self.stride % len(self.values)


def _expanded(entry, item):
    """The whole numbers of FIRST..LAST; anything else as it is."""
    if ".." not in item or set(item) - set("0123456789+-.eE \t"):  # not the path ../table.csv
        return [item]
    ends = re.fullmatch(r"([+-]?[0-9]{1,9})[ \t]*\.\.[ \t]*([+-]?[0-9]{1,9})", item)
    first, last = map(int, ends.groups()) if ends else (1, 0)
    if first > last:
        entry.refuse(f"'{shortened(item)}' is no range: expected FIRST..LAST with whole numbers of at most nine digits, FIRST <= LAST")
    if last - first >= MOST:
        entry.refuse(TOO_MANY)
    return [str(number) for number in range(first, last + 1)]


def _choice(entry):
    before, _, rest = entry.value.partition("{{")
    inside, closed, after = rest.partition("}}")
    if not closed or "}}" in before + after or "{{" in rest:
        entry.refuse("the braces of several values do not match: expected {{a|b|c}}, {{a||b||c}} or {{name: a|b|c}}, once")
    named = re.fullmatch(r"\s*([A-Za-z][A-Za-z0-9_ -]{0,99}?)\s*:(.*)", inside, re.DOTALL)
    name, inside = named.groups() if named else ("", inside)
    by_run = "||" in inside
    items = [item.strip() for item in inside.split("||" if by_run else "|")]
    if any("|" in item for item in items) or (by_run and name):
        entry.refuse("either | or || between all values, and | in a named choice")
    values = [(before + one + after).strip() for item in items for one in _expanded(entry, item)]
    twice = [value for value, n in Counter(values).items() if n > 1]
    if twice and not by_run and not name:
        entry.refuse(f"'{twice[0]}' is there twice")
    return Choice(entry, values, name, by_run)


def _combine(choices):
    """Says which variants take which value of each choice; the number of variants."""
    total, first_of = 1, {}
    for choice in choices:
        n, same = len(choice.values), first_of.get(choice.name)
        if same:
            choice.stride, choice.is_factor = same.stride, False
            if n != len(same.values):
                choice.entry.refuse(f"{n} values, but an entry before has {len(same.values)} for '{choice.name}'")
            continue
        if n > MOST // (1 if choice.by_run else total):
            choice.entry.refuse(TOO_MANY)
        if choice.name:
            first_of[choice.name] = choice
        if not choice.by_run:
            choice.stride = total
            total *= n
    for choice in choices:
        if choice.by_run:  # alone they set the number of variants
            n = len(choice.values)
            total = n if total == 1 else total
            if n != total:
                choice.entry.refuse(f"{n} values for {total} variants: {{{{a||b}}}} needs one for each")
    return total


def variants_of(entries, factors_at_once=0) -> List[Variant]:
    """All variants of a scene's entries, one if no entry has several values. factors_at_once: if above 0 only combinations in
    which at most so many factors, entries or named groups of entries, differ from their first value. Raises SceneError."""
    choices = [_choice(entry) for entry in entries if is_varied(entry)]
    for choice in choices:
        if choice.by_run and factors_at_once:
            choice.entry.refuse("{{a||b}} has a value for every variant and cannot be one of the factors of Expert / Study / Factors varied "
                                "at once: expected {{a|b|c}} or {{name: a|b|c}}")
    variants = []
    for i in range(_combine(choices)):
        if factors_at_once and sum(choice.is_factor and choice.index(i) > 0 for choice in choices) > factors_at_once:
            continue
        values = {choice.entry.name: choice.values[choice.index(i)] for choice in choices}
        variants.append(Variant(_debond.with_values(entries, values), values))
    return variants
