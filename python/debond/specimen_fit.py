"""The fit of one specimen of many, as a task that any process can take, and what it leaves in its directory."""

import hashlib
import json
import os

import numpy

import _debond

from .calibrate import json_of, plain, save, why_it_does_not_fit
from .errors import RunError
from .files import write_whole
from .fit import fit
from .scene import Scene


def _identity(text, specimen, files):
    """What results of a specimen belong to: template, row, content of files."""
    parts = hashlib.sha256(repr((_debond.version, text, specimen.name, specimen.group, specimen.curve)).encode())
    for file in files:
        with open(file, "rb") as stream:
            parts.update(hashlib.sha256(stream.read()).digest())
    return parts.hexdigest()


def task_of(specimen, template, table, directory):
    """What fit_one() is told: texts only, which any process can take."""
    curve = os.path.join(os.path.dirname(table), specimen.curve)
    own = [f"{name}={text}" for name, text in specimen.entries.items()]
    entries = _debond.changed(template, [*own, "Task=calibrate", "Output/Reference curve=" + curve])
    files = [entry.value for entry in entries if os.path.isfile(entry.value) and os.access(entry.value, os.R_OK)]
    text = _debond.text_of(_debond.changed(entries, ["Output/Reference curve=" + specimen.curve]))
    return _debond.text_of(entries), os.path.join(directory, specimen.name), _identity(text, specimen, files), os.getcwd()


def _result_file(directory):
    return os.path.join(directory, "specimen.json")


def finished(task):
    """The result that a directory holds already; None without one of this task."""
    try:
        with open(_result_file(task[1]), encoding="utf-8") as file:
            result = json.load(file)
    except (OSError, ValueError):
        return None
    return result if result.get("identity") == task[2] else None


def _remove(file):
    if os.path.exists(file):
        os.remove(file)


def _rows_of(done):
    """Of each unknown what calibration.json holds, and sd: of the error of its value, on the scale that is searched."""
    lower, upper = map(done.problem.unknowns.to_search, (done.lower, done.upper))
    with numpy.errstate(invalid="ignore"):
        sds = (upper - lower) / (2 * done.told.quantiles)
    return [{"unknown": name, **one, "sd": sd} for (name, one), sd in zip(json_of(done)["unknowns"].items(), sds)]


def fit_one(task):
    """Fits a specimen into its directory and returns what specimen.json holds. What an executor of any kind calls. Raises
    InputError or RunError."""
    text, directory, identity, work = task
    os.chdir(work)  # a process may have been started elsewhere
    runs = os.path.join(directory, "evaluations.jsonl")
    os.makedirs(directory, exist_ok=True)
    _remove(_result_file(directory))
    done = fit(Scene(None, text=text), evaluations=runs)
    save(done, directory)
    if why := why_it_does_not_fit(done):
        raise RunError(why)
    fits = not any(misfit.does_not_fit for misfit in done.misfits)
    result = plain({"identity": identity, "fits": fits, "e_rel": done.e_rel, "rows": _rows_of(done)})
    write_whole(_result_file(directory), json.dumps(result, indent=2) + "\n")
    _remove(runs)
    return result
