"""Noise of a measured curve: how large it is, and how far it hangs together from row to row.

A series of residuals is white noise, plus noise whose correlation falls by the same factor from each row to the next, AR(1), up
to a drift that hangs together over all rows. Cosines along the rows (the discrete cosine transform) make both independent,
exactly for a random walk and nearly for AR(1) (Ahmed, Natarajan and Rao, IEEE Trans. Comput. 23 (1974) 90), with the variances

    S_j = s^2 (1 - a + a g_j),   g_j ~ 1 / (1/L^2 + 2 (1 - cos(pi j / n))),   L^2 = phi / (1 - phi)^2.

How likely each share a and length L are says the restricted likelihood (REML; Patterson and Thompson, Biometrika 58 (1971) 545),
which knows that the fit has taken a part of the noise with it. Curves rarely tell a and L well, and the lowest frequencies, which
matter most, not at all: what follows from noise is averaged over all of them (Hoeting et al., Statist. Sci. 14 (1999) 382).
"""

import functools
from dataclasses import dataclass

import numpy
from scipy import fft, linalg, optimize, special, stats

FEWEST_FREE = 8  # rows beyond unknowns: fewer do not tell whether they hang together
WHITE = 0.9  # prior of white noise: it is left where rows ask for it
DRIFT = 1.0  # prior of what hangs together over all rows, over that of all shorter lengths


@functools.lru_cache(maxsize=2)
def _family(lengths, longest):
    """Variances of the cosines, of mean 1, for parts with so many rows each (kinds x n), and prior weights of these kinds. The
    first one is white."""
    frequencies = numpy.concatenate([numpy.pi * numpy.arange(n) / n for n in lengths])
    spectra, priors, n_lengths = [numpy.ones(len(frequencies))], [], 12
    for length in numpy.geomspace(1, longest, n_lengths):
        long = 1 / (1 / length**2 + 2 * (1 - numpy.cos(frequencies)))
        for share in (*special.expit(numpy.linspace(-6, 6, 13)), 1.0):
            spectra.append(1 - share + share * long / long.mean())
            priors.append(1 + (length == longest) * DRIFT * n_lengths)
    priors = (1 - WHITE) * numpy.array(priors) / sum(priors)
    return numpy.array(spectra), numpy.r_[WHITE, priors]


def _cosines(rows, parts, transform=fft.dct):
    """Their discrete cosine transform along each part, or the opposite."""
    return numpy.concatenate([transform(rows[part], axis=0, norm="ortho") for part in parts])


@dataclass
class Noise:
    """Of one measured curve, in the unit in which the residuals were given."""

    parts: list  # slices of rows that hang together: between them is a gap
    spectra: numpy.ndarray  # kinds x n: variances of cosines, of mean 1
    weights: numpy.ndarray  # how likely each kind is
    variances: numpy.ndarray  # of a row, if it is that
    freedom: float  # degrees of freedom that these were estimated from
    is_white: bool

    @functools.cached_property
    def spectrum(self):
        """Variances of the cosines: geometric means over all kinds."""
        return numpy.exp(self.weights @ numpy.log(self.variances[:, None] * self.spectra))

    @property
    def sd(self):
        """Standard deviation of a row."""
        return float(numpy.sqrt(self.spectrum.mean()))

    @property
    def correlation(self):
        """Of neighbouring rows."""
        waves = numpy.concatenate([numpy.cos(numpy.pi * numpy.arange(p.stop - p.start) / (p.stop - p.start)) for p in self.parts])
        return 0.0 if self.is_white else float(self.spectrum @ waves / self.spectrum.sum())

    @property
    def rows_per_value(self):
        """How many rows tell as much of a mean as one independent value does: 1 + 2 (rho_1 + rho_2 + ...), which is
        (1 + phi)/(1 - phi) if rho_k = phi^k (Bayley and Hammersley, J. R. Stat. Soc. Suppl. 8 (1946) 184)."""
        return max(1.0, float(numpy.mean([self.spectrum[part.start] for part in self.parts]) / self.spectrum.mean()))

    @property
    def name(self):
        return "white" if self.is_white else "white + AR(1)"

    def covariance_times(self, rows):
        """The covariance of the noise (n x n) times `rows` (n x k)."""
        return _cosines(self.spectrum[:, None] * _cosines(rows, self.parts), self.parts, fft.idct)

    def whitened(self, rows):
        """`rows` (n x k) such that this noise is white with variance 1, and the log of the determinant of its covariance."""
        return _cosines(rows, self.parts) / numpy.sqrt(self.spectrum)[:, None], float(numpy.log(self.spectrum).sum())

    def draw(self, generator):
        """Noise of this kind."""
        return _cosines(numpy.sqrt(self.spectrum) * generator.standard_normal(len(self.spectrum)), self.parts, fft.idct)

    def mixed_draws(self, generator, number):
        """Noise (number x n), each time of another kind, as likely as it is, and with a variance that may be its own."""
        kinds = generator.choice(len(self.weights), number, p=self.weights)
        variances = self.variances[kinds] * self.freedom / generator.chisquare(self.freedom, number)
        white = generator.standard_normal((number, self.spectra.shape[1]))
        return _cosines((numpy.sqrt(variances[:, None] * self.spectra[kinds]) * white).T, self.parts, fft.idct).T

    def half_width(self, direction, confidence):
        """Of the interval of the sum of `direction` (n) times the noise that holds zero so often."""
        sds = numpy.sqrt(self.variances * (self.spectra @ _cosines(direction, self.parts) ** 2))
        largest = sds.max()
        if not largest > 0:
            return 0.0
        tail = 0.5 * (1 - confidence)

        def beyond(logarithm):
            return self.weights @ special.stdtr(self.freedom, -numpy.exp(logarithm) / numpy.maximum(sds, 1e-12 * largest)) - tail

        limit = numpy.log(largest * stats.t.isf(tail / 2, self.freedom))
        return float(numpy.exp(optimize.brentq(beyond, limit - 30, limit, xtol=1e-6)))


