"""Numbers of a scene from measured curves: how well the curves tell them, and which test would tell them better.

    import debond
    fit = debond.fit("prm/calibrate/data_set_1.prm")
    fit.table()              # values with 95 % intervals
    fit.curves[0]            # measured and fitted values with their band
    fit.warnings
    fit.save("output/fit")   # calibration.json, fit.csv, fitted.prm, report.html ...
"""

import dataclasses
import functools
import time
from dataclasses import dataclass
from typing import Dict, List

import numpy
from scipy import stats

import _debond

from . import intervals, known, noise, numerics
from .errors import RunError, path_of
from .executors import check_workers
from .experiment import Experiment
from .measurement import stated_noise
from .problem import Optimum, Problem, Runs
from .scene import Scene
from .unknowns import Unknowns
from .variants import variants_of

FOLLOWED, FOLLOWED_SLOWLY = 5, 2  # of the starts: runs take longer than closed forms
CORRELATED = 0.99  # unknowns: more is said
FEWEST_ROWS = 20  # independent ones: with fewer a misfit looks like noise
UNLIKELY = 1e-6  # of noise.lack_of_fit(): then noise is no explanation
LOCAL, FAR = 0.02, 7  # of the largest value, and of the standard deviation of noise: three rows in turn are never so far off


def problem_of(scene, runs=None):
    """The Problem of a scene with unknowns. Raises SceneError."""
    scene = scene if isinstance(scene, Scene) else Scene(scene)
    entries = scene._entries
    if not any(entry.name == "Task" and entry.value == "calibrate" for entry in entries):
        entries = _debond.changed(entries, ["Task=calibrate"])
    variants = variants_of(entries)
    for entry in entries:
        if entry.name == "Output / Directory" and "{{" in entry.value:
            entry.refuse("a calibration has one directory: expected one value")
    unknowns = Unknowns(variants)
    problem = Problem(unknowns, [Experiment(unknowns, i, own.entries, scene._name) for i, own in enumerate(variants)], runs or Runs())
    _check(problem)
    return problem


def _check(problem):
    """Refuses what could not be searched for."""
    refuse = problem.experiments[0].scene.refuse
    n, k = len(problem.measured), len(problem.unknowns.list)
    if k == 0:
        refuse("Task", "a calibration needs unknowns: write <<START in LOWER..UPPER>> in the place of numbers that are to be found")
    if n == 0:
        refuse("Output / Reference curve", "a calibration needs a measured curve")
    if not problem.noise_is_known and n <= k:
        refuse("Output / Reference curve", f"{n} measured values for {k} unknowns do not tell how well they fit: give more, or "
                                           "Calibration / Noise")
    if problem.values["Expert / Calibration / Profiles"] == "true" and problem.measure != "least squares":
        refuse("Expert / Calibration / Profiles", "profiles are those of Expert / Calibration / Measure = least squares")
    for experiment in problem.experiments:
        experiment.check_bounds()


def _from_starts(problem, n_starts, n_best, closed):
    """The best starts, followed to their ends."""
    starts = problem.starts(n_starts)
    costs = [numpy.inf if curve is None else problem.cost(curve) for curve in problem.curves(starts, closed)]
    best = [starts[i] for i in numpy.argsort(costs, kind="stable")[:n_best] if numpy.isfinite(costs[i])]
    return _follow(problem, best, closed)


def _follow(problem, starts, closed):
    return problem.distinct([_end_from(problem, start, closed) for start in starts])


def _end_from(problem, first, closed, near=None):
    """The closed form has the stiffness of the place that it was made exact at, runs the steps that are right where they were
    chosen: from there on to the end, and again from that until it stays."""
    start, place, end, searched = first, problem.unknowns.starts if closed else first, None, problem.unknowns.to_search
    for _ in range(7 if closed else 2):
        try:
            (problem.settle if closed else problem.choose_steps)(place)
        except RunError as error:
            return end or Optimum(first, why=str(error))
        before, end = end, problem.minimise(start, closed, near=end or near)
        if end.why and before:  # of the closed form the edge of what can be computed has moved over it
            return problem.minimise(first, True) if closed else before
        moved = abs(searched(end.values) - searched(start)) / intervals.sizes_of(problem.unknowns, start)
        if end.why or moved.max() < (1e-8 if closed else 0.2) or not (closed or any(problem.steps.values())):
            break
        start = place = end.values
    return end


