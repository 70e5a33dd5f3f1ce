"""One number of each specimen in the place of a curve, the largest load of its test, and the one unknown that it tells.

For each set of other entries the peak is computed by runs at a few values of the unknown, once, with a monotone cubic in between
(Fritsch and Butland; SciPy's PchipInterpolator) and more runs wherever one in the middle of two neighbours is off the cubic by
more than TOLERANCE. The cubic is inverted exactly, also for the ends of the interval,

    peak -+ hypot(1.96 sd, e),   e^2 = (error of the cubic)^2 + (error of the model, by its coarser run)^2,

sd of the noise, which is the specimen's own; e is common to all of them, and does not average out.
"""

import hashlib
import os
import time
from types import SimpleNamespace

import numpy
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import maximum_filter1d

import _debond

from .errors import InputError, RunError
from .experiment import run_task
from .executors import results_of
from .files import digest_of
from .known import changes_of_model
from .measurement import curve_column, stated_noise
from .page_data import number, read_json
from .scene import Scene
from .unknowns import Unknowns
from .variants import Variant, is_varied

NODES, ROUNDS = 3, 7  # at first, with a check in the middle of two; they come to lie 2^(1 - ROUNDS) as close at most
TOLERANCE = 1e-3  # of the cubic, relative to the peak: a tenth of the usual Accuracy
NORMAL = 1.96
HARDLY = 0.1  # per cent of the peak for one of an entry
LARGEST_SPREAD = 20  # per cent of an entry for one of noise: what is more tells nothing
LARGEST_SECONDS = 300  # for what a peak cannot tell
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


class Template:
    """Scenes but for the value of the unknown, of which there is one. low, high: its bounds as they are searched, the way from one run to
    the next. Raises InputError."""

    def __init__(self, entries):
        if varied := next(filter(is_varied, entries), None):
            varied.refuse("a peak belongs to one scene: expected one value")
        self.entries, self.unknowns = entries, Unknowns([Variant(entries, {})])
        if len(self.unknowns.list) != 1:
            raise InputError(f"the template has {len(self.unknowns.list)} unknowns, {', '.join(self.unknowns.names)}: one peak tells one number; "
                             "write the others as numbers, or fit curves")
        self.unknown = self.unknowns.list[0]
        self.low, self.high = (float(self.unknowns.to_search(bound)[0]) for bound in (self.unknowns.lower, self.unknowns.upper))

    def value(self, place):
        return float(self.unknowns.from_search(numpy.array([place]))[0])

    def text(self, others, value):
        """others: entries of specimens, pairs (full name, text)."""
        own = _debond.changed(self.entries, [*(f"{name}={text}" for name, text in others), *_PLAIN])
        return _debond.text_of(_debond.with_values(own, self.unknowns.entries(0, [value])))


def _peak_in(summary):
    """The largest load of a run and its estimated error, NaN where there is none."""
    curve = summary.get("curve") or {"largest": summary["T_max_Nmm"], "largest_error": summary.get("T_max_Nmm_error")}
    return abs(curve["largest"]), number(curve.get("largest_error"))


def run_peak(task):
    """(peak, error, warnings) of a run: what an executor of any kind calls. `task`: text of a scene, and a directory that keeps the
    results of finite elements, or nothing. Raises InputError or RunError."""
    text, directory = task
    own = {"Calibration/Noise": "auto"}  # which is read here
    if not directory:
        result = Scene(None, own, text=text).run()
        return *_peak_in(result.summary), result.warnings
    file = os.path.join(directory, "summary.json")
    if not read_json(file).get("converged"):
        own |= {"Output/Fields every": "none", "Output/Report": False, "Expert/Output/Console": "quiet", "Output/Directory": directory}
        Scene(None, own, text=text).write(force=True)
    summary = read_json(file)
    return *_peak_in(summary), summary["warnings"]


