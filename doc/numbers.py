#!/usr/bin/env python3
"""Makes the numbers that stand in README.md, doc/*.md and tests/comparison/README.md
between <!-- numbers: NAME --> and <!-- end -->.

    doc/numbers.py                  all that take seconds, into the pages (some half a minute)
    doc/numbers.py NAME...          only these; --all: those that take minutes, too; --list: all names
    doc/numbers.py --check [NAME]   changes no page; exit code 1 if a page says something else

Each function below with @numbers is one NAME, and returns what stands there. Runs go to output/numbers; --force runs studies again
that are there already. Programs: build/release/debond, or DEBOND. In a check numbers may differ by one unit of the last digit
that the page prints. Seconds are those of one machine: they come from tables that are stored.
"""
import argparse
import csv
import functools
import glob
import json
import os
import re
import subprocess
import sys

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), '..'))
BLOCK = re.compile(r'(<!-- numbers: (\w+) -->)(.*?)(<!-- end -->)', re.S)
NUMBER = re.compile(r'(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?')
MAIN, REFERENCE = 'prm/coin_mode3.prm', 'Output/Reference curve=prm/studies/data/work_precision_torque.csv'
LINEAR = ('Bone/Material=linear', 'Implant/Material=linear')
LAYERED = ('Bone/Layer grading=1.5', 'Implant/Layer grading=1.5')
ADAPTIVE = ('Load steps/Steps=1, 10', 'Load steps/Adaptive=true')
NAMES, options = {}, None


def numbers(cost):
    """Registers a function as NAME; cost is `seconds' or `minutes'."""
    def register(function):
        NAMES[function.__name__] = (function, cost)
        return function
    return register


def debond(scene, directory, *changes, force=True):
    changes = ('Output/Directory=' + directory, 'Output/Console=quiet') + changes
    command = [options.debond, scene] + ['--force'] * force + [word for change in changes for word in ('--set', change)]
    if subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode:
        sys.exit('numbers.py: this failed: ' + ' '.join('"%s"' % word if ' ' in word else word for word in command))


@functools.lru_cache(None)
def run(scene, *changes):
    """The summary of a run, with its curve: rows of torque.csv."""
    directory = directory_of(scene, changes)
    debond(scene, directory, 'Output/Fields every=0', *changes)
    with open(directory + '/summary.json', encoding='utf-8') as text:
        summary = json.load(text)
    return {**summary, 'curve': rows_of(directory + '/torque.csv')}


@functools.lru_cache(None)
def study(scene, *changes):
    """The rows of study.csv."""
    directory = directory_of(scene, changes)
    debond(scene, directory, *changes, force=options.force)
    return rows_of(directory + '/study.csv')


def directory_of(scene, changes):
    return os.path.join(options.results, re.sub(r'\W+', '_', ' '.join((scene,) + changes))[-200:])


def rows_of(path):
    with open(path, encoding='utf-8') as lines:
        table = csv.DictReader(line for line in lines if line[0] != '#')
        return [{name: number(value) for name, value in row.items()} for row in table]


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def torque_at(curve, angle):
    """Linear between rows; nan beyond them."""
    for a, b in zip(curve, curve[1:]):
        if a['angle_deg'] <= angle <= b['angle_deg'] and b['angle_deg'] > 0:
            share = (angle - a['angle_deg']) / (b['angle_deg'] - a['angle_deg'])
            return a['torque_Nmm'] + share * (b['torque_Nmm'] - a['torque_Nmm'])
    return float('nan')


def last_angle(curve, torque):
    """The last angle with that torque."""
    for a, b in reversed(list(zip(curve, curve[1:]))):
        if b['torque_Nmm'] < torque <= a['torque_Nmm']:
            share = (a['torque_Nmm'] - torque) / (a['torque_Nmm'] - b['torque_Nmm'])
            return a['angle_deg'] + share * (b['angle_deg'] - a['angle_deg'])
    return curve[-1]['angle_deg']


