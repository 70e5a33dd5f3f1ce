#!/usr/bin/env python3
"""Makes prm/verification/data/cap_pulled_off.csv: the pull-off force of a rigid sphere on an elastic half space, F/(pi w Rc), over
Maugis' parameter lambda = 2 t_0 (Rc/(pi w K^2))^(1/3), K = 4/3 E*, for two laws of the same work w and strength t_0:

    dugdale      t_0 up to the gap w/t_0: closed form of Maugis (J. Colloid Interface Sci. 150 (1992) 243)
    exponential  t_0 (g/g_0) exp(1 - g/g_0), w = e t_0 g_0, as Law = adhesive has it: solved here on rings

It first checks itself: the limits 1.5 (JKR) and 2 (DMT), Hertz, and Maugis' values with the solution on rings, whose law is then
one of constant strength with short ramps. Run it at the top of the project (a minute; needs NumPy). With --parts it prints instead
what rings say of the scene prm/verification/cap_pulled_off.prm: the effects of its penalty stiffness and of its small face.

Units: lengths along the face a_c = (pi w Rc^2/K)^(1/3), gaps a_c^2/Rc, pressures K a_c/Rc, forces pi w Rc.
"""
import math
import sys

import numpy as np


def dugdale(lam):
    """Closed form: m = c/a, the radius of the zone that pulls over that of contact; a from a quadratic equation."""
    m = 1 + np.logspace(-6, 5, 200001)
    root, angle = np.sqrt(m * m - 1), np.arccos(1 / m)
    p, q = lam / 2 * (root + (m * m - 2) * angle), 4 * lam**2 / 3 * (root * angle - m + 1)
    a = 2 / (q + np.sqrt(q * q + 4 * p))
    return -(a**3 - lam * a**2 * (root + m * m * angle)).min()


def elliptic(k2):
    """Complete integrals K and E of k^2, by the mean of Gauss."""
    a, b = np.ones_like(k2), np.sqrt(1 - k2)
    total, weight = k2 / 2, .5
    for _ in range(8):
        a, b, c = (a + b) / 2, np.sqrt(a * b), (a - b) / 2
        weight *= 2
        total = total + weight * c * c
    return math.pi / (2 * a), math.pi / (2 * a) * (1 - total)


class Rings:
    """A half space under pressures that are constant on n rings."""

    def __init__(self, radius, n):
        border = np.linspace(0, radius, n + 1)
        self.r, self.area = (border[1:] + border[:-1]) / 2, math.pi * np.diff(border**2)
        r, b = np.meshgrid(self.r, border[1:], indexing='ij')
        K, E = elliptic(np.minimum(r / b, b / r)**2)
        disk = 4 / math.pi * np.where(r < b, b * E, r * (E - (1 - (b / r)**2) * K))  # Johnson, Contact Mechanics, section 3.4
        self.sinks = 4 / 3 * np.diff(disk, axis=1, prepend=0)  # by unit pressure: 1/E* = 4/3 of 1/K
        self.matrix = np.eye(n)

    def gap(self, depth, law, gap):
        """Newton's method from the state before; None if it fails."""
        for _ in range(200):
            p, slope = law(gap)
            step = np.linalg.solve(self.matrix - self.sinks * slope, self.r**2 / 2 - depth + self.sinks @ p - gap)
            largest = np.abs(step).max()
            gap = gap + step * min(1, .3 / largest)
            if largest < 1e-9:
                return gap
        return None

    def pull_off(self, law, depths):
        """The largest pull on the way up from the first depth: the top of a parabola."""
        gap, forces = np.maximum(self.r**2 / 2 - depths[0], 0), []
        for depth in depths:
            gap = self.gap(depth, law, gap)
            if gap is None:
                break
            forces.append(self.area @ law(gap)[0])
            if len(forces) > 2 and forces[-1] > forces[-2] and forces[-2] < -1:
                a, b, c = forces[-3:]
                return -(b - (c - a)**2 / (8 * (a - 2 * b + c)))
        raise RuntimeError('no largest pull')


def bond(lam, stiffness=2000., face=math.inf, r=None):
    """Law = adhesive on a face of that radius; stiffness: the penalty."""
    t_0, g_0 = lam / 2, 2 / (math.e * math.pi * lam)

    def law(gap):
        x = np.maximum(gap, 0) / g_0
        bonded = 1. if r is None else r < face
        return (np.where(gap < 0, -stiffness * gap, -t_0 * bonded * x * np.exp(1 - x)),
                np.where(gap < 0, -stiffness, -t_0 * bonded / g_0 * (1 - x) * np.exp(1 - x)))
    return law


