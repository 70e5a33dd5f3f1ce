#!/usr/bin/env python3
"""Exact solutions of contact on elastic half spaces, and a test of them and of the curves in prm/verification/data that
are theirs. Lengths in mm, forces in N, stresses and moduli in MPa, angles in radians.

Sources: Johnson, Contact Mechanics (1985), sections 3.7 to 3.9, 4.2, 7.2 and 7.4; Reissner and Sagoci, J. Appl. Phys. 15
(1944) 652; Lubkin, J. Appl. Mech. 18 (1951) 183; Jaeger, Arch. Appl. Mech. 65 (1995) 478 for the superposition of rigid
rotations.
"""
import csv
import math
import os
import sys

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

PI = math.pi


def leg(b, a):
    """sqrt(b^2 - a^2) without cancellation, 0 for a > b."""
    return math.sqrt(max(0., (b - a) * (b + a)))


def integral(f, start, end):
    return quad(f, start, end, epsabs=0., epsrel=1e-12, limit=400)[0] if end > start else 0.


def reissner_sagoci_torque(G, R, angle):
    """Torque of a rigid disk that is bonded to a half space and turned."""
    return 16. / 3. * G * R**3 * angle


def torque_through_layer(compliance, n):
    """Torque of a disk on an elastic layer over that without, compliance = G / (eps_t R). With the traction written as a
    sum of rigid rotations of smaller disks, tau(r) = 4 G r/pi int_r^R g(s) / sqrt(s^2 - r^2) ds, displacement plus tau/eps_t
    being theta r becomes

      int_r^R g ds + 2/pi int_0^r g [asin x - x sqrt(1 - x^2)] ds, x = s/r,
      + 4 G / (pi eps_t) int_r^R g / sqrt(s^2 - r^2) ds = theta,

    and T = 16/3 G int_0^R g s^3 ds: by collocation for a piecewise constant g, on n intervals that become short towards the
    edge."""
    def towards_edge(i):
        return 1. - (1. - i / n)**4

    def outside(x):
        """Integral of 2/pi [asin x - x sqrt(1 - x^2)]."""
        y = np.sqrt(np.maximum(0., 1. - x * x))
        return 2. / PI * (x * np.arcsin(x) + y + y**3 / 3.)
    ends, r = towards_edge(np.arange(n + 1.)), towards_edge(np.arange(n) + 0.5)[:, None]
    high, low = np.maximum(ends, r) / r, np.minimum(ends, r) / r
    A = r * np.diff(high) + 4. / PI * compliance * np.diff(np.arccosh(high)) + r * np.diff(outside(low))
    return np.linalg.solve(A, np.ones(n)) @ np.diff(ends**4) / 4.


def layer_torque(G, R, angle, eps_t):
    """Torque of full stick through a layer of the stiffness eps_t [MPa/mm]; the error falls like n^(-3/2), to 2e-5."""
    coarse, fine = (torque_through_layer(G / (eps_t * R), n) for n in (150, 300))
    return (fine + (fine - coarse) / (2.**1.5 - 1.)) * reissner_sagoci_torque(G, R, angle)