def small(value, digits=1):
    """1.3e-6"""
    return ('%.*e' % (digits, value)).replace('e-0', 'e-')


def difference(result, reference):
    """Largest difference of the torque at the angles of the reference, relative to its largest torque."""
    return max(abs(torque_at(result['curve'], row['angle_deg']) - row['torque_Nmm'])
               for row in reference['curve'] if row['angle_deg'] > 0) / reference['T_max_Nmm']


def table(head, rows):
    lines = [head, ['---'] * len(head)] + rows
    return '\n' + ''.join('| %s |\n' % ' | '.join(str(cell) for cell in line) for line in lines)


def percent(value, digits=2):
    return ('%#.*g' % (digits, 100 * value)).rstrip('.') + ' %'


# The main scene


@numbers('seconds')
def choices():
    first = run(MAIN, REFERENCE)
    rows = []
    for name, changes in (
            ('as it is: Neo-Hookean bodies, two equal layers, 1000 steps', ()),
            ('linear bodies', LINEAR),
            ('linear, adaptive steps with the tolerance 1e-3', LINEAR + ADAPTIVE),
            ('the same, four graded layers: `coin_mode3_fast`',
             LINEAR + ADAPTIVE + LAYERED + ('Bone/Cells=15, 15, 4', 'Implant/Cells=3, 4')),
            ('rigid bodies', ('Bone/Material=rigid', 'Implant/Material=rigid')),
            ('`Model = foundation`', ('Model=foundation',))):
        result = run(MAIN, REFERENCE, *changes)
        rows.append([name, int(result['steps']) - 1, percent(result['difference_max']),
                     '' if result is first else small(difference(result, first))])
    return table(['main scene', 'steps', 'error', 'differs from the first row by'], rows)


@numbers('seconds')
def foundation_error():
    return percent(run(MAIN, REFERENCE, 'Model=foundation')['difference_max'], 1)


@numbers('seconds')
def linear_bodies():
    return small(difference(run(MAIN, REFERENCE, *LINEAR), run(MAIN, REFERENCE)))


@numbers('seconds')
def steps_of_the_main_scene():
    curves = {n: run(MAIN, *LINEAR, 'Load steps/Steps=1, %d' % n) for n in (1, 10, 100, 1000)}
    worst = {n: max(abs(row['torque_Nmm'] - torque_at(curves[1000]['curve'], row['angle_deg']))
                    for row in curves[n]['curve'] if row['angle_deg'] > 0) / curves[1000]['T_max_Nmm'] for n in (100, 10, 1)}
    return '100 give %s of T_max, 10 give %s, one step of 10 degrees %s' % tuple(small(worst[n]) for n in (100, 10, 1))


# Closed forms


@numbers('seconds')
def foundation():
    rows = []
    for cells, implant, grading in (('15, 15, 2', '3, 2', ()), ('15, 15, 4', '3, 4', LAYERED), ('30, 30, 4', '6, 4', LAYERED)):
        result = run(MAIN, REFERENCE, 'Model=foundation', 'Bone/Cells=' + cells, 'Implant/Cells=' + implant, *grading)
        rows.append(['4.9 um', 585, cells.replace(', ', ' x ') + (', graded' if grading else ''), 'a converged reference',
                     percent(result['difference_max'])])
    same = run(MAIN, *LINEAR)
    rows.append(['4.9 um', 585, '15 x 15 x 2', 'the same cells', percent(difference(run(MAIN, 'Model=foundation'), same))])
    for penalty, force in ((585, 51.88), (1000, 82.8), (1800, 137.4)):
        result = study('prm/verification/foundation.prm', 'Interface/Penalty stiffness=%d' % penalty,
                       'Chuck/Translation z/Value=-%g * min(t, 1)' % force)
        rows.append(['%g N' % force, penalty, '30 x 30 x 2', 'the same cells', percent(result[1]['difference_max'])])
    return table(['pressed by', 'eps [MPa/mm]', 'stiffness from bone cells', 'against finite elements on', 'largest difference'], rows)


