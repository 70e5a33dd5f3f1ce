#!/usr/bin/env python3
"""Torque of a rigid disk under a compliant machine against an independent computation: rings that slide on their own with
the speed V of

  viscous     eta V = max(0, eps (r theta - d) - mu(d) p),                                     a bond that breaks
  stick_slip  p (mu_0 + A ln(1 + V/V_0) + B psi) + eta V = eps (r theta - d),                  rate and state friction
              psi' = V_0 e^(-psi)/D - V/D,   psi = ln(V_0 state/D),

while the disk is in balance with the spring, k (theta_m - theta) = 2 pi int r^2 eps (r theta - d) dr, integrated in time.

    tests/comparison/rings.py build/release/debond viscous|stick_slip DIRECTORY      results of the runs go there

The scenes are prm/stability/snap_back_viscous.prm and prm/stick_slip.prm, which cite these numbers. Implicit steps of the
program are of first order in their size: with twice as many its deviation is half as large, and one extrapolation takes it
away.
"""
import csv
import math
import subprocess
import sys

import numpy as np
from scipy.integrate import solve_ivp

R, EPS = 2.5, 585.  # radius [mm], stiffness of the interface [MPa/mm]


class Rings:
    """The state is the sliding distance of each ring, then what else the law knows of it, and last the viscous work."""

    def __init__(self, parts, k, turning, eta):
        abscissas, weights = np.polynomial.legendre.leggauss(20)
        half = 0.5 * R / parts
        self.r = ((2 * np.arange(parts)[:, None] + 1) * half + half * abscissas).ravel()
        self.weight = 2. * math.pi * self.r * np.tile(half * weights, parts)
        self.k, self.turning, self.eta = k, turning, eta

    def angle(self, time, slip):
        """Of the disk; SLIP has a row for each ring."""
        moment = EPS * np.einsum('i,i...->...', self.weight * self.r, slip)
        return (self.k * self.turning * time + moment) / (self.k + EPS * self.weight @ self.r**2)

    def solve(self, times, start):
        """Torque at TIMES, and the viscous work at the end."""
        n = len(self.r)
        with np.errstate(all='ignore'):  # of steps that are tried
            done = solve_ivp(self.rate, (times[0], times[-1]), np.append(start, 0.), 'RK45', times, rtol=1e-8, atol=1e-9)
        assert done.success, done.message
        return self.k * (self.turning * done.t - self.angle(done.t, done.y[:n])), done.y[-1, -1]

    def rate(self, time, state):
        n = len(self.r)
        over = EPS * (self.r * self.angle(time, state[:n]) - state[:n])
        speed, rest = self.speed(over, state[:n], state[n:-1])
        return np.concatenate((speed, rest, [self.weight @ speed**2 * self.eta]))


class ViscousRings(Rings):
    """A bond of the modified law of Coulomb."""
    p, mu_b, mu_ub, a_s, b_s = 2.6, 0.40, 0.58, 0.005, 0.3

    def speed(self, traction, slip, rest):
        x = np.clip((slip / self.a_s - 1.) / (2. * self.b_s), 0., 1.)
        bond = 0.5 - 0.5 * np.sin(math.pi * (x - 0.5))
        return np.maximum(0., traction - self.p * (self.mu_b + (self.mu_ub - self.mu_b) * bond)) / self.eta, rest


class RateAndStateRings(Rings):
    p, mu_0, A, B, V_0, D = 585. * 0.0049, 0.4, 0.01, 0.03, 1e-3, 0.01

    def speed(self, traction, slip, psi):
        """p A ln(1 + V/V_0) + eta V = over, by Newton's method in u = ln(1 + V/V_0), where the left-hand side is convex."""
        over = traction - self.p * (self.mu_0 + self.B * psi)
        positive = np.maximum(over, 0.)
        u = np.minimum(positive / (self.p * self.A), np.log1p(positive / (self.eta * self.V_0)))
        for _ in range(50):
            excess = self.p * self.A * u + self.eta * self.V_0 * np.expm1(u) - positive
            step = excess / (self.p * self.A + self.eta * self.V_0 * np.exp(u))
            u -= step
            if np.all(np.abs(step) <= 1e-13 * np.abs(u)):
                break
        V = self.V_0 * np.expm1(u)
        return V, (self.V_0 * np.exp(-psi) - V) / self.D


FAILED = []


def report(what, deviation, limit):
    FAILED.extend([what] if not abs(deviation) < limit else [])
    print(f'{what}: {deviation:.3g}, allowed {limit:g}')