def find_optima(problem, say=lambda text: None):
    """Optima with different curves, best first, and whether the closed form has found them. Searches with the closed form where
    there is one, and from there with the scene's own model; with that alone where the closed form says no to all starts."""
    clock, model = time.time(), problem.values["Model"]
    n_starts = int(problem.values["Expert / Calibration / Starts"])
    closed = not problem.why_no_closed_form
    optima = _from_starts(problem, n_starts, FOLLOWED, True) if closed else []
    by_closed_form = model == "foundation" and closed
    if closed and not by_closed_form:
        say(f"Closed form: {len(optima)} optim{'um' if len(optima) == 1 else 'a'}, after {time.time() - clock:.2g} s")
    if optima and not by_closed_form:
        good = [one.values for one in optima if one.cost <= 4 * optima[0].cost + 1e-12][:FOLLOWED_SLOWLY]
        optima = _follow(problem, good, False)
    elif not by_closed_form:
        optima = _from_starts(problem, n_starts, FOLLOWED_SLOWLY if model == "finite elements" else FOLLOWED, False)
    if not optima:
        raise RunError("nothing was found: no unknowns that were tried give a curve. The last reason: " + problem.runs.last_failure)
    return optima, by_closed_form


@dataclass
class Misfit:
    """How far a curve is from its fit."""

    name: str
    e_mp: float  # Eq. (19)
    e_rel: float  # Eq. (50)
    rms: float  # root mean square of the residuals over the largest value
    noise: noise.Noise  # of residuals over their weights
    effective_rows: float  # independent values that tell as much of a mean
    noise_over_largest: float
    F: float  # of noise.lack_of_fit()
    chance: float  # of so large an F if the model is right
    smooth: float  # root mean square, over the largest value, of what does not change from row to row of the residuals
    local: float  # by how much three neighbouring rows err alike at least, over the largest value, where that is most
    local_over_noise: float  # the same over the noise

    @property
    def does_not_fit(self):
        return (self.chance < UNLIKELY and self.smooth > 1e-5) or self.is_off_somewhere

    @property
    def is_off_somewhere(self):
        """Whether a part of the curve is missed, as a rise is by a fit that the many rows of a plateau decide."""
        return self.local > LOCAL and self.local_over_noise > FAR

    @property
    def is_ambiguous(self):
        """Whether what is left hangs together over so much of the curve that noise and a wrong model cannot be told apart."""
        hangs_together = self.effective_rows < FEWEST_ROWS or self.noise_over_largest > 2 * self.rms
        return not self.does_not_fit and hangs_together and not self.noise.is_white and self.smooth > 1e-5


def fit(scene, *, executor=None, threads: int = 1, evaluations: str = None, say=lambda text: None) -> "Fit":
    """Finds the unknowns <<...>> of a scene from its measured curves: those of its `Output / Reference curve`, of each variant
    if entries hold several values. Cells and steps that these leave to Accuracy become finer where they move the answer too far
    (numerics.py).

    scene: a Scene or the name of a file. executor: of concurrent.futures, which makes the runs: processes here, or those of
    mpi4py.futures or Dask. threads: without an executor. evaluations: a file that keeps the runs, so that a fit that was
    interrupted goes on. say: a function that is told what is going on. Raises SceneError, or RunError if nothing fits."""
    check_workers(executor, threads, "threads", say)
    return fit_problem(problem_of(scene, Runs(executor, threads, evaluations and path_of(evaluations, "evaluations"))), say)


def fit_problem(problem, say=lambda text: None) -> "Fit":
    """The same of what has been read."""
    clock = time.time()
    return numerics.refined(Fit(problem, *find_optima(problem, say), clock), say)