# The paper's tables


@numbers('seconds')
def table_3():
    rows = study('prm/paper/table_3.prm')
    lines = []
    for i, modulus in enumerate(('9', '18 (printed)', '36')):
        soft, stiff = (rows[i + k]['torsional_stiffness_MPa_per_mm'] for k in (0, 3))
        k = 3.14159265358979 / 2 * 2.5 ** 4 / 1000 # N m/rad per MPa/mm
        lines.append([modulus, '%.1f' % soft, '%.2f' % (k * soft), '%.1f' % stiff, '%.1f' % (k * stiff)])
    return table(['E_b [GPa]', 'calibrated interface: lambda [MPa/mm]', 'K [N m/rad]', 'printed interface: lambda', 'K'], lines)


@numbers('seconds')
def table_4():
    printed = {1: {.2: 5.2, .25: 4.2, .3: 3.5, .35: 3.0, .4: 2.6, .45: 2.3, .5: 2.1}, 2: {.3: 4.1, .4: 3.1}}
    lines = []
    for data_set in (1, 2):
        for row in study('prm/paper/table_4_set_%d.prm' % data_set):
            mu = row['Interface / Friction coefficient broken']
            off = row['difference_max']
            lines.append([data_set, '%.2f' % mu, '%.1f' % (1000 * -number(row['Chuck / Translation z / Value'].split()[0])),
                          '%.2f' % row['Interface / Friction coefficient unbroken'], printed[data_set][mu], '%.3f' % row['pressure_MPa'],
                          '%.2f' % row['T_max_Nmm'], '%.2f' % row['T_inf_Nmm'],
                          '-' if mu == .4 else small(off, 0) if off < 1e-3 else '%.1f %%' % (100 * off)])
    return table(['set', 'mu_b', 'd [um]', 'mu_ub', 'p: paper', 'p: ours', 'T_max [N mm]', 'T_inf [N mm]', 'difference'], lines)


LAYERS = {(2, 1.): '2 (the paper) | 1', (2, 1.5): '2 | 1.5', (4, 1.): '4 | 1', (4, 1.5): '4 | 1.5', (8, 1.): '8 | 1', (8, 1.5): '8 | 1.5'}


def layer_rows(name):
    """By layers and grading: p, K and T_inf relative to those of 8 graded layers, and the difference of the torque."""
    rows = {(int(row['Bone / Cells'].split()[-1]), row['Bone / Layer grading']): row for row in study('prm/paper/%s.prm' % name)}
    columns, last = ('pressure_MPa', 'initial_stiffness_Nm_per_rad', 'T_inf_Nmm'), rows[8, 1.5]
    lines = {key: ['%+.2f %%' % (100 * (row[c] / last[c] - 1)) for c in columns] + ['%.2f %%' % (100 * row['difference_max'])]
             for key, row in rows.items()}
    lines[8, 1.5] = ['%.4f MPa' % last[columns[0]], '%.2f N m/rad' % last[columns[1]], '%.2f N mm' % last[columns[2]], '-']
    return lines


@numbers('seconds')
def table_7_layers():
    soft, stiff = layer_rows('table_7_layers'), layer_rows('table_7_layers_printed')
    return table(['layers in each body', 'grading', 'eps 585: p', 'K', 'T_inf', 'torque', 'eps 1800: p', 'K', 'T_inf', 'torque'],
                 [name.split(' | ') + soft[key] + stiff[key] for key, name in LAYERS.items()])


@numbers('seconds')
def layers_plateau():
    return '%.1f %%' % float(layer_rows('table_7_layers')[2, 1.][2].split()[0])


# Seconds, from stored tables


