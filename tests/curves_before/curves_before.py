#!/usr/bin/env python3
"""Runs a scene and compares its rows with those that the program made before its bulk was rewritten.

    curves_before.py DEBOND NAME [--set ENTRY=VALUE ...] [--differs | --write]

NAME.csv in this directory has rows of torque.csv, every n-th where there are many: of a study those of all variants, one
after the other. A row is compared with the new row of the nearest time, along a path with that of the same number. What
is compared is told by scale_of(): differences may be 1e-9 of the largest magnitude of their kind of quantity in the
curve. Left out are numbers of rows and iterations. Defects are differences of large numbers, relative already, and
exact where tolerances are: 1e-6. --differs is content if and only if a number differs; --write keeps the new rows.
"""
import argparse
import glob
import os
import subprocess
import sys
import tempfile

import numpy

here = os.path.dirname(os.path.abspath(__file__))

# The interface that the scenes had when these rows were made.
BEFORE = [word for entry in ('Normal stiffness=585', 'Tangential stiffness=auto', 'Friction coefficient unbroken=0.58',
                             'Characteristic slip distance=0.022') for word in ('--set', 'Interface/' + entry)]

# Where adaptive steps end is not what is compared.
EQUAL_STEPS = ['--set', 'Load steps/Adaptive=false', '--set', 'Load steps/Steps=1, 100']

# name: scene below prm, more arguments, every n-th row is kept
SCENES = {
    'coin_mode3': ('paper/main_scene', BEFORE, 20),
    'coin_mode3_fast': ('coin_mode3_fast', BEFORE + EQUAL_STEPS, 2),
    # solved to the last digits
    'coin_mode3_spline': ('coin_mode3_spline', BEFORE + EQUAL_STEPS + ['--set', 'Expert/Load steps/Residual tolerance=1e-11'], 2),
    'compliant_machine': ('compliant_machine', BEFORE + ['--set', 'Chuck/Rotation z/Stiffness=55060', '--set', 'Load steps/Adaptive=false'], 20),
    'layered': ('heterogeneous/layered', BEFORE + EQUAL_STEPS, 2),
    'partial_bonding': ('partial_bonding', BEFORE + EQUAL_STEPS, 2),
    'slave_is_bone': ('stability/slave_is_bone', BEFORE, 2),
    'slide_off': ('stability/slide_off', [], 1),
    'snap_back_path': ('stability/snap_back_path', [], 6),
    'study_of_six': ('coin_mode3_fast', BEFORE[:-2] + EQUAL_STEPS + ['--set', 'Interface/Characteristic slip distance={{0.015|0.022|0.04}}',
                                                                     '--set', 'Interface/Bonding/Bonding degree={{1|0.5}}'], 10),
}
FOLLOWS_PATH = {'snap_back_path'}
LEFT_OUT = {'step', 'newton_iterations', 'variant'}
ALONE = {'time', 'phi_mean', 'share_stick', 'share_slip', 'share_open', 'share_pulled', 'warnings'}
DEFECTS = {'energy_defect', 'energy_defect_bound', 'reaction_defect'}
# All others end in their unit: force_N, chuck_Mx_Nmm and energy_bulk_Nmm, pressure_MPa, chuck_ux_mm, chuck_rx_deg.
ENERGIES = ('work', 'energy', 'dissipation', 'adhesive', 'viscous', 'released', 'damage')


def kind_of(column):
    if column in ALONE or column in DEFECTS:
        return column
    if column.startswith(ENERGIES):
        return 'energy'
    return column.rsplit('_', 1)[1]


def scale_of(column, before):
    """Differences are measured by this times 1e-9."""
    if column in DEFECTS:
        return 1e3
    same = [name for name in before if name not in LEFT_OUT and kind_of(name) == kind_of(column)]
    return max(numpy.nanmax(numpy.abs(before[name])) for name in same)


