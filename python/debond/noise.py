"""Noise of a measured curve: how large it is, and how far it hangs together from row to row.

A series of residuals r_t, t = 1..n, is taken as autoregressive, r_t = phi_1 r_{t-1} + ... + phi_p r_{t-p} + e_t with white
e_t; p = 0 is white noise. phi and the variance of e_t maximise the restricted likelihood (REML; Patterson and Thompson,
1971), which knows that the fit has taken a part of the noise with it: without that correlated noise comes out too small, and
intervals too narrow. p is the one of least BIC.
"""

from dataclasses import dataclass

import numpy
from scipy import linalg, optimize, signal, stats

LARGEST_ORDER = 4
LONGEST = 0.1  # of a curve: what hangs together over more is no noise, but what the model misses


def _coefficients(partial):
    """phi of an autoregression with these partial autocorrelations, which is stationary for any of them in ]-1, 1["""
    phi = numpy.zeros(0)
    for value in partial:
        phi = numpy.append(phi - value * phi[::-1], value)
    return phi


def autocovariance(phi, n):
    """Covariances of rows 0 .. n-1 apart, for e_t of variance 1 (Yule and Walker's equations)."""
    p = len(phi)
    equations = numpy.eye(p + 1)
    for i in range(p + 1):
        for k in range(1, p + 1):
            equations[i, abs(i - k)] -= phi[k - 1]
    first = numpy.linalg.solve(equations, numpy.eye(p + 1)[0])
    if p == 0 or n <= p + 1:
        return numpy.pad(first, (0, max(0, n - p - 1)))[:n]
    weights = numpy.r_[1, -phi]
    state = signal.lfiltic([1], weights, first[p:0:-1])
    return numpy.r_[first, signal.lfilter([1], weights, numpy.zeros(n - p - 1), zi=state)[0]]


def rows_per_value(phi):
    """How many rows tell as much of a mean as one independent value does: (1 + phi)/(1 - phi) for AR(1)."""
    return max(1.0, 1 / (1 - phi.sum()) ** 2 / autocovariance(phi, 1)[0])


def whitened(rows, phi):
    """`rows` (n x any) such that noise of these coefficients becomes white with the variance of e_t, and the logarithm of the
    determinant of the covariance over that variance."""
    p = min(len(phi), len(rows))
    if p == 0:
        return rows, 0.0
    result = signal.lfilter(numpy.r_[1, -phi], [1], rows, axis=0)
    root = numpy.linalg.cholesky(linalg.toeplitz(autocovariance(phi, len(phi) + 1)[:p]))
    result[:p] = linalg.solve_triangular(root, rows[:p], lower=True)
    return result, 2 * numpy.log(numpy.diag(root)).sum()


@dataclass
class Noise:
    """Of one measured curve, in the unit in which the residuals were given."""

    phi: numpy.ndarray  # of rows; empty: white
    variance: float  # of e_t
    parts: list  # slices of rows that hang together: between them is a gap
    freedom: float = numpy.inf  # degrees of freedom that the variance was estimated from
    # second derivatives of -2 log of the restricted likelihood in partial autocorrelations (arctanh) and log variance
    information: numpy.ndarray = None
    partial: numpy.ndarray = None  # arctanh of partial autocorrelations

    @property
    def sd(self):
        """Standard deviation of a row."""
        return numpy.sqrt(self.variance * autocovariance(self.phi, 1)[0])

    @property
    def correlation(self):
        """Of neighbouring rows."""
        return 0.0 if len(self.phi) == 0 else float(numpy.divide(*autocovariance(self.phi, 2)[::-1]))

    @property
    def rows_per_value(self):
        """See rows_per_value()."""
        return rows_per_value(self.phi)

    @property
    def name(self):
        return f"AR({len(self.phi)})" if len(self.phi) else "white"

    def covariance_times(self, rows):
        """The covariance of the noise (n x n) times `rows` (n x k)."""
        result = numpy.empty_like(rows)
        for part in self.parts:
            row = self.variance * autocovariance(self.phi, part.stop - part.start)
            result[part] = linalg.matmul_toeplitz(row, rows[part])
        return result

    def whitened(self, rows):
        """`rows` (n x k) such that this noise is white with variance 1, and the log of the determinant of its covariance."""
        done = [whitened(rows[part], self.phi) for part in self.parts]
        return (numpy.concatenate([rows for rows, _ in done]) / numpy.sqrt(self.variance),
                sum(log for _, log in done) + len(rows) * numpy.log(self.variance))

    def draw(self, generator):
        """Noise of this kind."""
        n = self.parts[-1].stop
        result = numpy.empty(n)
        for part in self.parts:
            length = part.stop - part.start
            white = generator.standard_normal(length + 500) * numpy.sqrt(self.variance)  # the start is forgotten
            result[part] = signal.lfilter([1], numpy.r_[1, -self.phi], white)[-length:]
        return result


def _criterion(partial, residuals, derivatives, parts):
    """-2 log of the restricted likelihood, with the variance that maximises it, that variance, and phi."""
    phi = _coefficients(numpy.tanh(partial))
    n, k = derivatives.shape
    both = numpy.column_stack([derivatives, residuals])
    try:
        done = [whitened(both[part], phi) for part in parts]
    except numpy.linalg.LinAlgError:  # so near to what never ends that rounding decides
        return 1e300, numpy.nan, phi
    triangle = numpy.abs(numpy.diag(numpy.linalg.qr(numpy.concatenate([rows for rows, _ in done]), mode="r")))
    freedom = n - k
    variance = max(triangle[-1] ** 2 / freedom, 1e-300)
    return (freedom * numpy.log(variance) + sum(log for _, log in done) + 2 * numpy.log(triangle[:-1]).sum(), variance, phi)