def baseline():
    return {(row['mesh'], row['bodies'], str(row['steps']), int(row['threads'])): row['seconds']
            for row in rows_of('tests/benchmark/baseline.csv')}


@numbers('seconds')
def timings():
    seconds, lines = baseline(), []
    for mesh in ('coarse', 'medium', 'fine', 'very fine'):
        line = [mesh]
        for steps, bodies in (('adaptive', 'linear'), ('adaptive', 'neo-hookean'), ('1000.0', 'linear'), ('1000.0', 'neo-hookean')):
            both = [seconds.get((mesh, bodies, steps, threads)) for threads in (1, 2)]
            line.append('-' if None in both else ' / '.join('%.2f' % s if s < 1 else ('%#.2g' % s).rstrip('.') for s in both))
        lines.append(line)
    return table(['mesh', 'linear, adaptive', 'Neo-Hookean, adaptive', 'linear, 1000 steps', 'Neo-Hookean, 1000 steps'], lines)


@numbers('seconds')
def neo_hooke_cost():
    seconds = baseline()
    ratios = [s / seconds[mesh, 'linear', steps, threads] for (mesh, bodies, steps, threads), s in seconds.items() if bodies != 'linear']
    return '%.1f to %.1f' % (min(ratios), max(ratios))


@functools.lru_cache(None)
def codes_factors():
    text = subprocess.run(['tests/comparison/work_precision.sh', '--factors', 'prm/studies/data/other_codes.csv'],
                          stdout=subprocess.PIPE, text=True, check=True).stdout
    return [(line.split()[1], float(line.split()[-1])) for line in text.splitlines() if line.startswith('CalculiX')]


@numbers('seconds')
def calculix_factor():
    factors = [factor for element, factor in codes_factors() if element.startswith('C3D8')]
    return '%.0f to %.0f' % (round(min(factors), -1), round(max(factors), -1))


@numbers('seconds')
def calculix_quadratic_factor():
    return '%.0f' % min(factor for element, factor in codes_factors() if element == 'C3D20R')


# What takes minutes


@numbers('minutes')
def stability():
    return '\n' + subprocess.run(['doc/stability/stability.sh'], stdout=subprocess.PIPE, text=True, check=True).stdout


@numbers('minutes')
def auto():
    names = ('main', 'disk pattern, f = 0.55', '3.5 mm off centre, near the edge', '1800 MPa/mm', '18 000 MPa/mm', '180 000 MPa/mm',
             'soft interface, 20 MPa/mm', 'soft implant, 30 MPa', 'tilted by 0.1 degrees', 'force held', 'brittle law')
    lines = []
    for name, row in zip(names, study('prm/verification/auto.prm')):
        lines.append([name, '%.3g %%' % (100 * row['Load steps / Tolerance']), row['answer'].split(' and ')[0],
                      percent(row['error_estimate']), percent(row['difference_max']),
                      '%.1f' % (row['error_estimate'] / row['difference_max']), '%.1f' % row['wall_seconds']])
    return table(['scene', 'tolerance', 'answer', 'estimate', 'true error', 'estimate / true', 'seconds, all levels'], lines)


@numbers('minutes')
def auto_foundation():
    names = ('main, 585 MPa/mm', '1800 MPa/mm', '18 000 MPa/mm', 'force held', 'brittle law', 'disk pattern')
    return table(['scene', 'tolerance', 'estimate', 'true error'],
                 [[name, '%.3g %%' % (100 * row['Load steps / Tolerance']), percent(row['error_estimate']), percent(row['difference_max'])]
                  for name, row in zip(names, study('prm/verification/auto_foundation.prm'))])


