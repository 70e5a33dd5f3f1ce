"""Experiments of a fit: what a scene predicts where something has been measured, for unknowns that change from one call to the
next. The rig stands between both,

    shown angle  = angle + offset + slack + compliance T,
    shown torque = T + offset + drift * share of the test,

and the same with displacements and forces.
"""

import functools
import re
import threading

import numpy

import _debond

from . import measurement
from .errors import RunError, SceneError
from .page_data import USUAL

# Entries of Calibration that say what instruments add, by the unit of the positions or loads that they show.
_RIG = {"deg": ("Angle offset", "Slack", "Machine compliance"), "N mm": ("Torque offset", "Torque drift"),
        "mm": ("Displacement offset", "Displacement slack", "Displacement compliance"), "N": ("Force offset", "Force drift")}


def entry_of(name):
    """The full name of an entry of Calibration."""
    return ("Expert / " if name == "Seed" or name.endswith("drift") else "") + "Calibration / " + name


def _rigs_of(columns):
    """For each column the entries that change what an instrument shows of it: of several in the same unit the first."""
    rigs = [_RIG.get(column.unit, ()) for column in columns]
    return [one if one not in rigs[:i] else () for i, one in enumerate(rigs)]


@functools.lru_cache(maxsize=16)
def _curve_of(text, name, _thread):
    """The curve of the scene `text`, one for each thread: what it keeps is not for several at a time."""
    return _debond.VaryingCurve(_debond.read_text(text, name), name)


def run_task(task):
    """Rows of a run, as {column: array}, or why there are none: what an executor of any kind calls. `task`: text and name of
    the scene, changes as pairs (full name, value), ends of steps of each phase, columns that are wanted."""
    text, name, changes, steps, columns = task
    try:
        rows = _curve_of(text, name, threading.get_ident()).by_scene(list(changes), [list(ends) for ends in steps])
    except (RunError, SceneError) as error:
        return str(error)
    return {column: rows[column] for column in columns}


