"""What a fit makes small: the differences between measured curves and those that a scene predicts, over their noise.

Least squares divides by the noise that was stated, or by the largest value of each curve. Its place does not depend on how far
the noise hangs together; intervals do (noise.py). Runs are made by an executor of concurrent.futures, whichever it is.
"""

import functools
import hashlib
import json
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy
from scipy import optimize
from scipy.stats import qmc

from .errors import RunError, SceneError
from .measurement import stated_noise
from .experiment import Experiment, run_task
from .files import run_in

SMOOTH = 1e-3  # below this difference magnitudes are smoothed, for the measures e_mp and e_rel


class Runs:
    """Runs of scenes that are remembered, in a file too if one is given: a fit that was interrupted goes on from there, with
    the same digits."""

    def __init__(self, executor=None, threads=1, filename=None):
        self.executor, self.threads, self.filename = executor, threads, filename
        self.known, self.n_failures, self.last_failure, self.n_runs = {}, 0, "", 0
        if filename and os.path.exists(filename):
            with open(filename, encoding="utf-8") as file:
                text = file.read()
            whole = text[:text.rfind("\n") + 1]  # the last line of a fit that was killed may not be whole
            for line in whole.splitlines():
                one = json.loads(line)
                rows = one["rows"]
                self.known[one["key"]] = rows if isinstance(rows, str) else {name: numpy.array(v) for name, v in rows.items()}
            os.truncate(filename, len(whole.encode()))

    @staticmethod
    def key(task):
        return hashlib.sha256(repr(task).encode()).hexdigest()

    def rows(self, tasks):
        """Of each task its rows, or text: why there are none. Tasks that are new run at the same time."""
        keys = [self.key(task) for task in tasks]
        new = {key: task for key, task in zip(keys, tasks) if key not in self.known}
        is_alone = len(new) < 2 or (self.executor is None and self.threads == 1)
        for key, rows in zip(new, map(run_task, new.values()) if is_alone else self._run_elsewhere(new.values())):
            self._remember(key, rows)
        return [self.known[key] for key in keys]

    def _run_elsewhere(self, tasks):
        self.executor = self.executor or ThreadPoolExecutor(self.threads)
        try:
            yield from self.executor.map(functools.partial(run_in, os.getcwd(), run_task), tasks)
        except Exception as error:  # a worker that has died, say: the runs before are remembered
            raise RunError(f"the executor failed: {type(error).__name__}: {error}") from error

    def _remember(self, key, rows):
        self.n_runs += 1
        if isinstance(rows, str):
            self.n_failures += 1
            self.last_failure = rows
        self.known[key] = rows
        if self.filename:
            with open(self.filename, "a", encoding="utf-8") as file:
                lists = rows if isinstance(rows, str) else {name: values.tolist() for name, values in rows.items()}
                file.write(json.dumps({"key": key, "rows": lists}) + "\n")


@dataclass
class Series:
    """A measured curve among all that is fitted."""

    name: str
    experiment: Experiment
    column: object
    slice: slice  # of all values
    scale: float  # largest magnitude


@dataclass
class Optimum:
    values: numpy.ndarray
    cost: float = numpy.inf  # half the sum of squares, or what the measure makes of it
    converged: bool = False
    why: str = ""  # there is none
    curve: numpy.ndarray = None
    derivatives: numpy.ndarray = None  # of runs: taken close by
    steps: dict = None  # of runs


