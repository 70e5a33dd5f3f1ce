"""One number of each specimen in the place of a curve, the largest load of its test, and the one unknown that it tells.

For each set of other entries the peak is computed by runs at a few values of the unknown, once, with a monotone cubic in between
(Fritsch and Butland; SciPy's PchipInterpolator), and at twice as many if one through every other of them is off the rest by more
than TOLERANCE. The cubic is inverted exactly, also for the ends of the interval,

    peak -+ hypot(1.96 sd, e),   e^2 = (error of the cubic)^2 + (error of the model, by its coarser run)^2,

sd of the noise, which is the specimen's own; e is common to all of them, and does not average out.
"""

import os
import time
from types import SimpleNamespace

import numpy
from scipy.interpolate import PchipInterpolator

import _debond

from .errors import InputError, RunError
from .executors import results_of
from .known import changes_of_model
from .measurement import curve_column, stated_noise
from .page_data import number, read_json
from .problem import Runs
from .scene import Scene
from .specimen_fit import identity_of
from .unknowns import Unknowns
from .variants import Variant, is_varied

MOST, STEPS = 33, (8, 4, 2, 1)  # values of the unknown, and which of them, as long as a cubic through every other one is not good
TOLERANCE = 1e-3  # of the cubic, relative to the peak: a tenth of the usual Accuracy; with an error of the model half of that
NORMAL = 1.96
LARGEST_SPREAD = 20  # per cent of an entry for one of noise: what is more tells nothing
LARGEST_SECONDS = 300  # for what a peak cannot tell
NUMBERS = ("peak", "load at the end", "area under the curve", "initial stiffness", "where the load has fallen halfway to its end")
OWN_PROCESSES = 50  # runs of closed forms that are worth more than this process
_BOND, _PLAIN = "Interface / Bonding / Bonding degree", ["Task=simulate", "Output/Reference curve=none", "Output/Reference columns=auto"]
# what Law and Friction law begin with, the entry, and its range or the factor from its value to the bounds
_DEFAULTS = (("friction, coulomb", "Interface / Friction coefficient", 10), ("friction, modified coulomb", _BOND, "<<0.5 in 0..1>>"),
             ("friction, table", _BOND, "<<0.5 in 0..1>>"), ("adhesive", "Interface / Adhesive / Strength", 3))


def with_default_unknown(template, say):
    """The entries of a template without an unknown, with the one that its law suggests. Raises InputError."""
    values = _read(_debond.text_of(_debond.changed(template, [*_PLAIN, f"{_BOND}=1"]))).values
    law = f"{values['Interface / Law']}, {values['Interface / Friction law']}"
    for begin, entry, mark in _DEFAULTS:
        if law.startswith(begin):
            value = number(values[entry])
            mark = mark if isinstance(mark, str) else f"<<{value:g} in {value / mark:g}..{value * mark:g} log>>"
            say(f"the template marks no unknown: {entry} = {mark} is taken")
            return _debond.changed(template, [f"{entry}={mark}"])
    raise InputError(f"the template has no unknown, and its law, {law}, suggests none: write <<START in LOWER..UPPER>> in the place of the "
                     "number that peaks are to tell")


def _read(text):
    return _debond.Scene(_debond.read_text(text, "scene"), "scene", _debond.Team(0))


def unknown_of(entries):
    """Unknowns of a template, of which there is one. Raises InputError."""
    if varied := next(filter(is_varied, entries), None):
        varied.refuse("a peak belongs to one scene: expected one value")
    unknowns = Unknowns([Variant(entries, {})])
    if len(unknowns.list) != 1:
        raise InputError(f"the template has {len(unknowns.list)} unknowns, {', '.join(unknowns.names)}: one peak tells one number; "
                         "write the others as numbers, or fit curves")
    return unknowns


def _text_of(entries, unknowns, others, value):
    """The scene with a value of the unknown, and other entries of specimens, pairs (full name, text)."""
    own = _debond.changed(entries, [*(f"{name}={text}" for name, text in others), *_PLAIN])
    return _debond.text_of(_debond.with_values(own, unknowns.entries(0, [value])))