@numbers('minutes')
def table_7():
    paper = {100: (2.233, 2.195, 2.186), 200: (2.242, 2.197, 2.185), 500: (2.239, 2.191, 2.177), 1000: (2.240, 2.190, 2.176),
             2000: (2.241, 2.190, 2.176), 2500: (2.241, 2.190, 2.176)}
    ours = {(row['Load steps / Steps'], row['Bone / Cells']): row['e_mp'] for row in study('prm/paper/table_7.prm')}
    return table(['step', 'ours: coarse', 'medium', 'fine', 'the paper: coarse', 'medium', 'fine'],
                 [['%g deg' % (10 / n)] + ['%.3f' % (100 * ours['1, %d' % n, '%d, %d, 2' % (cells, cells)]) for cells in (15, 30, 60)] +
                  ['%.3f' % value for value in values] for n, values in paper.items()])


def pattern_rows(name):
    """The rows of study.csv with the curves of the variants."""
    scene = 'prm/paper/%s.prm' % name
    return [{**row, 'curve': rows_of('%s/variant-%03d/torque.csv' % (directory_of(scene, ()), row['variant']))} for row in study(scene)]


@numbers('minutes')
def partial_equal():
    names = ('homogeneous', 'homogeneous', '(b), ours', '(c) disk', '(d) random')
    return table(['pattern', 'mean phi_0', 'T_max [N mm]', 'last angle with 0.999 T_max [deg]', 'T(10 deg) [N mm]', 'E_deb [1e-3 N m]',
                  'W_adh', 'w_adh [N/m]', 'D_adh [1e-3 N m]'],
                 [[name, '%.4g' % row['phi_0_mean'], '%.2f' % row['T_max_Nmm'], '%.2f' % last_angle(row['curve'], .999 * row['T_max_Nmm']),
                   '%.2f' % row['T_inf_Nmm'], '%.3f' % (1000 * row['E_deb_Nm']), '%.3f' % (1000 * row['W_adh_Nm']),
                   '%.1f' % row['w_adh_N_per_m'], '%.3f' % (1000 * row['D_adh_Nm'])]
                  for name, row in zip(names, pattern_rows('partial_equal_parameters'))])


@numbers('minutes')
def partial_fitted():
    paper = (('homogeneous, 1', '4.90 | 0.58 | 22, 42 | 0.74 | 2.240 | 1.4 | 130'), ('(b), ours', '4.80 | 0.80 | 21, 40.1 | 0.63 | 1.949 | 1.5 | 139'),
             ('(c) disk', '4.80 | 0.97 | 15, 28.6 | 0.67 | 1.988 | 1.4 | 130'), ('(d) random', '4.85 | 0.73 | 22, 42 | 0.66 | 2.152 | 1.5 | 139'))
    area = 3.14159265358979e-6 * 2.5 ** 2 # m^2
    return table(['pattern', 'd [um]', 'mu_ub', 'a_s: printed, here [um]', 'b_s', 'e_mp [%]: paper', 'W_adh [1e-3 N m]', 'w_adh [N/m]',
                  'ours: p [MPa]', 'T_max [N mm]', 'T(10 deg)', 'e_mp', 'W_adh', 'w_adh'],
                 [[name] + printed.split(' | ') +
                  ['%.3f' % row['pressure_MPa'], '%.2f' % row['T_max_Nmm'], '%.2f' % row['T_inf_Nmm'], '%.2f' % (100 * row['e_mp']),
                   '%.2f' % (1000 * row['W_adh_Nm']), '%.0f' % (row['W_adh_Nm'] / (.55 * area))]
                  for (name, printed), row in zip(paper, study('prm/paper/partial_fitted_parameters.prm'))])


@numbers('minutes')
def memory():
    lines = []
    for bone, implant in (('15, 15, 2', '3, 2'), ('30, 30, 2', '6, 2'), ('60, 60, 2', '12, 2'), ('30, 30, 12', '6, 12'), ('120, 120, 2', '24, 2')):
        changes = ('Bone/Cells=' + bone, 'Implant/Cells=' + implant, 'Load steps/Steps=1, 1')
        check = subprocess.run([options.debond, MAIN, '--check'] + [word for change in changes for word in ('--set', change)],
                               stdout=subprocess.PIPE, text=True, check=True).stdout
        lines.append([bone.replace(', ', ' x '), re.search(r'memory: some (\d+) MB', check)[1], '%.0f' % run(MAIN, *changes)['peak_memory_MB']])
    return table(['cells of the bone', 'estimate [MB]', 'measured peak [MB]'], lines)


