"""A mean over specimens of a number that each of them tells with its own uncertainty: random effects,

    y_i = mu + u_i + e_i,   u_i ~ N(0, tau^2) between specimens,   e_i ~ N(0, s_i^2) of the fit of one.

tau^2 is that of restricted maximum likelihood, which for few specimens is less biased than that of DerSimonian and Laird
(Viechtbauer, Journal of Educational and Behavioral Statistics 30 (2005) 261-293). The interval of mu is that of Hartung and
Knapp (Statistics in Medicine 20 (2001) 3875-3889), with Student's t and never narrower than the s_i say: with few specimens
intervals from the normal distribution are too narrow (IntHout et al., BMC Medical Research Methodology 14 (2014) 25).

Differences of groups are those of plain means. What values do not tell well is a part of their scatter, so intervals hold
without knowing it; with weights from few uncertain s_i they hold less often than they say (tests/python/groups.py draws both).
The mixed model is not that of statsmodels, which knows one scatter for all groups, and intervals of the normal distribution: of
these 85 to 88 of 100 hold with five or six animals.
"""

import itertools
from dataclasses import dataclass

import numpy
from scipy import optimize, special, stats


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


def _restricted(roots, y, X, parts):
    """Minus the log of the restricted likelihood of y ~ N(X b, V), V = sum_k roots_k^2 parts_k, and its derivatives by the roots."""
    theta = roots**2 + 1e-9
    W = numpy.linalg.inv(numpy.tensordot(theta, parts, 1))
    G = X.T @ W @ X
    P = W - W @ X @ numpy.linalg.solve(G, X.T @ W)
    Py = P @ y
    minus_log = 0.5 * (numpy.linalg.slogdet(G)[1] - numpy.linalg.slogdet(W)[1] + y @ Py)
    return minus_log, roots * (numpy.einsum("kij,ij->k", parts, P) - parts @ Py @ Py)


def _fitted(y, groups, animals):
    """Means of groups (G), and what _contrast() needs of them: y_i = m_group + u_animal + e_i, with the variance of u common and that of
    e each group's own, by restricted maximum likelihood. y, groups (0 ... G - 1), animals: of n values; if no animal repeats there
    is no u, and _contrast() is the test of Welch. With the covariance of Kenward and Roger (Biometrics 53 (1997) 983-997): with
    few animals the one that takes the variances as known is too small."""
    X, repeat = numpy.equal.outer(groups, numpy.arange(max(groups) + 1)).astype(float), len(set(animals)) < len(animals)
    parts = numpy.array([*map(numpy.diag, X.T), *[numpy.equal.outer(animals, animals)] * repeat], dtype=float)
    theta = numpy.array([numpy.var(y[own > 0], ddof=1) for own in X.T])
    scale = theta.mean() ** 0.5 or 1.0
    y, theta = y / scale, theta / scale**2 + 1e-12
    if repeat:
        start = numpy.sqrt(numpy.append(theta, theta.mean()) / 2)
        theta = optimize.minimize(_restricted, start, (y, X, parts), jac=True, method="BFGS").x ** 2 + 1e-9
    W = numpy.linalg.inv(numpy.tensordot(theta, parts, 1))
    Phi, A = numpy.linalg.inv(X.T @ W @ X), W @ X
    PV, VA = (W - A @ Phi @ A.T) @ parts, parts @ A
    told, D = 0.5 * numpy.einsum("aij,bji->ab", PV, PV), A.T @ VA  # of theta by y; minus slopes of the inverse of Phi
    sizes = numpy.sqrt(numpy.multiply.outer(told.diagonal(), told.diagonal()))
    of_theta = numpy.linalg.pinv(told / sizes) / sizes
    more = numpy.einsum("ab,anp,nm,bmq->pq", of_theta, VA, W - A @ Phi @ A.T, VA, optimize=True)
    return scale * Phi @ A.T @ y, scale**2 * (Phi + 2 * Phi @ more @ Phi), (scale**2 * Phi, scale**2 * Phi @ D @ Phi, of_theta)


def _contrast(c, covariance, known):
    """Variance of c times the means, and the quantile for 95 % of Student's t with the degrees of freedom of Satterthwaite."""
    Phi, slopes, of_theta = known
    by_theta = slopes @ c @ c
    freedom = 2 * (c @ Phi @ c) ** 2 / max(by_theta @ of_theta @ by_theta, 1e-300)
    # with few pairs that of Kenward and Roger may be the smaller one
    return max(c @ covariance @ c, c @ Phi @ c), special.stdtrit(max(1.0, freedom), 0.975)


def _ratio(c, means, covariance, known):
    """Of the mean that c counts positive over the other one, and its interval by Fieller (J. R. Stat. Soc. B 16 (1954) 175-185): all
    r such that a - r b may be 0, so that 1 is among them if the difference may be 0. NaN where a mean is not positive; without
    ends where b may be 0."""
    a, b = means[c > 0][0], means[c < 0][0]
    if min(a, b) <= 0:
        return numpy.nan, numpy.nan, numpy.nan

    def excess(r):
        variance, t = _contrast(numpy.where(c < 0, -r, c), covariance, known)
        return (a - r * b) ** 2 - t**2 * variance

    ends = [sign * 100 * a / b for sign in (-1, 1)]
    if min(map(excess, ends)) <= 0:
        return a / b, numpy.nan, numpy.nan
    return a / b, *(optimize.brentq(excess, a / b, end) if excess(a / b) < 0 else a / b for end in ends)


def compare_groups(y, groups, animals=None):
    """Means of groups and differences of each two, as lists of dictionaries, in the order in which groups come.

    y (n): values; groups, animals (n): names, None for an animal of its own. Values of one animal in a group count as their
    mean: it is animals that scatter. lower_95 and upper_95 of a mean are those of Student's t. `minus` is the group that comes
    first. NaN: one animal does not tell."""
    cells = {}
    for i, (value, group) in enumerate(zip(y, groups)):
        animal = (i,) if animals is None or animals[i] is None else animals[i]
        cells.setdefault(group, {}).setdefault(animal, []).append(value)
    means, used = [], []
    for group, own in cells.items():
        each, n = numpy.array([numpy.mean(values) for values in own.values()]), len(own)
        sd = each.std(ddof=1) if n > 1 else numpy.nan
        half = stats.t.ppf(0.975, n - 1) * sd / n**0.5 if n > 1 else numpy.nan
        means.append({"group": group, "values": sum(map(len, own.values())), "animals": n, "mean": each.mean(), "sd": sd,
                      "lower_95": each.mean() - half, "upper_95": each.mean() + half})
        used += [(value, group, animal) for value, animal in zip(each, own)] if n > 1 else []
    return means, _differences(used) if used else []


def _numbered(names):
    known = {name: i for i, name in enumerate(dict.fromkeys(names))}
    return list(known), numpy.array([known[name] for name in names])


def _differences(used):
    """Of (value, group, animal), each group with two animals or more."""
    values, groups, animals = zip(*used)
    (names, groups), (_, animals), rows = _numbered(groups), _numbered(animals), []
    means, *known = _fitted(numpy.array(values), groups, animals)
    for first, second in itertools.combinations(range(len(names)), 2):
        c = numpy.eye(len(names))[second] - numpy.eye(len(names))[first]
        variance, t = _contrast(c, *known)
        difference, half = c @ means, t * variance**0.5
        rows.append({"group": names[second], "minus": names[first], "difference": difference,
                     "lower_95": difference - half, "upper_95": difference + half,
                     **dict(zip(("ratio", "ratio_lower_95", "ratio_upper_95"), _ratio(c, means, *known)))})
    return rows
