"""The fit of one specimen of many, as a task that any process can take, and what it leaves in its directory."""

import hashlib
import json
import os

import numpy

import _debond

from .calibrate import plain, save, why_it_does_not_fit
from .errors import InputError, RunError
from .files import write_whole
from .fit import fit
from .scene import Scene


def _identity(text, specimen, files):
    """What results of a specimen belong to: template, row, content of files."""
    parts = [_debond.version, text, repr((specimen.name, specimen.group, specimen.curve))]
    for file in files:
        try:
            with open(file, "rb") as stream:
                parts.append(hashlib.sha256(stream.read()).hexdigest())
        except OSError as error:
            parts.append(error.strerror)
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def task_of(specimen, template, table, directory):
    """What fit_one() is told: texts only, which any process can take."""
    curve = os.path.join(os.path.dirname(table), specimen.curve)
    own = [f"{name}={text}" for name, text in specimen.entries.items()]
    entries = _debond.changed(template, [*own, "Task=calibrate", "Output/Reference curve=" + curve])
    files = [entry.value for entry in entries if os.path.isfile(entry.value) or entry.value == curve]
    text = _debond.text_of(_debond.changed(entries, ["Output/Reference curve=" + specimen.curve]))
    return _debond.text_of(entries), os.path.join(directory, specimen.name), _identity(text, specimen, files), os.getcwd()


def _result_file(directory):
    return os.path.join(directory, "specimen.json")


def finished(task):
    """The result that a directory holds already; None without one of this task."""
    try:
        with open(_result_file(task[1]), encoding="utf-8") as file:
            result = json.load(file)
        return result if result["identity"] == task[2] else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _rows_of(done):
    """Of each unknown what specimen.json holds. sd: of the error of its value, on the scale that is searched."""
    unknowns, told = done.problem.unknowns, done.told
    lower, upper = unknowns.to_search(done.lower), unknowns.to_search(done.upper)
    with numpy.errstate(invalid="ignore"):
        sd = (upper - lower) / (2 * told.quantiles)
    return [{"unknown": one.name, "value": done.values[j], "lower_95": done.lower[j], "upper_95": done.upper[j],
             "unit": one.unit, "told": done.is_told[j], "at_bound": not told.free[j], "logarithmic": one.logarithmic,
             "sd": sd[j]}
            for j, one in enumerate(unknowns.list)]


def fit_one(task):
    """Fits a specimen into its directory and returns what specimen.json holds, or {"reason"}: why it failed. What an executor
    of any kind calls."""
    text, directory, identity, work = task
    try:
        if os.getcwd() != work:  # of a process that was started elsewhere
            os.chdir(work)
        os.makedirs(directory, exist_ok=True)
        if os.path.exists(_result_file(directory)):
            os.remove(_result_file(directory))
        runs = os.path.join(directory, "evaluations.jsonl")
        done = fit(Scene(None, text=text), evaluations=runs)
        save(done, directory)
        why = why_it_does_not_fit(done)
        if why:
            return {"reason": why}
        fits = not any(misfit.does_not_fit for misfit in done.misfits)
        result = plain({"identity": identity, "fits": fits, "e_rel": done.e_rel, "rows": _rows_of(done)})
        write_whole(_result_file(directory), json.dumps(result, indent=2) + "\n")
        if os.path.exists(runs):
            os.remove(runs)
        return result
    except (InputError, RunError) as error:
        return {"reason": str(error)}
    except Exception as error:  # the others go on
        return {"reason": f"{type(error).__name__}: {error}"}
