"""How well curves tell the unknowns of a fit: 95 % intervals, what cannot be told, and what the answer hangs on.

With derivatives J (N x k), weighted, and residuals of covariance V the least squares estimate has the covariance

    C = (J'J)^-1 J'V J (J'J)^-1,

whether the noise is white or not. V is estimated from the residuals (noise.py), not as one but as many with their weights: the
error of an estimate is a mixture of Student's distributions, whose quantile is t sqrt(C_jj), C_jj that of the mean spectrum. An
interval ends where the sum of squares, with the other unknowns at their best, has grown by t^2 C_jj/(J'J)^-1_jj: for a curve
that is linear in the unknowns that is +- t sqrt(C_jj). Where it is not, J is that of the end, if a closed form gives it: the
question is what the noise would do if the truth were there. Estimates that make a sum of magnitudes least (e_mp, e_rel) are made
anew of noise that is drawn from the same estimated spectra, along the linear curve.
"""

from dataclasses import dataclass, field

import numpy
from scipy import stats

from . import noise
from .errors import RunError
from .problem import SMOOTH

CONFIDENCE = 0.95
_NEVER = 1e-7  # of the largest singular value: what is less is rounding


@dataclass
class Told:
    """What the curves say of the unknowns at the best fit. Numbers are those that are searched: logarithms of some."""

    derivatives: numpy.ndarray  # N x k, weighted
    noises: list  # a Noise for each series, of weighted residuals
    free: numpy.ndarray  # k: not at a bound that the curves push it against
    covariance: numpy.ndarray  # k x k; of what cannot be told as large as rounding lets it be
    covariance_told: numpy.ndarray  # k x k; without what cannot be told
    half_widths: numpy.ndarray  # k: t sqrt(C_jj), infinite if nothing tells it
    quantiles: numpy.ndarray  # k: t, so that t sqrt(C_jj) is the half width
    lower: numpy.ndarray = None  # k: ends of the intervals
    upper: numpy.ndarray = None
    directions: list = field(default_factory=list)  # (changes of the unknowns, largest change of a curve over its scale)

    @property
    def correlations(self):
        sd = numpy.sqrt(numpy.maximum(numpy.diag(self.covariance), 1e-150))
        result = self.covariance / numpy.outer(sd, sd)
        numpy.fill_diagonal(result, 1)
        return result


def inverse(J, scale_limit=1e-10):
    """(J'J)^-1, with what nothing tells very large, and the columns that it tells."""
    size = numpy.linalg.norm(J, axis=0)
    size[size == 0] = 1
    _, sigma, rows = numpy.linalg.svd(numpy.vstack([J / size, numpy.zeros((max(0, J.shape[1] - len(J)), J.shape[1]))]),
                                      full_matrices=False)
    largest = max(sigma.max(initial=0), 1e-300)
    lost = sigma <= _NEVER * largest
    scaled = rows / size
    inverse = (scaled.T / numpy.maximum(sigma, scale_limit * largest) ** 2) @ scaled
    finite = (scaled.T * numpy.where(lost, 0, 1 / numpy.where(lost, 1, sigma) ** 2)) @ scaled
    told = ~(abs(rows[lost]) > 1e-3).any(axis=0)
    return inverse, finite, told


def _sandwich(problem, J, inverse, noises):
    """C, with (J'J)^-1."""
    parts = ((J[series.slice], own) for series, own in zip(problem.series, noises))
    return inverse @ sum(rows.T @ own.covariance_times(rows) for rows, own in parts) @ inverse


def noises_of(problem, residuals, J):
    """A Noise for each series, of residuals over their weights. If the scene states the noise its size is that."""
    result = []
    for series in problem.series:
        own = noise.estimate(residuals[series.slice], J[series.slice], series.experiment.measured.parts)
        if problem.noise_is_known:
            own.variances, own.freedom = numpy.ones(len(own.weights)), 1e6
        result.append(own)
    return result


