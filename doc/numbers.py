#!/usr/bin/env python3
"""Makes the numbers that stand in README.md, the pages of doc and tests/comparison/README.md
between <!-- numbers: NAME --> and <!-- end -->, and the tables of doc/reference/parameters.md.

    doc/numbers.py                  all that take seconds, into the pages (some two minutes)
    doc/numbers.py NAME...          only these; --all: those that take minutes, too
    doc/numbers.py --list           all names, their cost, pages, and the files that they depend on; the pictures
    doc/numbers.py --check [NAME]   changes no page; exit code 1 if a page says something else

Each function below with @numbers is one NAME, and returns what stands there. Tables of more than a dozen rows go to
doc/evidence/tables/NAME.csv, and a few of their rows to the page. Runs go to output/numbers; --force runs studies again
that are there already. Programs: build/release/debond, or DEBOND. In a check numbers may differ by one unit of the last digit
that the page prints. Seconds are those of one machine: they come from tables that are stored. What has the cost `machine' consists of
seconds and memory, or of more digits than another processor gives, and is compared with nothing.
"""
import argparse
import csv
import functools
import glob
import inspect
import io
import json
import math
import os
import re
import subprocess
import sys
import zlib

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), '..'))
sys.path.append('python')
from debond.page_data import curve_file, rows_file, short  # noqa: E402

BLOCK = re.compile(r'(<!-- numbers: (\w+) -->)(.*?)(<!-- end -->)', re.S)
NUMBER = re.compile(r'(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?')
MAIN, REFERENCE = 'prm/paper/main_scene.prm', 'Output/Reference curve=prm/studies/data/work_precision_torque.csv'
STAND_IN = 'prm/paper/data/closed_form_b_data_set_%d.csv'
LINEAR = ('Bone/Material=linear', 'Implant/Material=linear')
LAYERED = ('Expert/Bone/Layer grading=1.5', 'Expert/Implant/Layer grading=1.5')
OTHER_INTERFACE = ('Interface/Normal stiffness=585', 'Interface/Tangential stiffness=auto', 'Interface/Friction coefficient unbroken=0.58',
                   'Interface/Characteristic slip distance=0.022')
THREE_PHASES = ('Load steps/Times=0, 1, 1.1, 2', 'Load steps/Steps=1, 10, 10')
ADAPTIVE = ('Load steps/Steps=1, 10', 'Load steps/Adaptive=true')
NAMES, options = {}, None
TABLES = 'doc/evidence/tables/'
CSV_FILES = {}  # name: text of the long tables that were made
EXACT = {'parameters'}  # where a number that differs in its last digit is another one
BY_STEPS = {'adaptive_scenes': 0.2}  # shares by which rounding, and so the processor, changes numbers of many adaptive steps


def isotropic(eps):
    """An interface as stiff tangentially as normally [MPa/mm]."""
    return 'Interface/Normal stiffness=%g' % eps, 'Interface/Tangential stiffness=auto'


def numbers(cost):
    """Registers a function as NAME; cost is `seconds', `minutes' or `machine'."""
    def register(function):
        NAMES[function.__name__] = (function, cost)
        return function
    return register


def debond(scene, directory, *changes, force=True, ranks=0):
    """ranks: under mpirun with so many processes of a thread each."""
    changes = ('Output/Directory=' + directory, 'Expert/Output/Console=quiet') + changes
    mpirun = ['mpirun', '--oversubscribe', '-np', str(ranks)] * (ranks > 0)
    os.environ.update({'OMPI_ALLOW_RUN_AS_ROOT': '1', 'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1'})
    alone = ['--threads', '1'] * (ranks > 0) + ['--jobs', '1'] * (ranks == 1)
    command = mpirun + [options.debond, scene] + alone + ['--force'] * force + [word for change in changes for word in ('--set', change)]
    if subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode:
        sys.exit('numbers.py: this failed: ' + ' '.join('"%s"' % word if ' ' in word else word for word in command))


@functools.lru_cache(None)
def run(scene, *changes):
    """The summary of a run, with its rows and the curve between them, those of curve.csv."""
    directory = directory_of(scene, changes)
    debond(scene, directory, 'Output/Fields every=none', 'Output/Report=false', *changes)
    with open(directory + '/summary.json', encoding='utf-8') as text:
        summary = json.load(text)
    return {**summary, 'curve': rows_of(rows_file(directory)), 'fine curve': fine_curve(directory)}


def fine_curve(directory):
    return rows_of(curve_file(directory))


@functools.lru_cache(None)
def study(scene, *changes):
    """The rows of study.csv."""
    directory = directory_of(scene, changes)
    debond(scene, directory, *changes, force=options.force)
    return rows_of(directory + '/study.csv')


def study_with_curves(scene, *changes):
    """The same, each row with its curve."""
    return [{**row, 'curve': fine_curve('%s/variant-%03d' % (directory_of(scene, changes), row['variant']))}
            for row in study(scene, *changes)]


@functools.lru_cache(None)
def fit(scene, *changes):
    """What calibration.json says."""
    directory = directory_of(scene, changes)
    debond(scene, directory, *changes)
    with open(directory + '/calibration.json', encoding='utf-8') as text:
        return json.load(text)


def console(*words):
    """What debond prints."""
    return subprocess.run([options.debond, *words], stdout=subprocess.PIPE, text=True, check=True).stdout


def check(scene, *changes):
    """What debond --check prints."""
    return console(scene, '--check', *(word for change in changes for word in ('--set', change)))


def directory_of(scene, changes):
    name = ' '.join((scene,) + changes)  # the checksum tells those with the same end apart
    return os.path.join(options.results, re.sub(r'\W+', '_', name)[-180:] + '_%08x' % zlib.crc32(name.encode()))


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
    return max(abs(torque_at(result['fine curve'], row['angle_deg']) - row['torque_Nmm'])
               for row in reference['fine curve'] if row['angle_deg'] > 0) / reference['T_max_Nmm']


def table(head, rows):
    lines = [head, ['---'] * len(head)] + rows
    return '\n' + ''.join('| %s |\n' % ' | '.join(str(cell) for cell in line) for line in lines)


def csv_of(head, rows):
    """The same for a file, without what makes code or bold text."""
    def plain(cell):
        cell = re.sub(r'`|[*][*]', '', str(cell).strip())
        return '"%s"' % cell.replace('"', '""') if ',' in cell or '"' in cell else cell
    return ''.join(','.join(plain(cell) for cell in row) + '\n' for row in [head] + rows)


def link(name, rows):
    return '\nAll %d rows: [tables/%s.csv](tables/%s.csv)\n' % (len(rows), name, name)


def long_table(name, head, rows, shown):
    """A table for a file of its own; in the page are the rows whose first cells are in shown, and a link."""
    CSV_FILES[name] = csv_of(head, rows)
    return table(head, [row for row in rows if tuple(map(str, row[:len(shown[0])])) in shown]) + link(name, rows)


def rows_of_markdown(text):
    """Head and rows of a table in Markdown."""
    rows = [[cell.strip() for cell in line.strip()[1:-1].split('|')] for line in text.strip().split('\n') if line.startswith('|')]
    return rows[0], rows[2:]


def two_digits(value):
    """3900, 0.42"""
    return '%.0f' % float('%.1e' % value) if value >= 10 else '%.2g' % value


def percent(value, digits=2):
    return ('%#.*g' % (digits, 100 * value)).rstrip('.') + ' %'


# The main scene


@numbers('seconds')
def choices():
    first = run(MAIN, REFERENCE)
    rows = []
    for name, scene, changes in (
            ('as it is: Neo-Hookean bodies, two equal layers, 1000 steps', MAIN, ()),
            ('linear bodies', MAIN, LINEAR),
            ('linear, adaptive steps with the tolerance 1e-3', MAIN, LINEAR + ADAPTIVE),
            ('the same, four graded layers: `coin_mode3_fast`', 'prm/coin_mode3_fast.prm', ()),
            ('splines: `coin_mode3_spline`', 'prm/coin_mode3_spline.prm', ()),
            ('rigid bodies', MAIN, ('Bone/Material=rigid', 'Implant/Material=rigid')),
            ('`Model = foundation`', MAIN, ('Model=foundation',))):
        result = run(scene, REFERENCE, *changes)
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
def bone_in_series():
    """What the bone under a rigid implant adds to the compliance of the printed interface."""
    press = isotropic(1800) + ('Bone/Material=linear', 'Implant/Material=rigid', 'Load steps/Times=0, 1', 'Load steps/Steps=1')
    two_layers, converged = (1 / (.0049 / run(MAIN, *press, *mesh)['pressure_MPa'] - 1 / 1800) for mesh in (
        (), ('Bone/Element=spline', 'Bone/Cells=60, 60, 12', 'Expert/Bone/Layer grading=2', 'Implant/Cells=8, 2')))
    return '%.0f MPa/mm; %.0f on the two layers of cells of the paper' % (converged, two_layers)


@numbers('seconds')
def steps_of_the_main_scene():
    curves = {n: run(MAIN, *LINEAR, 'Load steps/Steps=1, %d' % n) for n in (1, 10, 100, 1000)}
    worst = {n: max(abs(row['torque_Nmm'] - torque_at(curves[1000]['curve'], row['angle_deg']))
                    for row in curves[n]['curve'] if row['angle_deg'] > 0) / curves[1000]['T_max_Nmm'] for n in (100, 10, 1)}
    return '100 give %s of T_max, 10 give %s, one step of 10 degrees %s' % tuple(small(worst[n]) for n in (100, 10, 1))


@numbers('seconds')
def few_steps_lose():
    work = {n: run(MAIN, *LINEAR, 'Load steps/Steps=1, %d' % n)['W_adh_Nmm'] for n in (20, 50, 100, 200, 1000)}
    loss = {n: percent(1 - work[n] / work[1000], digits) for n, digits in ((20, 2), (50, 2), (100, 2), (200, 1))}
    return '20 equal steps lose %s of W_adh, 50 lose %s, 100 lose %s, 200 lose %s' % tuple(loss.values())


@numbers('seconds')
def energy_defect():
    return small(run(MAIN, REFERENCE)['largest_energy_defect'], 0)


@numbers('seconds')
def reaction_defect():
    return small(run(MAIN, REFERENCE)['largest_reaction_defect'], 0)


@numbers('seconds')
def slave_is_bone():
    off = []
    for changes in ((), ('Bone/Cells=30, 30, 2', 'Implant/Cells=6, 2')):
        implant, bone = (run(MAIN, 'Load steps/Steps=1, 20', *changes, 'Expert/Interface/Slave=' + slave)['curve'] for slave in ('implant', 'bone'))
        ratios = [b['torque_Nmm'] / a['torque_Nmm'] - 1 for a, b in zip(implant, bone) if a['angle_deg'] > 0]
        off.append(percent(max(ratios, key=abs)))
    return '%s on the coarse mesh, %s on the medium one' % tuple(off)


@numbers('seconds')
def versions():
    lines = []
    for scene, link, stiffness, mu, a_s in (
            (MAIN, 'calibrated, the *main scene* of tests and studies: `%s`', '622, 305', .586, 42),
            ('prm/paper/data_set_1_as_printed.prm', 'as printed: `%s`', '1800, 1800', .58, 22)):
        result = run(scene)
        lines.append([link % scene, stiffness, mu, a_s, '%.1f, %.1f' % (result['T_max_Nmm'], result['T_inf_Nmm']),
                      '%.2f' % result['pressure_MPa']])
    return table(['scene', 'stiffness normal, tangential [MPa/mm]', 'mu_ub', 'a_s [um]', 'T_max, T_inf [N mm] (published: 53.8, 36.8)',
                  'p [MPa] (2.6)'], lines)


# Closed forms and other codes


@numbers('seconds')
def closed_form_b():
    text = subprocess.run([sys.executable, 'doc/paper/closed_form_b.py', '--print-only'],
                          stdout=subprocess.PIPE, text=True, check=True).stdout
    return table(['set', 'T_max [N mm]', 'T_inf', 'E_deb [N mm]', 'E_fric', 'W_adh', 'w_adh [N/m]', 'w*_adh'],
                 [[line[:36].strip()] + line[36:].split() for line in text.splitlines()[1:]])


@numbers('seconds')
def numpy_main_scene():
    columns = []
    for name, start in (('main_scene', 'main_scene'), ('main_scene_as_printed', 'main_scene_1800')):
        result = run('tests/verification/%s.prm' % name, 'Load steps/Steps=1, 100', 'Expert/Load steps/Residual tolerance=1e-12')
        force = next(row['force_N'] for row in result['curve'] if row['time'] == 1)
        stiffness = run('tests/comparison/numpy/%s.prm' % start)['initial_stiffness_Nmm_per_rad'] / 1000
        columns.append(['%.10g' % force, '%.7g' % stiffness, '%.10g' % result['T_max_Nmm'], '%.10g' % result['T_inf_Nmm']])
    names = ('force after push-in [N]', 'stick stiffness, at 0.01 degrees [N m/rad]', 'T_max [N mm]', 'T at 10 degrees [N mm]')
    return table(['both programs', 'main scene', 'as printed'], [list(line) for line in zip(names, *columns)])


@numbers('seconds')
def calculix_scenes():
    page = text_of('tests/comparison/calculix/README.md')
    theirs = dict(re.findall(r'^\| eps (\d+), 4 \| CalculiX \|([\d. |]+?)\| +\|', page, re.M))
    columns = []
    for eps in ('585', '1800'):
        values = [float(value) for value in theirs[eps].split('|')]
        columns.append(['%.3f' % value for value in values])
        for kind in ('', '_bilinear'):
            curve = run('tests/verification/calculix_%s%s.prm' % (eps, kind))['curve']
            ours = [next(row['force_N'] for row in curve if row['time'] == 1)] + [torque_at(curve, angle) for angle in (.05, .1, .2, 1)]
            columns.append(['%+.*f %%' % (3 if kind else 2, 100 * (mine / value - 1)) for mine, value in zip(ours, values)])
    names = ['force [N]', 'torque at 0.05 degrees [N mm]', 'at 0.1 degrees', 'at 0.2 degrees', 'at 1 degree']
    return table(['', 'eps 585: CalculiX', 'NURBS', 'bilinear', 'eps 1800: CalculiX', 'NURBS', 'bilinear'],
                 [list(line) for line in zip(names, *columns)])


