"""What a fit has taken as known: by how much its answer changes if that is wrong."""

import itertools
import re

import numpy

import _debond

from .errors import RunError, SceneError
from .experiment import entry_of
from .measurement import given
from .page_data import numbers

# Numbers of a test, without those of meshes and of what is drawn by chance; the scene says which of them it does not read.
_NUMBERS = re.compile("(Expert / )?(Implant / (Radius|Inner radius|Cap radius|Height|Taper angle|Pitch|Thread depth|Size)|Bone / Outer radius|(Bone|Implant) / (Young modulus|Poisson ratio)"
                      "|Interface / (?!Quadrature|Friction starts|Bonding / )|Interface / Bonding / Bond|Closed form / (Normal|Torsional) stiffness"
                      "|Chuck / .*(Stiffness|/ Value))")
_SHARES = ("Bonding degree", "Bonded fraction", "Adhesive friction")  # at most 1
_COMPONENTS = [f"{motion} {axis}" for motion in ("Translation", "Rotation") for axis in "xyz"]
_JUMP = 0.05  # of the largest value, which 1 % of a number changes where a jump moves
_NAMES = {"deg": "angle", "mm": "displacement", "N mm": "torque", "N": "force"}


def _unit_of(entry, values):
    """Also of entries that may be expressions."""
    if entry.endswith("Interference"):
        return "mm"
    if entry.endswith("Value"):
        is_loaded, turns = values[entry.replace("Value", "Control")] in ("force", "moment"), "Rotation" in entry
        return ("N mm" if turns else "N") if is_loaded else "deg" if turns else "mm"
    return _debond.unit_of(entry)


def _changed_number(entry, text):
    """(change in words, new text) of a number; nothing of what is none."""
    known = numbers(text.split(","))
    if not text or known == [0]:
        return ()
    if entry.endswith(("Value", "Interference")):
        return "+1 %", f"({text}) * 1.01"
    if not numpy.isfinite(known).all():
        return ()
    percent = -1 if entry.endswith(_SHARES) and 1.01 * known[0] > 1 else 1
    return f"{percent:+} %", ", ".join(repr((1 + 0.01 * percent) * one) for one in known)


def changes_of_model(experiment, held):
    """(entry, value, unit, change in words, its new text) of numbers of the model but for the entries `held`. `experiment`: its values
    and what its curve is over, a CurveColumn, are read."""
    values = experiment.values
    return [(entry, text, _unit_of(entry, values), *change) for entry, text in values.items()
            if _NUMBERS.match(entry) and entry not in held and not _moves_along(experiment, entry)
            for change in [_changed_number(entry, given(text))] if change]


def _changes(fit):
    """The same of all that is taken as known. Small ones, as their effect is linearised."""
    problem = fit.problem
    experiment = problem.done[0]
    values, held = experiment.values, set().union(*(problem.unknowns.entries(e.number, fit.values) for e in problem.done))
    result = changes_of_model(experiment, held)
    for name, size, part in _changes_of_rig(fit, experiment):
        entry = entry_of(name)
        if entry not in held:
            unit = _debond.unit_of(entry)
            result.append((entry, values[entry], unit, f"+{size:.2g} {unit}, {part}", repr(float(values[entry]) + float(size))))
    return result


def _moves_along(experiment, entry):
    """Whether the entry prescribes the motion that curves are drawn over: then it says how far they go, not what they are."""
    component = entry.replace("Press", "Translation z").split(" / ")[1:2]
    return (entry.endswith("Value") and experiment.over.kind == "position" and component == _COMPONENTS[experiment.over.component:][:1]
            and experiment.values[entry.replace("Value", "Control")] not in ("force", "moment"))


def _changes_of_rig(fit, experiment):
    """(entry, change, what it is 1 % of) of all that instruments of this experiment may show."""
    own = [series for series in fit.problem.series if series.experiment is experiment]
    curves = [fit._best.curve[series.slice] for series in own]
    largest = [curve[numpy.argmax(abs(curve))] for curve in curves]
    load, name, half = 0, "", 0
    for series, curve, most in reversed(list(zip(own, curves, largest))):
        if series.column.kind == "load":  # the first one; on the way up, where positions matter
            load, name, half = most, _NAMES[series.column.unit], numpy.argmax(abs(curve) >= 0.5 * abs(most))
    for i, (column, names) in enumerate(zip((experiment.over, *experiment.columns), experiment.rigs)):
        if not names:
            continue
        size = 0.01 * (largest[i - 1] if i > 0 else experiment.measured.over[half])
        part = f"1 % of the largest {_NAMES[column.unit]}" if i > 0 else f"1 % of the {_NAMES[column.unit]} at half the largest {name}"
        if column.kind == "load":
            yield from ((name, size, part) for name in names)
        elif load != 0:
            yield from zip(names, (size, abs(size), abs(2 * size / load)), [part] * 3)