def tell(problem, best, derivatives):
    """What the curves tell at the `best` values, with `derivatives` (N x k) by what is searched, over the weights."""
    unknowns = problem.unknowns
    at, lower, upper = (unknowns.to_search(values) for values in (best.values, unknowns.lower, unknowns.upper))
    residuals = problem.weights * (best.curve - problem.measured)
    misfit = problem.residuals(best.curve)  # of the measure, which may be a sum of magnitudes
    psi = misfit if problem.measure == "least squares" else misfit / numpy.hypot(misfit, SMOOTH)
    slope, near = derivatives.T @ (problem.weights_of_measure / problem.weights * psi), 1e-6 * (upper - lower)
    pushed = ((at - lower < near) & (slope > 0)) | ((upper - at < near) & (slope < 0))
    J = derivatives  # those of unknowns at bounds, too: they may go back from there as others change
    noises = noises_of(problem, residuals, J)
    unlimited, finite, told = inverse(J)
    k, variance = len(at), _sandwich(problem, J, finite, noises)
    quantiles, half_widths = numpy.full(k, stats.norm.isf(0.5 * (1 - CONFIDENCE))), numpy.full(k, numpy.inf)
    if problem.measure != "least squares":
        estimates = _magnitude_estimates(problem, J, noises, numpy.random.default_rng(int(problem.values["Expert / Calibration / Seed"])))
        variance = estimates.T @ estimates / len(estimates)
        half_widths[told] = numpy.quantile(abs(estimates), CONFIDENCE, axis=0)[told]
    for j in numpy.flatnonzero(told):
        if problem.measure == "least squares":
            # of independent errors squares of half widths add up
            half_widths[j] = numpy.linalg.norm([own.half_width(J[series.slice] @ finite[:, j], CONFIDENCE)
                                                for series, own in zip(problem.series, noises)])
        if variance[j, j] > 0:
            quantiles[j] = half_widths[j] / numpy.sqrt(variance[j, j])
    whole = variance + numpy.median([own.sd**2 for own in noises]) * (unlimited - finite)
    ends = [numpy.where(told, numpy.clip(end, lower, upper), end) for end in (at - half_widths, at + half_widths)]
    result = Told(J, noises, ~pushed, whole, variance, half_widths, quantiles, *ends)
    _find_directions(problem, result, best.values, at, residuals)
    return result


def sizes_of(unknowns, values):
    """Where an unknown that is searched as it is gets a relative change from: itself, or a part of its range about zero."""
    return numpy.where(unknowns.logarithmic, 1, numpy.maximum(abs(values), 0.01 * (unknowns.upper - unknowns.lower)))


def _find_directions(problem, told, values, at, residuals):
    """Singular values of the relative changes that curves show if unknowns change by parts of themselves. A direction along
    which unknowns can double without a change that the noise lets see cannot be told; so is one that is lost beside others."""
    unknowns, free = problem.unknowns, numpy.flatnonzero(told.free)
    if len(free) == 0:
        return
    scaled = told.derivatives[:, free] * sizes_of(unknowns, values)[free]
    _, sigma, rows = numpy.linalg.svd(scaled, full_matrices=False)
    spread = numpy.sqrt(numpy.mean(residuals**2)) if not problem.noise_is_known else 1.0
    scales = numpy.concatenate([numpy.full(s.slice.stop - s.slice.start, s.scale) for s in problem.series])
    for row in rows[sigma < max(1e-6 * sigma.max(), spread)]:
        changes = numpy.zeros(len(at))
        changes[free] = row / row[numpy.argmax(abs(row))]
        told.directions.append((changes, abs(scaled @ changes[free] / problem.weights / scales).max()))


def text_of(direction, unknowns):
    """A direction that cannot be told, in words."""
    changes, effect = direction
    parts = numpy.flatnonzero(abs(changes) > 0.1)
    names = [unknowns.names[j] for j in parts]
    same = f"the curves then change by {100 * effect:.2g} % of their largest value where the unknowns change by 100 %"
    if len(parts) == 1:
        return f"the curves hardly depend on {names[0]}: {same}"
    text = f"the curves cannot tell {', '.join(names[:-1])} and {names[-1]} apart: "
    a, b = changes[parts[:2]]
    if len(parts) == 2 and abs(abs(a) - abs(b)) < 0.1:
        return text + f"they only appear as a {'product' if a * b < 0 else 'ratio'}; fix one of them ({same})"
    moves = ", ".join(f"{name} by {changes[j]:+.2g} %" for name, j in zip(names, parts))
    return text + f"the curves stay the same if they change together, {moves}; fix one of them ({same})"


def _growth_at_end(problem, told, J, j):
    """What the sum of squares has grown by where the interval of the unknown `j` ends, with derivatives J there; 0 if nothing
    tells it there."""
    finite = inverse(J)[1]
    if not finite[j, j] > 0:
        return 0
    return told.quantiles[j] ** 2 * _sandwich(problem, J, finite, told.noises)[j, j] / finite[j, j]