class PeakFunction:
    """The peak over the value of the unknown. runs: {place: (peak, error of the model)}; errors: {place: that of the cubic up to the next
    one}."""

    def __init__(self, template, runs, errors):
        self.unknown, places = template.unknown, sorted(runs)
        # a check in the middle may be met by chance: the largest of neighbours
        self.x, self.of_cubic = numpy.array(list(map(template.value, places))), maximum_filter1d([errors[x] for x in places[:-1]], 3)
        self.peaks, self.of_model = numpy.array([runs[x][:2] for x in places]).T
        self.curve = PchipInterpolator(self.x, self.peaks)
        self.slopes = self.curve.derivative()

    @property
    def is_monotone(self):
        steps = numpy.diff(self.peaks)
        return (steps > 0).all() or (steps < 0).all()

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
        part = numpy.searchsorted(self.x[1:-1], value, side="right")
        return float(numpy.hypot(self.of_cubic[part], numpy.nan_to_num(numpy.interp(value, self.x, self.of_model))))

    def slope(self, value):
        """Of the peak by what is searched, its magnitude."""
        return float(abs(self.slopes(value)) * (value if self.unknown.logarithmic else 1))

    def row(self, peak, sd):
        """What a peak with this error, 0 if it is not known, tells: a row of specimen.json."""
        values, at, lower, upper = self.values(peak), self.value(peak), numpy.nan, numpy.nan
        half = numpy.hypot(NORMAL * sd, self.error(at))
        if sd > 0 and len(values) < 2:
            lower, upper = sorted(self.value(peak + sign * half, at) for sign in (-1, 1))
        low, high, first, last = (numpy.log if self.unknown.logarithmic else numpy.array)([lower, upper, self.x[0], self.x[-1]])
        told = len(values) == 1 and self.slope(at) > 0 and not high - low >= 0.9 * (last - first)
        return {"unknown": self.unknown.name, "value": float(at), "lower_95": float(lower), "upper_95": float(upper),
                "unit": self.unknown.unit, "logarithmic": self.unknown.logarithmic, "told": bool(told), "at_bound": not len(values),
                "peak": peak, "peak_sd": sd or numpy.nan, "peak_error": self.error(at), "reason": (
                    f"the model's peaks are from {self.peaks.min():.4g} to {self.peaks.max():.4g}" if not len(values) else
                    " and ".join(f"{one:.4g}" for one in values) + " have the same peak" if len(values) > 1 else "")}


def functions_of(template, sets, run):
    """{set of other entries: PeakFunction, or the exception of a run}. run: {(set, place): run_peak()} of a list of such pairs."""
    first = numpy.linspace(template.low, template.high, NODES).tolist()
    known, errors, functions = {key: {} for key in sets}, {key: {} for key in sets}, {}
    parts = list(zip(first, first[1:]))
    wanted = {key: (first + [0.5 * (a + b) for a, b in parts], parts) for key in sets}
    for _ in range(ROUNDS):
        for (key, place), result in run([(key, x) for key, (places, _) in wanted.items() for x in places]).items():
            if isinstance(result, Exception):
                functions[key] = RunError(f"{template.unknown.name} = {template.value(place):.6g}, which narrower bounds leave out: {result}")
            known[key][place] = result
        for key, (_, parts) in list(wanted.items()):
            del wanted[key]
            if key in functions:
                continue
            own, middles, more = known[key], {0.5 * (a + b): (a, b) for a, b in parts}, []
            cubic = PchipInterpolator(*zip(*sorted((template.value(x), result[0]) for x, result in own.items() if x not in middles)))
            for middle, (a, b) in middles.items():
                peak = own[middle][0]
                errors[key][a] = errors[key][middle] = abs(float(cubic(template.value(middle))) - peak)
                if errors[key][a] > TOLERANCE * max(peak, 1e-2 * max(one[0] for one in own.values())):
                    more += [(a, middle), (middle, b)]
            if more:
                wanted[key] = [0.5 * (a + b) for a, b in more], more
        if not wanted:
            break
    return {key: functions.get(key) or PeakFunction(template, known[key], errors[key]) for key in sets}


def rows_of_peaks(specimens, functions, noise):
    """{name: its row, or the exception}. functions, noise: {name: ...}; that is the standard deviation of a peak over the peak, where the
    table states none, 0 if it is not known. sd and common, the errors of what is searched that are a value's own and those of all, are those at
    the median of its group: what a value weighs in a mean must not hang on its noise."""
    rows = {one.name: functions[one.name] if isinstance(functions[one.name], Exception) else functions[one.name].row(
        one.peak, one.sd or noise[one.name] * one.peak) for one in specimens}
    for group in {one.group for one in specimens}:
        own = [one for one in specimens if one.group == group and not isinstance(rows[one.name], Exception)]
        middle = numpy.median([rows[one.name]["value"] for one in own]) if own else 0
        for one in own:
            function = functions[one.name]
            slope = function.slope(middle) or numpy.inf
            sd = (one.sd or noise[one.name] * function.curve(middle)) / slope
            # of errors that are not known all weigh the same
            rows[one.name].update(sd=float(sd) or 1e-6, common=float(function.error(middle) / slope))
    return rows