def read(filename, variant):
    with open(filename) as file:
        names = file.readline().rstrip('\n').split(',')
    rows = numpy.loadtxt(filename, delimiter=',', skiprows=1, ndmin=2)
    return ['variant'] + names, numpy.column_stack([numpy.full(len(rows), float(variant)), rows])


def run(debond, name, more):
    scene, arguments, _ = SCENES[name]
    with tempfile.TemporaryDirectory() as directory:
        result = subprocess.run([debond, 'prm/%s.prm' % scene, *arguments, *more, '--set', 'Output/Fields every=none',
                                 '--set', 'Output/Report=false', '--set', 'Output/Directory=' + directory + '/result',
                                 '--set', 'Output/Curve=Rotation z, Moment z'],
                                cwd=os.path.join(here, '..', '..'), text=True, capture_output=True)
        if result.returncode != 0:
            sys.exit('%s ended with %d: %s%s' % (name, result.returncode, result.stdout[-1000:], result.stderr))
        files = sorted(glob.glob(directory + '/result/variant-*/torque.csv')) or [directory + '/result/torque.csv']
        curves = [read(file, i) for i, file in enumerate(files)]
    return curves[0][0], numpy.vstack([rows for _, rows in curves])


def write(name, names, rows):
    """Every n-th row of each variant, and its last."""
    every = SCENES[name][2]
    last = numpy.append(rows[1:, 0] != rows[:-1, 0], True)
    kept = rows[(rows[:, names.index('step')] % every == 0) | last]
    numpy.savetxt(os.path.join(here, name + '.csv'), kept, fmt='%.12g', delimiter=',', header=','.join(names), comments='')


def partners(name, before, now):
    """The new row of each old one."""
    key = 'step' if name in FOLLOWS_PATH else 'time'
    result = []
    for variant, place in zip(before['variant'], before[key]):
        rows = numpy.flatnonzero(now['variant'] == variant)
        if len(rows) == 0:
            sys.exit('%s: variant %d is not there' % (name, variant))
        result.append(rows[numpy.argmin(numpy.abs(now[key][rows] - place))])
    return numpy.array(result)


def worst_of(name, before, now):
    """Of the differences over 1e-9 of the scale: the largest, its column and its time."""
    partner = partners(name, before, now)
    worst = (0., 'nothing', 0.)
    for column in before:
        if column in LEFT_OUT:
            continue
        a, b = before[column], now[column][partner]
        off = numpy.where(numpy.isnan(a) & numpy.isnan(b), 0., numpy.abs(a - b))
        off = numpy.where(numpy.isnan(off), numpy.inf, off)
        i = numpy.argmax(off)
        if off[i] > 0.:
            scale = scale_of(column, before)
            worst = max(worst, (off[i] / (1e-9 * scale) if scale > 0. else numpy.inf, column, before['time'][i]))
    return worst


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('debond')
    parser.add_argument('name', choices=sorted(SCENES))
    parser.add_argument('--set', action='append', default=[])
    parser.add_argument('--differs', action='store_true')
    parser.add_argument('--write', action='store_true')
    arguments = parser.parse_args()
    more = [word for entry in arguments.set for word in ('--set', entry)]
    names, rows = run(os.path.abspath(arguments.debond), arguments.name, more)
    if arguments.write:
        write(arguments.name, names, rows)
        return
    kept_names, kept = read(os.path.join(here, arguments.name + '.csv'), 0)
    before = dict(zip(kept_names[1:], kept.T[1:]))
    now = dict(zip(names, rows.T))
    if not set(before) <= set(now):
        sys.exit('%s: columns that are gone: %s' % (arguments.name, ', '.join(sorted(set(before) - set(now)))))
    off, column, time = worst_of(arguments.name, before, now)
    print('%s: %d rows, the largest difference is %.3g of what is allowed, %s at time %.6g'
          % (arguments.name, len(kept), off, column, time))
    sys.exit(0 if (off > 1.) == arguments.differs else 1)


if __name__ == '__main__':
    main()