def _limited(partial, residuals, derivatives, parts):
    """The same, and a wall where noise would hang together over too much of the curve."""
    value, _, phi = _criterion(partial, residuals, derivatives, parts)
    return value + 1e4 * max(0, numpy.log(rows_per_value(phi) / max(2, LONGEST * len(residuals)))) ** 2


def _basis(derivatives):
    """Orthonormal columns that span those of `derivatives`, without what says nothing."""
    basis, sizes, _ = linalg.svd(derivatives, full_matrices=False)
    return basis[:, sizes > 1e-9 * max(sizes.max(initial=0), 1e-300)]


def estimate(residuals, derivatives, parts, largest_order=LARGEST_ORDER):
    """The Noise of `residuals` (n), what a fit has left, whose curve has these `derivatives` (n x k) by what was fitted.
    `parts`: slices of rows without a gap. Columns that say nothing may be there."""
    n = len(residuals)
    derivatives = _basis(derivatives)
    k = derivatives.shape[1]
    if n - k < 1:  # nothing is left that could tell
        return Noise(numpy.zeros(0), max(residuals @ residuals / n, 1e-300), parts, 1, numpy.full((1, 1), 0.5), numpy.zeros(0))
    best = None
    shortest = min(part.stop - part.start for part in parts)
    for order in range(max(0, min(largest_order, (n - k) // 8, shortest // 2)) + 1):
        start = numpy.zeros(order)
        if order > 0:
            start[:-1] = found
            if order == 1:
                lagged = sum(residuals[part][1:] @ residuals[part][:-1] for part in parts)
                start[0] = numpy.arctanh(numpy.clip(lagged / max(residuals @ residuals, 1e-300), -0.9, 1 - 4 / n))
            found = optimize.minimize(lambda z: _limited(z, residuals, derivatives, parts), start, method="Nelder-Mead",
                                      options={"xatol": 1e-3, "fatol": 1e-3, "initial_simplex": _simplex(start)}).x
        else:
            found = start
        _, variance, phi = _criterion(found, residuals, derivatives, parts)
        bic = _limited(found, residuals, derivatives, parts) + numpy.log(n) * order
        if best is None or bic < best[0]:
            best = (bic, found, variance, phi)
        elif order > len(best[1]) + 1:
            break
    _, partial, variance, phi = best
    return Noise(phi, variance, parts, n - k, _information(partial, variance, residuals, derivatives, parts), partial)


def _simplex(start):
    return numpy.vstack([start, start + 0.2 * numpy.eye(len(start))])


def _information(partial, variance, residuals, derivatives, parts):
    """Half the second derivatives of -2 log of the restricted likelihood, by differences: partial, then log variance."""
    n, k = derivatives.shape

    def value(at):
        profile, best, _ = _criterion(at[:-1], residuals, derivatives, parts)
        ratio = best / numpy.exp(at[-1])
        return profile + (n - k) * (ratio - 1 - numpy.log(ratio))

    centre, size, h = numpy.r_[partial, numpy.log(variance)], len(partial) + 1, 0.02
    result = numpy.empty((size, size))
    step = h * numpy.eye(size)
    for i in range(size):
        for j in range(i + 1):
            result[i, j] = result[j, i] = (value(centre + step[i] + step[j]) - value(centre + step[i] - step[j])
                                           - value(centre - step[i] + step[j]) + value(centre - step[i] - step[j])) / (8 * h * h)
    return result


def freedom_of(noise, quantity):
    """Degrees of freedom of a variance that depends on this noise (Satterthwaite's): 2 / Var(log v). `quantity`: that
    variance for a Noise."""
    centre = numpy.r_[noise.partial, numpy.log(noise.variance)]

    def value(at):
        return numpy.log(quantity(Noise(_coefficients(numpy.tanh(at[:-1])), numpy.exp(at[-1]), noise.parts)))

    step = 0.02 * numpy.eye(len(centre))
    slope = numpy.array([(value(centre + h) - value(centre - h)) / 0.04 for h in step])
    return float(numpy.clip(2 / max(slope @ numpy.linalg.pinv(noise.information) @ slope, 1e-12), 1, 1e6))


def lack_of_fit(residuals, derivatives, parts, n_waves=8):
    """F of the question whether residuals hold a smooth part that noise does not explain, about 1 if the model is right, and
    how likely so large an F is then. The part is the best sum of `n_waves` cosines along the rows, of fewer for less than six
    rows for each; the noise is estimated from what they leave, so that what the model misses is not taken for noise. Not a number
    for fewer than 12 rows."""
    n = len(residuals)
    n_waves = min(n_waves, n // 6)
    if n_waves < 2:
        return numpy.nan, numpy.nan
    place = (numpy.arange(n) + 0.5) / n
    waves = numpy.cos(numpy.pi * place[:, None] * numpy.arange(1, n_waves + 1))
    basis = _basis(derivatives)
    k = basis.shape[1]
    noise = estimate(residuals, numpy.column_stack([basis, waves]), parts)
    white, _ = noise.whitened(numpy.column_stack([basis, waves, residuals]))

    def squares(columns):
        return numpy.sum((white[:, -1] - columns @ numpy.linalg.lstsq(columns, white[:, -1], rcond=1e-10)[0]) ** 2)

    with_waves = squares(white[:, :-1])
    freedom = n - k - n_waves
    F = max(0, (squares(white[:, :k]) - with_waves) / n_waves / max(with_waves / freedom, 1e-300))
    return F, float(stats.f.sf(F, n_waves, freedom))
