"""A scene with `Task = calibrate` as the program runs it: into its directory, with all files."""

import json
import math
import os
import pathlib
from typing import Any, Dict

import numpy

import _debond

from . import intervals
from .errors import RunError
from .executors import check_workers
from .experiment import entry_of
from .files import csv_text, digest_of, heeding, make_directory, say, write_json, write_whole
from .fit import fit_problem, problem_of
from .measurement import rows_in_words, unit_doubt
from .page import write_page_if_possible
from .problem import Runs
from .scene import Scene


def plain(value):
    """As JSON has it: null for what is not known."""
    return json.loads(json.dumps(value, default=lambda item: item.tolist()), parse_constant=lambda name: None)


def _rigs(done):
    """What the rig shows besides the implant, at the best fit: number, unit, and whether that is fitted."""
    problem, result = done.problem, []
    for experiment in problem.experiments:
        rig, held = experiment.changes(done.values)[1], problem.unknowns.entries(experiment.number, done.values)
        said = {entry.name for entry in experiment.given}
        result.append({name: {"value": value, "unit": _debond.unit_of(entry_of(name)),
                              "fitted": entry_of(name) in held}
                       for name, value in rig.items() if entry_of(name) in said})
    return result


def _outline(problem, **found):
    """What calibration.json holds of any fit, and what has been found; nothing in the place of what has not."""
    runs = problem.runs
    lists = ("measured_rows", "rig", "curves", "noise", "taken_as_known", "optima", "cannot_be_told", "warnings", "candidates")
    return {"title": problem.values["Title"], "version": _debond.version, "provenance": _debond.provenance(), "seconds": None,
            "evaluations": runs.n_runs, "failures": runs.n_failures, "last_failure": runs.last_failure,
            "measured_values": len(problem.measured), "unknowns": {}, "correlations": {}, **dict.fromkeys(lists, []), **found}


def json_of(done) -> Dict[str, Any]:
    """What calibration.json holds of a Fit."""
    problem, told, names = done.problem, done.told, done.names
    unknowns = {u.name: {"value": done.values[j], "unit": u.unit, "lower_95": done.lower[j], "upper_95": done.upper[j],
                         "told": done.is_told[j], "at_bound": not told.free[j], "start": u.start, "bounds": [u.lower, u.upper],
                         "logarithmic": u.logarithmic} for j, u in enumerate(problem.unknowns.list)}
    correlations = {f"{names[i]} | {names[j]}": told.correlations[i, j] for j in range(len(names)) for i in range(j)}
    curves = [{"curve": m.name, "e_mp": m.e_mp, "e_rel": m.e_rel, "rms_over_largest": m.rms,
               "smooth_misfit_over_largest": m.smooth, "F_of_misfit": m.F, "chance_of_F": m.chance,
               "fits": not m.does_not_fit} for m in done.misfits]
    noises = [{"curve": m.name, "model": m.noise.name, "sd_over_largest": m.noise_over_largest,
               "correlation_of_neighbours": m.noise.correlation, "rows": s.slice.stop - s.slice.start,
               "effective_rows": m.effective_rows} for m, s in zip(done.misfits, problem.series)]
    per_search = numpy.where(problem.unknowns.logarithmic, done.values, 1)
    return plain(_outline(
        problem, seconds=done.seconds, failed=why_it_does_not_fit(done),
        measured_rows=[{"file": e.measured.file, **e.measured.counts} for e in problem.done],
        noise_is_known=problem.noise_is_known, unknowns=unknowns, rig=_rigs(done), correlations=correlations, curves=curves,
        noise=noises, taken_as_known=done.taken_as_known, warnings=done.warnings,
        optima=[{"cost": one.cost, "converged": one.converged, "unknowns": dict(zip(names, one.values))}
                for one in done.optima],
        cannot_be_told=[intervals.text_of(direction, problem.unknowns) for direction in told.directions],
        candidates=[{"experiment": number + 1, "half_widths": dict(zip(names, widths * per_search))}
                    for number, widths in done.candidates]))


def _write_outline(problem, directory, outline):
    """calibration.json, and the page, which is made of it."""
    write_json(os.path.join(directory, "calibration.json"), outline)
    if problem.values["Output / Report"] == "true":
        write_page_if_possible(directory)


def _numbered(name, ending, i, n):
    return f"{name}-{i + 1}{ending}" if n > 1 else name + ending


def interval_text(done, j):
    if not math.isfinite(done.upper[j] - done.lower[j]):
        return "cannot be told"
    return (f"{done.lower[j]:.5g} to {done.upper[j]:.5g}" + ("" if done.is_told[j] else ", most of its bounds")
            + ("" if done.told.free[j] else ", at its bound"))