class TorsionalPartialSlip:
    """A circular contact on a half space that is twisted. The traction is limited by q(r) = mu p(r), so the rim slips and a
    disk of the radius c sticks. Torsion does not change p. When the stick radius is s and the angle grows by dtheta, the
    disk r < s turns like a rigid one, so T grows by 16/3 G s^3 dtheta and the traction by (4 G/pi) r dtheta / sqrt(s^2 - r^2).
    That the sum of these is q(r) for r > c is an equation of Abel's type with the solution

      theta(c) = 1/(2G) int_c^R q(r) dr / sqrt(r^2 - c^2),
      T(c) = 4 int_c^R q(r) [2/3 c^3 / sqrt(r^2 - c^2) + r^2 arccos(c/r) + c sqrt(r^2 - c^2)] dr,

    and the traction at r < c is 2/pi r sqrt(c^2 - r^2) int_c^R q(s) ds / ((s^2 - r^2) sqrt(s^2 - c^2)). The limit is a
    function of r and sqrt(R^2 - r^2), which cannot be had from r at the edge without losing digits."""

    def __init__(self, R, G, q):
        self.R, self.G, self.q = R, G, q

    def integrate(self, c, scale, f):
        """int_c^R f q / sqrt(r^2 - c^2) dr for f(r, sqrt(r^2 - c^2)) that varies over the length SCALE near c. There
        x = sqrt(r^2 - c^2) = scale sinh(v); near R, x = X sin(phi), where q dx is regular."""
        X = max(leg(self.R, c), 1e-50 * self.R)

        def part(x, to_edge):
            r = math.hypot(c, x)
            return f(r, x) * self.q(r, to_edge) / r
        middle = math.sqrt(0.5) if scale > 0. else 0.
        inner = integral(lambda v: part(scale * math.sinh(v), leg(X, scale * math.sinh(v))) * scale * math.cosh(v),
                         0., math.asinh(middle * X / scale)) if scale > 0. else 0.
        return inner + integral(lambda phi: part(X * math.sin(phi), X * math.cos(phi)) * X * math.cos(phi),
                                math.asin(middle), PI / 2.)

    def angle_at_stick_radius(self, c):
        return self.integrate(c, c, lambda r, x: 1.) / (2. * self.G)

    def torque_at_stick_radius(self, c):
        return 4. * self.integrate(c, c, lambda r, x: 2. / 3. * c**3 + x * (r * r * math.atan2(x, c) + c * x))

    def traction(self, r, c):
        if r >= c:
            return self.q(r, leg(self.R, r))
        inside = leg(c, r)
        return 2. / PI * r * inside * self.integrate(c, inside, lambda s, x: 1. / (inside * inside + x * x))

    def stick_radius(self, theta):
        """Zero when it is below 1e-8 R."""
        def excess(log_k):
            return self.angle_at_stick_radius(self.R * math.exp(log_k)) - theta
        smallest = math.log(1e-8)
        if excess(0.) >= 0. or excess(smallest) <= 0.:
            return self.R if excess(0.) >= 0. else 0.
        return self.R * math.exp(brentq(excess, smallest, 0., xtol=1e-14))

    def torque(self, theta):
        """dT/dtheta = 16/3 G c^3 makes up for what the root lacks, and for all of the angle before slip begins."""
        c = self.stick_radius(theta)
        if c == 0.:
            return self.torque_at_stick_radius(0.)
        return self.torque_at_stick_radius(c) + reissner_sagoci_torque(self.G, c, theta - self.angle_at_stick_radius(c))


def uniform(q):
    return lambda r, to_edge: q


def flat_punch(R, mu, P):
    return lambda r, to_edge: mu * P / (2. * PI * R) / to_edge


def hertz(a, mu, P):
    return lambda r, to_edge: 3. * mu * P / (2. * PI * a**3) * to_edge


FAILED = []


def report(what, deviation, limit):
    FAILED.extend([what] if not deviation < limit else [])
    print(f'{what} below {limit:g}: {"yes" if deviation < limit else f"NO, {deviation}"}')


def relative(ours, expected):
    return abs(ours / expected - 1.)