# Random patterns

RANDOM = ('Interface/Bonding/Pattern=random', 'Interface/Bonding/Bonded fraction=0.55')
UNIFORM = ('Interface/Bonding/Pattern=homogeneous', 'Interface/Bonding/Initial bonding=0.55')


@numbers('minutes')
def random_patterns():
    angles = (.04, .06, .08, .1, .2, .5, 1, 2, 10)
    common = LINEAR + ('Implant/Cells=20, 2', 'Interface/Quadrature points=3', 'Load steps/Steps=1, 10, 9, 8',
                       'Load steps/Times=0, 1, 1.02, 1.2, 2')
    ensemble = study(MAIN, *common, *RANDOM, 'Interface/Bonding/Seed={{1..60}}', 'Output/Fields every=0') and rows_of(
        directory_of(MAIN, common + RANDOM + ('Interface/Bonding/Seed={{1..60}}', 'Output/Fields every=0')) + '/ensemble.csv')
    uniform = run(MAIN, *common, *UNIFORM)
    lines = []
    for angle in angles:
        row = min(ensemble, key=lambda row, angle=angle: abs(row['angle_deg'] - angle))
        off = (row['torque_mean_Nmm'] - torque_at(uniform['curve'], row['angle_deg'])) / uniform['T_max_Nmm']
        lines.append(['%g deg' % angle, '%+.2f %%' % (100 * off), '%.2f %%' % (100 * row['torque_sd_Nmm'] / uniform['T_max_Nmm'])])
    return table(['angle', 'mean of random less uniform, over the largest torque', 'scatter of one pattern (standard deviation)'], lines)


@numbers('minutes')
def ensemble():
    study('prm/studies/ensemble.prm')
    row = rows_of(directory_of('prm/studies/ensemble.prm', ()) + '/ensemble_summary.csv')[0]
    uniform = run('prm/studies/ensemble_scene.prm', *UNIFORM)
    lines = []
    for name, column, unit, factor, digits in (
            ('T_max [N mm]', 'T_max', 'Nmm', 1, 2), ('T_inf [N mm]', 'T_inf', 'Nmm', 1, 2), ('E_deb [1e-3 N m]', 'E_deb', 'Nm', 1000, 3),
            ('W_adh [1e-3 N m]', 'W_adh', 'Nm', 1000, 3), ('D_adh [1e-3 N m]', 'D_adh', 'Nm', 1000, 4),
            ('initial stiffness [N m/rad]', 'initial_stiffness', 'Nm_per_rad', 1, 2)):
        mean, low, high = ('%.*f' % (digits, factor * row['%s_%s_%s' % (column, what, unit)]) for what in ('mean', 'p05', 'p95'))
        lines.append([name, mean, '%.2g' % (factor * row['%s_sd_%s' % (column, unit)]), low + ' to ' + high,
                      '%.*f' % (digits, factor * uniform[column + '_' + unit])])
    return table(['200 implants, 55 % bonded', 'mean', 'standard deviation', '5 to 95 %', 'homogeneous 0.55'], lines)