def numbers_of(task):
    """{words: number} that can be read off the curve of a run, the peak first; and by which share of it the load rises in the last
    twentieth of its way. `task`: of run_task(), with the columns of the curve. What an executor of any kind calls. Raises RunError."""
    rows = run_task(task)
    if isinstance(rows, str):
        raise RunError(rows)
    x, y = (abs(rows[column] - rows[column][0] * (column == task[-1][0])) for column in task[-1])
    end = x.argmax()
    begin = numpy.flatnonzero(x[:end] == x[:end].min())[-1] if end else 0  # an implant may have been pressed before
    x, y = x[begin:end + 1], y[begin:end + 1]
    peak, half, steps = y.argmax(), 0.5 * (y.max() + y[-1]), numpy.diff(x)
    after = numpy.s_[peak:peak + 1 + (y[peak:] <= half).argmax()]
    return {"peak": y.max(), "load at the end": y[-1], "area under the curve": 0.5 * steps @ (y[1:] + y[:-1]),
            "initial stiffness": (y[1] - y[0]) / steps[0], "where the load has fallen halfway to its end": numpy.interp(-half, -y[after], x[after]),
            "rise": (y[-1] - numpy.interp(0.95 * x[-1], x, y)) / y.max()}


def _influence(template, others, value, run_all):
    """How peaks and other numbers change with what is taken as known, by one run for each entry with the same steps: a list of {"entry",
    "value", "unit", "peak": % of the peak for +1 %, "effect": % of the unknown, "further": what else would tell the entry, or nothing,
    "spread": % of it for 1 % noise of both}; and whether the load still rises at the end. None if that fails or takes too long. run_all:
    {key: numbers_of()} of {key: task}."""
    text, start, held = template.text(others, value), time.time(), template.unknowns.entries(0, [value])
    scene = _read(text)
    curve = _debond.VaryingCurve(_debond.read_text(text, "scene"), "scene")
    steps = tuple(map(tuple, curve.steps_of([]))) if scene.values["Model"] == "finite elements" else ()
    h = 0.01 if 1.01 * value <= template.unknown.upper else -0.01
    changes = changes_of_model(SimpleNamespace(values=scene.values, over=curve_column(scene, scene.curve[0], "")), held)

    def task(others):
        """A curve keeps what was changed before: all of it is said again."""
        return text, "scene", tuple({**held, **{entry: known for entry, known, *_ in changes}, **others}.items()), steps, scene.curve

    base = run_all({"": task({})})[""]
    if isinstance(base, Exception) or (time.time() - start) * len(changes) > LARGEST_SECONDS:
        return None
    found = run_all({"": task(template.unknowns.entries(0, [(1 + h) * value])), **{entry: task({entry: new}) for entry, *_, new in changes}})
    names, rows = [name for name in base if base[name] > 0 and name != "rise"], []

    def slopes(key, step):
        return numpy.array([numpy.log(max(found[key][name], 1e-300) / base[name]) / step for name in names])

    for entry, known, unit, change, _ in changes:
        if any(isinstance(found[key], Exception) for key in ("", entry)):
            continue
        by_unknown, own = slopes("", h), slopes(entry, float(change.rstrip(" %")) / 100)
        if abs(own).max() > 1e-3:
            with numpy.errstate(divide="ignore", invalid="ignore"):
                spread = numpy.hypot(by_unknown, by_unknown[0])[1:] / abs(by_unknown[0] * own - own[0] * by_unknown)[1:]
                effect = -own[0] / by_unknown[0]
            best = spread.argmin()
            rows.append({"entry": entry, "value": known, "unit": unit, "peak": own[0], "effect": effect,
                         "further": names[best + 1] if spread[best] < LARGEST_SPREAD else "", "spread": float(min(spread[best], 1e9))})
    return rows, bool(base["rise"] > 0.01)


def _directory_of(text, directory):
    """Where the results of a scene are kept: another one for other contents of its files."""
    files = [entry.value for entry in _debond.read_text(text, "scene") if os.path.isfile(entry.value)]
    return os.path.join(directory, "runs", hashlib.sha256(repr((_debond.version, text, *map(digest_of, files))).encode()).hexdigest()[:16])


