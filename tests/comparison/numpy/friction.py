"""Laws of friction: what the coefficient is at the end of a step in which a point slides by `way` mm.

A law is told with which history a point begins the step: `start.slid`, g_s [mm]; `start.bonded`, phi_0; `start.theta`,
the state of `rate and state` [time]; and `start.duration` of the step, 0 where no time passes. Arrays have the shape
(m,), one entry per point.
"""
import numpy as np
from scipy.interpolate import CubicHermiteSpline


class BondFriction:
    """mu of Eq. (11): from `unbroken` to `broken` as the bonding s falls with the sliding distance."""

    initial_theta = 0.

    def __init__(self, unbroken, broken):
        self.unbroken, self.broken = unbroken, broken

    def coefficient(self, start, way):
        """mu and its derivative with respect to the way [1/mm]."""
        value, slope = self.bonding(start.slid + way)
        difference = start.bonded * (self.unbroken - self.broken)
        return self.broken + difference * value, difference * slope

    def adhesive_strength(self, start, way):
        """The integral of mu - mu_b over the way [mm]."""
        spent = self.bonding_integral(start.slid + way) - self.bonding_integral(start.slid)
        return start.bonded * (self.unbroken - self.broken) * spent

    def theta(self, start, way):
        """The state at the end of the step: this law has none."""
        return start.theta


class ModifiedCoulomb(BondFriction):
    """The bond falls beyond a sliding distance of `threshold` mm, Eq. (13).

    Coulomb's law has the same coefficient twice.
    """

    def __init__(self, unbroken, broken, threshold, transition):
        super().__init__(unbroken, broken)
        self.threshold, self.transition = threshold, transition

    def bonding(self, slid):
        """s(g_s / a_s) of Eq. (13) and its derivative [1/mm]; phi = phi_0 s."""
        q = slid / self.threshold
        phase = np.pi / (2 * self.transition) * (q - self.transition - 1)
        falling = (q >= 1) & (q <= 1 + 2 * self.transition)
        value = np.where(q < 1, 1., np.where(falling, (1 - np.sin(phase)) / 2, 0.))
        slope = -np.pi / (4 * self.transition * self.threshold) * np.where(falling, np.cos(phase), 0.)
        return value, slope

    def bonding_integral(self, slid):
        """The integral of s over the sliding distance, from 0 to g_s [mm]."""
        q = np.clip(slid / self.threshold, 1, 1 + 2 * self.transition)
        phase = np.pi / (2 * self.transition) * (q - self.transition - 1)
        falling = (q - 1) / 2 + self.transition / np.pi * np.cos(phase)
        return np.minimum(slid, self.threshold) + self.threshold * falling


class Table(BondFriction):
    """The bond falls as in a table: `shares` phi at `distances` g_s [mm] from 0; constant from the last one on.

    Cubics lie between the rows. Their slope at an inner row is the harmonic mean of those of the two chords beside it,
    h_1 and h_2 long, with the weights h_1 + 2 h_2 and 2 h_1 + h_2 (Fritsch and Butland 1984), 0 beside a level chord;
    at the first and the last row it is that of the chord.
    """

    def __init__(self, unbroken, broken, distances, shares):
        super().__init__(unbroken, broken)
        length = np.diff(distances)
        chord = np.diff(shares) / length
        slopes = np.concatenate([chord[:1], np.zeros(len(chord) - 1), chord[-1:]])
        inner = 1 + np.flatnonzero((chord[:-1] < 0) & (chord[1:] < 0))
        first, second = 2 * length[inner] + length[inner - 1], length[inner] + 2 * length[inner - 1]
        slopes[inner] = (first + second) / (first / chord[inner - 1] + second / chord[inner])
        self.last = distances[-1]
        self.curve = CubicHermiteSpline(distances, shares, slopes)
        self.slope, self.integral = self.curve.derivative(), self.curve.antiderivative()

    def bonding(self, slid):
        """s(g_s) and its derivative [1/mm]; phi = phi_0 s."""
        inside = np.minimum(slid, self.last)
        return self.curve(inside), np.where(slid < self.last, self.slope(inside), 0.)

    def bonding_integral(self, slid):
        """The integral of s over the sliding distance, from 0 to g_s [mm]."""
        inside = np.minimum(slid, self.last)
        return self.integral(inside) + (slid - inside) * self.curve(self.last)


class RateAndState:
    """mu = mu_0 + A ln(1 + V/V_0) + B ln(V_0 theta/D) of Dieterich and Ruina, where V is the way over the duration.

    At this constant V the state tends to D/V, of which it is still exp(-way/D) as far as at the start of the step: theta
    itself with `ageing`, else its logarithm, the `slip` law. At rest the former ages by the duration, the latter stays.
    There is no bond.
    """

    def __init__(self, reference, direct, evolution, speed, distance, initial_theta, ageing):
        self.reference, self.direct, self.evolution = reference, direct, evolution
        self.speed, self.distance, self.ageing = speed, distance, ageing
        self.initial_theta = initial_theta or distance / speed

    def _log_theta(self, start, way):
        """ln theta at the end of the step, complex; the way has a small imaginary part and is thereby not zero."""
        if not np.any(start.duration):
            return np.log(start.theta + 0j)
        q = way / self.distance
        gone = -np.expm1(-q)
        if self.ageing:
            return np.log(start.theta * (1 - gone) + start.duration * gone / q)
        return np.log(start.theta) * (1 - gone) + np.log(start.duration / q) * gone

    def coefficient(self, start, way):
        """mu and its derivative with respect to the way [1/mm], by a complex step."""
        small = 1e-30
        way = way + small * 1j
        speed = way / start.duration if np.any(start.duration) else 0.
        mu = (self.reference + self.direct * np.log1p(speed / self.speed)
              + self.evolution * (self._log_theta(start, way) + np.log(self.speed / self.distance)))
        return mu.real, mu.imag / small

    def theta(self, start, way):
        """The state at the end of the step."""
        return np.exp(self._log_theta(start, way + 1e-30j).real)

    def adhesive_strength(self, start, way):
        """No bond, no work of adhesion."""
        return 0 * way

    def bonding(self, slid):
        """No bond."""
        return 0 * slid, 0 * slid
