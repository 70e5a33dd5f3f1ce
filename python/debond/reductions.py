"""Numbers to which tests are usually reduced, with a few words on what each leaves out."""

import math

from debond.page_data import numbers

_FACE = "a mean over the face: the bond breaks from the rim on, point by point"
_SIDE = "a mean over the side: stress peaks at its ends, where the bond breaks first; friction under the pressure of the fit is in it"
#: Of a load and sizes [N or N mm, mm, mm2]: strengths [MPa], as formula, function of load and sizes, and what is left out.
STRENGTHS = {
    ("force", "area"): ("F/A", lambda F, A: F / A, _FACE),
    ("force", "diameter", "length"): ("F/(π d L)", lambda F, d, L: F / (math.pi * d * L), _SIDE),
    ("moment", "area", "radius"): ("T/(A R)", lambda T, A, R: T / (A * R), f"{_FACE}; a stress that is the same all over a disk is 3/2 "
                                   "of this; friction under the press force is in it"),
    ("moment", "diameter", "length"): ("2 T/(π d² L)", lambda T, d, L: 2 * T / (math.pi * d**2 * L), _SIDE),
}


def sizes_of(entries):
    """{size: mm or mm2} of the contact face of a scene, from its entries in words; empty where usual reductions know no such shape."""
    (radius, *_), (hole, *_), (height, *_), (bone, *_), size = (numbers(entries.get(name, "0").split(",")) for name in (
        "Implant / Radius", "Implant / Inner radius", "Implant / Height", "Bone / Height", "Implant / Size"))
    side = {"diameter": 2 * radius, "length": min(filter(None, (height, bone)), default=math.nan)}
    coin, ring = ({"area": math.pi * (radius**2 - inner**2), "radius": radius} for inner in (0, hole))
    return {"pin": side, "screw": side, "coin": coin, "ring": ring, "block": {"area": math.prod(size[:2])}}.get(entries.get("Implant / Shape"), {})


def reduced(x, y, quantity, sizes):
    """Rows (words, number, unit, what is left out) of a curve, in mm and N or degrees and N mm: from its first row to its peak."""
    top = max(range(len(y)), key=lambda i: abs(y[i]), default=0)
    if not top or not y[top]:
        return []
    y, is_moment = [abs(load) for load in y[:top + 1]], quantity == "moment"
    sizes = {name: size for name, size in sizes.items() if is_moment or name != "radius"}
    formula, strength, left_out = STRENGTHS.get((quantity, *sizes), ("", lambda *_: math.nan, ""))
    first, second = (next(i for i, load in enumerate(y) if load >= share * y[top]) for share in (0.4, 0.8))
    energy = abs(sum(0.5 * (y[i] + y[i + 1]) * (x[i + 1] - x[i]) for i in range(top)))
    rows = (("strength " + formula, strength(y[top], *sizes.values()), "MPa", left_out),
            ("apparent stiffness, between 40 and 80 % of the peak", (y[second] - y[first]) / (abs(x[second] - x[first]) or math.nan),
             "N mm/°" if is_moment else "N/mm", "that of bone, bond and support together; a measured one has that of the machine in it, too"),
            ("energy to the peak", math.radians(energy) if is_moment else energy, "N mm",
             "what the bond takes after the peak; friction and what is stored elastically are in it"))
    return [row for row in rows if math.isfinite(row[1])]