@numbers('minutes')
def cap_pulled_off():
    exact, lines = rows_of('prm/verification/data/cap_pulled_off.csv'), []
    w = math.e * 5 * .005
    for row in study_with_curves('prm/verification/cap_pulled_off.prm'):
        E = row['Bone / Young modulus']
        lam = 10 * (50 / (math.pi * w * (4 / 3 * E / .91) ** 2)) ** (1 / 3)
        i = next(i for i, line in enumerate(exact) if line['lambda'] > lam)
        near = exact[i - 2:i + 2]  # the cubic through four: a straight line would be off by 0.05 %
        weights = [math.prod(math.log(lam / b['lambda']) / math.log(a['lambda'] / b['lambda']) for b in near if b is not a)
                   for a in near]
        maugis, rings = (sum(weight * a[name] for weight, a in zip(weights, near)) for name in ('dugdale', 'exponential'))
        pull = -min(line['force_N'] for line in row['curve']) / (math.pi * w * 50)
        lines.append(['%.0f' % E, '%.3f' % lam, '%.3f' % maugis, '%.3f' % rings, '%.3f' % pull,
                      '%+.2f %%' % (100 * (pull / rings - 1)), '%+.1f %%' % (100 * (pull / maugis - 1))])
    return table(['E [MPa]', 'lambda', 'Maugis', 'rings', 'ours', 'from rings', 'from Maugis'], lines)


SNAP_BACK = 'prm/stability/snap_back%s.prm'


def jump_of_the_closed_form(stiffness):
    """T_max, the machine's angle [deg] at the jump, the torques before and after it, and the energy that it releases [N mm]."""
    curve = run(SNAP_BACK % '', 'Model=foundation', 'Chuck/Rotation z/Stiffness=none', 'Load steps/Steps=1, 10000')['curve']
    angles = [math.radians(row['angle_deg']) for row in curve]
    torques = [row['torque_Nmm'] for row in curve]
    machine = [theta + T / stiffness for theta, T in zip(angles, torques)]
    peak = next(i for i in range(2, len(curve) - 1) if machine[i + 1] < machine[i])
    after = next(i for i in range(len(curve) - 1, peak, -1) if machine[i - 1] <= machine[peak])
    torques[after] += (machine[peak] - machine[after]) / (machine[after - 1] - machine[after]) * (torques[after - 1] - torques[after])
    angles[after] = machine[peak] - torques[after] / stiffness
    spent = sum((torques[i] + torques[i + 1]) / 2 * (angles[i + 1] - angles[i]) for i in range(peak, after))
    released = (torques[peak] ** 2 - torques[after] ** 2) / (2 * stiffness) - spent
    return max(torques), math.degrees(machine[peak]), torques[peak], torques[after], released


@numbers('seconds')
def snap_back():
    T_max, angle, before, after, released = jump_of_the_closed_form(3000)
    control, viscous, path = (run(SNAP_BACK % name) for name in ('', '_viscous', '_path'))
    jump = max(zip(control['curve'], control['curve'][1:]), key=lambda rows: rows[0]['torque_Nmm'] - rows[1]['torque_Nmm'])
    by_machine = [{**row, 'angle_deg': row['machine_angle_deg']} for row in viscous['curve']]
    angles = [row['machine_angle_deg'] for row in path['curve']]
    turn = next(i for i in range(2, len(angles) - 1) if angles[i + 1] < angles[i])
    return table(['the brittle bond under 3000 N mm/rad', 'T_max [N mm]', 'angle of the fall [deg]', 'loses', 'tells'], [
        ['closed form', '%.3f' % T_max, '%.4f' % angle, '%.5f N mm' % released, 'limit points, jump'],
        ['`snap_back.prm`: rotation control, steps of 0.005 deg', '%.3f' % control['T_max_Nmm'],
         '%.3f to %.3f' % tuple(row['machine_angle_deg'] for row in jump),
         '%.4f N mm, `released_energy_Nmm`' % control['released_energy_Nmm'], 'a warning and `jumps` = %d' % control['jumps']],
        ['`snap_back_viscous.prm`: `Viscosity = 0.2`, steps of 0.001 deg', '%.3f' % viscous['T_max_Nmm'],
         '%.2f to %.2f' % (last_angle(by_machine, before), last_angle(by_machine, after)),
         '%.4f N mm, `viscous_work_Nmm`' % viscous['viscous_dissipation_Nmm'], 'a curve that depends on the rate'],
        ['`snap_back_path.prm`: `Path following = slip`', '%.3f' % path['T_max_Nmm'],
         'turns back at %.4f, to %.4f' % (angles[turn], min(angles[turn:])), 'nothing', 'the whole path']])


@numbers('minutes')
def bench():
    """All published tests of prm/bench."""
    rows = []
    for rig in sorted(set(glob.glob('prm/bench/*.csv')) - {'prm/bench/cement_bone_softening.csv'}):
        out = os.path.join(options.results, 'bench_' + os.path.basename(rig)[:-4])
        subprocess.run([sys.executable, '-m', 'debond', 'bench', rig, '--out', out, *['--force'] * options.force], check=True,
                       stdout=subprocess.DEVNULL, env={**os.environ, 'PYTHONPATH': os.path.join(os.path.dirname(options.debond), 'python')})
        with open(out + '/bench.json', encoding='utf-8') as text:
            results = json.load(text)
        for row in results['rows']:
            rows.append(['`%s`' % os.path.basename(rig), row['group'] + (' [%s]' % row['unit'] if row['unit'] else ''), row['mean'] or '–',
                         *(short(row[name], 3) for name in ('nominal', 'least', 'most')), row['verdict']])
    few = re.compile('rat_femur(?!.*(blasted, (9|84)|phosphate, 5) days)|steel_post.*force over')
    shown = [tuple(row[:2]) for row in rows if not few.search(' '.join(row[:2]))]
    return long_table('bench', ['rig', 'result', 'published', 'computed', 'least', 'most', 'verdict'], rows, shown)


@numbers('minutes')
def refinement():
    def line(name, eps, exact, cells, ours, errors):
        order = math.log(abs(errors[0] / errors[-1])) / math.log(cells[-1] / cells[0])
        return [name, eps, exact, ', '.join('%d' % n for n in cells), ours, ', '.join(percent(error) for error in errors), '%.1f' % order]

    def rows(name, column, variants):
        return [row[column] for row in study('prm/verification/%s_refinement.prm' % name)[variants]]

    lines = []
    for i, eps, exact in ((0, '1e4', 49.022), (4, '1e5', 88.397), (8, '1e6', 98.799)):
        torques = rows('reissner_sagoci', 'T_max_Nmm', slice(i, i + 4))
        lines.append(line('Reissner-Sagoci: torque', eps, '%.3f N mm' % exact, (20, 30, 40, 60), ', '.join('%.3f' % T for T in torques),
                          [T / exact - 1 for T in torques]))
    for i, (eps, exact) in enumerate((('1e4', 49.022), ('1e5', 88.397), ('1e6', 98.799), ('1e8', 100.661))):
        torques = [row['T_max_Nmm'] for row in study('prm/verification/reissner_sagoci_fitted.prm')[4 * i:4 * i + 4]]
        lines.append(['the same, cells that follow the rim', eps, '%.3f N mm' % exact, '12, 16, 20, 20 around it',
                      ', '.join('%.3f' % T for T in torques), ', '.join(percent(T / exact - 1) for T in torques), ''])
    lines.append(line('torsional partial slip: whole curve', '1e6', 'T(angle)', (20, 30, 40, 60), '',
                      rows('torsional_partial_slip', 'difference_max', slice(8, 12))))
    exact = 60 * (1 - .0344 * 5e5 / 1e6)
    forces = rows('hertz', 'force_end_N', slice(8, 12))
    lines.append(line('Hertz: force', '1e6', '%.3f N' % exact, (12, 16, 24, 32), ', '.join('%.3f' % F for F in forces),
                      [F / exact - 1 for F in forces]))
    lines.append(line('Lubkin: whole curve', '1e6', 'T(angle)', (16, 24, 32), '', rows('lubkin', 'difference_max', slice(3, 6))))
    forces = rows('cattaneo_mindlin', 'force_end_N', slice(0, 3))
    lines.append(line('Cattaneo-Mindlin: force P', '5e5', '60 N', (16, 24, 32), ', '.join('%.3f' % F for F in forces),
                      [F / 60 - 1 for F in forces]))
    return table(['what', 'eps [MPa/mm]', 'exact', 'cells across, N', 'ours', 'error', 'order, first to last'], lines)


def above_hertz(row, eps):
    """Mean of the force over that of Hertz, less the interface's first order, over d from 2.5 to 5 um."""
    errors = []
    for line in row['curve']:
        if line['time'] >= .5:
            radius = math.sqrt(50 * .005 * line['time'])
            errors.append(line['force_N'] / (60 * line['time'] ** 1.5) - 1 + 3 * 18000 / (2 * math.pi * radius * eps))
    return sum(errors) / len(errors)


@numbers('minutes')
def half_space_parts():
    def off(*changes):
        change = study('prm/verification/torsional_partial_slip.prm', *changes, 'Study/Reference variant=1')[1]['difference_max']
        return '%.2f %%' % (100 * change) if change >= 5e-5 else 'below 0.005 %'

    hertz = study_with_curves('prm/verification/hertz_refinement.prm')
    size = [row['force_end_N'] for row in study('prm/verification/hertz_block_size.prm')]
    locked = study('prm/verification/cattaneo_mindlin_refinement.prm')[1]['force_end_N'] / 60
    return table(['what', 'effect', 'made with'], [
        ['partial slip, whole curve: block of 20 against 12.5 mm',
         off('Bone/Size={{12.5, 12.5, 6.25||20, 20, 10}}', 'Bone/Cells={{40, 40, 10||64, 64, 16}}'),
         '`torsional_partial_slip.prm`, `Bone / Size`, `Cells`'],
        ['the same: 8 against 5 quadrature points', off('Expert/Interface/Quadrature points={{5|8}}'), '`Expert / Interface / Quadrature points`'],
        ['the same: 25 against 5 steps', off('Load steps/Steps={{1, 5|1, 25}}'), '`Load steps / Steps`'],
        ['the same: pressed in with friction instead of without', off('Interface/Friction starts at={{1|0}}'), '`Interface / Friction starts at`'],
        ['Hertz, error of the mesh of 12, 16, 24, 32 cells (1)',
         ', '.join('%.2f %%' % (100 * above_hertz(row, 1e6)) for row in hertz[8:12]), '`hertz_refinement.prm`, eps 1e6'],
        ['the same with 24 cells, eps = 2.5e5, 5e5, 1e6',
         ', '.join('%.2f %%' % (100 * above_hertz(row, eps)) for row, eps in zip(hertz[2::4], (2.5e5, 5e5, 1e6))),
         '`hertz_refinement.prm`'],
        ['Hertz, block of width L: force at L/a = 5, 10 against 20',
         ', '.join('%.2f %%' % (100 * (F / size[-1] - 1)) for F in size[:-1]), '`hertz_block_size.prm`'],
        ['nearly incompressible bone locks: P with nu = 0.45, 24 cells', '%+.1f %%' % (100 * (locked - 1)), '`cattaneo_mindlin_refinement.prm`']])


@numbers('minutes')
def shear_of_a_sphere():
    lines = []
    names = {'refinement': ['nu = 0.45, N = %d' % n for n in (16, 24, 32)], 'coupling': ['nu = %s, N = 24' % nu for nu in ('0', '0.3', '0.4')]}
    for name, row, of in [(name, row, of) for of in names for name, row in
                          zip(names[of], study_with_curves('prm/verification/cattaneo_mindlin_%s.prm' % of))]:
        half = next(line for line in row['curve'] if line['time'] == 1.5)
        shift = (1 - .5 ** (2 / 3)) / (half['force_N'] / 60) ** (2 / 3)
        ours, exact = half['chuck_Fx_N'] / (.1 * half['force_N']), 1 - (1 - shift) ** 1.5
        nu = float(name.split(',')[0][5:])
        of_disk = (1 - 2 * nu) ** 2 / (12 * (1 - nu) * (2 - nu))
        lines.append([name, '%+.1f %%' % (100 * (ours / exact - 1)), 'cattaneo_mindlin_' + of, '%+.1f %%' % (100 * of_disk)])
    return table(['half of mu P', 'Q more than for the P found', 'prm/verification/', 'a disk'], lines)