class Experiment:
    """A scene with unknowns, and a measured curve that belongs to it."""

    def __init__(self, unknowns, number, entries, name, measured=None):
        """Experiment `number` of `unknowns`; `measured`: a Measurement that has been read. Raises SceneError."""
        self.unknowns, self.number, self.given = unknowns, number, entries
        entries = _debond.with_values(entries, unknowns.entries(number, unknowns.starts))
        # runs read no measured curve; the file is read once, by this module
        without = _debond.changed(entries, ["Output/Reference curve=none", "Output/Reference columns=auto"], "--set")
        self.scene = _debond.Scene(entries if measured is None else without, name, _debond.Team(0))
        self.name = name
        self.values = self.scene.values
        over, load = self.scene.curve
        self.columns = [measurement.curve_column(self.scene, column.strip(), "Calibration / Curves")
                        for column in (measurement.given(self.values["Calibration / Curves"]) or load).split(",")]
        self.over = measurement.curve_column(self.scene, measurement.given(self.values["Calibration / Over"]) or over, "Calibration / Over")
        self.rigs = _rigs_of([self.over, *self.columns])
        self.measured = measured or measurement.read(self.scene, self.values, self.columns, self.over, *self._shifts())
        self.direction = measurement.direction_of(self.measured.over, self.measured.branch) or 1
        self.text = _debond.text_of(without)
        self.curve = _debond.VaryingCurve(without, name)
        self.is_finite_elements = self.values["Model"] == "finite elements"
        self._held_in = [self._entries_with(j) for j in range(len(unknowns.list))]
        # others change what the rig shows
        self.changes_model = [any("Calibration / " not in name for name in names) for names in self._held_in]
        self.why_no_closed_form = self._find_why_no_closed_form()
        self._centre, self._settled = None, {}

    def changed(self, entries):
        """The same with other entries, {full name: text}. Raises SceneError."""
        given = _debond.changed(self.given, [f"{name}={text}" for name, text in entries.items()])
        return Experiment(self.unknowns, self.number, given, self.name, self.measured)

    @property
    def is_done(self):
        return bool(self.measured.file)

    @functools.cached_property
    def last_angle(self):
        """To which the scene turns the chuck [deg]; 0 if it prescribes a moment."""
        return self.scene.prescribed([self.scene.sample_times[-1]]).get("chuck_rz_deg", numpy.zeros(1))[0]

    def changes(self, values):
        """Entries of the scene but for those of Calibration, as pairs (full name, text), and the rig's numbers."""
        entries = self.unknowns.entries(self.number, values)
        every = {**self.values, **entries}
        rig = {name: float(every[entry_of(name)]) for names in _RIG.values() for name in names}
        return tuple((name, text) for name, text in entries.items() if "Calibration / " not in name), rig

    def scene_of(self, values):
        """The scene with these values of the unknowns."""
        entries = _debond.with_values(self.given, self.unknowns.entries(self.number, values))
        return _debond.Scene(_debond.changed(entries, ["Output/Reference curve=none", "Output/Reference columns=auto"]), self.name,
                             _debond.Team(0))

    def halved(self, steps):
        """Ends of steps half as wide as these, which adaptive ones have chosen, or as those planned."""
        start = self.scene.sample_times[0]
        if not steps:
            texts = [self.values["Load steps / " + name] for name in ("Times", "Steps")]
            times, numbers = ([float(item) for item in (USUAL["Load steps / Steps"] if text == "auto" else text).split(",")] for text in texts)
            steps = [numpy.linspace(begin, end, int(n) + 1)[1:] for begin, end, n in zip(times, times[1:], numbers)]
        starts = [start, *(ends[-1] for ends in steps[:-1])]
        return [numpy.unique(numpy.r_[ends, (numpy.array([begin, *ends[:-1]]) + ends) / 2]).tolist() for begin, ends in zip(starts, steps)]

    def _shifts(self):
        """By how much the instrument may show more than the implant moves, without a load and per load."""
        if self.over.kind != "position":
            return 0.0, 0.0
        offset, slack, compliance = self.rigs[0]
        rigs = [self.changes(values)[1] for values in (self.unknowns.lower, self.unknowns.upper)]
        return sum(max(abs(rig[key]) for rig in rigs) for key in (offset, slack)), self.changes(self.unknowns.starts)[1][compliance]

    @functools.cached_property
    def remarks(self):
        """What is to be said before a fit: of the file, and of entries of Calibration that nothing reads."""
        used = set().union(*self.rigs)
        readers = {name: f"what is measured in {unit}" for unit, names in _RIG.items() for name in names if name not in used}
        if self.values["Expert / Calibration / Measure"] == "least squares":
            readers["Seed"] = "Expert / Calibration / Measure = e_mp or e_rel"
        if measurement.given(self.values["Expert / Calibration / Noise columns"]):
            readers["Noise"] = "Expert / Calibration / Noise columns = none"
        # what an included file sets is for several scenes
        own = {entry.name: entry.value for entry in self.given
               if ":" not in entry.place or entry.place.startswith(self.name + ":")}
        return self.measured.remarks + [
            f"{full} = {own[full]} has no effect in this scene: it is for {reader}"
            for name, reader in readers.items() for full in [entry_of(name)]
            if own.get(full, "0") not in ("0", "auto")]

    def _entries_with(self, j):
        """Names of the entries that hold an unknown."""
        other, unknown = self.unknowns.starts.copy(), self.unknowns.list[j]
        other[j] = 0.5 * (other[j] + (unknown.upper if other[j] < unknown.upper else unknown.lower))
        before, after = (self.unknowns.entries(self.number, values) for values in (self.unknowns.starts, other))
        return {name for name in before if before[name] != after[name]}

    def _find_why_no_closed_form(self):
        others = any(column.kind != "load" or column.component not in (2, 5) for column in self.columns)
        return (self.curve.why_no_closed_form
                or "the radius is an unknown" * any("Implant / Radius" in names for names in self._held_in)
                or "closed forms know curves over the angle" * (not self.over.is_angle)
                or "closed forms know torque and axial force" * others)

    def check_bounds(self):
        """Values that are not allowed within the bounds show now, and not in the middle of a search. Raises SceneError."""
        for j, unknown in enumerate(self.unknowns.list):
            for bound in (unknown.lower, unknown.upper):
                values = self.unknowns.starts.copy()
                values[j] = bound
                try:
                    self.curve.check(list(self.unknowns.entries(self.number, values).items()))
                except SceneError as error:
                    unknown.entry.refuse(f"at the bound {bound:.6g}: {error}")

    def settle(self, values):
        """Makes the closed form exact in stiffness at these unknowns: what the bodies add to the compliance of the interface
        changes slowly, and is linear (by its logarithm) in the unknowns nearby. Searches begin at the same place again and
        again."""
        key = values.tobytes()
        if key not in self._settled:
            self._settled[key] = self._compliance_near(values)
        self._centre = self._settled[key]

    def _compliance_near(self, values):
        """These values, the compliance of the bodies there [mm/MPa], and the slopes of its logarithm by the unknowns."""
        compliance = numpy.array(self.curve.compliance_of_bodies(list(self.changes(values)[0])))
        slopes = numpy.zeros((2, len(values)))
        for j, unknown in enumerate(self.unknowns.list):
            of_bodies = any(re.match("Bone / |Implant / |Interface / (Normal|Tangential) stiffness", name) for name in self._held_in[j])
            if of_bodies and compliance.all():
                other = values.copy()
                h = 1e-2 * max(abs(values[j]), 1e-2 * (unknown.upper - unknown.lower))
                other[j] += h if values[j] + h <= unknown.upper else -h
                there = numpy.array(self.curve.compliance_of_bodies(list(self.changes(other)[0])))
                slopes[:, j] = numpy.log(there / compliance) / (other[j] - values[j])
        return values.copy(), compliance, slopes

    def by_closed_form(self, values):
        """The disk on a foundation, where something has been measured (curves x n). Raises SceneError."""
        if self._centre is None:
            self.settle(self.unknowns.starts)
        centre, compliance, slopes = self._centre
        # far away the straight line must not leave what is possible
        compliance = compliance * numpy.exp(numpy.clip(slopes @ (values - centre), -2, 2))
        changes, rig = self.changes(values)
        last = self.last_angle
        angles = self.measured.over - self.measured.signs[0] * rig["Angle offset"] - self.direction * rig["Slack"]
        angles = angles[(angles * last > 0) & (abs(angles) < abs(last))]
        angles = numpy.unique(numpy.concatenate([numpy.linspace(0, last, 101), angles]))[::1 if last > 0 else -1]
        torque, force = self.curve.by_foundation(list(changes), list(compliance), list(angles))
        rows = {self.over.key: angles, "torque_Nmm": torque}
        for column in self.columns:
            rows[column.key] = torque if column.is_torque else numpy.full(len(angles), force)
        return self.seen(rows, rig)

    def task(self, values, steps):
        """Of a run, for run_task()."""
        changes, _ = self.changes(values)
        positions = [column for column in (self.over, *self.columns) if column.kind == "position"]
        columns = {self.over.key, *(column.key for column in self.columns), *(column.load for column in positions)}
        return self.text, self.name, changes, tuple(tuple(ends) for ends in steps), tuple(sorted(columns))

    def seen(self, rows, rig):
        """Rows of a run as the instruments show them, at the measured rows: curves x n, one curve behind the other. The rows
        are joined by straight lines, branch by branch. Before the beginning of a branch the curve stays as it begins, beyond
        its end it goes on straight. Raises RunError."""
        measured = self.measured
        if self.over.kind == "position" and rig[self.rigs[0][1]] != 0:
            rows = _with_rows_without_load(rows, self.over.load)
        x, *curves = (self._shown(i, column, rows, rig) for i, column in enumerate((self.over, *self.columns)))
        branch = measurement.branches_like(x, (measured.over, measured.branch), measured.least_turn)
        result = numpy.empty((len(self.columns), len(measured.over)))
        self.n_beyond, self.ends_at = 0, x[-1]
        for b in numpy.unique(measured.branch):
            at = measured.branch == b
            first, last = numpy.searchsorted(branch, b), numpy.searchsorted(branch, b, side="right") - 1
            first -= first > 0  # the row at the turn
            begin, end, share = _neighbours(x[first:last + 1], measured.over[at])
            self.n_beyond += int((share > 1 + 1e-6).sum())
            for c, curve in enumerate(curves):
                y = curve[first:last + 1]
                result[c, at] = (1 - share) * y[begin] + share * y[end]
        for c, column in enumerate(self.columns):
            if column.kind == "load" and self.rigs[c + 1]:
                offset, drift = self.rigs[c + 1]
                result[c] += measured.signs[c + 1] * (rig[offset] + rig[drift] * measured.share)
        if not numpy.isfinite(result).all():
            raise RunError("the computed curve has no values where something has been measured")
        return result.ravel()


    def _shown(self, i, column, rows, rig):
        """Column i of a run, 0: `over`, as the machine moves while it is measured. The test begins before the slack is passed."""
        values, measured = rows[column.key], self.measured
        if column.kind != "position" or not self.rigs[i]:
            return values
        load, (offset, slack, compliance) = rows[column.load], self.rigs[i]
        load = numpy.where(abs(load) > 1e-9 * abs(load).max(initial=0), load, 0)
        way = self.direction
        if i > 0 and self.is_done:
            way = measurement.direction_of(measured.values[:, i - 1], measured.branch) or 1
        return values + measured.signs[i] * rig[offset] + numpy.where(way * load >= 0, way * rig[slack], 0) + rig[compliance] * load