def constant(lam, stiffness=2000., ramp=.04):
    """Dugdale's law with ramps at both ends."""
    t_0 = lam / 2
    opening = 1 / math.pi / t_0  # w/t_0
    x = opening * np.array([0, ramp, 1 - ramp / 2, 1 + 3 * ramp / 2])
    y = np.array([0, -t_0, -t_0, 0])
    def law(gap):
        i = np.clip(np.searchsorted(x, gap, 'right') - 1, 0, 3)
        slope = np.append(np.diff(y) / np.diff(x), 0)
        return (np.where(gap < 0, -stiffness * gap, y[i] + slope[i] * (gap - x[i])), np.where(gap < 0, -stiffness, slope[i]))
    return law


def exponential(lam, n=None, steps=300, **parts):
    """Enough rings for the zone that pulls, which is short where lambda is large."""
    g_0 = 2 / (math.e * math.pi * lam)
    rings = Rings(max(2.4, 4.5 * math.sqrt(g_0) + 1), n or (200 if lam < 2 else 400))
    return rings.pull_off(bond(lam, r=rings.r, **parts), np.linspace(1, -.8 - g_0, steps))


def check(name, value, exact, tolerance):
    print('%-60s %.4f, %.4f expected' % (name, value, exact))
    if abs(value / exact - 1) > tolerance:
        sys.exit('cap_pulled_off.py: this is wrong')


def check_all():
    check('Maugis, lambda = 1e-4: DMT', dugdale(1e-4), 2, 1e-4)
    check('Maugis, lambda = 100: JKR', dugdale(100), 1.5, 1e-4)
    rings = Rings(1.5, 300)
    gap = rings.gap(1., lambda g: (np.where(g < 0, -1e5 * g, 0), np.where(g < 0, -1e5, 0)), np.maximum(rings.r**2 / 2 - 1, 0))
    check('rings, Hertz at the depth 1: force', rings.area @ np.where(gap < 0, -1e5 * gap, 0), 1, 5e-3)
    for lam in (.1, .3, .7):
        rings = Rings(max(2.4, 2.5 * math.sqrt(1 / lam)), 400)
        check('rings, constant strength, lambda = %g' % lam, rings.pull_off(constant(lam), np.linspace(1, -2, 600)), dugdale(lam), 1e-2)
    check('rings, exponential, lambda = 0.01: DMT', exponential(.01), 2, 5e-3)
    check('rings, exponential, lambda = 1: 400 rings against 200', exponential(1., 400), exponential(1.), 5e-4)


def parts():
    """The bone of the scene: Rc = 50 mm, t_0 = 5 MPa, g_0 = 0.005 mm."""
    w = math.e * 5 * .005
    print('%8s %8s %12s %12s %20s %14s %12s %18s' % ('E [MPa]', 'lambda', 'F/(pi w Rc)', 'Maugis [N]', '2700 MPa/mm: effect', '2.5 mm: effect',
                                                   '400 rings', 'F with both [N]'))
    for E in (10000, 4000, 2000, 1000, 500, 300, 200):
        K = 4 / 3 * E / .91
        lam, a_c, force = 10 * (50 / (math.pi * w * K * K))**(1 / 3), (math.pi * w * 2500 / K)**(1 / 3), math.pi * w * 50
        F = exponential(lam)
        soft, small, fine = (exponential(lam, **part) / F - 1
                             for part in ({'stiffness': 2700 * a_c / K}, {'face': 2.5 / a_c}, {'n': 400, 'steps': 150}))
        print('%8g %8.4f %12.4f %12.3f %18.2f %% %12.3f %% %10.3f %% %18.3f' % (
            E, lam, F, force * dugdale(lam), 100 * soft, 100 * small, 100 * fine, force * F * (1 + soft + small)), flush=True)


def main():
    check_all()
    if sys.argv[1:] == ['--parts']:
        parts()
        return
    with open('prm/verification/data/cap_pulled_off.csv', 'w', encoding='utf-8') as table:
        table.write('# Pull-off force of a rigid sphere on an elastic half space over pi w Rc, made by doc/verification/cap_pulled_off.py\n'
                    'lambda,dugdale,exponential\n')
        for lam in np.logspace(math.log10(.03), math.log10(5), 24):
            table.write('%.5g,%.5f,%.5f\n' % (lam, dugdale(lam), exponential(lam)))


if __name__ == '__main__':
    main()