class Problem:
    """All experiments of a scene with unknowns, those that have been done as one vector of N values."""

    def __init__(self, unknowns, experiments, runs):
        self.unknowns, self.experiments, self.runs = unknowns, experiments, runs
        self.done = [experiment for experiment in experiments if experiment.is_done]
        self.values = experiments[0].values
        self.measure = self.values["Expert / Calibration / Measure"]
        self.steps, self.halvings = {id(experiment): () for experiment in experiments}, 0  # of steps that are chosen
        self.series, first = [], 0
        for experiment in self.done:
            n = len(experiment.measured.over)
            for c, column in enumerate(experiment.columns):
                which = f" (experiment {experiment.number + 1})" if len(experiments) > 1 else ""
                self.series.append(Series(column.name + which, experiment, column, slice(first, first + n), experiment.measured.scale[c]))
                first += n
        self.measured = numpy.concatenate([numpy.zeros(0), *(e.measured.values.T.ravel() for e in self.done)])
        self.noise_is_known = bool(self.done) and self.done[0].measured.sd is not None
        self._check_noise()
        sd = [e.measured.sd.T.ravel() if self.noise_is_known else numpy.repeat(e.measured.scale, len(e.measured.over)) for e in self.done]
        self.weights = 1 / numpy.concatenate([numpy.ones(0), *sd])
        self.weights_of_measure = self._weights_of_measure()
        self.why_no_closed_form = next((e.why_no_closed_form for e in self.done if e.why_no_closed_form), "")

    def _check_noise(self):
        for experiment in self.experiments:
            stated = experiment.measured.sd is not None if experiment.is_done else stated_noise(experiment.values)[0] > 0
            if self.done and stated != self.noise_is_known:
                experiment.scene.refuse("Calibration / Noise", "either all curves of all experiments have a known noise, or none: auto; "
                                                               "tests that have not been done need it here")

    def _weights_of_measure(self):
        """Eq. (19) divides by what has been measured, and leaves out what is less than a hundredth of the largest; Eq. (50)
        divides by the largest."""
        if self.measure != "e_mp":
            return self.weights
        result = numpy.zeros(len(self.measured))
        for series in self.series:
            values = abs(self.measured[series.slice])
            result[series.slice] = numpy.where(values > 0.01 * series.scale, 1 / numpy.maximum(values, 1e-300), 0)
        return result

    def choose_steps(self, values):
        """From now on runs with adaptive steps take those that are right for these unknowns, so that curves change smoothly
        with the unknowns. Raises RunError."""
        for experiment in self.experiments:
            if experiment.is_finite_elements:
                changes, _ = experiment.changes(values)
                steps = experiment.curve.steps_of(list(changes))
                for _ in range(self.halvings):
                    steps = experiment.halved(steps)
                self.steps[id(experiment)] = steps

    def settle(self, values):
        for experiment in self.done:
            experiment.settle(values)

    def settle_at_best(self, values):
        """The same where the search by runs has ended. If there is no closed form there, runs take its place from now on."""
        try:
            self.settle(values)
            self.derivatives(values, True)
            self._end(values, True, True)
        except RunError as error:
            self.why_no_closed_form = str(error)

    def curves(self, places, closed):
        """The predicted values (N) at each of several places, None where there are none."""
        if closed:
            return [self._joined(lambda e: e.by_closed_form(values)) for values in places]
        tasks = [self._of_done(lambda e: e.task(values, self.steps[id(e)])) for values in places]
        rows = iter(self.runs.rows([task for group in tasks if group for task in group]))
        return [group and self._seen(values, [next(rows) for _ in group]) for values, group in zip(places, tasks)]

    def finer_curve(self, values):
        """The predicted values (N) of runs with steps half as wide; None for closed forms. Raises RunError."""
        if not any(e.is_finite_elements for e in self.done):
            return None
        tasks = [e.task(values, e.halved(self.steps[id(e)]) if e.is_finite_elements else ()) for e in self.done]
        return self._seen(values, self.runs.rows(tasks))

    def _of_done(self, function):
        """What a function makes of each experiment that has been done; None if it fails with one."""
        try:
            return [function(experiment) for experiment in self.done]
        except (SceneError, RunError) as error:
            self.runs.n_failures += 1
            self.runs.last_failure = str(error)

    def _joined(self, function):
        curves = self._of_done(function)
        return None if curves is None else numpy.concatenate(curves)

    def _seen(self, values, rows):
        if any(isinstance(one, str) for one in rows):
            return None
        rows = iter(rows)
        return self._joined(lambda e: e.seen(next(rows), e.changes(values)[1]))

    def ends(self, values, j, closed, share=0):
        """Where differences by the unknown `j` are taken: to both sides, by this share of its value if there is one, but not over
        its bounds. The rig enters without the rounding of iterations."""
        unknown = self.unknowns.list[j]
        is_exact = closed or not any(experiment.changes_model[j] for experiment in self.done)
        h = (share or (1e-5 if is_exact else 1e-3)) * max(abs(values[j]), 1e-2 * (unknown.upper - unknown.lower))
        ends = [values.copy(), values.copy()]
        ends[0][j], ends[1][j] = max(values[j] - h, unknown.lower), min(values[j] + h, unknown.upper)
        return ends

    def derivatives(self, values, closed, free=None, share=0):
        """Of the predicted values by what is searched (N x k), by central differences, see ends(), at the edge of what can be
        computed by those to one side. Raises RunError."""
        free = range(len(values)) if free is None else free
        places = [end for j in free for end in self.ends(values, j, closed, share)]
        curves = self.curves(places, closed)
        if any(curve is None for curve in curves):
            middle = self.curves([values], closed)[0]
            places, curves = zip(*((values, middle) if curve is None else (place, curve) for place, curve in zip(places, curves)))
        result = numpy.empty((len(self.measured), len(free)))
        for i, j in enumerate(free):
            width = places[2 * i + 1][j] - places[2 * i][j]
            if width == 0 or curves[2 * i] is None or curves[2 * i + 1] is None:
                raise RunError(self.runs.last_failure)
            per_search = values[j] if self.unknowns.list[j].logarithmic else 1
            result[:, i] = (curves[2 * i + 1] - curves[2 * i]) / width * per_search
        return result

    def residuals(self, curve):
        """Over the weights of the measure (N)."""
        return self.weights_of_measure * (curve - self.measured)

    def cost(self, curve):
        r = self.residuals(curve)
        return 0.5 * r @ r if self.measure == "least squares" else numpy.sum(numpy.hypot(r, SMOOTH) - SMOOTH)

    def moved(self, end, change):
        """Where an Optimum goes, to first order, if predicted values change by this (N)."""
        if end.derivatives is None:
            return end.values
        unknowns, weights = self.unknowns, self.weights_of_measure
        step = numpy.linalg.lstsq(weights[:, None] * end.derivatives, -weights * change, rcond=1e-7)[0]
        return unknowns.from_search(numpy.clip(unknowns.to_search(end.values) + step, unknowns.to_search(unknowns.lower),
                                               unknowns.to_search(unknowns.upper)))

    def minimise(self, start, closed, free=None, near=None):
        """From these values on to the end, by SciPy's trust region within the bounds. `free`: indices of the unknowns that are
        searched; all of them if it is not given. `near`: an Optimum close by, whose derivatives do if the end is no further from it
        than the noise moves it. What fails makes steps smaller. Derivatives of runs are dear: those of the closed form lead close to
        the end, differences of runs to the end itself, taken again until it stays within a tenth of what the noise moves it by."""
        free = numpy.arange(len(start)) if free is None else numpy.asarray(free)
        try:
            if len(free) == 0:
                return self._end(start, True, closed)
            if closed:
                values, converged = self._search(start, True, free, lambda at: self.derivatives(at, True, free), 150)
                return self._at_bounds(values, converged, True, free)
            return self._minimise_by_runs(start, free, near)
        except RunError as error:
            return Optimum(start, why=str(error))

    def _minimise_by_runs(self, start, free, near, rounds=12):
        values, place, J, share = start, None, None, 1e-2
        if near is not None and near.derivatives is not None:
            place, J, share = near.values, near.derivatives[:, free], 1
        elif not self.why_no_closed_form:
            try:
                self.settle(start)
                values, _ = self._search(start, False, free, lambda at: self.derivatives(at, True, free), 8)
            except RunError:  # of the closed form, which only leads; runs say below what they cannot do
                pass
        for _ in range(rounds):
            if J is None:
                place, J = values, self.derivatives(values, False, free)
            values, _ = self._search(values, False, free, lambda at: J, 8)
            moved = self.weights_of_measure * (J @ (self.unknowns.to_search(values) - self.unknowns.to_search(place))[free])
            end = self._at_bounds(values, True, False, free)
            noise = self.residuals(end.curve)
            if moved @ moved <= share * (noise @ noise) / max(1, len(noise) - len(free)) + 1e-12 * len(noise):
                end.steps = dict(self.steps)
                if len(free) == len(start):
                    end.derivatives = J
                return end
            J, share = None, 1e-2
        end.converged = False
        return end

    def _search(self, start, closed, free, derivatives, n_evaluations):
        """Values, and whether the trust region has converged. `derivatives`: a function of the values. Raises RunError."""
        unknowns = self.unknowns

        def at(searched):
            result = start.copy()
            all_searched = unknowns.to_search(start)
            all_searched[free] = searched
            result[free] = unknowns.from_search(all_searched)[free]
            return result

        def difference(searched):
            curve = self.curves([at(searched)], closed)[0]
            return numpy.full(len(self.measured), numpy.nan) if curve is None else self.residuals(curve)

        def slopes(searched):
            return self.weights_of_measure[:, None] * derivatives(at(searched))

        lower, upper = unknowns.to_search(unknowns.lower)[free], unknowns.to_search(unknowns.upper)[free]
        squares = self.measure == "least squares"
        try:
            end = optimize.least_squares(difference, numpy.clip(unknowns.to_search(start)[free], lower, upper), slopes, (lower, upper),
                                         x_scale="jac", loss="linear" if squares else "soft_l1", f_scale=SMOOTH, gtol=None,
                                         ftol=1e-12 if closed else 1e-3 / len(self.measured) if squares else 1e-4, xtol=1e-8 if closed else 1e-5,
                                         max_nfev=n_evaluations)
        except ValueError as error:  # there is no curve where it begins
            raise RunError(self.runs.last_failure or str(error)) from None
        return at(end.x), end.status > 0

    def _at_bounds(self, values, converged, closed, free):
        """The end of a search, which keeps a little off the bounds: there, if that is no worse."""
        unknowns = self.unknowns
        lower, upper, searched = (unknowns.to_search(v) for v in (unknowns.lower, unknowns.upper, values))
        near, moved = 1e-4 * (upper - lower), values.copy()
        moved[free] = numpy.select([searched - lower < near, upper - searched < near], [unknowns.lower, unknowns.upper], values)[free]
        inside = self._end(values, converged, closed)
        if (moved == values).all():
            return inside
        best = self._end(moved, converged, closed)
        return best if best.cost <= inside.cost else inside

    def _end(self, values, converged, closed):
        curve = self.curves([values], closed)[0]
        if curve is None:
            raise RunError(self.runs.last_failure)
        return Optimum(values, self.cost(curve), converged, "", curve)

    def starts(self, n):
        """That of the scene, and others spread evenly between the bounds, always the same."""
        unknowns = self.unknowns
        lower, upper = unknowns.to_search(unknowns.lower), unknowns.to_search(unknowns.upper)
        with numpy.errstate(all="ignore"):
            shares = qmc.Sobol(len(lower), scramble=False).random_base2(int(numpy.ceil(numpy.log2(n + 1))))[1:n]
        return [unknowns.starts, *(unknowns.from_search(lower + share * (upper - lower)) for share in shares)]

    def distinct(self, ends):
        """Those that end at the same curve are one; best first, and of those that differ by rounding the one closest to where
        the scene starts: of unknowns that the curves do not tell apart, any values would do."""
        start, result = self.unknowns.to_search(self.unknowns.starts), []

        def rank(end):
            return float(f"{end.cost:.9g}"), numpy.linalg.norm(self.unknowns.to_search(end.values) - start)

        for end in sorted((end for end in ends if not end.why), key=rank):
            apart = [end.curve - other.curve for other in result]
            if all(numpy.linalg.norm(self.weights * d) >= 0.2 * numpy.sqrt(2 * end.cost)
                   and numpy.linalg.norm(d) >= 1e-4 * numpy.linalg.norm(end.curve) for d in apart):
                result.append(end)
        return result
