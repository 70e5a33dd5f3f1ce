"""The fit of one specimen of many, as a task that any process can take, and what it leaves in its directory."""

import hashlib
import os
import pathlib

import numpy

import _debond

from .calibrate import json_of, plain, save, why_it_does_not_fit
from .errors import RunError
from .files import digest_of, write_json
from .fit import fit
from .page_data import NoResults, read_json
from .scene import Scene


def identity_of(entries, *parts):
    """What results belong to: this version, these parts, and the content of the files that entries name."""
    files = [entry.value for entry in entries if os.path.isfile(entry.value) and os.access(entry.value, os.R_OK)]
    return hashlib.sha256(repr((_debond.version, *parts, *map(digest_of, files))).encode()).hexdigest()


def task_of(specimen, template, table, directory):
    """What fit_one() is told: texts only, which any process can take."""
    curve = os.path.join(os.path.dirname(table), specimen.curve)
    own = [f"{name}={text}" for name, text in specimen.entries.items()]
    entries = _debond.changed(template, [*own, "Task=calibrate", "Output/Reference curve=" + curve])
    text = _debond.text_of(_debond.changed(entries, ["Output/Reference curve=" + specimen.curve]))
    return _debond.text_of(entries), os.path.join(directory, specimen.name), identity_of(entries, text, specimen.name, specimen.group, specimen.curve)


def finished(task):
    """The result that a directory holds already; None without one of this task."""
    try:
        result = read_json(os.path.join(task[1], "specimen.json"))
    except (OSError, NoResults):
        return None
    return result if result.get("identity") == task[2] else None


def _rows_of(done):
    """Of each unknown what calibration.json holds, and sd: of the error of its value, on the scale that is searched."""
    lower, upper = map(done.problem.unknowns.to_search, (done.lower, done.upper))
    with numpy.errstate(invalid="ignore"):
        sds = (upper - lower) / (2 * done.told.quantiles)
    return [{"unknown": name, **one, "sd": sd} for (name, one), sd in zip(json_of(done)["unknowns"].items(), sds)]


def fit_one(task):
    """Fits a specimen into its directory and returns what specimen.json holds. What an executor of any kind calls. Raises
    InputError or RunError."""
    text, directory, identity = task
    runs, kept = (pathlib.Path(directory, name) for name in ("evaluations.jsonl", "specimen.json"))
    os.makedirs(directory, exist_ok=True)
    kept.unlink(missing_ok=True)
    done = fit(Scene(None, text=text), evaluations=runs)
    save(done, directory)
    if why := why_it_does_not_fit(done):
        raise RunError(why)
    fits = not any(misfit.does_not_fit for misfit in done.misfits)
    result = plain({"identity": identity, "fits": fits, "e_rel": done.e_rel, "rows": _rows_of(done)})
    write_json(kept, result)
    runs.unlink(missing_ok=True)
    return result