def _fitted_scene(done, experiment, directory, n):
    """A scene that runs, with what has been found. A run has no rig: where the fit has one, the title tells them apart."""
    entries = _debond.with_values(experiment.given, done.problem.unknowns.entries(experiment.number, done.values))
    values = _debond.Scene(entries, "fitted.prm", _debond.Team(0)).values
    more = ["Task=simulate", "Output/Directory=" + os.path.join(directory, _numbered("fitted", "", experiment.number, n))]
    if any(experiment.changes(done.values)[1].values()):
        more.append(f"Title={values['Title'] or 'Fit to ' + values['Output / Reference curve']}, without the test machine")
    found = (f"  {name} = {value:.6g} (95 %: {interval_text(done, j)})"
             for j, (name, value) in enumerate(zip(done.names, done.values)))
    comment = [f"Fitted by debond {_debond.version}", *found,
               f"to {experiment.measured.file}" if experiment.is_done else "not measured yet"]
    return "".join(f"# {line}\n" for line in comment) + _debond.text_of(_debond.changed(entries, more))


def save(done, directory):
    """Writes the files of a Fit into a directory, its page too. Raises RunError if that is impossible."""
    directory = os.fspath(directory)
    make_directory(directory)
    problem, n = done.problem, len(done.problem.experiments)
    for experiment, columns in zip(problem.done, done.curves):
        write_whole(os.path.join(directory, _numbered("fit", ".csv", experiment.number, n)),
                    csv_text(columns, zip(*columns.values())))
    rows = ([name, *(f"{value:.4g}" for value in row)] for name, row in zip(done.names, done.told.correlations))
    write_whole(os.path.join(directory, "correlations.csv"), csv_text(["unknown", *done.names], rows))
    for experiment in problem.experiments:
        write_whole(os.path.join(directory, _numbered("fitted", ".prm", experiment.number, n)),
                    _fitted_scene(done, experiment, directory, n))
    if problem.values["Expert / Calibration / Profiles"] == "true":
        rows = ([name, value, chi_squared, *unknowns] for name, profile in done.profiles().items()
                for value, chi_squared, unknowns in zip(*profile.values()))
        write_whole(os.path.join(directory, "profile.csv"), csv_text(["unknown", "value", "chi_squared", *done.names], rows))
    _write_outline(problem, directory, json_of(done))


def lines_of(done):
    """What the console says of a Fit."""
    width = max(map(len, done.names))
    yield f"{'unknown':{width}}  best fit    95 %"
    for j, (name, value) in enumerate(zip(done.names, done.values)):
        yield f"{name:{width}}  {value:<10.6g}  {interval_text(done, j)}"
    for m in done.misfits:
        correlated = f", neighbours correlated by {m.noise.correlation:.3g}" if not m.noise.is_white else ""
        yield (f"{m.name}: e_mp {100 * m.e_mp:.3g} %, e_rel {100 * m.e_rel:.3g} %, residuals {100 * m.rms:.3g} % of the "
               f"largest value; noise {m.noise.name}{correlated}")
    for row in done.taken_as_known[:len(done.errors)]:
        effects = ", ".join(f"{name} by {effect:+.2g} %" for name, effect in row["effect"].items() if effect)
        yield f"{row['entry']}, {row['value']}: changed {row['change']} they would move " + (effects or "nothing")
    if len(done.optima) > 1:
        first, second = done.optima[:2]
        values = ", ".join(f"{name} = {value:.5g}" for name, value in zip(done.names, second.values))
        ratio = math.sqrt(second.cost / max(first.cost, 1e-300))
        yield f"{len(done.optima)} different optima were found; the next one has {ratio:.3g} times the residuals: {values}"
    yield from ("warning: " + text for text in done.warnings)
    runs = done.problem.runs
    if runs.n_failures:
        yield f"{runs.n_failures} curves that were tried could not be computed: the search went around them"
    for number, widths in done.candidates:
        parts = []
        for j, (name, then) in enumerate(zip(done.names, widths)):
            now, value = done.told.half_widths[j], done.values[j] if done.problem.unknowns.list[j].logarithmic else 1
            parts.append(f"unknown for {name}, at its bound" if not done.told.free[j] else
                         f"{then / now:.2g} times as wide for {name}" if math.isfinite(now) else
                         f"+-{then * value:.2g} for {name}" if math.isfinite(then) else f"no better for {name}")
        yield f"Experiment {number + 1}, not done yet, would make the 95 % intervals {', '.join(parts)}"