def check_torsion(R=2.5, G=6900., mu=0.3, P=70., q=1.4):
    plain, punch, ball = (TorsionalPartialSlip(R, G, limit) for limit in (uniform(q), flat_punch(R, mu, P), hertz(R, mu, P)))
    # an independent computation
    known = {0.9: 0.536879, 0.7: 0.824613, 0.5: 0.942331, 0.3: 0.988216, 0.1: 0.999574}
    T_max = 2. / 3. * PI * q * R**3
    report('uniform: T/T_max against known values',
           max(abs(plain.torque_at_stick_radius(k * R) / T_max - ratio) for k, ratio in known.items()), 1e-6)
    report('uniform: T against 4/3 q R^3 [arccos k + k sqrt(1 - k^2)]',
           max(relative(plain.torque_at_stick_radius(k * R), 4. / 3. * q * R**3 * (math.acos(k) + k * leg(1., k)))
               for k in known), 1e-11)
    report('uniform: theta against q/(2G) arcosh(1/k)',
           max(relative(plain.angle_at_stick_radius(k * R), q / (2. * G) * math.acosh(1. / k)) for k in known), 1e-11)
    report('uniform: at a thousand times the angle of T_max/2', relative(plain.torque(1000. * q / G), T_max), 1e-11)
    report("uniform: slope at the start is Reissner's and Sagoci's",
           relative(plain.torque(1e-6 * q / G), reissner_sagoci_torque(G, R, 1e-6 * q / G)), 1e-10)
    rims = [(k * R, 1. - k * k) for k in (0.999, 0.9, 0.5, 0.1, 0.001)]
    unit = mu * P / (4. * PI * G * R * R)
    report('flat punch: theta against mu P / (4 pi G R^2) K(k\')',
           max(relative(punch.angle_at_stick_radius(c), unit * ellipk(m)) for c, m in rims), 1e-11)
    report("Hertz: theta against Lubkin's",
           max(relative(ball.angle_at_stick_radius(c), 3. * unit * (ellipk(m) - ellipe(m))) for c, m in rims), 1e-9)
    for name, problem, largest in (('uniform', plain, T_max), ('flat punch', punch, PI / 4. * mu * P * R),
                                   ('Hertz', ball, 3. * PI / 16. * mu * P * R)):
        report(f'{name}: T_max', relative(problem.torque_at_stick_radius(0.), largest), 1e-11)
        # the same torque from the angles alone, as it first comes; s = R cos(t)
        def moment_of_angle(t):
            return (R * math.cos(t))**2 * problem.angle_at_stick_radius(R * math.cos(t)) * R * math.sin(t)
        report(f'{name}: T by parts',
               max(relative(problem.torque_at_stick_radius(c),
                            reissner_sagoci_torque(G, c, problem.angle_at_stick_radius(c)) +
                            16. * G * quad(moment_of_angle, 0., math.acos(c / R), epsrel=1e-10)[0])
                   for c in (0.9 * R, 0.3 * R)), 1e-9)
        report(f'{name}: inverse',
               max(relative(problem.stick_radius(problem.angle_at_stick_radius(k * R)), k * R) for k in (0.95, 0.6, 0.2)), 1e-9)
        moment = jump = 0.
        for k in (0.9, 0.5, 0.1):
            c = k * R
            # r = c sin(phi) and r = R sin(phi): tractions have the slopes and poles of square roots at c and R
            def inner(phi):
                r = c * math.sin(phi)
                return r * r * problem.traction(r, c) * c * math.cos(phi)

            def outer(phi):
                r, w = R * math.sin(phi), R * math.cos(phi)
                return r * r * problem.q(r, w) * w
            sums = quad(inner, 0., PI / 2., epsrel=1e-10)[0] + quad(outer, math.asin(k), PI / 2., epsrel=1e-10)[0]
            moment = max(moment, relative(2. * PI * sums, problem.torque_at_stick_radius(c)))
            jump = max(jump, relative(problem.traction(c * (1. - 1e-12), c), problem.traction(c, c)))
        report(f'{name}: moment of the tractions against T', moment, 1e-8)
        report(f'{name}: jump of the traction at the stick radius', jump, 1e-5)
    # K(0) = pi/2: a flat punch sticks everywhere up to mu P / (8 G R^2)
    first = mu * P / (8. * G * R * R)
    report('flat punch: angle of first slip', relative(punch.angle_at_stick_radius(R), first), 1e-11)
    report("flat punch: full stick is Reissner's and Sagoci's",
           max(relative(punch.torque(part * first), reissner_sagoci_torque(G, R, part * first))
               for part in (0.01, 0.5, 0.999)), 1e-11)