@numbers('minutes')
def ensemble_correlation():
    scene = 'prm/studies/ensemble_correlation.prm'
    study(scene)
    bonded = [run('prm/studies/ensemble_scene.prm', UNIFORM[0], 'Interface/Bonding/Initial bonding=%d' % phi)['T_max_Nmm'] for phi in (0, 1)]
    lines = []
    for row in rows_of(directory_of(scene, ()) + '/ensemble_summary.csv'):
        length, sd = row['Interface / Bonding / Correlation length'], row['T_max_sd_Nmm']
        lines.append(['%g' % length + ' (elements of 0.22 mm)' * (length == 0),
                      '%.2f, %.2f, %.2f to %.2f' % (row['T_max_mean_Nmm'], sd, row['T_max_p05_Nmm'], row['T_max_p95_Nmm']),
                      percent(sd / (bonded[1] - bonded[0])) + ' of the surface' * (length == 0),
                      '%.2f %%' % (100 * row['D_adh_sd_Nm'] / row['D_adh_mean_Nm']), '%.1f' % row['largest_bonded_patch_mean_mm2']])
    return table(['correlation length [mm]', 'T_max: mean, standard deviation, 5 to 95 % [N mm]',
                  'the same in bonded fraction (standard deviation)', 'D_adh, standard deviation', 'largest patch, mean [mm2]'], lines)


# Pages


def pages():
    return ['README.md', 'tests/comparison/README.md'] + sorted(glob.glob('doc/*.md'))


def compare(old, new):
    """Whether a text says the same: numbers to one unit of the last digit printed, all else alike."""
    if NUMBER.sub('#', old).split() != NUMBER.sub('#', new).split():
        return False
    for a, b in zip(NUMBER.findall(old), NUMBER.findall(new)):
        mantissa, _, exponent = a.partition('e')
        unit = 10. ** (int(exponent or 0) - len(mantissa.partition('.')[2]))
        if abs(float(a) - float(b)) > 1.001 * unit:
            return False
    return True


def treat(page, wanted):
    """Puts the numbers into a page, or compares; returns whether all is well and the names found."""
    with open(page, encoding='utf-8') as lines:
        text = lines.read()
    found, good = set(), True

    def replaced(match):
        nonlocal good
        begin, name, old, end = match.groups()
        if name not in NAMES:
            sys.exit('numbers.py: %s: nothing makes "%s"' % (page, name))
        found.add(name)
        if name not in wanted:
            return match[0]
        new = NAMES[name][0]()
        if options.check and not compare(old, new):
            print('%s, %s: the page says\n%s\nand the program\n%s' % (page, name, old.strip(), new.strip()))
            good = False
        return match[0] if options.check or compare(old, new) else begin + new + end

    new_text = BLOCK.sub(replaced, text)
    if len(re.findall(r'<!-- numbers: \w+ -->', text)) != len(BLOCK.findall(text)):
        sys.exit('numbers.py: %s: a mark without an end' % page)
    if new_text != text:
        with open(page, 'w', encoding='utf-8') as lines:
            lines.write(new_text)
    return good, found


def main():
    global options
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('names', nargs='*', metavar='NAME')
    for flag in ('--all', '--check', '--force', '--list'):
        parser.add_argument(flag, action='store_true')
    parser.add_argument('--results', default='output/numbers', help='directory of the runs (default: %(default)s)')
    parser.add_argument('--debond', default=os.environ.get('DEBOND', 'build/release/debond'), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.list:
        for name, (_, cost) in NAMES.items():
            print('%-24s %s' % (name, cost))
        return
    unknown = set(options.names) - set(NAMES)
    if unknown:
        sys.exit('numbers.py: no such NAME: %s; --list names all' % ', '.join(sorted(unknown)))
    if not os.access(options.debond, os.X_OK):
        sys.exit('numbers.py: there is no %s: build the program first, or set DEBOND' % options.debond)
    wanted = options.names or [name for name, (_, cost) in NAMES.items() if options.all or cost == 'seconds']
    results = [treat(page, wanted) for page in pages()]
    unused = set(NAMES) - set().union(*(found for _, found in results))
    if unused:
        sys.exit('numbers.py: no page has ' + ', '.join(sorted(unused)))
    sys.exit(not all(good for good, _ in results))


if __name__ == '__main__':
    main()
