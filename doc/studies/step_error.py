#!/usr/bin/env python3
"""What steps lose where friction turns: doc/studies/step_error.py [--force] [--publish]

Runs the scenes of the chart of doc/evidence/speed_and_accuracy.md in steps of several sizes, writes output/step_error/order.csv (errors at the
ends of the steps) and codes.csv (errors of the curves as they are drawn, and seconds of the process) and draws output/step_error.png. Some ten minutes.
CalculiX takes part where ccx and calculix_input are. --force runs again what is there; --publish copies the pictures to doc/images.
Other programs: DEBOND, CALCULIX_INPUT, CCX."""

import csv
import math
import os
import shutil
import subprocess
import sys
import time

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../..')
sys.path.append(os.path.join(ROOT, 'python'))
from debond.page_data import curve_file, rows_file  # noqa: E402

DEBOND = os.environ.get('DEBOND', 'build/release/debond')
CALCULIX_INPUT = os.environ.get('CALCULIX_INPUT', 'build/release/tests/comparison/calculix/calculix_input')
CCX = os.environ.get('CCX', 'ccx')
RESULTS = 'output/step_error'
FORCES = ['chuck_F%s_N' % k for k in 'xyz']
MOMENTS = ['chuck_M%s_Nmm' % k for k in 'xyz']

PRESS = '0.0049 * min(t, 1)'
SHEAR = '0.02 * min(max(t - 1, 0), 1)'
SHEAR_THEN_TWIST = {'Translation x': SHEAR, 'Rotation z': '2 * max(t - 2, 0)'}
STIFFNESS = {'Interface/Normal stiffness': '585', 'Interface/Tangential stiffness': 'auto'}  # that of the scenes for CalculiX
BOND = {**STIFFNESS, 'Interface/Friction coefficient unbroken': '0.58', 'Interface/Characteristic slip distance': '0.022'}
COARSE = {**BOND, 'Bone/Cells': '12, 12, 3', 'Implant/Cells': '4, 2', 'Expert/Bone/Layer grading': '1.5', 'Expert/Implant/Layer grading': '1.5',
          'Bone/Material': 'linear', 'Implant/Material': 'linear'}
RIGID = {**BOND, 'Bone/Material': 'rigid', 'Implant/Material': 'rigid', 'Implant/Cells': '12, 2'}
# label, phases after the first one, motion, entries
CASES = [
    ('rigid bodies: shear then twist', 2, SHEAR_THEN_TWIST, RIGID),
    ('shear then twist', 2, SHEAR_THEN_TWIST, COARSE),
    ('trial', 2, SHEAR_THEN_TWIST, {**COARSE, 'Expert/Slip direction': 'trial'}),
    ('the same with the bone as slave', 2, SHEAR_THEN_TWIST, {**COARSE, 'Expert/Interface/Slave': 'bone'}),
    ('a cap', 2, SHEAR_THEN_TWIST, {**COARSE, 'Implant/Shape': 'cap'}),
    ('pressed and turned at once', 1, {'Press': '0.0049 * min(t, 1) + 0.003 * max(t - 1, 0)', 'Translation x': '0.01 * max(t - 1, 0)',
                                       'Rotation z': '2 * max(t - 1, 0)'}, COARSE),
    ('pressure to and fro', 1, {'Press': PRESS + ' + 0.002 * sin(4 * max(t - 1, 0))', 'Translation x': '0.01 * max(t - 1, 0)',
                                'Rotation z': '2 * max(t - 1, 0)'}, COARSE),
    ('fretting', 1, {'Translation x': '0.01 * sin(2 * pi * max(t - 1, 0))', 'Rotation z': '0.3 * max(t - 1, 0)'}, COARSE),
    ('circle', 2, {'Translation x': '0.01 * (min(max(t - 1, 0), 1) + cos(2 * pi * max(t - 2, 0)) - 1)',
                   'Translation y': '0.01 * sin(2 * pi * max(t - 2, 0))'}, COARSE)]
STEPS = [10, 20, 50, 100, 200]
REFERENCE_STEPS = 2000

