"""Laws of a point of the interface: what it bears in the normal direction, and the limit of its tangential traction.

They get `begin`, the history with which a point begins the step (`slid`, `bonded`, `kappa`, `omega`, `bonds`,
`normal_gap`), the way that it slides in the step and its normal gap at the end [mm]. Arrays have the shape (m,), one
entry per point.

friction    law of friction.py: mu and the decay s of the bond with the sliding distance
stiffness   normal and tangential, MPa/mm
"""
import numpy as np


class Friction:
    """p = -eps_n g_n while closed, friction mu p, nothing in tension."""

    climbs = False

    def __init__(self, friction, stiffness):
        self.friction = friction
        self.normal, self.tangential = stiffness

    cohesive = False  # whether bonded points are held at the places where they bonded, beside what is said here

    def bonds(self, history):
        """Whether a point may pull; it has `touched` the master in an accepted state."""
        return np.zeros(history.touched.shape, bool)

    def carried(self, begin, gap):
        """Whether a point is carried that does not slide."""
        return (gap < 0) | begin.bonds

    def pressure(self, begin, way, gap):
        """p [MPa], negative where the bond pulls, and its derivatives by the gap and by the way."""
        return -self.normal * gap, np.full(gap.shape, -self.normal), 0 * way

    def coefficient(self, begin, way):
        """L over the pressure, under pressure."""
        return self.friction.coefficient(begin, way)[0]

    def string(self, begin, way, gap):
        """L / eps_t [mm], its derivatives by the depth -g_n and by the way, and whether viscosity resists."""
        mu, slope = self.friction.coefficient(begin, way)
        ratio, depth = self.normal / self.tangential, -gap
        return ratio * mu * depth, ratio * mu, ratio * slope * depth, 1.

    def kappa(self, begin, gap):
        """Largest gap of a point since it first closed [mm]: this law does not need it."""
        return begin.kappa

    def gone(self, kappa):
        """Whether nothing is left of a bond that has opened so far."""
        return np.zeros(kappa.shape, bool)

    def rise(self, slid):
        """Height [mm] that the faces have climbed, and its derivative."""
        return 0 * slid, 0 * slid

    def bond(self, history):
        """phi."""
        return history.bonded * self.friction.bonding(history.slid)[0]

    def stored(self, begin, way, gap):
        """Energy per area in the normal direction, N/mm."""
        return self.pressure(begin, way, gap)[0] ** 2 / self.normal / 2

    def damage(self, begin, way, gap):
        """What is dissipated per area in the step beside friction, N/mm."""
        return 0 * way

    def adhesive_work(self, begin, way, before, after):
        """The friction work per area beyond that without bond, N/mm, with p and L `before` and `after` the step."""
        return (after.pressure + before.pressure) / 2 * self.friction.adhesive_strength(begin, way)


class Dilatant(Friction):
    """Faces that climb by h = h_inf (1 - exp(-g_s/l)) as they slide: p = -eps_n (g_n - h) while that is positive."""

    climbs = True  # a point that is closed stays so while its way lifts it

    def __init__(self, friction, stiffness, height, length):
        super().__init__(friction, stiffness)
        self.height, self.length = height, length

    def rise(self, slid):
        return -self.height * np.expm1(-slid / self.length), self.height / self.length * np.exp(-slid / self.length)

    def carried(self, begin, gap):
        return gap < self.rise(begin.slid)[0]

    def pressure(self, begin, way, gap):
        rise, slope = self.rise(begin.slid + way)
        return self.normal * (rise - gap), np.full(gap.shape, -self.normal), self.normal * slope

    def string(self, begin, way, gap):
        mu, by_way = self.friction.coefficient(begin, way)
        p, _, p_by_way = self.pressure(begin, way, gap)
        presses = p > 0
        return (presses * mu * p / self.tangential, presses * mu * self.normal / self.tangential,
                presses * (by_way * p + mu * p_by_way) / self.tangential, presses)


