#!/usr/bin/env python3
"""Forces and stick radii for prm/verification/pressed_disk.prm: a rigid disk is pressed on an elastic half space with friction.
Run it at the top of the project; it takes some seconds and needs NumPy and SciPy. It knows nothing of finite elements: on rings
the pressure is constant, the radial traction proportional to the radius, and the surface follows from Hankel transforms
(Johnson, Contact mechanics, 3.8). As the face of contact does not grow, the radius of stick does not depend on the load
(Spence 1968, Proc. R. Soc. A 305, 55; 1975, J. Elasticity 5, 297). Forces are converged to 1e-5, radii to a ring: the smallest to
3 %. It checks itself with the limits: without friction (Boussinesq) and where all sticks
(Mossakovskii), both to 1e-5."""
import math
import sys

import numpy as np

sys.path.insert(0, 'doc/verification')
from bonds_reference import PULLED, R, pulled_up, turned  # noqa: E402  E = 18 000 MPa, nu = 0.3

NU, G, DEPTH = .3, 18000 / 2.6, 1e-3


def rings(n):
    border = R * (1 - (1 - np.linspace(0, 1, n + 1)) ** 3)
    return border, (border[1:] + border[:-1]) / 2


def influence(border, r):
    """[uz; ur] of [p; q], inwards and outwards: what couples them is (1 - 2 nu)/(2 G) times integrals within and beyond r."""
    within, beyond = np.minimum(border, r[:, None]), np.maximum(border, r[:, None])
    coupling = (1 - 2 * NU) / (4 * G)
    ur_of_p = -coupling / r[:, None] * np.diff(within ** 2, axis=1)
    uz_of_q = -coupling / r * np.diff(beyond ** 2, axis=1)
    return np.block([[pulled_up(border, r), uz_of_q], [ur_of_p, (1 - NU) * turned(border, r)]])


def pressed(border, r, moved, mu, n_stick):
    """Pressure and traction if the n_stick inner rings stick and the others slide."""
    n, matrix = len(r), moved.copy()
    slide = np.arange(n_stick, n)
    matrix[n + slide] = 0
    matrix[n + slide, n + slide] = 1
    matrix[n + slide, slide] = -mu
    p, q = np.split(np.linalg.solve(matrix, np.repeat([DEPTH, 0], n)), 2)
    return p, q, math.pi * np.diff(border ** 2) @ p


def force_and_radius(n, mu):
    border, r = rings(n)
    moved = influence(border, r)
    if math.isinf(mu):
        return pressed(border, r, moved, 0, n)[2], R
    few, many = 0, n  # the largest number of rings that stick within the law
    while many - few > 1:
        n_stick = (few + many) // 2
        p, q, _ = pressed(border, r, moved, mu, n_stick)
        few, many = (n_stick, many) if np.all(q[:n_stick] <= mu * p[:n_stick]) else (few, n_stick)
    return pressed(border, r, moved, mu, few)[2], border[few]


if __name__ == '__main__':
    assert abs(force_and_radius(400, 0)[0] / (2 * R * PULLED * DEPTH) - 1) < 1e-5
    assert abs(force_and_radius(400, math.inf)[0] / (4 * G * R * DEPTH * math.log(3 - 4 * NU) / (1 - 2 * NU)) - 1) < 1e-5
    print('mu, force [N] and stick radius over R with 200 and with 400 rings')
    for mu in (0, .1, .2, .3, math.inf):
        print(mu, *('%.4f %.4f' % (F, c / R) for F, c in (force_and_radius(n, mu) for n in (200, 400))))