def check_layer(R=2.5, G=6900.):
    """Full stick through an elastic layer: between bounds that meet for a soft layer, and without it for a stiff one."""
    rigid = reissner_sagoci_torque(G, R, 1.)
    stiffnesses = (1., 100., 1e3, 1e4, 1e5, 1e6, 1e8)
    torques = [layer_torque(G, R, 1., eps) for eps in stiffnesses]
    # from above: the face below the disk turns like a rigid one; from below: the traction is proportional to r
    report('elastic layer: excess over the upper bound',
           max(T * (1. / rigid + 1. / (PI / 2. * eps * R**4)) - 1. for eps, T in zip(stiffnesses, torques)), 1e-6)
    report('elastic layer: deficit to the lower bound',
           max(PI**2 / 4. * R**8 / (8. / 15. * R**5 / G + PI / 2. * R**4 / eps) / T - 1.
               for eps, T in zip(stiffnesses, torques)), 1e-6)
    report('elastic layer: fall with the stiffness', max(a / b - 1. for a, b in zip(torques, torques[1:])), 0.)
    report('elastic layer: stiff', relative(layer_torque(G, R, 1., 1e13), rigid), 2e-5)
    # An independent Galerkin solution: traction r (1 - r^2)^k, 28 terms, with exact Weber-Schafheitlin integrals. Scenes are
    # compared with these values.
    report('elastic layer: against a Galerkin solution',
           max(relative(layer_torque(18000. / 2.6, 2.5, math.radians(0.01), eps), torque)
               for eps, torque in ((1e4, 49.0218), (1e5, 88.3973), (1e6, 98.7987))), 2e-5)


def check_mindlin(mu=0.3, G=6900., approach=0.01, Rc=20., E=18000. / 0.91):
    """Hertz: a = sqrt(Rc d), P = 4/3 E* a d. Cattaneo and Mindlin: mu p of the whole contact less that of the disk
    c = a (1 - Q/(mu P))^(1/3) that sticks; the displacement is 3 mu P / (16 a) compliance (1 - (c/a)^2)."""
    a = math.sqrt(Rc * approach)
    P = 4. / 3. * E * a * approach
    pressure = hertz(a, 1., P)
    force = integral(lambda phi: a * math.sin(phi) * pressure(0., a * math.cos(phi)) * a * math.cos(phi), 0., PI / 2.)
    report('Hertz: pressure over the area', relative(2. * PI * force, P), 1e-12)
    report('Hertz: largest pressure', relative(pressure(0., a), 2. / PI * E * math.sqrt(approach / Rc)), 1e-12)
    q, sums = hertz(a, mu, P), 0.
    for part in (0.2, 0.7, 1.):
        c = a * (1. - part)**(1. / 3.)
        traction = integral(lambda r: r * q(r, leg(a, r)), 0., a) - integral(lambda r: r * q(r, leg(c, r)), 0., c)
        sums = max(sums, relative(2. * PI * traction, part * mu * P))
    report('Mindlin: traction over the area', sums, 1e-6)
    small, compliance = 1e-6, 1.7 / G
    displacement = 3. * mu * P / (16. * a) * compliance * (1. - (1. - small)**(2. / 3.))
    report('Mindlin: stiffness of full stick', relative(displacement, small * mu * P * compliance / (8. * a)), 1e-6)


def check_published_curves(directory):
    """The curves that scenes are compared with; lubkin.csv was computed independently, by the arithmetic-geometric mean."""
    bone = 18000. / 2.6
    slip = TorsionalPartialSlip(2.5, bone, uniform(0.1))
    sphere = TorsionalPartialSlip(0.5, 6300., hertz(0.5, 0.1, 60.))
    for name, torque, rows, limit in (('reissner_sagoci', lambda angle: reissner_sagoci_torque(bone, 2.5, angle), 11, 1e-9),
                                      ('torsional_partial_slip', slip.torque, 26, 1e-9), ('lubkin', sphere.torque, 21, 1e-6)):
        with open(f'{directory}/{name}.csv', newline='') as file:
            curve = [list(map(float, row)) for row in csv.reader(line for line in file if line[0] not in '#a')]
        report(f'{name}.csv [N mm]', max(abs(torque(math.radians(angle)) - T) for angle, T in curve), limit)
        report(f'{name}.csv: missing rows', abs(len(curve) - rows), 1)


if __name__ == '__main__':
    check_torsion()
    check_layer()
    check_mindlin()
    check_published_curves(os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../prm/verification/data'))
    sys.exit(1 if FAILED else 0)
