"""Units in the names of the columns of measured tables."""

import itertools
import math
import re
from typing import NamedTuple, Optional

# of each quantity, for messages
UNITS = {
    "angle": "deg, rad, mrad, gon or rev",
    "moment": "N mm, mN m, N cm, N m, kN m, lbf in, ozf in, kgf cm or the like",
    "force": "mN, N, kN, lbf or kgf",
    "length": "um, mm, cm, m or in",
    "time": "ms, s, min or h",
}
EXAMPLES = {"angle": "deg", "moment": "N m", "force": "N", "length": "mm", "time": "s"}


class Unit(NamedTuple):
    """What a column holds, and the factor to what it is read in: deg, N mm, N, mm, s."""

    quantity: str
    factor: float


# exact, by definition
_INCH, _LBF, _KGF, _RAD = 25.4, 0.45359237 * 9.80665, 9.80665, 180 / math.pi

_FORCES = {"uN µN": 1e-6, "mN": 1e-3, "cN": 1e-2, "dN": 0.1, "N": 1.0, "daN": 10.0, "kN": 1e3, "gf": 1e-3 * _KGF, "kgf kp": _KGF}
_ARMS = {"mm": 1.0, "cm": 10.0, "m": 1e3}
_POUNDS = {"lb lbs lbf pound pounds": _LBF, "oz ozf ounce ounces": _LBF / 16}
_INCHES = {"in inch inches": _INCH}
_FEET = {**_INCHES, "ft foot feet": 12 * _INCH}


def _units(quantity, *tables):
    """{name: Unit} of names and factors; of two tables of their products."""
    return {"".join(names): Unit(quantity, math.prod(factor for _, factor in pairs))
            for pairs in itertools.product(*(table.items() for table in tables))
            for names in itertools.product(*(names.split() for names, _ in pairs))}


# M and m differ; without blanks and signs of a product
_METRIC = {
    **_units("force", _FORCES),
    **_units("length", {"um µm": 1e-3, **_ARMS}),
    # kg and g: masses that are meant as weights, as torque meters say them
    **_units("moment", {**_FORCES, "kg": _KGF}, _ARMS),
    # gm would be grams; shouted: M for mega has no meaning here
    **_units("moment", {"gcm": 1e-2 * _KGF, "NM": 1e3, "NCM": 10.0, "NMM": 1.0, "KNM": 1e6}),
    **_units("angle", {"Grad": 1.0}),  # German nouns have capitals; why_ambiguous() has others
}
# these may be shouted
_OTHER = {
    **_units("moment", _POUNDS, _FEET), **_units("moment", _FEET, _POUNDS),
    **_units("moment", {"newtonmetre newtonmetres newtonmeter newtonmeters": 1e3}),
    # alone, pounds and ounces may be masses
    **_units("force", {"lbf": _LBF, "ozf": _LBF / 16}),
    **_units("length", _INCHES),
    **_units("angle", {"deg degree degrees ° degré degrés grados gradi": 1.0, "mdeg": 1e-3, "arcmin": 1 / 60,
                       "rad radian radians": _RAD, "mrad": 1e-3 * _RAD, "urad µrad": 1e-6 * _RAD, "gon": 0.9, "mgon": 0.9e-3,
                       "rev revs revolution revolutions turn turns umdrehungen": 360.0}),
    # the name `time` is enough
    **_units("time", {"us µs": 1e-6, "ms": 1e-3, "s sec second seconds time sek sekunden secondes": 1.0,
                      "min minutes minuten": 60.0, "h hours": 3600.0}),
}


def find_unit(text: str) -> Optional[Unit]:
    """The unit that `text` is; None if it is none. Blanks and the signs of a product may stand where they like: "lbf in",
    "in·lbf", "IN-LB"."""
    plain = re.sub("[ .*·_-]", "", text)
    return _METRIC.get(plain) or _OTHER.get(plain.lower())


def unit_text_in(name: str) -> str:
    """What stands for the unit in the name of a column: in brackets, behind the last slash or underscore, or all or the last
    words of it. Nothing if there is none, or a factor."""
    if re.search(r"10\^|[x*] ?10|×|[\])] *[x*/·]", name):
        return ""
    for opening, closing in ("[]", "()"):
        begin, end = name.rfind(opening), name.rfind(closing)
        if 0 <= begin < end:
            return name[begin + 1:end].strip()
    # "Force in lbf" is no moment: words that begin with "in" are a unit only as the whole name
    ends = [name[i:] for i in range(1, len(name)) if name[i - 1] in "/_ ," and not re.match("in[ _]", name[i:], re.I)]
    return next(filter(find_unit, [name] + ends), "")


def unit_in(name: str) -> Optional[Unit]:
    """The unit that unit_text_in() finds; None if there is none, or if an English name begins all words with capitals."""
    text = unit_text_in(name)
    return None if text == "Grad" and "angle" in name.lower() else find_unit(text)


def why_ambiguous(name: str) -> str:
    """What else a unit that find_unit() does not know could mean; empty if there are not several such meanings."""
    if re.search(r"\bgrads?\b", name, re.I):
        return "grad may be degrees, deg, or gon, of which a turn has 400"
    return "nm may be N m or nanometres" if re.search(r"\bnm\b", name) else ""