class _Profile:
    """The least sum of squares along one unknown, the others following. Searches are generators, which yield a place and are sent
    the residuals there, so that all of them go on at once; None where there is no curve."""

    def __init__(self, problem, told, best, slopes):
        unknowns = problem.unknowns
        self.problem, self.told, self.slopes = problem, told, slopes
        self.centre, self.lower, self.upper = (unknowns.to_search(v) for v in (best.values, unknowns.lower, unknowns.upper))
        self.finite = inverse(told.derivatives)[1]
        residuals = problem.weights * (best.curve - problem.measured)
        self.least = residuals @ residuals

    def _derivatives(self, place):
        if self.slopes is None:  # too dear: those of the best fit
            return self.told.derivatives
        return self.problem.weights[:, None] * self.slopes(self.problem.unknowns.from_search(place))

    def _follow(self, j, place, target):
        """The others go to where the squares are least: that place, by how much these have grown, and the growth at the end."""
        residuals, gain = (yield place), 0
        if residuals is None:
            return None
        for _ in range(10):
            try:
                J = self._derivatives(place)
            except RunError:
                break
            target, slope = _growth_at_end(self.problem, self.told, J, j) or target, J.T @ residuals
            free = ~(((place <= self.lower) & (slope > 0)) | ((place >= self.upper) & (slope < 0)))  # at bounds they cannot follow
            free[j] = False
            step = -numpy.linalg.lstsq(J[:, free], residuals, rcond=_NEVER)[0]
            gain = -(residuals @ (J[:, free] @ step))
            if gain < 0.03 * target:
                break
            for share in (1,) if self.slopes is None else (1, 0.25, 0.06, 0.015):
                other = place.copy()
                other[free] = numpy.clip(place[free] + share * step, self.lower[free], self.upper[free])
                there = yield other
                if there is not None and there @ there < residuals @ residuals:
                    place, residuals = other, there
                    break
            else:
                gain = 0
                break
        growth = residuals @ residuals - self.least - (gain if self.slopes is None else 0)
        return place, max(growth, 1e-12 * target), target

    def end(self, j, sign):
        """How far from the best value the interval ends. The square root of the growth is nearly linear in the distance: a secant
        finds where it is that of the target, between the last places on either side."""
        limit = (self.upper[j] - self.centre[j]) if sign > 0 else (self.centre[j] - self.lower[j])
        target, column = self.told.half_widths[j] ** 2 / self.finite[j, j], self.finite[:, j] / self.finite[j, j]
        inside, beyond, n_inside = (0.0, 0.0), None, 0  # (distance, sqrt of the growth over its target) below and above 1
        place, distance, next_one = self.centre, 0.0, min(self.told.half_widths[j], limit)
        while True:
            # the others go along as the linear curve says, from where they are
            place = numpy.clip(place + column * sign * (next_one - distance), self.lower, self.upper)
            distance = next_one
            place[j] = self.centre[j] + sign * distance
            found = yield from self._follow(j, place, target)
            if found is None:  # there is no curve so far away
                beyond, next_one = (distance, numpy.inf), 0.5 * (inside[0] + distance)
                continue
            place, growth, target = found
            root = numpy.sqrt(growth / target)
            if abs(root - 1) < 0.03 or (distance >= limit and root < 1):
                return min(distance / root, limit) if distance < limit or root > 1 else limit
            if root < 1:
                inside, n_inside = max(inside, (distance, root)), n_inside + 1
            else:
                beyond, n_inside = min(beyond or (numpy.inf, 0), (distance, root)), 0
            if n_inside == 4:  # what was beyond was judged before the others had followed
                beyond, n_inside = None, 0
            next_one = _secant(inside, beyond, limit)


def _secant(inside, beyond, limit):
    """The place where a line through both is 1."""
    a, root = inside
    if beyond is None:
        return min(a * numpy.clip(1 / root, 1.1, 2.5), limit)
    b, other = beyond
    if numpy.isinf(other):
        return 0.5 * (a + b)
    return numpy.clip(a + (1 - root) / (other - root) * (b - a), 0.9 * a + 0.1 * b, 0.1 * a + 0.9 * b)  # it moves from both