# the same cells for CalculiX; a constant coefficient is what it knows
CODES = {**STIFFNESS, 'Bone/Cells': '15, 15, 2', 'Implant/Cells': '6, 2', 'Bone/Material': 'linear', 'Implant/Material': 'linear',
         'Interface/Friction law': 'coulomb', 'Interface/Friction coefficient': '0.58'}
CODE_STEPS = [5, 10, 20, 40, 80]
CODE_REFERENCE_STEPS = 320
FORCE = '--force' in sys.argv


def rows_of(file):
    with open(file, encoding='utf-8') as text:
        return [{key: float(value or 'nan') for key, value in row.items()} for row in csv.DictReader(text)]


def settings(phases, motion, entries, **load_steps):
    times = ', '.join(str(k) for k in range(phases + 2))
    values = {'Press': PRESS, 'Rotation z': '0', **motion}
    result = ['Load steps/Times=' + times] + ['Load steps/%s=%s' % entry for entry in load_steps.items()]
    return result + ['Chuck/%s/Value=%s' % entry for entry in values.items()] + ['%s=%s' % entry for entry in entries.items()]


def run(name, entries):
    """The directory of a run of the main scene with other entries; again only if asked."""
    directory = '%s/%s' % (RESULTS, name)
    if FORCE or not os.path.exists(directory + '/summary.json'):
        command = [DEBOND, 'prm/paper/main_scene.prm', '--force']
        for entry in entries + ['Output/Directory=' + directory, 'Output/Fields every=none', 'Expert/Output/Console=quiet']:
            command += ['--set', entry]
        timed(command, directory)
    return directory


def timed(command, directory, **more):
    """Runs a program; its seconds go to wall_seconds."""
    begin = time.monotonic()
    result = subprocess.run(command, check=False, capture_output=True, text=True, **more)
    seconds = time.monotonic() - begin
    if result.returncode:
        sys.exit('step_error.py: %s\n%s%s' % (' '.join(command), result.stdout[-2000:], result.stderr[-2000:]))
    with open(directory + '/wall_seconds', 'w', encoding='utf-8') as file:
        file.write('%.4f' % seconds)


def largest_error(reference, rows, groups):
    """Over the rows of the curve, drawn as straight lines between its points: the largest difference of a group over its largest value."""
    errors, after = {column: 0. for group in groups for column in group}, 0
    for row in reference:
        while rows[after]['time'] < row['time'] - 1e-9:
            after += 1
        begin, end = rows[max(after - 1, 0)], rows[after]
        share = (row['time'] - begin['time']) / (end['time'] - begin['time']) if after else 0.
        for column in errors:
            errors[column] = max(errors[column], abs(begin[column] + share * (end[column] - begin[column]) - row[column]))
    return max(max(errors[column] for column in group) / max(abs(row[column]) for row in reference for column in group) for group in groups)


def order():
    lines = [['case', 'steps', 'error', 'order']]
    for number, (label, phases, motion, entries) in enumerate(CASES):
        def steps(n):
            chosen = settings(phases, motion, entries, Steps='30' + ', %d' % n * phases)
            return rows_of(rows_file(run('case-%d-%d' % (number, n), chosen)))
        fine = {round(row['time'], 9): row for row in steps(REFERENCE_STEPS)}
        before = None
        for n in STEPS:
            rows = [row for row in steps(n) if row['time'] >= 1]
            error = largest_error([fine[round(row['time'], 9)] for row in rows], rows, [FORCES, MOMENTS])
            slope = '%.2f' % (math.log(before[1] / error) / math.log(n / before[0])) if before else ''
            lines.append([label, n, '%.3g' % error, slope])
            before = (n, error)
        print('%-28s errors %s, orders %s' % (label, ' '.join(line[2] for line in lines[-5:]), ' '.join(line[3] for line in lines[-4:])), flush=True)
    write('order.csv', lines)