class Adhesive(Friction):
    """A bond that pulls with phi_0 s sigma_e on first opening, straight to the origin else, and adds to friction.

    sigma_e(x) = t_0 x/g_0 exp(1 - x/g_0) has its largest value, the `strength` t_0, at the `opening` g_0. The bond
    phi = phi_0 s d falls by sliding, s, and by the largest gap kappa: d = sigma_e(kappa)/t_0 beyond g_0. The limit of
    the tangential traction is mu(phi) (p + c phi t_0), c being the `share`.
    """

    def __init__(self, friction, stiffness, strength, opening, share):
        super().__init__(friction, stiffness)
        self.strength, self.opening, self.share = strength, opening, share

    def bonds(self, history):
        return history.touched & (history.bonded > 0) & (self.strength > 0)

    def kappa(self, begin, gap):
        return np.where(begin.bonds, np.maximum(begin.kappa, gap), begin.kappa)

    def gone(self, kappa):
        return kappa > 20 * self.opening

    def _left(self, kappa):
        """d and its derivative by kappa."""
        if self.strength == 0:
            return np.ones(kappa.shape), 0 * kappa
        x = kappa / self.opening
        softens = x > 1
        return (np.where(softens, x * np.exp(1 - x), 1.),
                np.where(softens, (1 - x) * np.exp(1 - x) / self.opening, 0.))

    def _stiffness(self, kappa):
        """K(kappa) of the whole bond, MPa/mm."""
        return self.strength / self.opening * np.exp(1 - kappa / self.opening)

    def bond(self, history):
        return super().bond(history) * self._left(history.kappa)[0]

    def pressure(self, begin, way, gap):
        s, by_way = self.friction.bonding(begin.slid + way)
        kappa = self.kappa(begin, gap)
        pull = begin.bonded * self._stiffness(kappa) * np.where(begin.bonds, gap, 0.)
        softer = np.where(gap >= kappa, 1 - gap / self.opening, 1.) * begin.bonds  # d(pull)/d(gap), relative
        opened = gap > 0
        return (np.where(opened, -s * pull, -self.normal * gap),
                np.where(opened, -s * begin.bonded * self._stiffness(kappa) * softer, -self.normal),
                np.where(opened, -by_way * pull, 0.))

    def string(self, begin, way, gap):
        p, p_by_gap, p_by_way = self.pressure(begin, way, gap)
        kappa = self.kappa(begin, gap)
        s, s_by_way = self.friction.bonding(begin.slid + way)
        left, by_kappa = self._left(kappa)
        phi, phi_by_way = begin.bonded * left * s, begin.bonded * left * s_by_way
        phi_by_gap = np.where(begin.bonds & (gap >= kappa), begin.bonded * by_kappa * s, 0.)
        difference = self.friction.unbroken - self.friction.broken
        mu = self.friction.broken + difference * phi
        cohesion = self.share * self.strength
        limit = p + cohesion * phi
        bears = limit > 1e-14 * np.maximum(np.abs(p), cohesion * phi)
        by_gap = difference * phi_by_gap * limit + mu * (p_by_gap + cohesion * phi_by_gap)
        by_way = difference * phi_by_way * limit + mu * (p_by_way + cohesion * phi_by_way)
        return (*(np.where(bears, value, 0.) / self.tangential for value in (mu * limit, -by_gap, by_way)),
                begin.bonds | (p > 0))

    def _stored(self, bonded, slid, kappa, gap):
        """Energy per area of bonds that pull, N/mm."""
        return bonded * self.friction.bonding(slid)[0] * self._stiffness(kappa) * np.maximum(gap, 0) ** 2 / 2

    def stored(self, begin, way, gap):
        kappa = self.kappa(begin, gap)
        pulls = self._stored(begin.bonded, begin.slid + way, kappa, gap) * begin.bonds * ~self.gone(kappa)
        return np.where(gap > 0, pulls, self.normal * gap ** 2 / 2)

    def lost(self, kappa):
        """D(kappa): work of the whole bond up to the gap kappa less what is stored there, N/mm."""
        x = kappa / self.opening
        work = np.e * self.strength * self.opening * (-np.expm1(-x) - x * np.exp(-x))
        return work - self._stiffness(kappa) * kappa ** 2 / 2

    def damage(self, begin, way, gap):
        kappa = self.kappa(begin, gap)
        s_before, s = (self.friction.bonding(slid)[0] for slid in (begin.slid, begin.slid + way))
        stored_before, stored = (self._stiffness(k) * np.maximum(g, 0) ** 2 / 2
                                 for k, g in ((begin.kappa, begin.normal_gap), (kappa, gap)))
        opened = (s_before + s) / 2 * (self.lost(kappa) - self.lost(begin.kappa))
        result = opened - (s - s_before) * (stored_before + stored) / 2 + self.gone(kappa) * s * stored
        return begin.bonds * begin.bonded * result

    def adhesive_work(self, begin, way, before, after):
        if self.strength == 0:
            return super().adhesive_work(begin, way, before, after)
        pressure = (np.maximum(before.pressure, 0) + np.maximum(after.pressure, 0)) / 2
        return ((before.limit + after.limit) / 2 - self.friction.broken * pressure) * way