@numbers('minutes')
def bonds_on_half_spaces():
    """Largest loads against doc/verification/bonds_reference.py, the strength and Kendall's brittle bond."""
    reference = {row['strength_MPa']: row for row in rows_of('prm/verification/data/bonds_on_half_space.csv')}
    pull, twist = math.sqrt(8 * math.pi * 2.5 ** 3 * 18000 / .91 * .098), 8 / 3 * math.sqrt(math.pi * 18000 / 2.6 * .098 * 2.5 ** 5)
    lines = []
    for scene, what, column, load, brittle, weak, unit, strengths, first in (
            ('kendall', 'pulled off, `adhesive`', 'pull_off', 'force_N', pull, math.pi * 2.5 ** 2, 'N', (5, 20, 40, 60, 100, 300), 0),
            ('bonded_disk_torsion', 'twisted off, `adhesive`', 'twist_adhesive', 'torque_Nmm', twist, 2 * math.pi / 3 * 2.5 ** 3, 'N mm',
             (5, 20, 40, 80, 200), 0),
            ('bonded_disk_torsion', 'twisted off, `mixed mode`', 'twist_mixed_mode', 'torque_Nmm', twist, 2 * math.pi / 3 * 2.5 ** 3, 'N mm',
             (5, 20, 40, 80, 200), 5)):
        curves = study_with_curves('prm/verification/%s.prm' % scene)[first:]
        ours = [max(abs(line[load]) for line in row['curve']) for row, _ in zip(curves, strengths)]
        lines.append([what, ', '.join('%g' % strength for strength in strengths), ', '.join('%.2f' % F for F in ours) + ' ' + unit,
                      ', '.join('%+.2f %%' % (100 * (F / (reference[strength][column] * brittle) - 1)) for F, strength in zip(ours, strengths)),
                      '%+.2f %%' % (100 * (ours[0] / (weak * strengths[0]) - 1)), '%+.1f %%' % (100 * (ours[-1] / brittle - 1))])
    return table(['bond', 'strength [MPa]', 'ours', 'from the other method', 'weakest from the strength', 'strongest from the brittle bond'], lines)


@numbers('seconds')
def foundation():
    rows = []
    for cells, implant, grading in (('15, 15, 2', '3, 2', ()), ('15, 15, 4', '3, 4', LAYERED), ('30, 30, 4', '6, 4', LAYERED)):
        result = run(MAIN, REFERENCE, 'Model=foundation', 'Bone/Cells=' + cells, 'Implant/Cells=' + implant, *grading)
        rows.append(['4.9 um', '622, 305', cells.replace(', ', ' x ') + (', graded' if grading else ''), 'a converged reference',
                     percent(result['difference_max'])])
    same = run(MAIN, *LINEAR)
    rows.append(['4.9 um', '622, 305', '15 x 15 x 2', 'the same cells', percent(difference(run(MAIN, 'Model=foundation'), same))])
    for stiffness, changes, force in (('622, 305', (), 54.89), ('1000', isotropic(1000), 82.8), ('1800', isotropic(1800), 137.4)):
        result = study('prm/verification/foundation.prm', *changes, 'Chuck/Press/Value=%g * min(t, 1)' % force)
        rows.append(['%g N' % force, stiffness, '30 x 30 x 2', 'the same cells', percent(result[1]['difference_max'])])
    return table(['pressed by', 'eps [MPa/mm]', 'stiffness from bone cells', 'against finite elements on', 'largest difference'], rows)


# The paper's tables


@numbers('seconds')
def calibrated():
    scenes = study_with_curves('prm/paper/calibrated.prm')
    lines = [[], []]  # of each set
    rows = []  # of each set as printed, with a_s fitted to E_deb, and with b_s in its place
    for i, (a_s, b_s) in enumerate(((.022, 2.33), (.026, 4.81))):
        rows += scenes[2 * i:2 * i + 2] + [run('prm/paper/data_set_%d_calibrated.prm' % (i + 1), 'Accuracy=none', 'Interface/Characteristic slip distance=%g' % a_s,
                                               'Interface/Transition factor=%g' % b_s, 'Output/Reference curve=' + STAND_IN % (i + 1))]
    for name, how, paper, digits, missed, value in (
            ('T_max [N mm]', 'fitted', (53.8, 59.5), 2, (), lambda row: row['T_max_Nmm']),
            ('T_inf (10 degrees) [N mm]', 'fitted', (36.8, 44.4), 2, (), lambda row: row['T_inf_Nmm']),
            ('theta_lin = 0.75 T_max / K [deg]', 'fitted', (.13, .11), 3, (), theta_lin),
            ('E_deb [N mm]', 'fitted', (7.1, 8.9), 2, (), lambda row: row['E_deb_Nmm']),
            ('K = 0.75 T_max / theta_lin [N m/rad]', 'follows', (17.8, 23.2), 2, (), lambda row: row['initial_stiffness_Nmm_per_rad'] / 1000),
            ('E_fric = T_inf (10 degrees - theta_fric) [N mm]', 'follows', (5.7, 6.2), 2, (), lambda row: row['E_fric_Nmm']),
            ('W_adh = E_deb - E_fric [N mm]', 'follows', (1.4, 2.7), 2, (), lambda row: row['W_adh_Nmm']),
            ('debonding begins at the rim [deg]', 'met with a_s only', ('1.13 (text)', '-'), 2, (2,), lambda row: row['theta_debonding_deg']),
            ('theta_full, the last angle with 0.999 T_max [deg]', 'missed', ('1.13 (theta_max)', '2.02 (theta_max)'), 2, (1, 2, 4, 5), plateau_end),
            ('mean pressure [MPa]', 'missed', (2.6, 3.1), 3, (1, 2, 4, 5), lambda row: row['pressure_MPa']),
            ('initial stiffness K, measured (2) [N m/rad]', 'missed', (20.5, 20.5), 2, (1, 2, 4, 5),
             lambda row: row['initial_stiffness_Nmm_per_rad'] / 1000),
            ('e_mp against the stand-in [%]', 'the shape', ('', ''), 1, (), lambda row: 100 * row['e_mp'])):
        ours = ['**%.*f**' % (digits, value(row)) if i in missed else '%.*f' % (digits, value(row)) for i, row in enumerate(rows)]
        for i in (0, 1):
            lines[i].append([name, how, paper[i]] + ours[3 * i:3 * i + 3])
    return ''.join(table(['data set %d' % (i + 1), 'calibrated scene', 'paper', 'as printed' + i * ' (1)', 'a_s fitted', 'b_s fitted'], lines[i]) for i in (0, 1))


def theta_lin(row):
    return math.degrees(.75 * row['T_max_Nmm'] / row['initial_stiffness_Nmm_per_rad'])


def plateau_end(row):
    return last_angle(row['curve'], .999 * row['T_max_Nmm'])


@numbers('seconds')
def contradictions():
    names = ('eps 1800, as printed', 'eps 585', 'eps 623.4', 'calibrated', 'Eq. (14), w_adh = 51 N/m', 'Eq. (14), w_adh = 70 N/m')
    lines = []
    for name, row in zip(names, study('prm/paper/contradictions.prm')):
        p, uniform = row['pressure_MPa'], 2 / 3 * math.pi * .4 * row['pressure_MPa'] * 2.5 ** 3
        line = ['%.2f' % p, '%.0f' % (p / .0049), '%.2f' % row['T_max_Nmm'], '%.2f' % row['T_inf_Nmm'],
                '%+.1f %%' % (100 * (row['T_inf_Nmm'] / uniform - 1)), '%.4f' % (row['T_max_Nmm'] / row['T_inf_Nmm']),
                '%.1f' % (row['initial_stiffness_Nmm_per_rad'] / 1000), '%.2f' % row['theta_debonding_deg']]
        lines.append([name] + (['2.81, given', '-', line[2]] + 5 * ['-'] if name[0] == 'E' else line))
    return table(['variants 1 to 6', 'p [MPa]', 'p/d [MPa/mm]', 'T_max [N mm]', 'T_inf', 'more than 2/3 pi mu_b p R^3 by', 'T_max / T_inf',
                  'K [N m/rad]', 'debonding begins [deg]'], lines)


@numbers('seconds')
def degrees_of_freedom():
    return ', '.join(re.search(r'(\d+) degrees of freedom', check('prm/paper/main_scene.prm', 'Bone/Cells=%d, %d, 2' % (n, n),
                                                                  'Implant/Cells=%d, 2' % (n / 5)))[1] for n in (15, 30, 60))


@numbers('seconds')
def table_2():
    paper = ((53.8, 36.8, .13, 1.13), (59.5, 44.4, .11, 2.02))
    lines = []
    for i, row in enumerate(study_with_curves('prm/paper/calibrated.prm')[1::2]):
        ours = '%.2f' % row['T_max_Nmm'], '%.2f' % row['T_inf_Nmm'], '%.3f' % theta_lin(row), '%.2f' % plateau_end(row)
        lines.append([i + 1] + ['%s, %s' % both for both in zip(paper[i], ours)])
    return table(['set', 'T_max [N mm]: paper, here', 'T_inf', 'theta_lin [deg]', 'theta_max: paper; here theta_full'], lines)