def _identity(scene, problem):
    """What the results of a calibration belong to."""
    files = (f"# {e.measured.file} {digest_of(e.measured.file)}" for e in problem.done)
    return "\n".join(["# debond " + _debond.version, _debond.text_of(scene._entries), *files, ""])


def why_it_does_not_fit(done) -> str:
    """Text if a Fit is further from what was measured than its scene accepts; else none."""
    problem = done.problem
    largest = float(problem.values["Expert / Calibration / Largest misfit"])
    if not done.e_rel > largest:  # no number if no row is used
        return ""
    curve, doubts = done.optima[0].curve, ""
    for series in problem.series:
        doubt = unit_doubt(series.name, series.column.unit, series.scale, abs(curve[series.slice]).max(), "fit", 2)
        doubts += doubt and "; " + doubt
    return (f"no parameters of this scene fit the measured curve: the best ones leave e_rel = {100 * done.e_rel:.3g} %, more "
            f"than Expert / Calibration / Largest misfit, {100 * largest:.3g} %" + doubts
            + ("; a minus before their unit in Reference columns turns values of the opposite sign" if problem.measured @ curve < 0 else ""))


def calibrate(scene, threads: int = 1, force: bool = False, *, executor=None, say=lambda text: None) -> Dict[str, Any]:
    """Finds the unknowns <<...>> of a scene with `Task = calibrate` from measured curves, writes into its directory as the
    program does, and returns what calibration.json holds. One that was interrupted goes on. executor: as of fit(). Raises
    SceneError, or RunError if nothing fits."""
    check_workers(executor, threads, "threads", say)
    scene = scene if isinstance(scene, Scene) else Scene(scene)
    problem = problem_of(scene)
    directory = problem.values["Output / Directory"]
    say = heeding(problem.values["Expert / Output / Console"], say)
    lock = _debond.claim_directory(problem.experiments[0].scene, _identity(scene, problem), force)
    log = os.path.join(directory, "evaluations.jsonl")
    if force:
        pathlib.Path(log).unlink(missing_ok=True)
    for line in dict.fromkeys(warning for experiment in problem.experiments for warning in experiment.scene.warnings):
        say("warning: " + line)
    for experiment in problem.done:
        say(rows_in_words(experiment.measured))
    say(f"{len(problem.measured)} measured values, {len(problem.unknowns.list)} unknowns")
    problem.runs = Runs(executor, threads, log)
    try:
        done = fit_problem(problem, say)
    except RunError as error:
        _write_outline(problem, directory, _outline(problem, failed=str(error)))
        raise
    save(done, directory)
    for line in lines_of(done):
        say(line)
    fitted = _numbered("fitted", ".prm", 0, len(problem.experiments))
    say(f"Results are in {directory}/calibration.json, the fitted scene is {fitted}")
    del lock
    if why := why_it_does_not_fit(done):
        raise RunError(why)
    return json_of(done)


def check_lines(problem):
    """What would be done."""
    for u in problem.unknowns.list:
        by = ", by its logarithm" if u.logarithmic else ""
        yield f"{u.name}: from {u.start:.6g}, between {u.lower:.6g} and {u.upper:.6g}{by}"
    for experiment in problem.experiments:
        measured, over = experiment.measured, experiment.over
        if not experiment.is_done:
            yield "A candidate without a measured curve"
            continue
        ranges = "".join(f"{column.name} from {values.min():.6g} to {values.max():.6g} {column.unit}; "
                         for column, values in zip((over, *experiment.columns), (measured.over, *measured.values.T)))
        why_not = experiment.why_no_closed_form
        yield f"{rows_in_words(measured)}; {ranges}" + (f"no closed form: {why_not}" if why_not else "searched with the closed form first")
        if over.is_angle and any(column.is_torque and numpy.sum(values) * experiment.last_angle < 0
                                 for column, values in zip(experiment.columns, measured.values.T)):
            yield f"warning: {measured.file}: {_debond.CurveComparison.opposite_sign}"
    for line in dict.fromkeys(text for e in problem.experiments for text in (*e.scene.warnings, *e.remarks)):
        yield "warning: " + line


def main(scene, options):
    """The command."""
    scene = Scene(scene)
    scene._entries = _debond.changed(scene._entries, options["--set"], "--set")
    if options["--check"]:
        for line in check_lines(problem_of(scene)):
            say(line)
    else:
        calibrate(scene, options["--threads"], options["--force"], say=say)