class MixedMode(Friction):
    """A bilinear cohesive law holds the bonded share of the area where it bonded; the broken share rubs with mu_b.

    The gap (n, delta_t) [mm] from there bears phi_0 (1 - omega) K (<n>, delta_t) until it is broken, omega = 1. In a
    fixed direction, let q be the gap as a multiple of that where damage begins, (<t_n>/N)^2 + (t/T)^2 = 1, and r the
    same at the end, after the energy G of the criterion. Then omega = (1 - 1/q) r/(r - 1), and it never falls.

    strengths   N and T, MPa
    energies    G_I and G_II, N/mm
    initial     stiffness K, MPa/mm
    power_law   (G_i/G_I)^exponent + (G_ii/G_II)^exponent = 1 instead of Benzeggagh and Kenane's G
    """

    cohesive = True

    def __init__(self, friction, stiffness, strengths, energies, initial, power_law, exponent):
        super().__init__(friction, stiffness)
        self.onset = np.array(strengths) / initial  # mm
        self.energies, self.initial, self.power_law, self.exponent = energies, initial, power_law, exponent
        if min(2 * energy / initial / onset ** 2 for energy, onset in zip(energies, self.onset)) <= 1:
            raise ValueError('a bond breaks before it is damaged: more energy or stiffness')

    def bonds(self, history):
        return history.touched & (history.bonded > 0) & (history.omega < 1)

    def bond(self, history):
        return history.bonded * (1 - history.omega)

    def pressure(self, begin, way, gap):
        closed = gap < 0
        return np.where(closed, -self.normal * gap, 0.), np.where(closed, -self.normal, 0.), 0 * way

    def string(self, begin, way, gap):
        ratio = self.normal / self.tangential * self.friction.broken
        rubs = (1 - begin.bonds * begin.bonded * (1 - begin.omega)) * (gap < 0)
        return ratio * rubs * -gap, ratio * rubs, 0 * way, gap < 0

    def coefficient(self, begin, way):
        return self.friction.broken * (1 - begin.bonds * begin.bonded * (1 - begin.omega)) + 0 * way

    def by_omega(self, begin, gap):
        """Derivative of L / eps_t by omega, mm."""
        return self.normal / self.tangential * self.friction.broken * begin.bonds * begin.bonded * np.maximum(-gap, 0)

    def adhesive_work(self, begin, way, before, after):
        return 0 * way

    def energy_to_break(self, share):
        """G [N/mm] where the `share` delta_t^2/delta^2 of the squared gap is tangential, and its derivative."""
        first, second = self.energies
        if self.power_law:
            parts = (1 - share) / first, share / second
            energy = (parts[0] ** self.exponent + parts[1] ** self.exponent) ** (-1 / self.exponent)
            slopes = (np.maximum(part, 1e-300) ** (self.exponent - 1) for part in parts)
            return energy, energy ** (1 + self.exponent) * (next(slopes) / first - next(slopes) / second)
        slope = self.exponent * np.maximum(share, 1e-300) ** (self.exponent - 1)
        return first + (second - first) * share ** self.exponent, (second - first) * slope

    def broken(self, normal, tangential):
        """omega on first opening to a gap [mm], and its derivatives by both parts of that."""
        normal = np.maximum(normal, 0)
        squared = np.maximum(normal ** 2 + tangential ** 2, 1e-300)
        q = np.maximum(np.hypot(normal / self.onset[0], tangential / self.onset[1]), 1e-150)
        share = tangential ** 2 / squared
        energy, slope = self.energy_to_break(share)
        r = 2 * energy * q ** 2 / (self.initial * squared)
        omega = np.where(q > 1, (1 - 1 / q) * r / (r - 1), 0.)
        softens = (omega > 0) & (omega < 1)
        derivatives = []
        for gap, onset, of_share in ((normal, self.onset[0], -2 * normal * share / squared),
                                     (tangential, self.onset[1], 2 * tangential * (1 - share) / squared)):
            of_q = gap / (onset ** 2 * q)
            of_r = r * (slope * of_share / energy + 2 * of_q / q - 2 * gap / squared)
            change = of_q / q ** 2 * r / (r - 1) - (1 - 1 / q) * of_r / (r - 1) ** 2
            derivatives.append(np.where(softens, change, 0.))
        return np.minimum(omega, 1), *derivatives

    def hold(self, begin, gap, normal):
        """Of bonded points with a gap (m, 3) from where they bonded, and the master's normal (m, 3) there.

        The `gap` that bears, <n> and delta_t; omega and its derivative (m, 3); stiffness and traction (m, 3) with its
        derivative (m, 3, 3). All is 0 where there is no bond.
        """
        along = (gap * normal).sum(1)
        tangential = gap - along[:, None] * normal
        length = np.linalg.norm(tangential, axis=1)
        omega, by_normal, by_length = self.broken(along, length)
        grows = begin.bonds & (omega > begin.omega)
        omega = np.where(grows, omega, begin.omega)
        opened = along > 0
        bears = (tangential + np.where(opened, along, 0.)[:, None] * normal) * begin.bonds[:, None]
        slope = ((by_normal * opened)[:, None] * normal
                 + by_length[:, None] * tangential / np.maximum(length, 1e-300)[:, None]) * grows[:, None]
        stiffness = begin.bonds * begin.bonded * (1 - omega) * self.initial
        both = normal[:, :, None] * normal[:, None, :] * ~opened[:, None, None]
        derivative = (stiffness[:, None, None] * (np.eye(3) - both)
                      - (begin.bonded * self.initial)[:, None, None] * bears[:, :, None] * slope[:, None, :])
        return bears, omega, slope, stiffness, stiffness[:, None] * bears, derivative