@numbers('seconds')
def table_5():
    paper = ((6.6, 5.6, '1.0', 70, 51), (7.1, 5.7, 1.4, 98, 72), (7.1, 5.7, 1.4, 98, 72),
             ('8.0', 6.4, 1.6, 120, 81), (8.7, 6.7, '2.0', 141, 102), (8.9, 6.2, 2.7, 191, 138))
    measured = (('7.0', 5.6, 1.4, 98, 71), (8.8, '6.0', 2.8, 198, 143))
    lines = []
    for i, row in enumerate(study('prm/paper/table_5.prm')):
        if i % 3 == 0:
            lines.append([1 + i // 3, 'exp.'] + list(measured[i // 3]) + 7 * ['-'])
        lines.append([1 + i // 3, ('(14) to (16)', 'Eq. (18)', 'simulation')[i % 3]] + list(paper[i]) +
                     ['%.2f' % row[name + '_Nmm'] for name in ('E_deb', 'E_fric', 'W_adh')] +
                     ['%.1f' % row['w_adh_N_per_m'], '%.1f' % row['w_adh_star_N_per_m'],
                      '%.2f' % row['D_adh_Nmm'] if i % 3 == 2 else '-', '-' if i % 3 == 1 else '%.1f' % (100 * row['e_mp'])])
    return table(['set', 'model', 'E_deb', 'E_fric', 'W_adh', 'w_adh', 'w*_adh', 'ours: E_deb', 'E_fric', 'W_adh', 'w_adh', 'w*_adh', 'D_adh',
                  'e_mp [%]'], lines)


@numbers('seconds')
def table_7_differences():
    lines = []
    for eps, changes in (('622, 305', ()), ('1800', isotropic(1800))):
        coarse, _, fine = study('prm/paper/table_7_meshes.prm', *changes)
        steps = study('prm/paper/table_7_steps.prm', *changes)[1]
        lines.append([eps, '%.3f %%' % (100 * coarse['difference_max']), '%.3f %%' % (100 * fine['difference_max']),
                      small(steps['difference_max'])])
    return table(['eps [MPa/mm]', 'coarse to medium', 'medium to fine', '100 to 1000 steps'], lines)


@numbers('seconds')
def table_3():
    rows = study('prm/paper/table_3.prm')
    lines = []
    for i, modulus in enumerate(('9, 3.5', '18, 6.9 (printed: 18, 7)', '36, 13.8')):
        soft, stiff = (rows[i + k]['torsional_stiffness_MPa_per_mm'] for k in (0, 3))
        k = math.pi / 2 * 2.5 ** 4 / 1000 # N m/rad per MPa/mm
        lines.append([modulus, '%.1f' % soft, '%.2f' % (k * soft), '%.1f' % stiff, '%.1f' % (k * stiff)])
    return table(['E_b, G_b [GPa]', 'calibrated interface: lambda [MPa/mm]', 'K [N m/rad]', 'printed interface: lambda', 'K'], lines)


@numbers('seconds')
def table_4():
    printed = {1: {.2: 5.2, .25: 4.2, .3: 3.5, .35: 3.0, .4: 2.6, .45: 2.3, .5: 2.1}, 2: {.3: 4.1, .4: 3.1}}
    lines = []
    for data_set in (1, 2):
        for row in study('prm/paper/table_4_set_%d.prm' % data_set):
            mu = row['Interface / Friction coefficient broken']
            off = row['difference_max']
            lines.append([data_set, '%.2f' % mu, '%.1f' % (1000 * number(row['Chuck / Press / Value'].split()[0])),
                          '%.2f' % row['Interface / Friction coefficient unbroken'], printed[data_set][mu], '%.3f' % row['pressure_MPa'],
                          '%.2f' % row['T_max_Nmm'], '%.2f' % row['T_inf_Nmm'],
                          '-' if mu == .4 else small(off, 0) if off < 1e-3 else '%.1f %%' % (100 * off)])
    return table(['set', 'mu_b', 'd [um]', 'mu_ub', 'p: paper', 'p: ours', 'T_max [N mm]', 'T_inf [N mm]', 'difference'], lines)


@numbers('minutes')
def calibration_fits():
    """The calibrated scenes beside fits of four numbers, with b_s as printed, and of five, of which a_s and b_s stand in for each other."""
    names = ('eps_n', 'eps_t', 'mu_ub', 'a_s', 'b_s')
    scenes = {1: (622, 305, .586, .042, .74), 2: (710, 403, .546, .052, 1.86)}
    lines = []
    for data_set, scene in scenes.items():
        e_mp = run('prm/paper/data_set_%d_calibrated.prm' % data_set, 'Output/Reference curve=%s' % STAND_IN % data_set)['e_mp']
        rows = [('calibrated scene', dict(zip(names, scene)), e_mp)]
        for what, changes in (('four numbers', ('Interface/Transition factor=%g' % scene[4],)), ('five numbers', ())):
            result = fit('prm/calibrate/data_set_%d.prm' % data_set, *changes)
            found = {name: unknown['value'] for name, unknown in result['unknowns'].items()}
            rows.append((what, {'b_s': scene[4], **found}, result['curves'][0]['e_mp']))
        lines += [[data_set, what, '%.0f, %.0f' % (of['eps_n'], of['eps_t']), '%.3f' % of['mu_ub'], '%.*f' % (what[:4] != 'five', 1000 * of['a_s']),
                   '%.*f' % (1 + (what[:4] != 'five'), of['b_s']), '%.2f' % (100 * e_mp)] for what, of, e_mp in rows]
    return table(['set', 'what', 'eps_n, eps_t [MPa/mm]', 'mu_ub', 'a_s [um]', 'b_s', 'e_mp [%]'], lines)


def staged_table(*what):
    return '\n' + subprocess.run(['doc/paper/staged.sh', *what], env={**os.environ, 'DEBOND': os.path.abspath(options.debond), 'MU_B': '0.20 0.40 0.50'},
                                 check=True, capture_output=True, text=True).stdout


@numbers('minutes')
def staged():
    return staged_table('1', '2')


@numbers('minutes')
def staged_patterns():
    return staged_table('patterns')


LAYERS = {(2, 1.): '2 (the paper) | 1', (2, 1.5): '2 | 1.5', (4, 1.): '4 | 1', (4, 1.5): '4 | 1.5', (8, 1.): '8 | 1', (8, 1.5): '8 | 1.5'}


def layer_rows(name):
    """By layers and grading: p, K and T_inf relative to those of 8 graded layers, and the difference of the torque."""
    rows = {(int(row['Bone / Cells'].split()[-1]), row['Expert / Bone / Layer grading']): row for row in study('prm/paper/%s.prm' % name)}
    columns, last = ('pressure_MPa', 'initial_stiffness_Nmm_per_rad', 'T_inf_Nmm'), rows[8, 1.5]
    lines = {key: ['%+.2f %%' % (100 * (row[c] / last[c] - 1)) for c in columns] + ['%.2f %%' % (100 * row['difference_max'])]
             for key, row in rows.items()}
    lines[8, 1.5] = ['%.4f MPa' % last[columns[0]], '%.2f N m/rad' % (last[columns[1]] / 1000), '%.2f N mm' % last[columns[2]], '-']
    return lines


@numbers('seconds')
def table_7_layers():
    soft, stiff = layer_rows('table_7_layers'), layer_rows('table_7_layers_printed')
    return table(['layers in each body', 'grading', 'main scene: p', 'K', 'T_inf', 'torque', 'as printed: p', 'K', 'T_inf', 'torque'],
                 [name.split(' | ') + soft[key] + stiff[key] for key, name in LAYERS.items()])


@numbers('seconds')
def layers_plateau():
    return '%.1f %%' % float(layer_rows('table_7_layers')[2, 1.][2].split()[0])


# Seconds, from stored tables


def baseline():
    return {(row['mesh'], row['bodies'], str(row['steps']), int(row['threads'])): row['seconds']
            for row in rows_of('tests/benchmark/baseline.csv')}


@numbers('seconds')
def splines_are_closer():
    """Error of trilinear cells that no faster ones reach, over that of the closest splines that take no longer."""
    trilinear, splines = (sorted((number(row[seconds].split()[0]), row['torque']) for row in rows_of(TABLES + 'work_precision_%s.csv' % name))
                          for name, seconds in (('meshes', 'all'), ('splines', 'seconds')))
    best, parts = math.inf, []
    for seconds, error in trilinear:
        closest = min((e for s, e in splines if s <= seconds), default=None)
        if error < best and closest:
            parts.append('%.2g times at %.2g s' % (error / closest, seconds))
        best = min(best, error)
    return ', '.join(parts)


@numbers('seconds')
def neo_hooke_cost():
    seconds = baseline()
    ratios = [s / seconds[mesh, 'linear', steps, threads] for (mesh, bodies, steps, threads), s in seconds.items() if bodies != 'linear']
    return '%.1f to %.1f' % (min(ratios), max(ratios))


@functools.lru_cache(None)
def codes_rows(name, *options):
    """Rows of other codes and ours with the seconds of debond at the same error, and how many times as long another code takes."""
    file = 'prm/studies/data/%s.csv' % name
    text = subprocess.run(['tests/comparison/work_precision.sh', '--factors', *options, file], stdout=subprocess.PIPE, text=True, check=True).stdout
    found = {(line[:9].strip(), line[10:55].strip()): line.split()[-2:] for line in text.splitlines()[1:]}
    return [{**row, 'own': own, 'factor': factor} for row in rows_of(file) for own, factor in [found.get((row['code'], row['label']), ('', ''))]]


def codes_table(name):
    return table(['code, bone / implant', 'increments', 'unknowns', 'seconds', 'error', 'debond, same error or less', 'factor'],
                 [['%s %s' % (row['code'], row['label']), '%d' % row['increments'], '%d' % row['unknowns'], two_digits(row['seconds']),
                   small(row['error_torque']), row['own'], row['factor'] and two_digits(float(row['factor']))] for row in codes_rows(name)])


@numbers('seconds')
def codes_curve():
    return codes_table('other_codes')


@numbers('seconds')
def codes_angles():
    return codes_table('other_codes_angles')


def factors_of(begin, *options):
    """Smallest and largest for the labels of the curve that begin so."""
    factors = [float(row['factor']) for row in codes_rows('other_codes', *options) if row['code'] != 'debond' and row['label'].startswith(begin)]
    low, high = two_digits(min(factors)), two_digits(max(factors))
    return low if low == high else low + ' to ' + high


@numbers('seconds')
def calculix_factor():
    return factors_of('C3D8')


@numbers('seconds')
def calculix_quadratic_factor():
    return factors_of('C3D20R')


@numbers('seconds')
def getfem_factor():
    return factors_of('Q')


@numbers('seconds')
def factors_without_start():
    return '%s, %s and %s' % tuple(factors_of(begin, '--without-start') for begin in ('C3D8', 'C3D20R', 'Q'))


# What takes minutes


def stored(name):
    """Head and rows of a table that doc/studies/publish.py has written."""
    return next((head, rows) for head, *rows in [list(csv.reader(io.StringIO(text_of(TABLES + name + '.csv'))))])


def with_seconds_of(name, rows):
    """New rows with the seconds that are stored."""
    return [[old if re.fullmatch(r'[\d.]+ s', old) else new for old, new in zip(*both)] for both in zip(stored(name)[1], rows)]


@numbers('minutes')
def stiffness():
    """Errors of today beside the stored seconds; doc/studies/stiffness.py --publish measures both."""
    errors = iter([row['difference_max'] for row in study('prm/studies/stiffness.prm')])
    head, rows = stored('stiffness')
    rows = [[row[0]] + ['%s: %.1e' % (cell.split(':')[0], next(errors)) for cell in row[1:]] for row in rows]
    CSV_FILES['stiffness'] = csv_of(head, rows)
    return table(head, [rows[i] for i in (1, 3, 5, 10, 12)]) + link('stiffness', rows)


@numbers('minutes')
def work_precision():
    """The same of the tables of doc/studies/work_precision.sh --publish."""
    def awk(script, *files):
        return subprocess.run(['awk', '-f', 'doc/studies/%s.awk' % script, *files], stdout=subprocess.PIPE, text=True, check=True).stdout

    scenes = ['prm/studies/work_precision%s.prm' % name for name in ('_closed_forms', '_ends', '_splines', '_quadratic', '')]
    text = awk('gather', *(study(scene) and directory_of(scene, ()) + '/study.csv' for scene in scenes))
    gathered = options.results + '/work_precision.csv'
    with open(gathered, 'w', encoding='utf-8') as file:
        file.write(text)

    def errors_of(choice, column):  # closed forms with the stiffness of several meshes are called alike
        return [row[column] for row in rows_of(gathered) if row['label'] == choice]

    tables = dict(zip(('splines', 'meshes', 'factors'), map(rows_of_markdown, re.split(r'\n\s*\n', awk('tables', gathered)))))
    tables = {name: (head, with_seconds_of('work_precision_' + name, rows)) for name, (head, rows) in tables.items()}
    head, rows = stored('work_precision_front')
    tables['front'] = head, [row[:2] + ['%.1e' % min(errors_of(row[3], 'error_torque'), key=lambda error: abs(error - float(row[2])))] + row[3:]
                             for row in rows]
    head, rows = stored('work_precision_fastest')
    errors = ('error_torque', 'error_pressure', 'error_slip')
    tables['fastest'] = head, [row[:1] + [cell if min(errors_of(cell.split(': ', 1)[1], error)) <= 1.01 * float(row[0][:-2]) / 100 else 'not this one'
                                          for cell, error in zip(row[1:], errors)] for row in rows]
    for name, (head, rows) in tables.items():
        CSV_FILES['work_precision_' + name] = csv_of(head, rows)
    return ''.join(table(*tables[name]) for name in ('splines', 'fastest', 'front'))


@numbers('machine')
def stability():
    text = subprocess.run(['doc/stability/stability.sh'], stdout=subprocess.PIPE, text=True, check=True).stdout
    return long_table('stability', *rows_of_markdown(text), [
        ('slip_direction', 'default'), ('slip_direction', 'previous-gap'), ('uniqueness', 'default'), ('chatter', 'bilinear-dense')])


def runs_to_accuracy():
    """Rows of the studies of Accuracy = 1 % against the truth, and the directories of their variants."""
    return [(row, '%s/variant-%03d' % (directory_of(scene, ()), row['variant']))
            for scene in ('prm/verification/accuracy.prm', 'prm/verification/accuracy_stiff.prm') for row in study(scene)]


@numbers('minutes')
def accuracy():
    """Seconds are those of the last two runs of a scene; in a check those that are stored."""
    names = ('main', 'disk pattern, f = 0.55', '3.5 mm off centre, near the edge', '1800 MPa/mm', '18 000 MPa/mm', '180 000 MPa/mm',
             'soft interface, 20 MPa/mm', 'soft implant, 30 MPa', 'tilted by 0.1 degrees', 'force held', 'brittle law',
             '10 000 MPa/mm', '1e6 MPa/mm', '1e5 MPa/mm: disk pattern, f = 0.55', '1e5 MPa/mm: tilted by 0.05 degrees',
             '1e5 MPa/mm: force held', '1e5 MPa/mm: brittle law', "1e5 MPa/mm: Poisson's ratio 0.45", '1e5 MPa/mm: near the edge')
    lines = []
    for name, (row, directory) in zip(names, runs_to_accuracy()):
        chosen = text_of(directory + '/parameters.prm')
        cells = [re.search(r'subsection %s\n.*?set Cells +=([^#\n]*)' % body, chosen, re.S)[1].strip() for body in ('Bone', 'Implant')]
        estimate, error = row['error_estimate'], row['difference_max']
        seconds = row['wall_seconds'] + json.loads(text_of(directory + '/coarser/summary.json'))['wall_seconds']
        lines.append([name, ' / '.join(cells), percent(estimate), percent(error), two_digits(estimate / error), two_digits(seconds) + ' s'])
    if options.check:
        lines = with_seconds_of('accuracy', lines)
    return long_table('accuracy', ['scene', 'cells chosen, bone / implant', 'estimate', 'true error', 'estimate / true', 'seconds'], lines, [
        ('main',), ('soft implant, 30 MPa',), ('1e6 MPa/mm',), ('1e5 MPa/mm: disk pattern, f = 0.55',), ('1e5 MPa/mm: near the edge',)])


@numbers('minutes')
def accuracy_errors():
    errors = sorted(row['difference_max'] for row, _ in runs_to_accuracy())
    return '%s to %s' % (percent(errors[0]), percent(errors[-1]))


@numbers('minutes')
def table_7():
    paper = {100: (2.233, 2.195, 2.186), 200: (2.242, 2.197, 2.185), 500: (2.239, 2.191, 2.177), 1000: (2.240, 2.190, 2.176),
             2000: (2.241, 2.190, 2.176), 2500: (2.241, 2.190, 2.176)}
    ours = {(row['Load steps / Steps'], row['Bone / Cells']): row['e_mp'] for row in study('prm/paper/table_7.prm')}
    return table(['step', 'ours: coarse', 'medium', 'fine', 'the paper: coarse', 'medium', 'fine'],
                 [['%g deg' % (10 / n)] + ['%.3f' % (100 * ours['1, %d' % n, '%d, %d, 2' % (cells, cells)]) for cells in (15, 30, 60)] +
                  ['%.3f' % value for value in values] for n, values in paper.items()])


@numbers('minutes')
def partial_equal():
    names = ('homogeneous', 'homogeneous', '(b), ours', '(c) disk', '(d) random')
    return table(['pattern', 'mean phi_0', 'T_max [N mm]', 'last angle with 0.999 T_max [deg]', 'T(10 deg) [N mm]', 'E_deb [N mm]',
                  'W_adh', 'w_adh [N/m]', 'D_adh [N mm]'],
                 [[name, '%.4g' % row['phi_0_mean'], '%.2f' % row['T_max_Nmm'], '%.2f' % last_angle(row['curve'], .999 * row['T_max_Nmm']),
                   '%.2f' % row['T_inf_Nmm'], '%.3f' % row['E_deb_Nmm'], '%.3f' % row['W_adh_Nmm'],
                   '%.1f' % row['w_adh_N_per_m'], '%.3f' % row['D_adh_Nmm']]
                  for name, row in zip(names, study_with_curves('prm/paper/partial_equal_parameters.prm'))])


@numbers('minutes')
def partial_fitted():
    paper = (('homogeneous, 1', '4.90 | 0.58 | 22, 42 | 0.74 | 2.240 | 1.4 | 130'), ('(b), ours', '4.80 | 0.80 | 21, 40.1 | 0.63 | 1.949 | 1.5 | 139'),
             ('(c) disk', '4.80 | 0.97 | 15, 28.6 | 0.67 | 1.988 | 1.4 | 130'), ('(d) random', '4.85 | 0.73 | 22, 42 | 0.66 | 2.152 | 1.5 | 139'))
    area = 1e-3 * math.pi * 2.5 ** 2 # mm^2 / 1000: N mm over it are N/m
    return table(['pattern', 'd [um]', 'mu_ub', 'a_s: printed, here [um]', 'b_s', 'e_mp [%]: paper', 'W_adh [N mm]', 'w_adh [N/m]',
                  'ours: p [MPa]', 'T_max [N mm]', 'T(10 deg)', 'e_mp', 'W_adh', 'w_adh'],
                 [[name] + printed.split(' | ') +
                  ['%.3f' % row['pressure_MPa'], '%.2f' % row['T_max_Nmm'], '%.2f' % row['T_inf_Nmm'], '%.2f' % (100 * row['e_mp']),
                   '%.2f' % row['W_adh_Nmm'], '%.0f' % (row['W_adh_Nmm'] / (.55 * area))]
                  for (name, printed), row in zip(paper, study('prm/paper/partial_fitted_parameters.prm'))])


def largest(curve, reference, low, high):
    """The largest difference between two angles, with its sign."""
    return max((row['torque_Nmm'] - torque_at(reference, row['angle_deg']) for row in curve if low < row['angle_deg'] <= high), key=abs)


@numbers('minutes')
def partial_readings():
    printed_a_s = 'Interface/Characteristic slip distance={{0.022||0.021||0.015||0.022}}'
    lines = []
    stiff = 'Interface/Normal stiffness=1800', 'Interface/Tangential stiffness=1800'
    for name, changes in (('printed (1800), printed a_s', stiff + (printed_a_s,)), ('calibrated, printed a_s', (printed_a_s,)),
                          ('**calibrated, a_s 42 / 22**', ())):
        rows = study_with_curves('prm/paper/partial_fitted_parameters.prm', *changes)
        full = rows[0]
        early, late = (', '.join('%.1f' % (100 * largest(row['curve'], full['curve'], *ends) / full['T_max_Nmm']) for row in rows[1:])
                       for ends in ((0, .4999), (.4999, 10)))
        lines.append([name, '%.1f' % full['T_max_Nmm'], '%.2f' % plateau_end(full), early, late,
                      ', '.join('%.2f' % row['W_adh_Nmm'] for row in rows),
                      ', '.join('%.*f' % (row['e_mp'] < 1, 100 * row['e_mp']) for row in rows)])
    return table(['interface, a_s', 'T_max, homogeneous [N mm]', 'its last angle with 0.999 T_max [deg]', '(b), (c), (d) below 0.5 deg [%]',
                  'from 0.5 deg on [%]', 'W_adh, four rows [N mm]', 'e_mp, four rows [%]'], lines)


@numbers('machine')
def memory():
    lines = []
    for bone, implant in (('15, 15, 2', '3, 2'), ('30, 30, 2', '6, 2'), ('60, 60, 2', '12, 2'), ('30, 30, 12', '6, 12'), ('120, 120, 2', '24, 2')):
        changes = ('Bone/Cells=' + bone, 'Implant/Cells=' + implant, 'Load steps/Steps=1, 1')
        estimate = re.search(r'memory: some (\d+) MB', check(MAIN, *changes))[1]
        lines.append([bone.replace(', ', ' x '), estimate, '%.0f' % run(MAIN, *changes)['peak_memory_MB']])
    return table(['cells of the bone', 'estimate [MB]', 'measured peak [MB]'], lines)


# Random patterns

RANDOM = ('Interface/Bonding/Pattern=random', 'Interface/Bonding/Bonded fraction=0.55')
UNIFORM = ('Interface/Bonding/Pattern=homogeneous', 'Interface/Bonding/Bonding degree=0.55')


@numbers('minutes')
def random_patterns():
    angles = (.04, .06, .08, .1, .2, .5, 1, 2, 10)
    common = LINEAR + ('Implant/Cells=20, 2', 'Expert/Interface/Quadrature points=3', 'Load steps/Steps=1, 10, 9, 8',
                       'Load steps/Times=0, 1, 1.02, 1.2, 2')
    ensemble = study(MAIN, *common, *RANDOM, 'Interface/Bonding/Seed={{1..60}}', 'Output/Fields every=none') and rows_of(
        directory_of(MAIN, common + RANDOM + ('Interface/Bonding/Seed={{1..60}}', 'Output/Fields every=none')) + '/ensemble.csv')
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
            ('T_max [N mm]', 'T_max', 'Nmm', 1, 2), ('T_inf [N mm]', 'T_inf', 'Nmm', 1, 2), ('E_deb [N mm]', 'E_deb', 'Nmm', 1, 3),
            ('W_adh [N mm]', 'W_adh', 'Nmm', 1, 3), ('D_adh [N mm]', 'D_adh', 'Nmm', 1, 4),
            ('initial stiffness [N m/rad]', 'initial_stiffness', 'Nmm_per_rad', 1e-3, 2)):
        mean, low, high = ('%.*f' % (digits, factor * row['%s_%s_%s' % (column, what, unit)]) for what in ('mean', 'p05', 'p95'))
        sd = factor * row['%s_sd_%s' % (column, unit)]
        lines.append([name, mean, '%.2g' % sd if sd > 1e-6 * float(mean) else '0', low + ' to ' + high,  # but for rounding
                      '%.*f' % (digits, factor * uniform[column + '_' + unit])])
    return table(['200 implants, 55 % bonded', 'mean', 'standard deviation', '5 to 95 %', 'homogeneous 0.55'], lines)


@numbers('minutes')
def ensemble_correlation():
    scene = 'prm/studies/ensemble_correlation.prm'
    study(scene)
    bonded = [run('prm/studies/ensemble_scene.prm', UNIFORM[0], 'Interface/Bonding/Bonding degree=%d' % phi)['T_max_Nmm'] for phi in (0, 1)]
    lines = []
    for row in rows_of(directory_of(scene, ()) + '/ensemble_summary.csv'):
        length, sd = row['Interface / Bonding / Correlation length'], row['T_max_sd_Nmm']
        lines.append(['%g' % length + ' (elements of 0.22 mm)' * (length == 0),
                      '%.2f, %.2f, %.2f to %.2f' % (row['T_max_mean_Nmm'], sd, row['T_max_p05_Nmm'], row['T_max_p95_Nmm']),
                      percent(sd / (bonded[1] - bonded[0])) + ' of the surface' * (length == 0),
                      '%.2f %%' % (100 * row['D_adh_sd_Nmm'] / row['D_adh_mean_Nmm']), '%.1f' % row['largest_bonded_patch_mean_mm2']])
    return table(['correlation length [mm]', 'T_max: mean, standard deviation, 5 to 95 % [N mm]',
                  'the same in bonded fraction (standard deviation)', 'D_adh, standard deviation', 'largest patch, mean [mm2]'], lines)


# Pages


def printed(text, begin, end=None):
    """The lines of a console from one that begins so to one that does, as a block."""
    text = text[text.index('\n' + begin):]
    return '\n```%s\n```\n' % (text[:text.index('\n', text.index('\n' + end) + 1)] if end else text.rstrip())


@numbers('seconds')
def first_run():
    scene = 'prm/paper/data_set_1_calibrated.prm'
    text = console(scene, '--force', '--set', 'Output/Directory=' + directory_of(scene, ()))
    return printed(text, 'Largest torque', 'The bond begins')[:-len('```\n')] + '...\n' + printed(text, 'Estimated error', 'Estimated error')[len('\n```\n'):]


TUTORIAL, TUTORIAL_FIT, MEASURED = 'prm/tutorial/implant.prm', 'prm/tutorial/fit.prm', 'prm/tutorial/measured.csv'


@numbers('seconds')
def tutorial_check():
    return printed(check(TUTORIAL), 'Closed forms predict')


@numbers('seconds')
def tutorial_torques():
    return '%.1f N mm and %.1f N mm' % tuple(run(TUTORIAL)[name + '_Nmm'] for name in ('T_max', 'T_inf'))


@numbers('minutes')
def which_entry():
    """Changes of no more than 0.3 % are 0; bold: what an entry of the interface is for."""
    first, *rows = study_with_curves('prm/tutorial/which_entry.prm')
    columns = ('initial_stiffness_Nmm_per_rad', 'T_max_Nmm', 'plateau_end', 'T_inf_Nmm')
    names = {'Chuck / Press / Value': 'axial force', 'Bone / Young modulus': 'Young modulus of the bone', 'Interface / Tangential stiffness':
             'tangential stiffness $\\epsilon_t$', 'Interface / Friction coefficient broken': '$\\mu_b$', 'Interface / Friction coefficient unbroken':
             '$\\mu_{ub}$', 'Interface / Characteristic slip distance': '$a_s$', 'Interface / Transition factor': '$b_s$'}
    lines = []
    for entry, name in names.items():
        row = next(row for row in rows if row[entry] != first[entry])
        changes = [{**row, 'plateau_end': plateau_end(row)}[column] / {**first, 'plateau_end': plateau_end(first)}[column] - 1 for column in columns]
        bold = '**' if entry.startswith('Interface') else ''
        lines.append([name] + [('%s%+.*f %%%s' % (bold * (abs(change) > .05), abs(change) < .005, 100 * change, bold * (abs(change) > .05)))
                               if abs(change) > .003 else '0' for change in changes])
    return table(['a tenth more of', 'slope', '$T_{max}$', 'end of the peak', '$T_\\infty$'], lines)


def half_bonded(pattern):
    return run(TUTORIAL, 'Interface/Bonding/' + ('Expression=x > 0' if pattern == 'expression' else 'Bonded fraction=0.5'),
               'Interface/Bonding/Pattern=' + pattern)


@numbers('seconds')
def half_of_the_face():
    return 'from %.1f to %.1f N mm' % (run(TUTORIAL)['T_max_Nmm'], half_bonded('expression')['T_max_Nmm'])


@numbers('seconds')
def half_disk():
    return '%.1f N mm' % half_bonded('disk')['T_max_Nmm']


@numbers('seconds')
def half_annulus():
    return '%.1f N mm' % half_bonded('annulus')['T_max_Nmm']


@numbers('seconds')
def tutorial_compare():
    directory = 'output/tutorial/implant'
    debond(TUTORIAL, directory)
    return printed('\n' + console('--compare', directory, MEASURED), MEASURED)


def with_interval(unknown, text='%s (%s to %s)'):
    return text % tuple(('%#.3g' % unknown[name]).rstrip('.') for name in ('value', 'lower_95', 'upper_95'))


@numbers('minutes')
def tutorial_fit():
    true = {'eps_t': 350, 'mu_b': .34, 'mu_ub': .56, 'a_s': .045, 'b_s': 1.2, 'angle_offset': .06}  # make_measured.py
    units = {'eps_t': ' [MPa/mm]', 'a_s': ' [mm]', 'angle_offset': ' [deg]'}
    return table(['unknown', 'best fit', '95 % interval', 'true'],
                 [['`%s`%s' % (name, units.get(name, ''))] + with_interval(unknown, '%s|%s to %s').split('|') + ['%g' % true[name]]
                  for name, unknown in fit(TUTORIAL_FIT)['unknowns'].items()])


@numbers('minutes')
def tutorial_correlation():
    result = fit(TUTORIAL_FIT)
    assert any('a_s and b_s have a correlation of' in text for text in result['warnings'])
    return '%.3f' % result['correlations']['a_s | b_s']


@numbers('minutes')
def tutorial_fitted():
    fit(TUTORIAL_FIT)
    return '%.1f N mm' % run(directory_of(TUTORIAL_FIT, ()) + '/fitted.prm')['T_max_Nmm']


@numbers('minutes')
def tutorial_poor():
    result = fit(TUTORIAL_FIT, 'Calibration/Angle offset=0')
    assert any('the model does not fit torque_Nmm' in text for text in result['warnings'])
    return with_interval(result['unknowns']['eps_t'])


@numbers('minutes')
def tutorial_no_offset():
    result = fit(TUTORIAL_FIT, 'Calibration/Torque offset=0')
    assert not any('does not fit' in text for text in result['warnings'])
    return with_interval(result['unknowns']['mu_b'])


@numbers('minutes')
def tutorial_rigid_machine():
    result = fit(TUTORIAL_FIT, 'Calibration/Machine compliance=0')
    assert 1e-7 < result['curves'][0]['chance_of_F'] < 1e-5  # UNLIKELY of fit.py is 1e-6
    return with_interval(result['unknowns']['eps_t'])


def changed_fit(*changes):
    """By how many per cent each unknown of the tutorial's fit changes."""
    return {name: '%g %%' % float('%.1g' % abs(100 * (unknown['value'] / fit(TUTORIAL_FIT)['unknowns'][name]['value'] - 1)))
            for name, unknown in fit(TUTORIAL_FIT, *changes)['unknowns'].items()}


@numbers('minutes')
def tutorial_finer():
    rows = fit(TUTORIAL_FIT)['taken_as_known'][:2]
    assert [row['entry'] for row in rows] == ['Cells', 'Steps']
    return '%.1g %%' % max(abs(effect) for row in rows for effect in row['effect'].values())


@numbers('minutes')
def tutorial_no_machine():
    change = changed_fit('Calibration/Machine compliance=0', 'Calibration/Torque offset=0')
    return '`mu_b` is %s and `eps_t` %s off' % (change['mu_b'], change['eps_t'])


@numbers('minutes')
def mean_force():
    """The scene says what these changes are for."""
    return with_interval(fit('prm/calibrate/axial_force.prm', 'Chuck/Press/File=none', 'Expert/Chuck/Press/File columns=auto',
                             'Chuck/Press/Value=25.4 * min(t, 1)')['unknowns']['mu_ub'])


@numbers('seconds')
def one_step_of_ten_degrees():
    return steps_of_the_main_scene().split()[-1]


@numbers('minutes')
def turning_slip():
    scene = ('prm/stability/rigid_coin.prm', 'Load steps/Times=0, 1, 2, 3', 'Implant/Cells=%s, 2',
             'Chuck/Translation x/Value=0.02 * min(max(t - 1, 0), 1)', 'Chuck/Rotation z/Value=2 * max(t - 2, 0)')

    def between(curve, column, time):
        after = next(k for k, row in enumerate(curve) if row['time'] >= time - 1e-12)
        begin, end = curve[max(after - 1, 0)], curve[after]
        share = (time - begin['time']) / (end['time'] - begin['time']) if after else 0
        return begin[column] + share * (end[column] - begin[column])

    def errors(reference, curve):
        for column in ('chuck_Fx_N', 'torque_Nmm'):
            largest = max(abs(row[column]) for row in reference)
            yield max(abs(row[column] - between(curve, column, row['time'])) for row in reference) / largest

    lines = []
    for name, cells, bodies, steps in (('rigid', 12, (), 800), ('linear', 3, LINEAR, 600)):
        motion = tuple(entry % cells if '%' in entry else entry for entry in scene) + bodies
        reference = run(*motion, 'Load steps/Steps=1, %d, %d' % (steps, steps))['curve']
        for tolerance in ('1e-2', '1e-3', '1e-4'):
            line = [('%s, ' % name if tolerance == '1e-2' else '') + tolerance]
            for direction in ('integrated', 'trial'):
                result = run(*motion, 'Load steps/Adaptive=true', 'Load steps/Steps=1, 10, 10', 'Load steps/Tolerance=' + tolerance,
                             'Expert/Slip direction=' + direction)
                line += [str(len(result['curve']))] + [small(error) for error in errors(reference, result['fine curve'])]
            lines.append(line)
    return table(['tolerance', '`integrated`: rows', 'Fx', 'torque', '`trial`: rows', 'Fx', 'torque'], lines)


FORCES, MOMENTS = ['chuck_F%s_N' % k for k in 'xyz'], ['chuck_M%s_Nmm' % k for k in 'xyz']


def largest_error(reference, curve, groups):
    """Of the columns in each group at the times of the reference, relative to the largest value in the group."""
    errors, after = [], 0
    for row in reference:
        while curve[after]['time'] < row['time'] - 1e-12:
            after += 1
        begin, end = curve[max(after - 1, 0)], curve[after]
        share = (row['time'] - begin['time']) / (end['time'] - begin['time']) if after else 0
        errors.append({c: abs(begin[c] + share * (end[c] - begin[c]) - row[c]) for columns in groups for c in columns})
    return max(max(error[c] for error in errors for c in columns) / max(abs(row[c]) for row in reference for c in columns)
               for columns in groups)


@numbers('minutes')
def adaptive_scenes():
    press, twice = '0.0049 * min(t, 1)', 'min(max(t - 1, 0), 1)'
    mesh = OTHER_INTERFACE + ('Bone/Cells=12, 12, 3', 'Implant/Cells=4, 2') + LINEAR + LAYERED
    rigid = OTHER_INTERFACE + ('Bone/Material=rigid', 'Implant/Material=rigid', 'Implant/Cells=12, 2')
    turning = {'Translation x': '0.02 * ' + twice, 'Rotation z': '2 * max(t - 2, 0)'}
    zigzag = 'min(max(t - 1, 0), 1) - 2 * min(max(t - 2, 0), 1) + 2 * min(max(t - 3, 0), 1)'
    scenes = [
        ('twist', 1, {'Rotation z': '10 * max(t - 1, 0)'}, mesh),
        ('shear, then twist, rigid bodies', 2, turning, rigid),
        ('shear, then twist', 2, turning, mesh),
        ('the same, bone as slave', 2, turning, mesh + ('Expert/Interface/Slave=bone',)),
        ('zig-zag while it turns', 4, {'Translation x': '0.01 * (%s - min(max(t - 4, 0), 1))' % zigzag,
                                       'Translation y': '0.005 * max(t - 1, 0)', 'Rotation z': '0.5 * max(t - 1, 0)'}, mesh),
        ('random patches, 3000 MPa/mm', 1, {'Rotation z': '3 * max(t - 1, 0)'}, mesh + (
            'Interface/Normal stiffness=3000', 'Interface/Tangential stiffness=3000', 'Interface/Bonding/Pattern=random',
            'Interface/Bonding/Bonded fraction=0.5')),
        ('bonded beside the axis', 1, {'Rotation z': '3 * max(t - 1, 0)'}, mesh + (
            'Interface/Bonding/Pattern=expression', 'Interface/Bonding/Expression=(x - 0.6)^2 + y^2 < 1 ? 1 : 0')),
        ('tilt and twist', 1, {'Rotation x': '0.02 * max(t - 1, 0)', 'Rotation z': '3 * max(t - 1, 0)'}, mesh),
        ('twist to and fro', 3, {'Rotation z': '1.5 * (%s)' % zigzag}, mesh),
        ('pressure that changes', 1, {'Press': press + ' + 0.002 * sin(4 * max(t - 1, 0))',
                                      'Translation x': '0.01 * max(t - 1, 0)', 'Rotation z': '2 * max(t - 1, 0)'}, mesh),
        ('circular shear', 2, {'Translation x': '0.01 * (%s + cos(2 * pi * max(t - 2, 0)) - 1)' % twice,
                               'Translation y': '0.01 * sin(2 * pi * max(t - 2, 0))'}, mesh),
        ('fretting: shear by a sine, slow twist', 2, {'Translation x': '0.01 * sin(2 * pi * max(t - 1, 0))',
                                                      'Rotation z': '0.3 * max(t - 1, 0)'}, mesh),
        ('a cap that rocks about x and y', 1, {'Press': '0.02 * min(t, 1)', 'Rotation x': '0.5 * sin(2 * pi * max(t - 1, 0))',
                                               'Rotation y': '0.3 * sin(4 * pi * max(t - 1, 0))'}, mesh + ('Implant/Shape=cap', 'Implant/Cap radius=50')),
        ('under a moment, to and fro: the angle', 2, {'Rotation z': '49.5 * (%s - 1.8 * max(t - 2, 0))' % twice},
         mesh + ('Chuck/Rotation z/Control=moment',))]
    lines = []

    def add(name, scene, groups, phases, n, first=''):
        reference = run(*scene, 'Load steps/Adaptive=false', 'Load steps/Steps=%s%s' % (first and '30, ', ', '.join([str(n)] * phases)))['curve']
        line = [name]
        for tolerance in ('1e-2', '1e-3', '1e-4'):
            result = run(*scene, 'Load steps/Adaptive=true', 'Load steps/Steps=%s%s' % (first, ', '.join(['10'] * phases)),
                         'Load steps/Tolerance=' + tolerance)
            line += [str(len(result['curve'])), '%.1f' % (largest_error(reference, result['fine curve'], groups) / float(tolerance))]
        lines.append(line)

    for name, phases, motion, changes in scenes:
        scene = (MAIN, 'Load steps/Times=' + ', '.join(str(k) for k in range(phases + 2))) + changes + tuple(
            'Chuck/%s/Value=%s' % entry for entry in {'Press': press, 'Rotation z': '0', **motion}.items())
        add(name, scene, [['angle_deg']] if 'under a moment' in name else [FORCES, MOMENTS], phases, 800, '1, ')
    for name, scene in (('pulled at 45 degrees, adhesive', 'coin_45_degrees'), ('pulled at 45 degrees, mixed mode', 'mixed_mode')):
        add(name, ('prm/adhesion/%s.prm' % scene, 'Accuracy=none', 'Load steps/Times=0, 1', 'Bone/Cells=12, 12, 3') + LINEAR,
            [['chuck_Fx_N', 'force_N']], 1, 2000)
    return long_table('adaptive_scenes', ['12 x 12 x 3 and 4 x 4 x 2 cells, linear', '1e-2: rows', 'error', '1e-3: rows', 'error', '1e-4: rows', 'error'],
                      lines, [('twist',), ('shear, then twist',), ('under a moment, to and fro: the angle',), ('pulled at 45 degrees, mixed mode',)])


def study_of_splines(bone, implant, *changes):
    """On the main scene, with steps whose error does not count."""
    return study('prm/coin_mode3_spline.prm', 'Bone/Cells=' + bone, 'Implant/Cells=' + implant, *changes, 'Load steps/Tolerance=1e-5',
                 *THREE_PHASES, 'Output/Fields every=none', REFERENCE)


@numbers('minutes')
def spline_layers():
    layers = [3, 4, 6, 8, 12, 20]
    rows = study_of_splines('60, 60, {{%s}}' % '|'.join(map(str, layers)), '8, 6')
    return table(['layers in the bone'] + layers, [['error'] + [small(row['difference_max']) for row in rows]])


@numbers('minutes')
def spline_points():
    points, lines = [4, 5, 6, 7, 8, 10], []
    for bone, implant in (('24, 24, 8', '4, 3'), ('32, 32, 8', '6, 4'), ('40, 40, 8', '6, 4'), ('60, 60, 10', '8, 6')):
        rows = study_of_splines(bone, implant, 'Expert/Interface/Quadrature points={{%s}}' % '|'.join(map(str, points)))
        name = '%s / %s x %s' % (bone.replace(', ', ' x '), implant.split(',')[0], implant.replace(', ', ' x '))
        # the reference is known to 1.2e-5
        lines.append([name] + [small(row['difference_max'], int(row['difference_max'] > 1e-4)) for row in rows])
    return table(['bone / implant'] + ['n = %d' % points[0]] + points[1:], lines)


@numbers('minutes')
def refined_parts():
    """Quadratic elements on a mesh graded to the rim, of which one part is made finer."""
    choices = (('24 x 24 x 4 / 8 x 8 x 3', {}),
               ('cells below the contact layer twice as wide', {'Expert/Bone/Coarser below': 'true'}),
               ('twice the layers of the bone', {'Bone/Cells': '24, 24, 8'}),
               ('the bone beside the implant 3 times finer', {'Bone/Cells': '40, 40, 4'}),
               ('the bone under the implant, to the rim, 1.5 times finer',
                {'Bone/Cells': '32, 32, 4', 'Expert/Bone/Cells under implant': '24'}),
               ('the implant 2 times finer', {'Implant/Cells': '16, 6'}),
               ('everything 1.5 times finer', {'Bone/Cells': '36, 36, 6', 'Expert/Bone/Cells under implant': '24', 'Implant/Cells': '12, 5'}))
    mesh = {'Bone/Cells': '24, 24, 4', 'Expert/Bone/Cells under implant': '16', 'Implant/Cells': '8, 3', 'Expert/Bone/Layer grading': '2',
            'Expert/Implant/Layer grading': '1.5', 'Bone/Element': 'quadratic', 'Implant/Element': 'quadratic'}
    lines = []
    for name, changes in choices:
        summary = run(MAIN, *('%s=%s' % entry for entry in {**mesh, **changes}.items()), *LINEAR, *THREE_PHASES,
                      'Load steps/Adaptive=true', 'Load steps/Tolerance=1e-4', REFERENCE)
        lines.append([name, summary['unknowns'], small(summary['difference_max'])])
    return table(['mesh', 'unknowns', 'error of the curve'], lines)


def with_mesh(bone, implant, grading, element, tolerance):
    return tuple('%s/%s' % pair for body, cells in (('Bone', bone), ('Implant', implant)) for pair in (
        (body, 'Cells=' + cells), ('Expert/' + body, 'Layer grading=%g' % grading), (body, 'Element=' + element))) + ADAPTIVE + (
            'Load steps/Tolerance=' + tolerance,) + THREE_PHASES


BONDED_IN_A_DISK = ('Interface/Bonding/Pattern=disk', 'Interface/Bonding/Bonded fraction=0.55', 'Expert/Interface/Bonding/Resolution=quadrature point')
TILTED = ('Chuck/Rotation x/Value=0.1 * min(t, 1)',)


def errors_elsewhere(scenes, fine, choices):
    lines = []
    for name, changes in scenes:
        changes = OTHER_INTERFACE + changes
        reference = run(MAIN, *fine, *LINEAR, *changes)['curve']
        line = [name]
        for _, choice in choices:
            result = run(MAIN, *choice, *LINEAR, *changes)
            line.append(small(largest_error(reference, result['fine curve'], [FORCES, MOMENTS])))
        lines.append(line)
    return table(['scene'] + [name for name, _ in choices], lines)


@numbers('minutes')
def splines_elsewhere():
    bonded_half = ('Interface/Bonding/Pattern=expression', 'Interface/Bonding/Expression=x > 0 ? 1 : 0')
    # about an axis half a millimetre beside that of the coin
    off_centre = ('Chuck/Translation x/Value=0.5 * (1 - cos(pi / 18 * max(t - 1, 0)))',
                  'Chuck/Translation y/Value=-0.5 * sin(pi / 18 * max(t - 1, 0))')
    choices = (('trilinear 30 x 30 x 8 / 6 x 6 x 8', with_mesh('30, 30, 8', '6, 8', 1.5, 'trilinear', '1e-3')),
               ('splines 32 x 32 x 8 / 6 x 6 x 4', with_mesh('32, 32, 8', '6, 4', 2, 'spline', '3e-4')),
               ('trilinear 60 x 60 x 12 / 12 x 12 x 12', with_mesh('60, 60, 12', '12, 12', 1.5, 'trilinear', '2e-4')),
               ('splines 60 x 60 x 8 / 12 x 12 x 6', with_mesh('60, 60, 8', '12, 6', 2, 'spline', '2e-4')))
    return errors_elsewhere((
        ('585 MPa/mm', ()),
        ('1800 MPa/mm', isotropic(1800)),
        ('6000 MPa/mm', isotropic(6000)),
        ("Poisson's ratio of the bone 0.45", ('Bone/Poisson ratio=0.45',)),
        ("Poisson's ratio of the bone 0.49", ('Bone/Poisson ratio=0.49',)),
        ('bonded in a disk, f = 0.55', BONDED_IN_A_DISK),
        ('one half bonded, turned about an axis 0.5 mm off centre', bonded_half + off_centre),
        ('a cap, pressed by 0.02 mm', ('Implant/Shape=cap', 'Implant/Cap radius=50', 'Chuck/Press/Value=0.02 * min(t, 1)')),
        ('tilted by 0.1 degrees', TILTED),
        ('a force instead of a depth', ('Chuck/Press/Control=force', 'Chuck/Press/Value=51.5 * min(t, 1)'))),
        with_mesh('120, 120, 12', '16, 10', 2, 'spline', '2e-5') + ('Expert/Interface/Quadrature points=8',), choices)


@numbers('seconds')
def forecast_of_stiff():
    """The largest torque that --check predicts, against that of the reference."""
    parts = []
    for eps in ('1e5', '1e6'):
        text = check('prm/coin_stiff.prm', 'Interface/Normal stiffness=' + eps)
        T_max = float(re.search(r'largest torque ([\d.]+) N mm', text)[1])
        off = T_max / max(row['torque_Nmm'] for row in rows_of('prm/studies/data/stiffness_%s.csv' % eps)) - 1
        parts.append('%.1f N mm at %s, off by %+.1f %%, and states %s' % (T_max, eps, 100 * off, re.search(r'to some ([\d.]+ %)', text)[1]))
    return '; '.join(parts)


@numbers('minutes')
def stiff_elsewhere():
    choices = (('equal 32 x 32 x 8 / 6 x 6 x 4', with_mesh('32, 32, 8', '6, 4', 2, 'spline', '3e-4')),
               ('equal 64 x 64 x 10 / 12 x 12 x 6', with_mesh('64, 64, 10', '12, 6', 2, 'spline', '3e-4')),
               ('fitted 12, 4, 7, 6 / 12, 4, 4', with_mesh('fitted 12, 4, 7, 6', 'fitted 12, 4, 4', 1, 'spline', '3e-4')),
               ('fitted 16, 6, 10, 9 / 12, 5, 5', with_mesh('fitted 16, 6, 10, 9', 'fitted 12, 5, 5', 1, 'spline', '3e-4')))
    stiff = isotropic(1e5)
    return errors_elsewhere((
        ('1e5 MPa/mm', stiff),
        ('Neo-Hookean', stiff + ('Bone/Material=neo-hookean', 'Implant/Material=neo-hookean')),
        ('a force instead of a depth', stiff + ('Chuck/Press/Control=force', 'Chuck/Press/Value=600 * min(t, 1)')),
        ('bonded in a disk, f = 0.55', stiff + BONDED_IN_A_DISK),
        ('tilted by 0.1 degrees', stiff + TILTED)),
        with_mesh('fitted 24, 8, 14, 11', 'fitted 20, 6, 6', 1, 'spline', '2e-4'), choices)


@numbers('machine')
def lattice():
    scene = ('prm/coin_mode3_spline.prm', 'Load steps/Tolerance=1e-3')

    def measured(*changes):
        result = run(*scene, *changes)
        return result, '%.2g s' % result['wall_seconds'], '%.0f MB' % result['peak_memory_MB']
    neo_hookean = ('Bone/Material=neo-hookean', 'Implant/Material=neo-hookean')
    lines = []
    for name, cells, changes in (('linear', '60, 60, 6', ()), ('linear, under a force', '60, 60, 6', (
            'Chuck/Press/Control=force', 'Chuck/Press/Value=51.5 * min(t, 1)')),
                                 ('Neo-Hookean', '60, 60, 6', neo_hookean), ('linear', '200, 200, 10', ())):
        changes = ('Bone/Cells=' + cells, 'Implant/Cells=8, 4') + changes
        result, *line = measured(*changes)
        if cells == '60, 60, 6':
            direct, *more = measured(*changes, 'Expert/Bone/Solver=direct')
            line += more
        else:
            line += ['', '']
        lines.append(['%s, %s' % (cells.replace(', ', ' x '), name)] + line)
    return table(['bone', 'lattice', 'memory', 'direct', 'memory'], lines)


TURN = ('Load steps/Times=0, 1, 1.05', 'Load steps/Steps=1, 1', 'Expert/Load steps/Residual tolerance=1e-7', 'Output/Fields every=none',
        'Implant/Cells=12, 4') + LINEAR + LAYERED + OTHER_INTERFACE
MULTIGRID = ('Expert/Bone/Solver=multigrid',)


@functools.lru_cache(None)
def run_on(ranks, *changes, repetition=0):
    """The summary of a run of the main scene, a thread in each of so many processes; another run for each repetition."""
    directory = directory_of('ranks %d' % ranks, changes)
    debond(MAIN, directory, *changes, ranks=ranks)
    with open(directory + '/summary.json', encoding='utf-8') as text:
        return json.load(text)


def n_unknowns(cells):
    x, y, z = (int(n) for n in cells.split(','))
    return 3 * ((x + 1) * (y + 1) * (z - 1) + (x + 2) * (y + 2))


def pair(rows, name, form):
    return ' / '.join(form % row[name] for row in rows)


@numbers('machine')
def multigrid_sizes():
    lines = []
    for cells in ('25, 25, 5', '40, 40, 10', '75, 75, 15', '130, 130, 25'):
        repetitions = range(3 if n_unknowns(cells) < 1e6 else 1)  # the median of three, or what takes a minute
        rows = [sorted((run_on(ranks, 'Bone/Cells=' + cells, *TURN, *MULTIGRID, repetition=i) for i in repetitions),
                       key=lambda row: row['wall_seconds'])[len(repetitions) // 2] for ranks in (1, 2)]
        lines.append([cells.replace(', ', ' x '), '%d k' % round(n_unknowns(cells) / 1000), pair(rows, 'multigrid_most_cycles', '%d'),
                      '%.2f' % (rows[0]['wall_seconds'] / rows[1]['wall_seconds']), pair(rows, 'peak_memory_MB', '%.0f')])
    return table(['cells', 'unknowns', 'cycles to 1e-8, one / two processes', 'speed-up of the whole run by the second process',
                  'memory of a process [MB]'], lines)


@numbers('minutes')
def multigrid_contrast():
    def cycles(*changes):
        return '%d' % run_on(1, 'Bone/Cells=40, 40, 10', *TURN, *MULTIGRID, *changes)['multigrid_most_cycles']
    lines = [['stiffness of the interface 585, 1800, 18 000, 180 000 MPa/mm',
              ', '.join(cycles(*isotropic(eps)) for eps in (585, 1800, 18000, 180000))]]
    for eps, text in ((585, '585'), (18000, '18 000')):
        lines.append(['Coulomb friction of 0.4, 2, 10, turned by 5 degrees at once, ' + text + ' MPa/mm', ', '.join(
            cycles('Load steps/Times=0, 1, 1.5', *isotropic(eps), 'Interface/Friction law=coulomb',
                   'Interface/Friction coefficient=%g' % mu) for mu in (0.4, 2, 10))])
    for name, where in (('cubes of 0.6 mm', 'sin(pi * x / 0.6) * sin(pi * y / 0.6) * sin(pi * z / 0.6) > 0'), ('a layer of 1 mm', 'z > -1'),
                        ('a layer of 1 mm, softer on top', 'z < -1')):
        lines.append(['modulus of 18 000 MPa and less by 10, 100, 1000: ' + name,
                      ', '.join(cycles('Bone/Young modulus=if(%s, 18000, %g)' % (where, 18000 / k)) for k in (10, 100, 1000))])
    return table(['what varies', 'cycles to 1e-8'], lines)


@numbers('machine')
def multigrid_splines():
    cubes = 'if(sin(pi * x / 0.6) * sin(pi * y / 0.6) * sin(pi * z / 0.6) > 0, 18000, %g)'
    lines = []
    for name, modulus in (('the same everywhere', '18000'), ('18 000 exp(x / 10)', '18000 * exp(x / 10)'),
                          ('18 000 exp(-(x^2 + y^2) / 10)', '18000 * exp(-(x^2 + y^2) / 10)'), ('cubes of 0.6 mm, less by 10', cubes % 1800),
                          ('less by 100', cubes % 180), ('less by 1000', cubes % 18)):
        rows = [run_on(ranks, 'Bone/Element=spline', 'Bone/Cells=60, 60, 8', *TURN, *MULTIGRID, 'Bone/Young modulus=' + modulus) for ranks in (1, 2)]
        lines.append([name, pair(rows, 'multigrid_most_cycles', '%d'), pair(rows, 'peak_memory_MB', '%.0f')])
    return table(['modulus of the bone [MPa]', 'cycles to 1e-8, one / two processes', 'memory of a process [MB]'], lines)


@numbers('minutes')
def multigrid_on_splines():
    """Largest difference of the torque on two processes from that of the lattice solver, over the largest torque."""
    changes = ('Bone/Cells=100, 100, 8', 'Implant/Cells=8, 4', 'Load steps/Adaptive=false', 'Load steps/Times=0, 1, 1.5', 'Load steps/Steps=1, 10',
               'Expert/Load steps/Residual tolerance=1e-11', 'Output/Fields every=none')
    curves = []
    for ranks, more in ((0, ()), (2, MULTIGRID)):
        directory = directory_of('ranks %d' % ranks, ('prm/coin_mode3_spline.prm',) + changes + more)
        debond('prm/coin_mode3_spline.prm', directory, *changes, *more, ranks=ranks)
        curves.append([row['torque_Nmm'] for row in rows_of(directory + '/torque.csv')])
    worst = max(abs(a - b) for a, b in zip(*curves)) / max(curves[0])
    return '1e-11' if worst < 1e-11 else small(worst)  # what is less is rounding


CURVE = ('Output/Fields every=none', 'Implant/Cells=12, 4', 'Load steps/Tolerance=1e-3') + LINEAR + LAYERED + ADAPTIVE + OTHER_INTERFACE
VARIES = ('Bone/Young modulus=18000 * exp(x / 10)',)


@numbers('machine')
def multigrid_crossover():
    lines = []
    for cells in ('40, 40, 10', '75, 75, 15', '100, 100, 20'):
        for name, changes in (('', ()), (', modulus varies', VARIES)):
            if cells == '100, 100, 20' and not changes:
                continue
            line = [cells.replace(', ', ' x ') + name, '%d k' % round(n_unknowns(cells) / 1000)]
            for solver in ('direct', 'multigrid'):
                row = run_on(1, 'Bone/Cells=' + cells, 'Expert/Bone/Solver=' + solver, *CURVE, *changes)
                line += [two_digits(row['wall_seconds']), two_digits(row['peak_memory_MB'] / 1000)]
            lines.append(line + ['%d' % row['multigrid_systems'], '%d' % row['multigrid_cycles']])
    return table(['cells', 'unknowns', 'direct [s]', '[GB]', 'multigrid [s]', '[GB]', 'linear systems', 'cycles in all'], lines)


@numbers('machine')
def multigrid_large():
    cells = '130, 130, 25'
    row = run_on(2, 'Bone/Cells=' + cells, *CURVE)
    return '%.0f minutes and %s GB in each of two processes (%s cells, %.2g M unknowns)' % (
        row['wall_seconds'] / 60, two_digits(row['peak_memory_MB'] / 1000), cells.replace(', ', ' x '), n_unknowns(cells) / 1e6)


@functools.lru_cache(None)
def step_error(name):
    """A table of doc/studies/step_error.py, as text."""
    subprocess.run(['doc/studies/step_error.py'] + ['--force'] * options.force, env={**os.environ, 'DEBOND': options.debond}, check=True,
                   stdout=subprocess.DEVNULL)
    with open('output/step_error/' + name, encoding='utf-8') as text:
        return list(csv.DictReader(text))


@numbers('minutes')
def step_orders():
    rows, lines = step_error('order.csv'), []
    for case in dict.fromkeys(row['case'] for row in rows):
        errors = {int(row['steps']): float(row['error']) for row in rows if row['case'] == case}
        lines.append([case.replace('trial', 'shear then twist, `Slip direction = trial`')] + [small(error) for error in errors.values()] +
                     ['%.1f' % (math.log(errors[20] / errors[200]) / math.log(10))])
    return table(['steps in each phase', '10', '20', '50', '100', '200', 'order, 20 to 200'], lines)


@numbers('minutes')
def step_codes():
    rows, lines = step_error('codes.csv'), []
    for code in dict.fromkeys(row['code'] for row in rows):
        best = min((row for row in rows if row['code'] == code), key=lambda row: float(row['error']))
        lines.append([code, best['steps'] + (' in all' if 'adaptive' in code else ' in each phase'), small(float(best['error']))])
    return table(['code', 'steps', 'error'], lines)


@numbers('seconds')
def parameters():
    """All entries of a scene, from what debond --print-parameters prints: an index, and a heading for each entry."""
    text = subprocess.run([options.debond, '--print-parameters'], stdout=subprocess.PIPE, text=True, check=True).stdout
    sections, path, comment = [('', [])], [], []
    for line in map(str.strip, text.splitlines()[2:]):  # behind the title
        if line.startswith('#'):
            comment.append(line[1:].strip())
        elif line.startswith('subsection '):
            path.append(line[len('subsection '):])
            sections.append((' / '.join(path), []))
        elif line == 'end':
            path.pop()
        elif line.startswith('set '):
            name, default = (part.strip() for part in line[len('set '):].split('=', 1))
            meaning, allowed = ' '.join(comment).split(' Allowed: ')
            if meaning.endswith(' No default.'):
                meaning, default = meaning[:-len(' No default.')], None
            sections[-1][1].append((name, default, allowed, meaning))
            comment = []
    parts, others = [], {}  # of subsections x, y, z that say the same of their letters x is there
    for title, rows in sections:
        first = title[:-1] + 'x'
        if title[-2:] in (' y', ' z') and rows == [tuple(axis(cell, title[-1]) for cell in row) for row in dict(sections)[first]]:
            others[first].append(title)
        elif rows:
            parts.append((title, rows))
            others[title] = []
    links = {' / '.join(filter(None, (title, row[0]))): '#' + anchor(' / '.join(filter(None, (title, row[0]))))
             for title, rows in parts for row in rows}
    links.update({title: '#' + anchor(title) for title, _ in parts if title})
    links.update({name: '#' + anchor(first) for first, names in others.items() for name in names})
    links.update({'%s / %s' % (name, row[0]): '#' + anchor('%s / %s' % (first, row[0]))
                  for first, names in others.items() for name in names for row in dict(parts)[first]})
    index = ['- %s: %s%s' % ('[%s](#%s)' % (title, anchor(title)) if title else 'outside of subsections',
                             ', '.join('[%s](%s)' % (row[0], links[' / '.join(filter(None, (title, row[0])))]) for row in rows),
                             '; %s alike' % ' and '.join(others[title]) if others[title] else '') for title, rows in parts]
    pieces = ['\n'.join(index)]
    for title, rows in parts:
        pieces.append('## ' + (title or 'Outside of subsections'))
        if others[title]:
            pieces.append('%s have the same entries, with their letter in the place of x.' % ' and '.join('`%s`' % other for other in others[title]))
        for row in rows:
            own = ' / '.join(filter(None, (title, row[0])))
            pieces += ['### ' + own, entry(*row[1:], {name: link for name, link in links.items() if name != own})]
    return '\n\n%s\n\n' % '\n\n'.join(pieces)


def anchor(heading):
    """As GitHub makes it."""
    return re.sub(r'[^\w\- ]', '', heading.lower()).replace(' ', '-')


def link_to_page(match):
    """(doc/SECTION/PAGE.md) of a text with the title of the page."""
    return '([%s](../%s))' % (re.search('^# (.*)', text_of('doc/' + match[1]), re.M)[1], match[1])


def entry(default, allowed, meaning, links):
    """The list below the heading of an entry: code for names, links to other entries that are named in full (`Output / Curve'),
    the unit apart, no signs that Markdown would take for its own."""
    names = [name for name in sorted(links, key=len, reverse=True) if ' / ' in name]

    def text_with_links(text):
        parts = re.split(r'(?<!/ )\b(%s)\b(?! /)' % '|'.join(map(re.escape, names)), text)
        parts[::2] = [re.sub(r'\(doc/([\w/]+\.md)\)', link_to_page, re.sub(r'([\\*<>])', r'\\\1', part)) for part in parts[::2]]
        parts[1::2] = ['[%s](%s)' % (name, links[name]) for name in parts[1::2]]
        return ''.join(parts)

    def plain(text):
        parts = re.sub(r"`([^']*)'|(<<.*?>>|\{\{.*?\}\})", '\0\\1\\2\0', text).split('\0')  # every second one is code
        parts[::2] = map(text_with_links, parts[::2])
        return '`'.join(parts)
    in_brackets = re.search(r' ?\[([^\]]+)\]', allowed)
    in_words = re.search(r'(an expression in t), in (.+)$', allowed)
    unit = in_brackets[1] if in_brackets else in_words[2] if in_words else ''
    allowed = allowed.replace(in_brackets[0], '', 1) if in_brackets else in_words[1] if in_words else allowed
    choices = re.sub('^auto, or ', 'auto | ', allowed).split(' | ') if ' | ' in allowed else []
    # a line for each choice that is explained, where two or more are
    labels = '|'.join(map(re.escape, choices))
    begins = [match.start() for match in re.finditer(r"(?:(?<=^)|(?<=[.:;] ))`(?:%s)'(?:, `(?:%s)')*:" % (labels, labels), meaning)] if choices else []
    items = [meaning[i:j].strip() for i, j in zip([0] + begins, begins + [len(meaning)])] if len(begins) > 1 else [meaning]
    lines = ['Default: ' + ('none; a scene that reads it says it' if default is None else '`%s`' % default if default else 'empty'),
             'Allowed: ' + (', '.join('`%s`' % choice for choice in choices) or plain(allowed))] + ['Unit: ' + unit] * bool(unit)
    lines.append('Meaning: ' + plain(items[0]) if items[0] else 'Meaning:')
    return '\n'.join(['- ' + line for line in lines] + ['  - ' + plain(item) for item in items[1:]])


def axis(text, letter):
    """What is said of x, of another axis: +x, chuck_ux_mm, chuck_Mx_Nmm."""
    return re.sub(r'(?<=[+uFrM])x(?![a-z])', letter, text)


# The command of each picture of doc/evidence, which its page names, and the files that it depends on beside the program.
PICTURES = {
    'fig_1 fig_3_12 fig_4 fig_5 fig_6 fig_7 fig_8 fig_9 fig_10 fig_13': ('doc/pictures.sh paper', 'doc/paper prm/paper'),
    'work_precision work_precision_local work_precision_codes': ('doc/studies/work_precision.sh --publish', 'doc/studies prm/studies'),
    'stiffness': ('doc/studies/stiffness.py --publish', 'doc/studies prm/studies/stiffness.prm prm/studies/data'),
    'step_error': ('doc/pictures.sh step_error', 'doc/studies/step_error.py doc/studies/step_error.gp prm/paper/main_scene.prm'),
    'stability_slip_direction stability_chatter stability_penalty stability_snap_back': ('doc/pictures.sh stability', 'doc/stability prm/stability'),
    'convergence': ('doc/pictures.sh convergence', 'doc/verification/convergence.sh doc/verification/convergence.gp prm/verification'),
    'cap_pulled_off_force': ('doc/pictures.sh cap_pulled_off', 'doc/verification/cap_pulled_off.sh doc/verification/cap_pulled_off.gp '
                             'prm/verification/cap_pulled_off.prm'),
    'bonds_on_half_spaces': ('doc/pictures.sh bonds', 'doc/verification/bonds_on_half_spaces.sh doc/verification/bonds_on_half_spaces.gp '
                             'prm/verification/kendall.prm prm/verification/bonded_disk_torsion.prm'),
    'bone': ('doc/pictures.sh bone', 'doc/bone.gp prm/bone prm/coin_mode3.prm'),
    'setup': ('doc/pictures.sh setup', 'doc/images/setup.svg'),
    'data_set_1': ('doc/pictures.sh first', 'doc/first_picture.sh prm/paper/data_set_1_calibrated.prm prm/paper/data'),
    'report': ('doc/pictures.sh report', 'prm/paper/data_set_1_calibrated.prm prm/paper/data'),
    'geometry towing cell law': ('doc/pictures.sh geometry', 'doc/geometry.gp doc/towing.gp doc/cell.gp doc/law.gp'),
    'half_bonded': ('doc/pictures.sh half_bonded', 'doc/half_bonded.gp prm/paper/data_set_1_calibrated.prm'),
    'front_film': ('doc/pictures.sh film', 'doc/film.py prm/paper/data_set_1_calibrated.prm'),
    'mesh front peeled opened': ('doc/pictures.sh bodies', 'doc/paraview prm/paper/main_scene.prm prm/coin_mode3_fast.prm prm/coin_mode3_spline.prm '
                                 'prm/adhesion/coin_peeled.prm'),
    'tutorial_fit': ('doc/pictures.sh tutorial_fit', 'doc/plot_calibration.gp prm/tutorial/fit.prm'),
    'calibration_data_set_1': ('doc/pictures.sh calibration', 'doc/plot_calibration.gp prm/calibrate/data_set_1.prm'),
    'ensemble_correlation': ('doc/pictures.sh ensemble', 'doc/studies/ensemble.sh prm/studies')}


def complaints_about_evidence():
    """Pictures that are not in the list, or, in doc/evidence, whose page does not name the command; tables of doc/evidence that
    nothing makes."""
    commands = {name: (command, files) for names, (command, files) in PICTURES.items() for name in names.split()}
    for page in pages():
        text = '' if page == 'doc/gallery/index.md' else text_of(page)  # all by doc/gallery.py
        for name in re.findall(r'images/(\w+)\.(?:png|svg)\)', text):
            command, files = commands.get(name, (None, ''))
            if command is None or page.startswith('doc/evidence') and command not in text:
                yield '%s: %s.png: no command, or not that of PICTURES: %s' % (page, name, command)
            yield from ('%s depends on %s, which is not there' % (name, file) for file in files.split() if not os.path.exists(file))
    made = ''.join(inspect.getsource(function) for function, _ in NAMES.values()) + 'work_precision_splines meshes factors front fastest'
    for path in glob.glob(TABLES + '*.csv'):
        name, rows = os.path.basename(path)[:-4], rows_of(path)
        by_hand = [column for column in rows[0] if column.startswith(('test', 'made with'))]
        if name.replace('work_precision_', '') not in made and (not by_hand or any(not str(row[by_hand[0]]).strip() for row in rows)):
            yield '%s: no function of numbers.py makes it, and no column says what does' % path


def files_of(function, seen=()):
    """Scenes, scripts and tables that a function names, also by way of functions and constants that it uses; % stands for any text."""
    source = inspect.getsource(function)
    used = [globals().get(name) for name in dict.fromkeys(re.findall(r'(?<![.\w])[A-Z_]{3,}|(?<![.\w])\w+(?=\()', source))]
    files = set(re.findall(r"'((?:prm|doc|tests)/[^' ]+\.(?:prm|csv|py|sh))'", source))
    files |= {one for one in used if isinstance(one, str) and re.fullmatch(r'(prm|doc|tests)/.*\.prm', one)}
    for other in (getattr(one, '__wrapped__', one) for one in used):
        if inspect.isfunction(other) and other.__module__ == __name__ and other not in (function, *seen):
            files |= files_of(other, (function, *seen))
    return files


def pages():
    return ['README.md', 'tests/comparison/README.md'] + sorted(glob.glob('doc/**/*.md', recursive=True))


def compare(name, old, new):
    """Whether a text says the same: numbers to one unit of the last digit printed, all else alike."""
    if name in EXACT:
        return old == new
    if NUMBER.sub('#', old).split() != NUMBER.sub('#', new).split():
        return False
    for a, b in zip(NUMBER.findall(old), NUMBER.findall(new)):
        mantissa, _, exponent = a.partition('e')
        unit = 10. ** (int(exponent or 0) - len(mantissa.partition('.')[2]))
        if abs(float(a) - float(b)) > max(1.001 * unit, BY_STEPS.get(name, 0) * abs(float(a))):
            return False
    return True


def text_of(path):
    with open(path, encoding='utf-8') as lines:
        return lines.read()


def treat(page, wanted):
    """Puts the numbers into a page, or compares; returns whether all is well and the names found."""
    text, found, good = text_of(page), set(), True

    def replaced(match):
        nonlocal good
        begin, name, old, end = match.groups()
        if name not in NAMES:
            sys.exit('numbers.py: %s: nothing makes "%s"' % (page, name))
        found.add(name)
        if name not in wanted:
            return match[0]
        new = NAMES[name][0]()
        if options.check and not compare(name, old, new):
            old_lines, new_lines = (text.strip().split('\n') for text in (old, new))
            if name in EXACT:  # long ones: only what differs
                old_lines, new_lines = ([line for line in lines if line not in others]
                                        for lines, others in ((old_lines, new_lines), (new_lines, old_lines)))
            print('%s, %s: the page says\n%s\nand the program\n%s' % (page, name, '\n'.join(old_lines), '\n'.join(new_lines)))
            good = False
        return match[0] if options.check or compare(name, old, new) else begin + new + end

    new_text = BLOCK.sub(replaced, text)
    if len(re.findall(r'<!-- numbers: \w+ -->', text)) != len(BLOCK.findall(text)):
        sys.exit('numbers.py: %s: a mark without an end' % page)
    if new_text != text:
        with open(page, 'w', encoding='utf-8') as lines:
            lines.write(new_text)
    return good, found


def treat_table(name):
    """The same for the file of a long table."""
    path, new = TABLES + name + '.csv', CSV_FILES[name]
    old = text_of(path) if os.path.exists(path) else ''
    same = compare(name, old, new)
    if options.check and not same:
        print('%s is not what the program says, which is\n%s' % (path, new))
    elif not same:
        os.makedirs(TABLES, exist_ok=True)
        with open(path, 'w', encoding='utf-8') as lines:
            lines.write(new)
    return same or not options.check


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
        for name, (function, cost) in NAMES.items():
            print('%-24s %-8s %s; %s' % (name, cost, ' '.join(page for page in pages() if '<!-- numbers: %s -->' % name in text_of(page)),
                                         ' '.join(sorted(files_of(function)))))
        for names, (command, files) in PICTURES.items():
            print('%s: %s; %s' % (names, command, files))
        return
    unknown = set(options.names) - set(NAMES)
    if unknown:
        sys.exit('numbers.py: no such NAME: %s; --list names all' % ', '.join(sorted(unknown)))
    if not os.access(options.debond, os.X_OK):
        sys.exit('numbers.py: there is no %s: build the program first, or set DEBOND' % options.debond)
    wanted = options.names or [name for name, (_, cost) in NAMES.items() if cost == 'seconds' or options.all and not (options.check and cost == 'machine')]
    complaints = list(complaints_about_evidence())
    if complaints:
        sys.exit('\n'.join(complaints))
    results = [treat(page, wanted) for page in pages()]
    good = all([treat_table(name) for name in CSV_FILES])
    unused = set(NAMES) - set().union(*(found for _, found in results))
    if unused:
        sys.exit('numbers.py: no page has ' + ', '.join(sorted(unused)))
    sys.exit(not (good and all(good for good, _ in results)))


if __name__ == '__main__':
    main()