def _notes(template, functions, influence, noise_is_known, n_beyond):
    """What is to be said of peaks in words. n_beyond: peaks that the model does not come to."""
    name = template.unknown.name
    cubic, model = (100 * max(max(errors(one)) / one.peaks.max() for one in functions) for errors in (
        lambda one: one.of_cubic, lambda one: one.of_model))
    notes = [f"Where runs checked it, the peak as a function of {name} is off by {cubic:.2g} % of the largest at most; the model is off by "
             + (f"{model:.2g} %, as coarser runs say." if numpy.isfinite(model) else "an unknown error: nothing estimates it here.")]
    if not noise_is_known:
        notes.append("The error of a peak is not known: single values have no interval, and the interval of a mean is that of the scatter alone. A "
                     "column with SD and the unit in its name gives it, or Calibration / Noise in the template, relative to the peak.")
    if n_beyond:
        notes.append(f"{n_beyond} of the peaks are beyond those of the model, and left out of means, which are then off to the other side: wider "
                     "bounds bring them back, or another entry is wrong.")
    if not all(one.is_monotone for one in functions):
        notes.append(f"The peak is no monotone function of {name}: several values have the same peak, and such a peak does not tell which.")
    if not influence:
        return [*notes, "What else a peak hangs on was not computed: these runs fail, or take too long."]
    if influence[1]:
        notes.append("The load still rises where the scene ends: let it move further, or the peak is that of the scene and not of the implant.")
    hardly = [one["entry"] for one in influence[0] if abs(one["peak"]) < HARDLY]
    return [*notes, f"A peak tells one number: {name} is found with all others taken as known, and what is wrong in these is wrong in it."] + [
        f"The peak hardly depends on {', '.join(hardly)}, and tells nothing of them."] * bool(hardly)


def fit_peaks(specimens, entries, directory, executor, n_jobs, say):
    """{name: {"fits", "rows"} as of a fit, or the exception}, and what else the page shows. Raises InputError."""
    template, seen = Template(entries), {}
    keys = {specimen.name: tuple(sorted(specimen.entries.items())) for specimen in specimens}
    scenes = {key: _read(template.text(key, template.unknown.start)) for key in dict.fromkeys(keys.values())}
    scene = next(iter(scenes.values()))
    is_cheap = scene.values["Model"] != "finite elements"

    def run_all(function, tasks):
        return results_of(function, tasks, executor, 1 if is_cheap and len(tasks) < OWN_PROCESSES else n_jobs)

    def run(pairs):
        say(f"{len(pairs)} runs")
        tasks = {(key, x): template.text(key, template.value(x)) for key, x in pairs}
        results = run_all(run_peak, {pair: (text, "" if is_cheap else _directory_of(text, directory)) for pair, text in tasks.items()})
        seen.update((text, "") for one in results.values() if not isinstance(one, Exception) for text in one[2])
        return results

    by_set = functions_of(template, list(scenes), run)
    noise = {key: stated_noise(one.values)[0] for key, one in scenes.items()}
    rows = rows_of_peaks(specimens, *({name: of_set[key] for name, key in keys.items()} for of_set in (by_set, noise)))
    unit = scene.curve[1].rpartition("_")[2].replace("Nmm", "N mm")
    results = {name: row if isinstance(row, Exception) else {"fits": True, "rows": [{**row, "peak_unit": unit}]} for name, row in rows.items()}
    if not (functions := [one for one in by_set.values() if isinstance(one, PeakFunction)]):
        return results, {}
    found = {name: row for name, row in rows.items() if not isinstance(row, Exception)}
    middle = numpy.median([row["value"] for row in found.values()]) or 0.5 * (template.unknown.lower + template.unknown.upper)
    first = next(key for key, one in by_set.items() if isinstance(one, PeakFunction))
    influence = _influence(template, first, middle, lambda tasks: run_all(numbers_of, tasks))
    values = numpy.array(list(map(template.value, numpy.linspace(template.low, template.high, 65))))
    return results, {
        "unknown": template.unknown.name, "unit": template.unknown.unit, "load_unit": unit, "at": float(middle), "warnings": list(seen),
        "influence": influence[0] if influence else [], "notes": _notes(
            template, functions, influence, all(one.sd or noise[keys[one.name]] for one in specimens), sum(row["at_bound"] for row in found.values())),
        "values": values.tolist(), "peaks": [one.curve(values).tolist() for one in functions]}