def run_peak(task):
    """(largest load of a run, its estimated error or NaN, warnings): what an executor of any kind calls. `task`: text of a scene, and a
    directory that keeps the results of finite elements, or nothing. Raises InputError or RunError."""
    text, directory = task
    own = {"Calibration/Noise": "auto"}  # which is read here
    if directory:
        file = os.path.join(directory, "summary.json")
        if not read_json(file).get("converged"):
            own |= {"Output/Fields every": "none", "Output/Report": False, "Expert/Output/Console": "quiet", "Output/Directory": directory}
            Scene(None, own, text=text).write(force=True)
        summary = read_json(file)
    else:
        result = Scene(None, own, text=text).run()
        summary = {**result.summary, "warnings": result.warnings}
    curve = summary.get("curve") or {"largest": summary["T_max_Nmm"], "largest_error": summary.get("T_max_Nmm_error")}
    return abs(curve["largest"]), number(curve.get("largest_error")), summary["warnings"]


class PeakFunction:
    """The peak over the value of the unknown, from runs, (peak, error of the model, ...), at an odd number of places."""

    def __init__(self, unknowns, x, runs):
        self.x, self.unknowns, self.unknown = x, unknowns, unknowns.list[0]
        self.peaks, self.of_model = numpy.array([run[:2] for run in runs]).T
        self.curve = PchipInterpolator(x, self.peaks)
        checked, is_off = self.peaks[1::2], abs(PchipInterpolator(x[::2], self.peaks[::2])(x[1::2]) - self.peaks[1::2])
        allowed = numpy.fmax(TOLERANCE * numpy.maximum(checked, 1e-2 * checked.max()), 0.5 * self.of_model[1::2])
        # of each part twice what was found in the middle of two: enough where the peak begins like a root, too
        self.of_cubic, self.is_good = numpy.repeat(2 * is_off, 2), (is_off <= allowed).all()
        self.is_monotone = abs(numpy.sign(numpy.diff(self.peaks)).sum()) == len(x) - 1

    def values(self, peak):
        """All values with this peak."""
        found = self.curve.solve(peak, extrapolate=False)
        found = numpy.sort([*found[numpy.isfinite(found)], *self.x[self.peaks == peak]])  # by rounding some meet a run twice, or never
        return found[numpy.diff(found, prepend=-numpy.inf) > 1e-9 * numpy.ptp(self.x)]

    def value(self, peak, near=0.0):
        """That value which is nearest; where none is, that of the peak that comes closest."""
        found = self.values(peak)
        return found[abs(found - near).argmin()] if len(found) else self.x[abs(self.peaks - peak).argmin()]

    def error(self, value):
        """Of cubic and model, in the unit of the peak."""
        # a check in the middle may be met by chance: the larger one of neighbours
        part = numpy.searchsorted(self.x[1:-1], value, side="right")
        return float(numpy.hypot(self.of_cubic[max(part - 1, 0):part + 2].max(), numpy.nan_to_num(numpy.interp(value, self.x, self.of_model))))

    def slope(self, value):
        """Of the peak by what is searched, its magnitude."""
        return float(abs(self.curve(value, 1)) * (value if self.unknown.logarithmic else 1))

    def row(self, peak, sd):
        """What a peak with this error, 0 if it is not known, tells: a row of specimen.json."""
        values, at, ends = self.values(peak), self.value(peak), [numpy.nan, numpy.nan]
        if sd > 0 and len(values) < 2:
            half = numpy.hypot(NORMAL * sd, self.error(at))
            ends = sorted(float(self.value(peak + sign * half, at)) for sign in (-1, 1))
        width, whole = map(numpy.ptp, map(self.unknowns.to_search, (ends, self.x)))
        return {"unknown": self.unknown.name, "value": float(at), "lower_95": ends[0], "upper_95": ends[1],
                "unit": self.unknown.unit, "logarithmic": self.unknown.logarithmic, "at_bound": not len(values),
                "told": len(values) == 1 and self.slope(at) > 0 and not width >= 0.9 * whole,
                "peak": peak, "peak_sd": sd or numpy.nan, "peak_error": self.error(at), "reason": (
                    f"the model's peaks are from {self.peaks.min():.4g} to {self.peaks.max():.4g}" if not len(values) else
                    " and ".join(f"{one:.4g}" for one in values) + " have the same peak" if len(values) > 1 else "")}


def places_of(unknown, n):
    """From bound to bound, on the way that is searched."""
    return (numpy.geomspace if unknown.logarithmic else numpy.linspace)(unknown.lower, unknown.upper, n)


