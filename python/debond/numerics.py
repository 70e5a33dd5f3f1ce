"""Cells and steps of a fit by finite elements: by how much finer ones would move the answer, and a fit with these where that is too
much for its intervals.

Curves of finer cells and steps are made with the values that were found; what they differ by moves the unknowns as any other
change does. Cells are finer as in a single run whose error is above its Accuracy: half as many again in each direction."""

import math
import time
from dataclasses import dataclass

import numpy

from .errors import RunError, SceneError

LARGEST = 1 / 6  # half widths of an interval by which finer ones may move an unknown; their own error is no larger, but for slow convergence
LEAST = 1e-3  # of an unknown: no interval counts as narrower, as those of exact data would
ROUNDS = 6
RUNS = 30  # that a fit takes, roughly


@dataclass(eq=False)
class Error:
    """What finer cells or steps would change."""

    entry: str
    value: str  # what it is
    change: str  # in words
    of_curve: numpy.ndarray  # change of predicted values (N)
    half_widths: float  # of its interval, by which it moves the unknown that it moves most
    unknown: str  # name of that


def _error(fit, entry, value, change, finer):
    of_curve = finer - fit.optima[0].curve
    shift = abs(fit.shift(of_curve, LEAST))
    return Error(entry, value, change, of_curve, shift.max(), fit.names[shift.argmax()])


def _chosen(scene):
    """{entry: text} of all that Accuracy has chosen for a scene."""
    names, values = scene.parameters.partition("# chosen by Accuracy: ")[2].partition("\n")[0].split("; "), scene.values
    return {name: values[name] for name in names if name}


def _of_bodies(scenes):
    """The same of cells, elements and materials alone, by the number of the experiment."""
    return {number: {name: text for name, text in _chosen(scene).items() if name.startswith(("Bone /", "Implant /"))}
            for number, scene in scenes.items()}


def _are_open(scene):
    """Whether steps are left to Accuracy."""
    return "Load steps / " + ("Tolerance" if scene.values["Load steps / Adaptive"] == "true" else "Steps") in _chosen(scene)


def _finer(scene):
    """None if cells are not left to Accuracy, or carry a bond each, which others would not have."""
    bond = "Interface / Bonding / "
    pattern, length = (scene.values[bond + name] for name in ("Pattern", "Correlation length"))
    return None if pattern == "file" or (pattern == "random" and float(length) == 0) else scene.finer


def _in_words(scenes):
    cells = (" and ".join(scene.values[body + " / Cells"] for body in ("Bone", "Implant")) for scene in scenes.values())
    return "; ".join(dict.fromkeys(cells))


def _error_of_cells(fit, meshes, finer):
    """None if a curve cannot be computed."""
    problem = fit.problem
    others = [e.changed(_of_bodies(finer)[e.number]) for e in problem.done]
    rows = problem.runs.rows([other.task(fit.values, problem.steps[id(e)]) for e, other in zip(problem.done, others)])
    if any(isinstance(one, str) for one in rows):
        return None
    curve = numpy.concatenate([other.seen(one, other.changes(fit.values)[1]) for other, one in zip(others, rows)])
    return _error(fit, "Cells", _in_words(meshes), "to " + _in_words(finer), curve)


def _error_of_steps(fit):
    try:
        curve = fit.problem.finer_curve(fit.values)
    except RunError:
        curve = None
    n = sum(map(len, fit.problem.steps[id(fit.problem.done[0])]))
    return None if curve is None else _error(fit, "Steps", str(n or fit.problem.values["Load steps / Steps"]), "to twice as many", curve)


def _why_not(fit, meshes, finer, n_runs):
    """What forbids so many runs with finer cells; empty: nothing."""
    if not all(finer.values()):
        return "the scene sets them"
    values, n = fit.problem.values, max(scene.n_unknowns for scene in finer.values())
    growth = max((scene.n_unknowns / max(1, mesh.n_unknowns))**1.5 for scene, mesh in zip(finer.values(), meshes.values()))
    minutes = growth * (time.time() - fit.clock) / 60
    beyond = [name for name, one in (("Largest number of unknowns", n), ("Largest minutes", minutes * n_runs / RUNS))
              if one > float(values["Expert / " + name])]
    return f"a fit with {_in_words(finer)} cells, {n:.6g} unknowns, some {minutes:.2g} minutes, is beyond Expert / {beyond[0]}" if beyond else ""


def refined(fit, say=lambda text: None):
    """The fit, or one with finer cells and steps, as far as its scene leaves them open, until the error of neither moves an unknown
    by more than a third of the half width of its interval. Its `errors` are those that are left."""
    done = fit.problem.done
    if fit.closed or not all(experiment.is_finite_elements for experiment in done):
        return fit
    meshes, cells = {experiment.number: experiment.scene_of(fit.values) for experiment in done}, None
    steps_are_open = all(map(_are_open, meshes.values()))
    try:
        # with the values that were found others may be chosen than with those of the start
        if any(e.values[name] != text for e in done for name, text in _of_bodies(meshes)[e.number].items()):
            fit = fit.again(_of_bodies(meshes), 0)
        for _ in range(ROUNDS):
            finer, steps = {number: _finer(mesh) for number, mesh in meshes.items()}, _error_of_steps(fit)
            cells = None if _why_not(fit, meshes, finer, 1) else _error_of_cells(fit, meshes, finer)
            fit.errors, why_not = [error for error in (cells, steps) if error], _why_not(fit, meshes, finer, RUNS)
            taken = [error for error, is_open in ((cells, not why_not), (steps, steps_are_open))
                     if error and error.half_widths > LARGEST and is_open]
            if not taken:
                break
            for one in taken:
                say(f"{one.entry} changed {one.change} move {one.unknown} by {one.half_widths:.2g} half widths of its interval: "
                    "the fit goes on with them")
            meshes = finer if cells in taken else meshes
            halvings = math.ceil(math.log(steps.half_widths / LARGEST, 3)) if steps in taken else 0  # of nearly second order
            fit = fit.again(_of_bodies(meshes), sum(error.of_curve for error in taken), halvings)
    except (RunError, SceneError) as error:
        fit.warnings.append(f"finer cells or steps failed: {error}")
    else:
        if cells and cells.half_widths > LARGEST:
            fit.warnings.append(f"cells are too coarse for this fit: changed {cells.change} they move {cells.unknown} by "
                                f"{cells.half_widths:.2g} half widths of its interval, and {why_not or 'are too coarse still'}")
        elif not cells and all(finer.values()):
            fit.warnings.append("what finer cells would change is not known: " + (why_not or fit.problem.runs.last_failure))
    return fit