def _neighbours(x, places):
    """Rows of a branch between which `places` lie, and the share of the second one. Of rows that stay in a place, as while it is
    pressed, the last one is met."""
    sign = -1 if x[-1] < x[0] else 1
    reached, ahead = numpy.maximum.accumulate(sign * x), numpy.maximum(sign * places, sign * x[0])
    end = numpy.searchsorted(reached, ahead + 1e-9 * abs(ahead), side="right").clip(min(1, len(x) - 1), len(x) - 1)
    begin = numpy.maximum(end - 1, 0)
    width = x[end] - x[begin]
    share = numpy.where(width == 0, 1, numpy.maximum(0, (places - x[begin]) / numpy.where(width == 0, 1, width)))
    return begin, end, share


def _with_rows_without_load(rows, load):
    """Where the load changes its sign the slack is passed at rest: adds a row just before and one just after."""
    torque = rows[load]
    rounding = 1e-9 * abs(torque).max(initial=0)
    is_some = abs(torque) > 2 * rounding
    before = numpy.flatnonzero((torque[:-1] * torque[1:] < 0) & is_some[:-1] & is_some[1:])
    share = torque[before] / (torque[before] - torque[before + 1])
    result = {}
    for name, values in rows.items():
        between = (1 - share) * values[before] + share * values[before + 1]
        pairs = numpy.repeat(between, 2)
        if name == load:
            pairs = 2 * rounding * numpy.sign(numpy.column_stack([torque[before], torque[before + 1]])).ravel()
        result[name] = numpy.insert(values, numpy.repeat(before + 1, 2), pairs)
    return result