def estimate(residuals, derivatives, parts, longest=None):
    """The Noise of `residuals` (n), what a fit has left, whose curve has these `derivatives` (n x k) by what was fitted.
    `parts`: slices of rows without a gap. Columns that say nothing may be there. `longest`: L; if it is not given that of a random
    walk from zero on, what moves all rows alike having its variance, n^2/3."""
    basis = linalg.orth(derivatives, rcond=1e-9)  # without what says nothing
    for _ in range(2):  # what derivatives explain says nothing of the noise; of exact data it is all but rounding
        residuals = residuals - basis @ (basis.T @ residuals)
    size, (n, k) = max(numpy.linalg.norm(residuals), 1e-150), basis.shape
    freedom, lengths = n - k, tuple(part.stop - part.start for part in parts)
    if freedom < FEWEST_FREE or size == 1e-150:
        return Noise(parts, numpy.ones((1, n)), numpy.ones(1), numpy.array([size**2 / max(1, freedom)]), max(1, freedom), True)
    spectra, priors = _family(lengths, max(2.0, longest or max(lengths) / numpy.sqrt(3)))
    both = _cosines(numpy.column_stack([basis, residuals / size]), parts)
    products = (both[:, :, None] * both[:, None, :]).reshape(n, -1)
    triangles = numpy.linalg.cholesky((1 / spectra @ products).reshape(-1, k + 1, k + 1))
    diagonals = numpy.diagonal(triangles, axis1=1, axis2=2)
    squares = diagonals[:, -1] ** 2
    minus_log = 0.5 * numpy.log(spectra).sum(axis=1) + numpy.log(diagonals[:, :-1]).sum(axis=1) + 0.5 * freedom * numpy.log(squares)
    weights = priors * numpy.exp(minus_log.min() - minus_log)
    weights /= weights.sum()
    used = weights > 1e-7
    return Noise(parts, spectra[used], weights[used] / weights[used].sum(), size**2 * squares[used] / freedom, freedom, weights[0] > 0.5)


def lack_of_fit(residuals, derivatives, parts, n_waves=8):
    """F of the question whether residuals hold a smooth part that noise does not explain, about 1 if the model is right, and
    how likely so large an F is then. The part is the best sum of `n_waves` cosines along the rows, of fewer for less than six
    rows for each; the noise is estimated from what they leave, and hangs together over less than they do, so that what the model
    misses is not taken for noise. Not a number for fewer than 12 rows."""
    n = len(residuals)
    n_waves = min(n_waves, n // 6)
    if n_waves < 2:
        return numpy.nan, numpy.nan
    place = (numpy.arange(n) + 0.5) / n
    waves = numpy.cos(numpy.pi * place[:, None] * numpy.arange(1, n_waves + 1))
    basis = linalg.orth(derivatives, rcond=1e-9)
    k = basis.shape[1]
    noise = estimate(residuals, numpy.column_stack([basis, waves]), parts, n / (numpy.pi * n_waves))
    white, _ = noise.whitened(numpy.column_stack([basis, waves, residuals]))

    def squares(columns):
        return numpy.sum((white[:, -1] - columns @ numpy.linalg.lstsq(columns, white[:, -1], rcond=1e-10)[0]) ** 2)

    with_waves = squares(white[:, :-1])
    freedom = n - k - n_waves
    F = max(0, (squares(white[:, :k]) - with_waves) / n_waves / max(with_waves / freedom, 1e-300))
    return F, float(stats.f.sf(F, n_waves, freedom))