def nearby_curves(problem, best, closed):
    """Two functions: of places (values of the unknowns), which gives curves there, and of one place, which gives derivatives; None
    if these are too dear. Runs are replaced by the closed form where there is one: what it says is not linear is added to the line
    through the best fit."""
    if closed or problem.why_no_closed_form:
        return lambda places: problem.curves(places, closed), (lambda place: problem.derivatives(place, True)) if closed else None
    at = problem.unknowns.to_search(best.values)
    base, slopes = problem.curves([best.values], True)[0], problem.derivatives(best.values, True)

    def curves(places):
        result = []
        for place, curve in zip(places, problem.curves(places, True)):
            moved = problem.unknowns.to_search(place) - at
            result.append(None if curve is None else best.curve + best.derivatives @ moved + curve - base - slopes @ moved)
        return result

    return curves, lambda place: best.derivatives + problem.derivatives(place, True) - slopes


def profile_ends(problem, told, nearby, best, n_places):
    """Ends of the intervals along the curve that is not linear in the unknowns, found from those of the linear one. `nearby`:
    see nearby_curves(). Returns the indices of the unknowns that have an end of the linear curve, as the other one was not found
    from so many places."""
    curves_at, slopes = nearby
    profile = _Profile(problem, told, best, slopes)
    # exact data leave rounding only
    is_wide = numpy.isfinite(told.half_widths) & (told.half_widths > 1e-9 * sizes_of(problem.unknowns, best.values))
    searches = {(j, sign): profile.end(j, sign) for j in numpy.flatnonzero(is_wide) for sign in (-1, 1)}
    places = {key: next(search) for key, search in searches.items()}
    for _ in range(n_places):
        curves = curves_at([problem.unknowns.from_search(place) for place in places.values()])
        for (j, sign), curve in zip(list(places), curves):
            try:
                places[j, sign] = searches[j, sign].send(None if curve is None else problem.weights * (curve - problem.measured))
            except StopIteration as end:
                del places[j, sign]
                (told.lower if sign < 0 else told.upper)[j] = profile.centre[j] + sign * end.value
    return sorted({j for j, _ in places})


def _magnitude_estimates(problem, J, noises, generator, n_draws=50, n_iterations=30):
    """Changes (8 n_draws x k) of what is searched that make the sum of magnitudes of the measures e_mp and e_rel least for noise that is
    drawn, along the linear curve: by least squares with the weights of the solution before. What nothing tells stays."""
    over = problem.weights_of_measure / problem.weights
    rows = over[:, None] * J
    size = numpy.linalg.norm(rows, axis=0)
    size[size == 0] = 1
    basis, sigma, turned = numpy.linalg.svd(rows / size, full_matrices=False)
    kept = sigma > _NEVER * max(sigma.max(initial=0), 1e-300)
    basis, back = basis[:, kept], (turned[kept].T / sigma[kept]).T / size
    products = (basis[:, :, None] * basis[:, None, :]).reshape(len(rows), -1)
    result = []
    for _ in range(8):  # not all at once: there may be many rows
        drawn = over * numpy.hstack([own.mixed_draws(generator, n_draws) for own in noises])
        parts = drawn @ basis
        for _ in range(n_iterations):
            weights = 1 / numpy.hypot(drawn - parts @ basis.T, SMOOTH)
            squares = (weights @ products).reshape(n_draws, len(back), len(back))
            parts = numpy.linalg.solve(squares, ((weights * drawn) @ basis)[:, :, None])[:, :, 0]
        result.append(parts @ back)
    return numpy.vstack(result)


def with_test(problem, told, derivatives):
    """Half widths (k) if a test with these derivatives (rows x k), over its noise, were done as well: with the noise that the fit
    leaves, as far as it hangs together. What does so over more than a tenth of the rows is rather what the model misses."""
    scales = [own.sd * numpy.sqrt(min(own.rows_per_value, max(1, 0.1 * len(own.spectrum)))) for own in told.noises]
    sd = numpy.sqrt(numpy.diag(told.covariance_told))
    sd[sd == 0] = 1
    variances, directions = numpy.linalg.eigh(told.covariance_told / numpy.outer(sd, sd))
    known = variances > 1e-12 * variances.max(initial=0)
    before = (directions[:, known] / numpy.sqrt(variances[known])).T / sd  # its products are the inverse of the covariance
    rows = numpy.vstack([before, derivatives / numpy.sqrt(numpy.mean(numpy.square(scales)))])
    _, finite, known = inverse(numpy.where(told.free, rows, 0))
    return numpy.where(told.free, numpy.where(known, told.quantiles * numpy.sqrt(numpy.diag(finite)), numpy.inf), 0)
