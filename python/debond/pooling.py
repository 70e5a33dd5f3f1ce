"""A mean over specimens of a number that each of them tells with its own uncertainty: random effects,

    y_i = mu + u_i + e_i,   u_i ~ N(0, tau^2) between specimens,   e_i ~ N(0, s_i^2) of the fit of one.

tau^2 is that of restricted maximum likelihood, which for few specimens is less biased than that of DerSimonian and Laird
(Viechtbauer, Journal of Educational and Behavioral Statistics 30 (2005) 261-293). The interval of mu is that of Hartung and
Knapp (Statistics in Medicine 20 (2001) 3875-3889), with Student's t and never narrower than the s_i say: with few specimens
intervals from the normal distribution are too narrow (IntHout et al., BMC Medical Research Methodology 14 (2014) 25).
"""

from dataclasses import dataclass

import numpy
from scipy import optimize, stats


@dataclass
class Pooled:
    """n specimens; mean mu and the ends of its 95 % interval; tau, the standard deviation between specimens. NaN: unknown."""

    n: int = 0
    mean: float = numpy.nan
    lower: float = numpy.nan
    upper: float = numpy.nan
    tau: float = numpy.nan


def _weighted(y, variance, tau_squared):
    w = 1 / (variance + tau_squared)
    return w, w @ y / w.sum()


def tau_squared_of(y, variance) -> float:
    """By restricted maximum likelihood, from values (n >= 2) and their variances (n): the root of its derivative,
    w = 1/(variance + tau^2),   tau^2 = sum w^2 ((y - mu)^2 - variance) / sum w^2 + 1 / sum w,   or 0."""

    def excess(tau_squared):
        w, mu = _weighted(y, variance, tau_squared)
        return w**2 @ ((y - mu) ** 2 - variance) / (w @ w) + 1 / w.sum() - tau_squared

    return 0.0 if excess(0) <= 0 else optimize.brentq(excess, 0, 2 * numpy.ptp(y) ** 2 + 2 * variance.max(), rtol=1e-13)


def pool(y, sd) -> Pooled:
    """Of values (n) and the standard deviations of their errors (n), all above 0. One specimen does not tell how they scatter,
    and so not how far the mean of all is from it."""
    y, variance = numpy.asarray(y, dtype=float), numpy.asarray(sd, dtype=float) ** 2
    n = len(y)
    if n < 2:
        return Pooled(n, y[0]) if n else Pooled()
    tau_squared = tau_squared_of(y, variance)
    w, mu = _weighted(y, variance, tau_squared)
    scatter = w @ (y - mu) ** 2 / (n - 1)
    half = stats.t.ppf(0.975, n - 1) * numpy.sqrt(max(1.0, scatter) / w.sum())
    return Pooled(n, mu, mu - half, mu + half, numpy.sqrt(tau_squared))