class Fit:
    """A fit that is done. `values`, `lower`, `upper`: of the unknowns `names`, in the units of their entries; an end that is
    infinite cannot be told. `errors`: what finer cells and steps would change."""

    def __init__(self, problem, optima, closed, clock):
        self.problem, self.optima, self.closed, self.clock = problem, optima, closed, clock
        self.errors: List[numerics.Error] = []  # of cells and steps that are known
        self.warnings: List[str] = list(dict.fromkeys(text for experiment in problem.experiments for text in experiment.remarks))
        best = optima[0]
        if closed:
            problem.settle(best.values)
        elif not problem.why_no_closed_form:
            problem.settle_at_best(best.values)
        problem.steps = best.steps or problem.steps
        try:
            if best.derivatives is None:
                best.derivatives = problem.derivatives(best.values, closed)
        except RunError as error:
            raise RunError(f"the best fit cannot be differentiated: {error}") from None
        self._best, self._derivatives = best, problem.weights[:, None] * best.derivatives
        self.told = intervals.tell(problem, best, self._derivatives)
        self.misfits = [self._misfit(series, own) for series, own in zip(problem.series, self.told.noises)]
        self._find_intervals()
        self._warn()
        self.candidates = self._judge_candidates()
        self.seconds = time.time() - clock

    def again(self, entries, change, halvings=0):
        """The same fit with other entries of experiments, {number: {entry: text}}, and halved steps, from where curves that `change` (N)
        would move it. Raises RunError."""
        before = self.problem
        problem = Problem(before.unknowns, [e.changed(entries.get(e.number, {})) for e in before.experiments], before.runs)
        problem.halvings = before.halvings + halvings
        starts = [dataclasses.replace(one, values=before.moved(one, change)) for one in self.optima]
        optima = problem.distinct([_end_from(problem, one.values, False, one) for one in starts])
        if not optima:
            raise RunError(problem.runs.last_failure)
        return Fit(problem, optima, False, self.clock)

    @functools.cached_property
    def taken_as_known(self):
        """What the fit has not looked for, and what it would do to the answer if it were wrong: see known.table_of()."""
        return known.table_of(self)

    names = property(lambda self: self.problem.unknowns.names)
    values = property(lambda self: self._best.values)

    def _find_intervals(self):
        problem, told = self.problem, self.told
        if problem.measure == "least squares":
            cheap = self.closed or not problem.why_no_closed_form
            nearby = intervals.nearby_curves(problem, self._best, self.closed)
            for j in intervals.profile_ends(problem, told, nearby, self._best, 400 if cheap else 12):
                self.warnings.append(f"{self.names[j]}: an end of its interval was not found along the curve, and is that of a linear "
                                     "one")
        self.lower, self.upper = (problem.unknowns.values_of(end) for end in (told.lower, told.upper))
        span = problem.unknowns.to_search(problem.unknowns.upper) - problem.unknowns.to_search(problem.unknowns.lower)
        self.is_told = numpy.isfinite(told.half_widths) & (told.upper - told.lower < 0.9 * span)

    def _misfit(self, series, own):
        measured, curve = self.problem.measured[series.slice], self._best.curve[series.slice]
        difference = curve - measured
        sd = numpy.inf if series.experiment.measured.sd is None else 1 / self.problem.weights[series.slice]
        used = numpy.broadcast_to((sd <= series.scale) | numpy.isinf(sd), measured.shape)
        n, rms = used.sum(), numpy.sqrt(numpy.mean(difference**2)) / series.scale
        # row by row: whatever a curve is drawn over, it is compared as one that turns on
        row = numpy.arange(n + 1)
        compared = _debond.CurveComparison([row, numpy.r_[0, curve[used]]], [row[1:], measured[used]])
        F, chance = noise.lack_of_fit(difference / series.scale, self.told.derivatives[series.slice], series.experiment.measured.parts)
        to_scale = numpy.median(1 / self.problem.weights[series.slice]) / series.scale
        alike = numpy.lib.stride_tricks.sliding_window_view(difference, min(3, len(difference)))
        local = numpy.where(abs(numpy.sign(alike).sum(axis=1)) == alike.shape[1], abs(alike).min(axis=1), 0).max() / series.scale
        robust = numpy.median(abs(difference)) / stats.norm.isf(0.25) / series.scale  # rows that are far off do not count
        smooth = numpy.sqrt(max(0, rms**2 - own.spectrum.min() * to_scale**2))
        return Misfit(series.name, compared.e_mp, compared.e_rel, rms, own, len(measured) / own.rows_per_value,
                      own.sd * to_scale, F, chance, smooth, local, local / max(robust, 1e-6))

    @property
    def e_rel(self):
        """Eq. (50), the largest of all curves."""
        return max(misfit.e_rel for misfit in self.misfits)

    def _warn(self):
        problem = self.problem
        if not self._best.converged:
            self.warnings.append("the search has not converged: it ended after as many steps as it may take, or where none helped")
        for j, unknown in enumerate(problem.unknowns.list):
            if not self.told.free[j] and self.is_told[j]:
                self.warnings.append(f"{unknown.name} ends at one of its bounds: the best value may lie beyond")
            elif self.is_told[j]:
                ends = [bound for end, bound in ((self.lower[j], unknown.lower), (self.upper[j], unknown.upper))
                        if bound != 0 and numpy.isclose(end, bound, 1e-6, 0)]
                if ends:
                    self.warnings.append(f"the 95 % interval of {unknown.name} ends at a bound of its search, {ends[0]:.5g}: that end is "
                                         "no result")
        self.warnings += [intervals.text_of(direction, problem.unknowns) for direction in self.told.directions]
        named = " ".join(self.warnings)
        self.warnings += [f"the curves do not tell {name}: its interval is most of what is between its bounds"
                          for name, told in zip(self.names, self.is_told) if not told and name not in named]
        for misfit in self.misfits:
            if misfit.is_off_somewhere:
                self.warnings.append(f"the model does not fit {misfit.name}: rows in turn are off by {100 * misfit.local:.2g} % of the largest "
                                     f"value, {misfit.local_over_noise:.2g} times what most rows are: see where, in the residuals. The intervals "
                                     "do not hold if the model is wrong")
            elif misfit.does_not_fit:
                self.warnings.append(f"the model does not fit {misfit.name}: beyond the noise the residuals have a smooth part of "
                                     f"{100 * misfit.smooth:.2g} % of the largest value (root mean square). The intervals take it for "
                                     "noise; they do not hold if the model is wrong")
            elif misfit.is_ambiguous:
                self.warnings.append(f"neighbouring residuals of {misfit.name} hang together so far that noise and a model that is "
                                     "wrong cannot be told apart; the intervals may be too narrow")
        self._warn_of_noise()
        self._warn_of_search()

    def shift(self, curve, least=1e-6):
        """By how much the unknowns would change, over the half widths of their intervals, if the curve differed by this (N). Those of
        exact data are of rounding: no half width counts as less than this part of the value."""
        told, result = self.told, numpy.zeros(len(self.values))
        free = numpy.flatnonzero(told.free & numpy.isfinite(told.half_widths))
        widths = numpy.maximum(told.half_widths, least * intervals.sizes_of(self.problem.unknowns, self.values))[free]
        result[free] = numpy.linalg.lstsq(told.derivatives[:, free], self.problem.weights * curve, rcond=1e-7)[0] / widths
        return result

    def _warn_of_search(self):
        problem, told, names = self.problem, self.told, self.names
        if problem.measure == "least squares" and self._best.converged:
            shift = self.shift(problem.measured - self._best.curve)
            for j in numpy.flatnonzero(abs(shift) > 0.5):
                self.warnings.append(f"the search for {names[j]} stalled: the slopes of the curve ask for a step of {abs(shift[j]):.2g} half widths "
                                     "of its interval, along which the curve comes no closer. A curve that jumps does that, as that of a soft "
                                     "machine; try other starts, or Steps or a Tolerance that are finer")
        for i, j in numpy.argwhere(numpy.triu(abs(told.correlations) > CORRELATED, 1)):
            if numpy.isfinite(told.half_widths[[i, j]]).all() and not any(abs(c[[i, j]]).min() > 0.1 for c, _ in told.directions):
                self.warnings.append(f"{names[i]} and {names[j]} have a correlation of {told.correlations[i, j]:.4f}: the curves tell little more "
                                     "than one combination of both; fix one, or add a test that tells them apart")
        try:
            finer = problem.finer_curve(self.values)
        except RunError:
            finer = None
        shift = numpy.zeros(len(names)) if finer is None else self.shift(finer - self._best.curve)
        for j in numpy.flatnonzero(abs(shift) > 0.5):
            self.warnings.append(f"steps of the load are too wide for this fit: with half of them {names[j]} changes by {abs(shift[j]):.2g} half "
                                 "widths of its interval; give more Load steps / Steps, or a smaller Tolerance")
        for experiment in problem.done:
            n, over = experiment.n_beyond, experiment.over
            if n > 0 and not experiment.measured.is_prescribed:
                self.warnings.append(f"{n} of {len(experiment.measured.over)} rows of {experiment.measured.file} are beyond {experiment.ends_at:.4g} "
                                     f"{over.unit}, where the load of the scene is reached, and are compared with a straight line from there: "
                                     "give the load of the test, or leave them out with Calibration / Windows")
            said = (experiment.scene_of(problem.unknowns.starts).warnings, experiment.scene_of(self.values).warnings)
            self.warnings += [f"with the values that were found {text}" for text in said[1] if text not in said[0]]

    def _warn_of_noise(self):
        rms = sorted((misfit.rms, misfit.name) for misfit in self.misfits)
        if not self.problem.noise_is_known and rms[-1][0] > max(3 * rms[0][0], 1e-5):
            self.warnings.append(f"residuals of {rms[-1][1]} are {rms[-1][0] / max(rms[0][0], 1e-6):.2g} times those of {rms[0][1]}, over the "
                                 "largest values: both count alike in the fit; Calibration / Noise for each curve makes it better")
        if self.problem.noise_is_known:
            residuals = self.problem.weights * (self._best.curve - self.problem.measured)
            n = len(residuals) - self.told.free.sum()
            n_independent = n * sum(misfit.effective_rows for misfit in self.misfits) / len(residuals)
            ratio = numpy.sqrt(residuals @ residuals / max(1, n))
            if abs(ratio**2 - 1) > 3.3 * numpy.sqrt(2 / max(1, n_independent)):
                self.warnings.append(f"the residuals are {ratio:.3g} times the noise that Calibration / Noise states: "
                                     + ("the model does not fit, or the noise is more" if ratio > 1 else "the noise is less")
                                     + ", and the intervals are wrong by about that")

    def _judge_candidates(self):
        """By how much experiments that have not been done would shrink the intervals: (number, half widths)."""
        problem, result = self.problem, []
        for experiment in problem.experiments:
            if experiment.is_done:
                continue
            own = Problem(problem.unknowns, [experiment], problem.runs)
            own.done, own.measured = [experiment], numpy.zeros(len(experiment.columns) * len(experiment.measured.over))
            own.steps = problem.steps
            closed = self.closed and not experiment.why_no_closed_form
            if closed:
                experiment.settle(self.values)
            curve = own.curves([self.values], closed)[0]
            if curve is None:
                self.warnings.append(f"experiment {experiment.number + 1}, not done yet, could not be computed: {problem.runs.last_failure}")
                continue
            derivatives = own.derivatives(self.values, closed)
            scales = abs(curve.reshape(len(experiment.columns), -1)).max(axis=1)
            stated = numpy.array(stated_noise(experiment.values))
            sd = numpy.repeat(scales * numpy.where(stated > 0, stated, 1), len(experiment.measured.over))
            result.append((experiment.number, intervals.with_test(problem, self.told, derivatives / sd[:, None])))
        return result

    def table(self):
        """A pandas.DataFrame: a row for each unknown, with value, ends of the 95 % interval, unit, and whether the curves tell
        it."""
        import pandas

        units = [unknown.unit for unknown in self.problem.unknowns.list]
        return pandas.DataFrame({"value": self.values, "lower_95": self.lower, "upper_95": self.upper, "unit": units,
                                 "told": self.is_told}, index=pandas.Index(self.names, name="unknown"))

    @property
    def curves(self) -> List[Dict[str, numpy.ndarray]]:
        """Of each experiment that has been done its columns: what it is drawn over, and of each curve NAME_measured,
        NAME_fitted, NAME_lower_95 and NAME_upper_95, the band that the unknowns leave."""
        problem, result = self.problem, []
        C = self.told.covariance_told
        sd = numpy.sqrt(numpy.maximum(0, numpy.einsum("ij,jk,ik->i", self.told.derivatives, C, self.told.derivatives)))
        band = numpy.median(self.told.quantiles) * sd / problem.weights
        for experiment in problem.done:
            columns = {experiment.over.name: experiment.measured.over}
            for series in problem.series:
                if series.experiment is experiment:
                    name, part = series.column.name, series.slice
                    columns[name + "_measured"], columns[name + "_fitted"] = problem.measured[part], self._best.curve[part]
                    columns[name + "_lower_95"] = self._best.curve[part] - band[part]
                    columns[name + "_upper_95"] = self._best.curve[part] + band[part]
            result.append(columns)
        return result

    def profiles(self, n: int = 11) -> Dict[str, Dict[str, numpy.ndarray]]:
        """Fits in which one unknown is held at `n` values, two interval widths to both sides: {unknown: {"value",
        "chi_squared" (n), "unknowns" (n x k)}}. chi_squared is the growth of the sum of squares, such that it is 3.84 at
        the ends of the 95 % interval if the curve is linear in the unknowns."""
        problem, told, result = self.problem, self.told, {}
        unknowns = problem.unknowns
        at, lower, upper = (unknowns.to_search(v) for v in (self.values, unknowns.lower, unknowns.upper))
        _, finite, _ = intervals.inverse(told.derivatives)
        for j, name in enumerate(self.names):
            if not told.free[j] or not 0 < told.half_widths[j] < numpy.inf:
                continue
            unit = (told.half_widths[j] / 1.96) ** 2 / finite[j, j]
            rows = []
            for place in numpy.linspace(max(lower[j], 2 * told.lower[j] - at[j]), min(upper[j], 2 * told.upper[j] - at[j]), n):
                start = at.copy()
                start[j] = place
                end = problem.minimise(unknowns.from_search(start), self.closed, numpy.delete(numpy.arange(len(at)), j))
                rows.append((end.values[j], 2 * (end.cost - self._best.cost) / unit if end.converged else numpy.nan, end.values))
            result[name] = dict(zip(("value", "chi_squared", "unknowns"), map(numpy.array, zip(*rows))))
        return result

    def bootstrap(self, n: int = 200, seed: int = 1) -> numpy.ndarray:
        """Values of the unknowns (n x k) of fits to the fitted curves with new noise of the kind that was estimated."""
        problem, generator, result = self.problem, numpy.random.default_rng(seed), []
        measured = problem.measured
        try:
            for _ in range(n):
                problem.measured = self._best.curve.copy()
                for series, own in zip(problem.series, self.told.noises):
                    problem.measured[series.slice] += own.draw(generator) / problem.weights[series.slice]
                end = problem.minimise(self.values, self.closed)
                if not end.why:
                    result.append(end.values)
        finally:
            problem.measured = measured
        return numpy.array(result)

    def log_likelihood(self, values) -> float:
        """Of these values of the unknowns, with the noise that was estimated; -inf outside of the bounds: for a posterior."""
        unknowns = self.problem.unknowns
        values = numpy.asarray(values, dtype=float)
        if not ((values >= unknowns.lower) & (values <= unknowns.upper)).all():
            return -numpy.inf
        curve = self.problem.curves([values], self.closed)[0]
        if curve is None:
            return -numpy.inf
        residuals = self.problem.weights * (curve - self.problem.measured)
        whites = [own.whitened(residuals[series.slice][:, None])[0] for series, own in zip(self.problem.series, self.told.noises)]
        return -0.5 * sum(float(numpy.sum(white**2)) for white in whites)

    def posterior(self, steps: int = 1000, walkers: int = 0, seed: int = 1) -> numpy.ndarray:
        """Samples of the unknowns (n x k) by emcee, uniform between the bounds (in the logarithm, with `log`) before; the first
        half of the steps is left out. Raises ImportError without emcee."""
        import emcee

        unknowns, k = self.problem.unknowns, len(self.names)
        walkers = walkers or 2 * k + 2
        generator = numpy.random.default_rng(seed)
        at, lower, upper = (unknowns.to_search(v) for v in (self.values, unknowns.lower, unknowns.upper))
        width = numpy.minimum(self.told.half_widths, upper - lower)
        start = numpy.clip(at + 0.1 * width * generator.standard_normal((walkers, k)), lower, upper)

        def likelihood(searched):
            inside = ((searched >= lower) & (searched <= upper)).all()
            return self.log_likelihood(unknowns.from_search(searched)) if inside else -numpy.inf

        sampler = emcee.EnsembleSampler(walkers, k, likelihood)
        sampler.run_mcmc(emcee.State(start, random_state=numpy.random.RandomState(seed).get_state()), steps)
        return numpy.array([unknowns.from_search(sample) for sample in sampler.get_chain(discard=steps // 2, flat=True)])

    def save(self, directory) -> None:
        """Writes calibration.json, fit.csv, correlations.csv, fitted.prm and report.html into a directory."""
        from .calibrate import save

        save(self, directory)

    def __repr__(self) -> str:
        return "Fit(" + ", ".join(f"{name} = {value:.5g}" for name, value in zip(self.names, self.values)) + ")"

    def _repr_html_(self) -> str:
        return self.table()._repr_html_()