def functions_of(unknowns, sets, run):
    """{set of other entries: PeakFunction}, and {set: why there is none}. run: {(set, value): run_peak()} of a list of such pairs."""
    x, runs, failed = places_of(unknowns.list[0], MOST), {}, {}
    for step in STEPS:
        runs.update(run([(key, value) for key in sets if key not in failed for value in x[::step].tolist() if (key, value) not in runs]))
        failed = {key: RunError(f"{unknowns.names[0]} = {value:.6g}, which narrower bounds leave out: {result}")
                  for (key, value), result in runs.items() if isinstance(result, Exception)}
        found = {key: PeakFunction(unknowns, x[::step], [runs[key, value] for value in x[::step].tolist()]) for key in sets if key not in failed}
        if all(one.is_good for one in found.values()):
            break
    return found, failed


def rows_of_peaks(specimens, functions, noise):
    """{name: its row}. functions, noise: {name: ...}; that is the standard deviation of a peak over the peak, where the table states none,
    0 if it is not known. sd and common, the errors of what is searched that are a value's own and those of all, are those at the median of
    its group: what a value weighs in a mean must not hang on its noise."""
    rows = {one.name: functions[one.name].row(one.peak, one.sd or noise[one.name] * one.peak) for one in specimens}
    middles = {group: numpy.median([rows[one.name]["value"] for one in specimens if one.group == group]) for group in {one.group for one in specimens}}
    for one in specimens:
        function, middle = functions[one.name], middles[one.group]
        slope = function.slope(middle) or numpy.inf
        sd = (one.sd or noise[one.name] * function.curve(middle)) / slope
        # of errors that are not known all weigh the same
        rows[one.name].update(sd=float(sd) or 1e-6, common=float(function.error(middle) / slope))
    return rows


def numbers_of(x, y):
    """NUMBERS of a curve, and by which share of the peak the load rises in the last twentieth of its way."""
    x, y = abs(x - x[0]), abs(y)
    end = x.argmax()
    begin = numpy.flatnonzero(x[:end] == x[:end].min())[-1] if end else 0  # an implant may have been pressed before
    x, y = x[begin:end + 1], y[begin:end + 1]
    peak, half = y.argmax(), 0.5 * (y.max() + y[-1])
    fall = numpy.s_[peak:peak + 1 + (y[peak:] <= half).argmax()]
    return numpy.array([y[peak], y[-1], numpy.trapz(y, x), (y[1] - y[0]) / (x[1] - x[0]), numpy.interp(-half, -y[fall], x[fall])]), (
        y[-1] - numpy.interp(0.95 * x[-1], x, y)) / y[peak]


def _influence(text, unknowns, value, runs):
    """How peaks and other numbers change with what is taken as known, by one run for each entry with the same steps: a list of {"entry",
    "value", "unit", "peak": % of the peak for +1 %, "effect": % of the unknown, "further": what else would tell the entry, or nothing,
    "spread": % of it for 1 % noise of both}; and whether the load still rises at the end. None if that fails or takes too long. text: the
    scene at this value."""
    held, start, entries = unknowns.entries(0, [value]), time.time(), _debond.read_text(text, "scene")
    scene, steps = _debond.Scene(entries, "scene", _debond.Team(0)), _debond.VaryingCurve(entries, "scene").steps_of([])
    changes = changes_of_model(SimpleNamespace(values=scene.values, over=curve_column(scene, scene.curve[0], "")), held)
    known = {**held, **{entry: now for entry, now, *_ in changes}}  # a curve keeps what was changed before: all of it is said again

    def numbers(all_own):
        rows = runs.rows([(text, "scene", tuple({**known, **own}.items()), steps, scene.curve) for own in all_own])
        return [None if isinstance(one, str) else numbers_of(*(one[column] for column in scene.curve)) for one in rows]

    (base,) = numbers([{}])
    if base is None or (time.time() - start) * len(changes) > LARGEST_SECONDS:
        return None
    step = 0.01 if 1.01 * value <= unknowns.upper[0] else -0.01
    found = numbers([unknowns.entries(0, [(1 + step) * value]), *({entry: new} for entry, *_, new in changes)])
    shares, used = [step, *(float(change.rstrip(" %")) / 100 for *_, change, _ in changes)], base[0] > 0
    slopes = [one and numpy.log(numpy.maximum(one[0], 1e-300)[used] / base[0][used]) / share for one, share in zip(found, shares)]
    names, u, rows = numpy.array(NUMBERS)[used][1:], slopes[0], []
    for (entry, now, unit, *_), own in zip(changes, slopes[1:]):
        if u is None or own is None or abs(own).max() <= 1e-3:
            continue
        with numpy.errstate(divide="ignore", invalid="ignore"):
            spread, effect = numpy.hypot(u, u[0])[1:] / abs(u[0] * own - own[0] * u)[1:], -own[0] / u[0]
        best = numpy.argmin(spread)
        rows.append({"entry": entry, "value": now, "unit": unit, "peak": own[0], "effect": effect,
                     "further": str(names[best]) if spread[best] < LARGEST_SPREAD else "", "spread": float(min(spread[best], 1e9))})
    return rows, bool(base[1] > 0.01)