def _change_of_curve(fit, entry, text):
    """By how much the predicted values (N) at the best fit change if an entry of all experiments has another value; None if
    there is no such curve, or nothing reads the entry. By the closed form where there is one: this is no place to spend runs."""
    problem, curves = fit.problem, []
    closed = not problem.why_no_closed_form
    for experiment in problem.done:
        try:
            other = experiment.changed({entry: text})
            if any(text.startswith(entry + " = ") and "has no effect" in text for text in other.scene.warnings):
                return None
            if closed and not other.why_no_closed_form:
                other.settle(fit.values)
                curves.append(other.by_closed_form(fit.values))
                continue
            rows = problem.runs.rows([other.task(fit.values, problem.steps[id(experiment)])])[0]
            if isinstance(rows, str):
                return None
            curves.append(other.seen(rows, other.changes(fit.values)[1]))
        except (SceneError, RunError):
            return None
    base = problem.curves([fit.values], True)[0] if closed else fit._best.curve
    return None if base is None else numpy.concatenate(curves) - base


def _slopes(fit, free):
    """Of the curve by the unknowns `free`, over the weights, along changes of 1 % as those of the table."""
    problem = fit.problem
    try:
        return problem.weights[:, None] * problem.derivatives(fit.values, not problem.why_no_closed_form, free, 1e-2)
    except RunError:
        return fit.told.derivatives[:, free]


def _uncertainties(J):
    return numpy.linalg.norm(numpy.linalg.pinv(J), axis=1)


def _compensation(J, change, robust):
    """What of the unknowns makes up for a change of the curve (both over the weights), by least squares; robust: rows that stay off
    by far more than most count by their sign, as those beside a jump."""
    weights = numpy.ones(len(change))
    for _ in range(30 if robust else 1):
        moved = numpy.linalg.lstsq(weights[:, None] * J, -weights * change, rcond=1e-7)[0]
        rest = abs(J @ moved + change)
        weights = numpy.sqrt(numpy.minimum(1, 4 * numpy.median(rest) / numpy.maximum(rest, 1e-300)))
    return moved


def table_of(fit):
    """A list of {"entry", "value", "unit", "change", "effect": {unknown: by how many % of itself}}. Rows over which 1 % of a number moves
    a jump of the curve are left out, and so are effects on what hardly any other rows tell, and numbers that change nothing by 0.01 %.
    Cells and steps of the fit come first, as they are."""
    problem, told = fit.problem, fit.told
    usable = told.free & numpy.isfinite(told.half_widths)
    free = numpy.flatnonzero(usable)
    J, table = _slopes(fit, free), []
    largest = numpy.concatenate([numpy.full(series.slice.stop - series.slice.start, abs(fit._best.curve[series.slice]).max()) for series in problem.series])
    percent = 0.01 * numpy.array([1 if problem.unknowns.list[j].logarithmic else abs(fit.values[j]) for j in free])
    steady = (abs(J) * percent <= _JUMP * (problem.weights * largest)[:, None]).all(axis=1)
    if not steady.all():
        usable[free] = _uncertainties(J[steady]) < 10 * _uncertainties(J)
    of_runs = [((error.entry, error.value, "", error.change), error.of_curve) for error in fit.errors]
    others = ((change[:4], _change_of_curve(fit, change[0], change[4])) for change in _changes(fit))
    for (entry, value, unit, change), change_of_curve in itertools.chain(of_runs, others):
        if change_of_curve is None:
            continue
        rows = steady & (abs(change_of_curve) <= _JUMP * largest)
        moved = numpy.zeros(len(fit.values))
        moved[free] = _compensation(J[rows], (problem.weights * change_of_curve)[rows], not rows.all())
        at = problem.unknowns.to_search(fit.values)
        other = problem.unknowns.values_of(at + moved)
        with numpy.errstate(over="ignore"):
            effect = numpy.where(usable & (fit.values != 0), 100 * (other / numpy.where(fit.values == 0, 1, fit.values) - 1), numpy.nan)
        effect = {name: (round(float(x), 2) + 0.0 if numpy.isfinite(x) else None) for name, x in zip(fit.names, effect)}
        if len(table) < len(fit.errors) or any(effect.values()) or (abs(change_of_curve).max() > 1e-6 * largest.max() and set(effect.values()) == {None}):
            table.append({"entry": entry, "value": value, "unit": unit, "change": change, "effect": effect})
    return table
