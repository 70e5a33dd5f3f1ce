#!/usr/bin/env python3
"""Makes prm/verification/data/bonds_on_half_space.csv: the largest loads that bonds between a rigid disk and an elastic half space
carry, over those of a brittle bond (prm/verification/kendall.prm, bonded_disk_torsion.prm). Run it at the top of the project; it
takes two minutes and needs NumPy and SciPy. It knows nothing of finite elements: tractions are constant (twist: proportional to
the radius) on rings, the surface follows from closed forms, and the states of equilibrium are followed by the length of their
path. With half as many rings the loads differ by less than 0.1 %."""
import math

import numpy as np
from scipy.special import ellipe, ellipk, gamma, hyp2f1

R, PULLED, SHEARED, WORK = 2.5, 18000 / (1 - .3 ** 2), 18000 / 2.6, .098  # radius [mm], E* and G [MPa], work [N/mm]
STRENGTHS = (2, 3, 5, 7, 10, 14, 17, 20, 25, 30, 35, 40, 50, 60, 70, 80, 100, 120, 150, 200, 300, 400)
RINGS = 300


def rings():
    """Borders of rings that become thinner towards the rim, and their middles."""
    border = R * (1 - (1 - np.linspace(0, 1, RINGS + 1)) ** 2.5)
    return border, (border[1:] + border[:-1]) / 2


def pulled_up(border, r):
    """Displacement at r for a pull of 1 MPa on each ring; differences of disks (Johnson, Contact mechanics, 3.29)."""
    result = np.zeros((len(r), len(border)))
    for j, b in enumerate(border[1:], 1):
        m = (np.minimum(r, b) / np.maximum(r, b)) ** 2
        outside = r / b * (ellipe(m) - (1 - m) * ellipk(m))
        result[:, j] = 4 * b / (math.pi * PULLED) * np.where(r < b, ellipe(m), outside)
    return result[:, 1:] - result[:, :-1]


def bessel_integral(mu, nu, power, a, b):
    """int_0^infinity J_mu(a t) J_nu(b t) t^-power dt for b < a (Weber and Schafheitlin)."""
    return (b ** nu * gamma((mu + nu - power + 1) / 2) /
            (2 ** power * a ** (nu - power + 1) * gamma(nu + 1) * gamma((power + mu - nu + 1) / 2)) *
            hyp2f1((nu + mu - power + 1) / 2, (nu - mu - power + 1) / 2, nu + 1, (b / a) ** 2))


def turned(border, r):
    """Circumferential displacement at r for a traction of 1 MPa, in its middle, on each ring."""
    result = np.zeros((len(r), len(border)))
    for j, b in enumerate(border[1:], 1):
        within = r < b
        result[within, j] = b ** 2 / SHEARED * bessel_integral(2, 1, 1, b, r[within])
        result[~within, j] = b ** 2 / SHEARED * bessel_integral(1, 2, 1, r[~within], b)
    return (result[:, 1:] - result[:, :-1]) / r


def exponential(strength):
    """Traction and slope over the gap, of Law = adhesive in tension; and a gap to measure by."""
    g_0 = WORK / (math.e * strength)
    return lambda g: (strength * g / g_0 * np.exp(1 - g / g_0), strength / g_0 * (1 - g / g_0) * np.exp(1 - g / g_0)), g_0


def by_slip(strength):
    """The same of its friction, with mu_b = 1/2, mu_ub = b_s = c = 1: over the path, of which strength/eps_t is elastic."""
    a_s, stiffness = WORK / (1.875 * strength), 200 * strength ** 2
    slip = np.linspace(0, 3 * a_s, 6001)
    s = np.where(slip < a_s, 1, (1 - np.sin(math.pi / 2 * (slip / a_s - 2))) / 2)
    limit = (1 + s) / 2 * s * strength
    path = slip + limit / stiffness
    slope = np.gradient(limit, path)
    return lambda g: (np.where(g < path[0], stiffness * g, np.interp(g, path, limit, right=0)),
                      np.where(g < path[0], stiffness, np.interp(g, path, slope, right=0))), a_s / 5


def bilinear(strength):
    """The same of Law = mixed mode in shear, with the stiffness 5 strength^2 / work."""
    onset, end = strength / (5 * strength ** 2 / WORK), 2 * WORK / strength
    return lambda g: (np.where(g < onset, strength * g / onset, strength * np.clip((end - g) / (end - onset), 0, None)),
                      np.where(g < onset, strength / onset, np.where(g < end, -strength / (end - onset), 0))), onset


def largest_load(compliance, weights, shape, law, gap_scale):
    """Of states with  gap + compliance traction = place * shape,  weights traction being the load."""
    n = len(weights)
    place_scale = gap_scale + (compliance @ np.full(n, law(np.array([gap_scale]))[0][0])).max() / shape.max()
    scale = np.append(np.full(n, gap_scale), place_scale)
    y, direction, step, loads = np.zeros(n + 1), np.append(np.zeros(n), 1.), .02, [(0., 0.)]
    while len(loads) < 10000 and loads[-1][1] >= .98 * max(load for _, load in loads):
        z = y + step * direction
        for iteration in range(15):
            traction, slope = law(z[:n] * gap_scale)
            residual = np.append(z[:n] + (compliance @ traction - z[n] * place_scale * shape) / gap_scale, direction @ (z - y) - step)
            matrix = np.block([[np.eye(n) + compliance * slope, -(place_scale / gap_scale * shape)[:, None]], [direction]])
            change = np.linalg.solve(matrix, -residual)
            z += change
            if np.abs(change).max() < 1e-10:
                break
        else:
            step /= 2
            continue
        direction = (z - y) / np.linalg.norm(z - y)
        y = z
        loads.append((loads[-1][0] + step, weights @ law((y * scale)[:n])[0]))
        step = min(1.3 * step, .5) if iteration < 5 else step
    top = max(range(len(loads)), key=lambda i: loads[i][1])
    s, load = zip(*loads[top - 1:top + 2])
    a, b, c = np.polyfit(s, load, 2)
    return c - b ** 2 / (4 * a)


def main():
    border, r = rings()
    area = math.pi * (border[1:] ** 2 - border[:-1] ** 2)
    arm = math.pi / 2 * (border[1:] ** 4 - border[:-1] ** 4) / r
    pull, twist = math.sqrt(8 * math.pi * R ** 3 * PULLED * WORK), 8 / 3 * math.sqrt(math.pi * SHEARED * WORK * R ** 5)
    up, around = pulled_up(border, r), turned(border, r)
    with open('prm/verification/data/bonds_on_half_space.csv', 'w') as file:
        file.write('# Largest load over that of a brittle bond with the same work, of bonds between a rigid disk and a half space,\n'
                   '# made by doc/verification/bonds_reference.py. R = 2.5 mm, w = 0.098 N/mm; pulled off by Law = adhesive with\n'
                   '# E* = 19 780 MPa, twisted off by adhesive and mixed mode with G = 6923 MPa.\n'
                   'strength_MPa,pull_off,twist_adhesive,twist_mixed_mode\n')
        for strength in STRENGTHS:
            row = [largest_load(up, area, np.ones(RINGS), *exponential(strength)) / pull]
            row += [largest_load(around, arm, r, *law(strength)) / twist for law in (by_slip, bilinear)]
            file.write('%g,%.5f,%.5f,%.5f\n' % (strength, *row))
            print(strength, row, flush=True)


if __name__ == '__main__':
    main()