def calculix(n):
    """Rows of time, chuck_Fx_N and torque_Nmm, and the seconds of CalculiX."""
    directory = '%s/calculix-%d' % (RESULTS, n)
    if FORCE or not os.path.exists(directory + '/wall_seconds'):
        os.makedirs(directory, exist_ok=True)
        command = [CALCULIX_INPUT, 'prm/paper/main_scene.prm', directory + '/calculix.inp']
        for entry in settings(2, SHEAR_THEN_TWIST, CODES, Steps='1, %d, %d' % (n, n)):
            command += ['--set', entry]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        timed([CCX, 'calculix'], directory, cwd=directory, env={**os.environ, 'OMP_NUM_THREADS': '1'})
    rows, step = [], -1
    torque = subprocess.run(['awk', '-f', 'tests/comparison/calculix/reactions.awk', directory + '/calculix.inp', directory + '/calculix.dat'],
                            check=True, capture_output=True, text=True).stdout.splitlines()
    force = []
    with open(directory + '/calculix.dat', encoding='utf-8') as data:
        for line in data:
            values = line.split()
            if line.startswith(' forces'):
                force.append(0.)
            elif len(values) == 4 and force:
                force[-1] += float(values[1])
    for line, sum_of_forces in zip(torque, force):
        values = [float(value) for value in line.split(',')]
        rows.append({'time': values[0], 'chuck_Fx_N': sum_of_forces, 'torque_Nmm': values[3]})
    with open(directory + '/wall_seconds', encoding='utf-8') as file:
        return [{'time': 0., 'chuck_Fx_N': 0., 'torque_Nmm': 0.}] + rows, float(file.read())


def codes():
    lines, groups = [['code', 'steps', 'seconds', 'error']], [['chuck_Fx_N'], ['torque_Nmm']]

    def add(code, n, seconds, reference, rows):
        error = largest_error([row for row in reference if row['time'] >= 1], rows, groups)
        lines.append([code, n, '%.3g' % seconds, '%.3g' % error])
        print('%-28s %4s steps, %6.2f s, error %.2g' % (code, n, seconds, error), flush=True)

    def ours(name, direction, **load_steps):
        directory = run(name, settings(2, SHEAR_THEN_TWIST, {**CODES, 'Expert/Slip direction': direction}, **load_steps))
        with open(directory + '/wall_seconds', encoding='utf-8') as file:
            return rows_of(curve_file(directory)), float(file.read())

    reference = ours('code-reference', 'integrated', Steps='1, 4000, 4000')[0]
    for direction in ('integrated', 'trial'):
        for n in CODE_STEPS + [160, 320]:
            rows, seconds = ours('code-%s-%d' % (direction, n), direction, Steps='1, %d, %d' % (n, n))
            add('debond ' + direction, n, seconds, reference, rows)
    for tolerance in ('1e-2', '3e-3', '1e-3', '3e-4', '1e-4'):
        rows, seconds = ours('code-adaptive-' + tolerance, 'integrated', Steps='1, 10, 10', Adaptive='true', Tolerance=tolerance)
        add('debond adaptive', (len(rows) - 1) // 16, seconds, reference, rows)
    if not (shutil.which(CCX) and os.path.exists(CALCULIX_INPUT)):
        sys.exit('step_error.py: for CalculiX there have to be ' + CCX + ' and ' + CALCULIX_INPUT)
    reference = calculix(CODE_REFERENCE_STEPS)[0]
    for n in CODE_STEPS:
        rows, seconds = calculix(n)
        add('CalculiX', n, seconds, reference, rows)
    write('codes.csv', lines)


def write(name, lines):
    with open('%s/%s' % (RESULTS, name), 'w', encoding='utf-8') as file:
        csv.writer(file, lineterminator='\n').writerows(lines)


def main():
    if any(option not in ('--force', '--publish') for option in sys.argv[1:]):
        sys.exit(__doc__)
    os.chdir(ROOT)
    if not os.path.exists(DEBOND):
        sys.exit('step_error.py: there is no %s: build the program first, or set DEBOND' % DEBOND)
    order()
    codes()
    subprocess.run(['gnuplot', 'doc/studies/step_error.gp'], check=True)
    if '--publish' in sys.argv:
        for ending in ('png', 'svg'):
            shutil.copy('output/step_error.' + ending, 'doc/images')


main()