def fit_peaks(specimens, entries, directory, executor, n_jobs, say):
    """{name: {"fits", "rows"} as of a fit, or the exception}, and what else the page shows. Raises InputError."""
    unknowns, warnings = unknown_of(entries), {}
    unknown, keys = unknowns.list[0], {specimen.name: tuple(sorted(specimen.entries.items())) for specimen in specimens}
    scenes = {key: _read(_text_of(entries, unknowns, key, unknown.start)) for key in dict.fromkeys(keys.values())}
    scene = next(iter(scenes.values()))
    is_kept, unit = scene.values["Model"] == "finite elements", scene.curve[1].rpartition("_")[2].replace("Nmm", "N mm")

    def run(pairs):
        say(f"{len(pairs)} runs")
        tasks = {}
        for key, value in pairs:
            text = _text_of(entries, unknowns, key, value)
            tasks[key, value] = text, os.path.join(directory, "runs", identity_of(_debond.read_text(text, "scene"), text)[:16]) * is_kept
        results = results_of(run_peak, tasks, executor, n_jobs if is_kept or len(tasks) >= OWN_PROCESSES else 1)
        warnings.update((text, "") for one in results.values() if not isinstance(one, Exception) for text in one[2])
        return results

    functions, failed = functions_of(unknowns, list(scenes), run)
    results = {name: failed[key] for name, key in keys.items() if key in failed}
    if not functions:
        return results, {}
    done = [one for one in specimens if one.name not in results]
    noise = {one.name: stated_noise(scenes[keys[one.name]].values)[0] for one in done}
    rows = rows_of_peaks(done, {one.name: functions[keys[one.name]] for one in done}, noise)
    if beyond := [one.peak for one in done if rows[one.name]["at_bound"]]:
        least, most = (end(end(one.peaks) for one in functions.values()) for end in (min, max))
        warnings[f"{len(beyond)} of {len(done)} peaks, {min(beyond):.4g}{f' to {max(beyond):.4g}' * (len(beyond) > 1)} {unit}, are beyond those of the model, {least:.4g} to "
                 f"{most:.4g}: they tell nothing, and means without them are off to the other side. Are the sizes, what presses the faces, the "
                 "other coefficients and the unit those of these tests?"] = ""
    for text in warnings:
        say(f"warning: {text}")
    results.update((name, {"fits": True, "rows": [{**row, "peak_unit": unit}]}) for name, row in rows.items())
    middle = numpy.median([row["value"] for row in rows.values()]) or 0.5 * (unknown.lower + unknown.upper)
    influence = _influence(_text_of(entries, unknowns, next(iter(functions)), middle), unknowns, middle, Runs(executor, n_jobs))
    values, functions = places_of(unknown, 65), functions.values()
    of_cubic, of_model = (100 * numpy.max([getattr(one, name).max() / one.peaks.max() for one in functions]) for name in ("of_cubic", "of_model"))
    return results, {
        "unknown": unknown.name, "unit": unknown.unit, "load_unit": unit, "at": float(middle), "warnings": list(warnings),
        "of_cubic": float(of_cubic), "of_model": float(of_model) if of_model == of_model else None,
        "beyond": len(beyond), "noise_is_known": all(one.sd or noise[one.name] for one in done),
        "is_monotone": all(one.is_monotone for one in functions), "influence": influence and influence[0],
        "rises": bool(influence and influence[1]), "values": values.tolist(), "peaks": [one.curve(values).tolist() for one in functions]}