def rows_of(debond, scene, directory, *entries):
    """Times since the push-in, torques, and the last row."""
    subprocess.run([debond, scene, '--force', '--set', 'Output/Directory=' + directory, '--set', 'Output/Report=false',
                    *(word for entry in entries for word in ('--set', entry))], stdout=subprocess.DEVNULL, check=True)
    with open(directory + '/torque.csv', newline='') as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)][1:]
    return np.array([row['time'] - 1. for row in rows]), np.array([row['torque_Nmm'] for row in rows]), rows[-1]


def check_viscous(debond, directory):
    turning, eta = math.radians(2.), 1.
    rings = ViscousRings(20, 3000., turning, eta)
    at_rest = np.zeros(len(rings.r))
    of_torque, of_work = {}, {}
    for steps in (500, 1000):
        times, torques, last = rows_of(debond, 'prm/stability/snap_back_viscous.prm', f'{directory}/{steps}',
                                       f'Load steps/Steps=1, {steps}', f'Interface/Viscosity={eta}')
        exact, work = rings.solve(times, at_rest)
        of_torque[steps] = np.max(np.abs(torques - exact)) / max(torques)
        of_work[steps] = last['viscous_work_Nmm'] / work - 1.
    report('torque, relative to the largest', of_torque[1000], 6e-3)
    report('its deviation over that with half the steps, from 1/2', of_torque[1000] / of_torque[500] - 0.5, 0.01)
    report('viscous work', of_work[1000], 5e-3)
    report('viscous work, extrapolated', 2. * of_work[1000] - of_work[500], 1e-3)
    # The motion before and after the jump is slow, and its viscous work vanishes with eta; that of the jump tends to what
    # the closed form of prm/stability/snap_back.prm releases.
    released = 0.012767
    over = [ViscousRings(4, 3000., turning, eta).solve([0., 1.], np.zeros(80))[1] / released for eta in (0.1, 0.01)]
    report('viscous work over the energy released without, eta = 0.01, from 1', over[1] - 1., 0.12)
    report('over that with eta = 0.1', (over[1] - 1.) / (over[0] - 1.), 0.2)
    torques, work = ViscousRings(20, 3000., turning, 0.2).solve(np.linspace(0., 1., 2001), at_rest)
    report('the scene cites the largest torque', max(torques) / 49.301 - 1., 1e-4)
    report('and the viscous work', work / 0.02896 - 1., 1e-3)


def cycle_of(times, torques):
    """Torque before and after the second slip, and the time between its end and that of the first one."""
    inner = torques[1:-1]
    peaks = torques[1:-1][(inner >= torques[:-2]) & (inner > torques[2:])]
    low = (inner <= torques[:-2]) & (inner < torques[2:])
    return np.array([peaks[1], inner[low][1], times[1:-1][low][1] - times[1:-1][low][0]])


def check_stick_slip(debond, directory):
    rings = RateAndStateRings(4, 200., math.radians(10.), 0.02)
    n = len(rings.r)
    at_rest = np.concatenate((np.zeros(n), np.full(n, math.log(1. + rings.V_0 / rings.D))))  # aged while it was pressed
    of_cycle = {}
    for steps in (800, 1600):
        times, torques, _ = rows_of(debond, 'prm/stick_slip.prm', f'{directory}/{steps}', 'Load steps/Times=0, 1, 2, 2.8',
                                    f'Load steps/Steps=1, 20, {steps}')
        exact, _ = rings.solve(times, at_rest)
        of_cycle[steps] = cycle_of(times, torques) / cycle_of(times, exact) - 1.
        if steps == 1600:
            report('the scene cites the largest torque', max(exact) / 41.502 - 1., 1e-3)
    coarse, fine = of_cycle[800], of_cycle[1600]
    report('torque before the slip, half the steps over all, from 2', coarse[0] / fine[0] - 2., 0.1)
    # the period is as fine as a step, 0.2 %
    limits = {'torque before the slip': 5e-4, 'torque after it': 1e-3, 'period': 6e-3}
    for (name, limit), deviation in zip(limits.items(), 2. * fine - coarse):
        report(f'{name}, extrapolated', deviation, limit)


if __name__ == '__main__':
    {'viscous': check_viscous, 'stick_slip': check_stick_slip}[sys.argv[2]](sys.argv[1], sys.argv[3])
    sys.exit(1 if FAILED else 0)
