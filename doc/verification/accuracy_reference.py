#!/usr/bin/env python3
"""Makes prm/verification/data/accuracy_*.csv: runs prm/verification/accuracy_reference.prm (about half an hour on two cores), whose
meshes have 2, 3 and 4 times the cells of the main scene in every direction, finds the order at which the torque curves converge
and takes them to their limit. On stiff interfaces these meshes are too coarse for that; there the curve is that of
cells that follow the rim, `--stiff' makes only these (some minutes). Run it at the top of the project. An argument names another
directory of results."""
import csv
import math
import subprocess
import sys

PROGRAM = 'build/release/debond'
STUDY = 'prm/verification/accuracy_reference.prm'
NAMES = ['main', 'disk', 'near_edge', 'penalty_1800', 'penalty_18000', 'penalty_180000', 'soft_interface', 'soft_implant',
         'tilted', 'force', 'brittle']
REFINEMENTS = [2, 3, 4]
STEP_TOLERANCE = 3e-4
STIFF_STUDY = 'prm/verification/accuracy_stiff_reference.prm'
STIFF_NAMES = ['1e4', '1e6', 'disk', 'tilted', 'force', 'brittle', 'poisson', 'near_edge']
STIFF = {'penalty_1800': '1800', 'penalty_18000': '18000', 'penalty_180000': '180000'}


def read_curve(filename):
    with open(filename) as file:
        rows = [(float(row['angle_deg']), float(row['torque_Nmm'])) for row in csv.DictReader(file)]
    first = max(i for i, row in enumerate(rows) if row[0] == rows[0][0])  # the push-in has no angle
    return rows[first:]


def torque_at(curve, angle):
    for (a, t), (b, u) in zip(curve, curve[1:]):
        if a <= angle <= b:
            return t + (u - t) * (angle - a) / (b - a)
    raise ValueError(angle)


def largest_difference(curve, other):
    angles = sorted({a for a, _ in curve} | {a for a, _ in other})
    return max(abs(torque_at(curve, a) - torque_at(other, a)) for a in angles)


def observed_order(coarse, fine):
    """p with errors C/n^p, n the refinements, from the differences of the first two and the last two meshes; within -4 and 8."""
    def ratio(p):
        if abs(p) < 1e-6:  # the limit of vanishing order
            e = [-math.log(n) for n in REFINEMENTS]
            return (e[0] - e[1]) / (e[1] - e[2])
        e = [n ** -p for n in REFINEMENTS]
        return (e[0] - e[1]) / (e[1] - e[2])
    low, high = -4., 8.
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ratio(middle) < coarse / fine else (low, middle)
    return low


def write_stiff(name, scene, cells, tolerance, results):
    with open('prm/verification/data/accuracy_%s.csv' % name, 'w') as file:
        file.write('# Torque of %s, linear bodies, made by\n# doc/verification/accuracy_reference.py --stiff: %s, steps that keep %s.\n'
                   'angle_deg,torque_Nmm\n' % (scene, cells, tolerance))
        file.writelines('%.9g,%.8g\n' % row for row in read_curve(results + '/torque.csv'))


def make_stiff_references():
    for name, eps in STIFF.items():
        results = 'output/verification/accuracy_' + name
        subprocess.run([PROGRAM, 'prm/coin_stiff.prm', '--force'] + [word for entry in (
            'Output/Directory=' + results, 'Output/Fields every=none', 'Output/Report=false', 'Bone/Cells=fitted 28, 9, 16, 13',
            'Implant/Cells=fitted 20, 7, 6', 'Interface/Normal stiffness=' + eps, 'Load steps/Tolerance=1e-4')
                                                                    for word in ('--set', entry)], check=True)
        write_stiff(name, 'scene %d of prm/verification/accuracy_scenes.prm' % (NAMES.index(name) + 1), 'cells fitted 28, 9, 16, 13 and 20, 7, 6',
                    '1e-4', results)
    subprocess.run([PROGRAM, STIFF_STUDY], check=True)
    for i, name in enumerate(STIFF_NAMES, 1):
        write_stiff('stiff_' + name, 'scene %d of prm/verification/accuracy_stiff_scenes.prm' % i,
                    'cells of prm/verification/accuracy_stiff_reference.prm', '3e-4', 'output/verification/accuracy_stiff_reference/variant-%03d' % i)


make_stiff_references()
if sys.argv[1:] == ['--stiff']:
    sys.exit()
directory = sys.argv[1] if len(sys.argv) > 1 else 'output/verification/accuracy_reference'
if len(sys.argv) == 1:
    subprocess.run([PROGRAM, STUDY, '--set', 'Output/Directory=' + directory], check=True)
for i, name in enumerate(NAMES):
    if name in STIFF:
        continue
    curves = [read_curve('%s/variant-%03d/curve.csv' % (directory, i + 1 + len(NAMES) * k)) for k in range(3)]
    differences = [largest_difference(curves[k], curves[k + 1]) for k in range(2)]
    observed = observed_order(*differences)
    order = min(max(observed, 0.5), 2.)  # no other order is trusted
    factor = 1 / ((REFINEMENTS[2] / REFINEMENTS[1]) ** order - 1)
    if differences[1] < 2 * STEP_TOLERANCE * max(abs(t) for _, t in curves[2]):
        order, factor = 0, 0  # that is the steps, not the mesh
    limit = [(a, t + factor * (t - torque_at(curves[1], a))) for a, t in curves[2]]
    T_max = max(abs(t) for _, t in limit)
    with open('prm/verification/data/accuracy_%s.csv' % name, 'w') as file:
        file.write('# Torque of scene %d of prm/verification/accuracy_scenes.prm, Neo-Hookean bodies, made by\n'
                   '# doc/verification/accuracy_reference.py: ' % (i + 1))
        if factor == 0:
            file.write('60 x 60 x 8 cells in the bone, %.1g of T_max from 45 x 45 x 6 cells;\n'
                       % (differences[1] / T_max))
        else:
            file.write('meshes of 45 x 45 x 6 and 60 x 60 x 8 cells in the bone, taken to the limit with\n'
                       '# the order %.2f (observed: %.2f), from which the finer one is %.2g of T_max away;\n'
                       % (order, observed, factor * differences[1] / T_max))
        file.write('# steps that keep 3e-4.\nangle_deg,torque_Nmm\n')
        for a, t in limit:
            file.write('%.9g,%.8g\n' % (a, t))
    print('%-15s differences %.2e %.2e order %.2f (observed %.2f) limit %.2e away, rows %d' %
          (name, differences[0] / T_max, differences[1] / T_max, order, observed, factor * differences[1] / T_max, len(limit)))
