#!/usr/bin/env python3
"""Results belong to the content of the files that a scene names, not to their names or times.

    changed_files.py DEBOND [FOLDER | all]

expected.csv names a file, the entries that use it, two contents from files/, and a number of the results that these hold.
The second content always comes with an older time, as from `cp -p`. Results with the first content must then be refused by
a run, a study and --resume, and accepted again with the first content. With references the distances must follow: the
measured curve is a multiple c of the computed one, so that the mean difference is 1 - 1/c of its largest torque. FOLDER has
the module of Python, in which what is kept in memory must not be taken for what is on the disk. Studies, which know files as runs
do, are tried with the first file only, or with `all`.
"""
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time

here = os.path.dirname(os.path.abspath(__file__))
debond = os.path.abspath(sys.argv[1])
with_all = sys.argv[2:] == ['all']
module = os.path.abspath(sys.argv[2]) if len(sys.argv) > 2 and not with_all else None
failures = []


def expect(is_right, what, run=None):
    if not is_right:
        failures.append(what + (': %d, %s%s' % (run.returncode, run.stdout[-500:], run.stderr) if run else ''))


def call(*arguments, program=debond):
    return subprocess.run([program, *arguments], text=True, capture_output=True)


def with_entries(*entries):
    return [word for entry in entries for word in ('--set', entry)]


def put(source, name, age):
    """As `cp -p` of a file that is AGE seconds old."""
    shutil.copyfile(source, name)
    os.utime(name, (1.7e9 - age, 1.7e9 - age))


def table(name):
    with open(name, newline='') as lines:
        return list(csv.DictReader(lines))


def contents(name):
    with open(name) as file:
        return file.read()


def number_of(where, run, directory):
    kind, _, rest = where.partition(' ')
    if kind == 'summary':
        return json.loads(contents(directory + '/summary.json'))[rest]
    if kind == 'console':
        return float(re.search(rest, run.stdout)[1])
    _, _, name, column = rest.split()
    return float(table(directory + '/' + name)[-1][column])


def check_file(has_studies, name, entries, first, second, where, of_first, of_second):
    """Results in a directory with one content are not those with another one."""
    shutil.copy(os.path.join(here, 'files', 'bone.mhd'), '.')
    first, second = (os.path.join(here, 'files', file) for file in (first, second))
    options = with_entries(*entries.split('; '))
    study = with_entries('Implant/Poisson ratio={{0.3|0.31}}', 'Output/Directory=study') + ['--jobs', '1']
    put(first, name, 0)
    run = call('scene.prm', *options)
    expect(run.returncode == 0 and abs(number_of(where, run, 'results') - float(of_first)) < 1e-9, name + ' is read', run)
    expect(not has_studies or call('scene.prm', *options, *study).returncode == 0, name + ' in a study')
    curve = contents('results/torque.csv')

    put(second, name, 1000)
    for what, words in (('run', options), ('study', options + study))[:2 if has_studies else 1]:
        run = call('scene.prm', *words)
        expect(run.returncode == 1 and 'another scene' in run.stderr, '%s, %s of another content' % (name, what), run)
    run = call('--resume', 'results')
    expect(run.returncode == 1 and name in run.stderr, name + ', --resume with another content', run)
    expect(contents('results/torque.csv') == curve, name + ': results stay')
    if has_studies:
        run = call('scene.prm', *options, *study, '--check')
        expect('done already' not in run.stdout, name + ', --check of a study', run)

    put(first, name, 2000)
    expect('is finished' in call('--resume', 'results').stdout, name + ', the first content again')
    if has_studies:
        run = call('scene.prm', *options, *study)
        expect('2 of them done already' in run.stdout, name + ', study with the first content again', run)

    put(second, name, 3000)
    run = call('scene.prm', *options, '--force')
    expect(run.returncode == 0 and abs(number_of(where, run, 'results') - float(of_second)) < 1e-9, name + ', --force', run)


def multiple(curve, factor, name, age):
    with open('multiple', 'w') as file:
        file.write('angle_deg,torque_Nmm\n')
        for row in table(curve):
            file.write('%s,%.17g\n' % (row['angle_deg'], factor * float(row['torque_Nmm'])))
    put('multiple', name, age)


def check_reference_curve():
    options = with_entries('Model=foundation', 'Interface/Characteristic slip distance={{0.1|0.2}}', 'Output/Reference curve=measured.csv',
                           'Output/Directory=study')
    plain = with_entries('Model=foundation', 'Interface/Characteristic slip distance=0.1', 'Output/Reference curve=measured.csv')
    call('scene.prm', *with_entries('Model=foundation', 'Interface/Characteristic slip distance=0.1'))
    curve = 'curve.csv'
    shutil.copy('results/curve.csv' if os.path.exists('results/curve.csv') else 'results/torque.csv', curve)
    shutil.rmtree('results')

    def differences(directory):
        return [float(row['difference_mean']) for row in table(directory + '/study.csv')]

    mean = sum(abs(float(row['torque_Nmm'])) for row in table(curve)[1:] if float(row['angle_deg']) > 0)
    largest = max(abs(float(row['torque_Nmm'])) for row in table(curve))
    n = sum(float(row['angle_deg']) > 0 and abs(float(row['torque_Nmm'])) > 0.01 * largest for row in table(curve))
    share = mean / n / largest  # of the mean torque in the largest

    multiple(curve, 2, 'measured.csv', 0)
    run = call('scene.prm', *options)
    expect(run.returncode == 0 and abs(differences('study')[0] - share / 2) < 1e-9, 'a reference curve', run)
    before = os.stat('study/variant-001/torque.csv').st_mtime_ns

    multiple(curve, 4, 'measured.csv', 1000)
    run = call('scene.prm', *options, '--check')
    expect(run.stdout.count('distances will be computed anew') == 2, '--check with another reference curve', run)
    run = call('scene.prm', *options)
    expect(run.returncode == 0 and '2 of them done already' in run.stdout and 'distances of 2 variants' in run.stdout and
           abs(differences('study')[0] - share * 3 / 4) < 1e-9, 'another reference curve', run)
    expect(os.stat('study/variant-001/torque.csv').st_mtime_ns == before, 'the curves of the study stay')
    call('scene.prm', *options, *with_entries('Output/Directory=anew'))
    expect(max(abs(a - b) for a, b in zip(differences('study'), differences('anew'))) < 1e-9, 'distances of a study made anew')
    for name in 'study', 'anew':
        summary = json.loads(contents(name + '/variant-002/summary.json'))
        expect(len(summary['remarks']) == len(set(summary['remarks'])) and 'CRC-64' in summary['reference_files']['curve'],
               'remarks of ' + name)
    run = call('scene.prm', *options)
    expect('computed anew' not in run.stdout and '2 of them done already' in run.stdout, 'the same reference curve', run)
    multiple(curve, -4, 'measured.csv', 2000)
    call('scene.prm', *options)
    expect(sum('opposite sign' in text for text in json.loads(contents('study/variant-001/summary.json'))['warnings']) == 1,
           'a reference curve of the other sign')
    multiple(curve, 4, 'measured.csv', 2000)
    call('scene.prm', *options)
    expect('opposite sign' not in contents('study/variant-001/summary.json'), 'a remark that no longer holds')

    # the page shows the curve that its distances belong to
    call('scene.prm', *plain)
    call('--report', 'results')
    page = contents('results/report.html')
    multiple(curve, 3, 'measured.csv', 3000)
    call('--report', 'results')
    expect(contents('results/report.html') == page, 'the page with another reference curve')
    call('scene.prm', *plain)
    call('--report', 'results')
    expect(contents('results/report.html') != page, 'the page of the run made again')


def check_reference_profiles():
    options = with_entries('Model=foundation', 'Expert/Output/Profile angles=0.5', 'Output/Directory=study',
                           'Expert/Output/Reference profiles=profiles.csv', 'Interface/Characteristic slip distance={{0.1|0.2}}')
    call('scene.prm', *with_entries('Model=foundation', 'Expert/Output/Profile angles=0.5', 'Interface/Characteristic slip distance=0.1'))
    rows = table('results/profiles.csv')
    for factor, age in (2, 0), (4, 1000):
        with open('multiple', 'w', newline='') as file:
            writer = csv.DictWriter(file, rows[0].keys())
            writer.writeheader()
            writer.writerows({**row, 'pressure_MPa': factor * float(row['pressure_MPa'])} for row in rows)
        put('multiple', 'profiles.csv', age)
        run = call('scene.prm', *options)
        # the pressure is uniform
        distance = float(table('study/study.csv')[0]['pressure_difference_rms'])
        expect(abs(distance - (1 - 1 / factor)) < 1e-6, 'profiles times %d' % factor, run)


def check_other_program():
    options = with_entries('Model=foundation', 'Interface/Characteristic slip distance={{0.1|0.2}}', 'Output/Directory=study')
    call('scene.prm', *options)
    name = 'study/variant-002/summary.json'
    summary = json.loads(contents(name))
    summary['provenance']['program'] = 'debond 0.9.0'
    with open(name, 'w') as file:
        json.dump(summary, file)
    run = call('scene.prm', *options)
    expect(run.returncode == 1 and 'debond 0.9.0' in run.stderr and '--force' in run.stderr, 'variants of another program', run)
    run = call('scene.prm', *options, '--force')
    expect(run.returncode == 0 and json.loads(contents(name))['provenance']['program'] != 'debond 0.9.0', 'them anew', run)


def check_ensemble():
    options = ['scene.prm'] + with_entries('Interface/Bonding/Pattern=random', 'Interface/Bonding/Bonded fraction=0.5',
                                           'Output/Directory=study') + ['--force']
    call(*options, *with_entries('Interface/Bonding/Seed={{1|2}}'))
    expect(os.path.exists('study/ensemble.csv'), 'an ensemble')
    call(*options, *with_entries('Implant/Poisson ratio={{0.3|0.31}}'))
    expect(not os.path.exists('study/ensemble.csv') and not os.path.exists('study/ensemble_summary.csv'),
           'statistics of a study that has no seeds any more')


in_python = r'''
import os, shutil, sys
sys.path.insert(0, sys.argv[1])
import debond
def force(name):
    scene = debond.Scene("scene.prm", {"Bone/Voxel file": name, "Bone/Young modulus": "grey"})
    simulation = debond.Simulation(scene)
    simulation.run()
    return simulation, simulation.row["force_N"]
'''


def check_memory():
    """An image that is in use, and another one of the same name."""
    files = os.path.join(here, 'files')
    for name, first, second in ('voxels.csv', 'bone_soft.csv', 'bone_stiff.csv'), ('bone.raw', 'soft.raw', 'stiff.raw'):
        image = 'bone.mhd' if name == 'bone.raw' else name
        for folder, content in ('.', first), ('other', second):
            os.makedirs(folder, exist_ok=True)
            put(os.path.join(files, content), os.path.join(folder, name), 0)
            shutil.copy(os.path.join(files, 'bone.mhd'), folder)
            shutil.copy('scene.prm', folder) if folder != '.' else None
        os.utime('other/bone.mhd', (1.7e9, 1.7e9))
        os.utime('bone.mhd', (1.7e9, 1.7e9))
        alone = 'kept, value = force("%s")\nprint(repr(value))\n' % image
        one = call('-c', in_python + alone, module, program=sys.executable).stdout
        other = call('-c', in_python + 'os.chdir("other")\n' + alone, module, program=sys.executable).stdout
        expect(one and other and one != other, name + ' in Python: %s, %s' % (one, other))
        run = call('-c', in_python + alone + 'os.chdir("other")\n' + alone.replace('kept', 'also'), module,
                   program=sys.executable)
        expect(run.stdout == one + other, name + ' after chdir: expected %s%s' % (one, other), run)
        run = call('-c', in_python + alone + 'shutil.copy2("other/%s", "%s")\n' % (name, name) +
                   'os.utime("%s", (1.6e9, 1.6e9))\n' % name + alone.replace('kept', 'also'), module, program=sys.executable)
        expect(run.stdout == one + other, name + ', an older one in its place: expected %s%s' % (one, other), run)


def check_change_during_study():
    """A picture that changes while the first variant runs: the second one is not of the scenes that were read."""
    whole, half = (os.path.join(here, 'files', name) for name in ('whole.png', 'half.png'))
    put(whole, 'picture.png', 0)
    options = with_entries('Interface/Bonding/Pattern=image', 'Interface/Bonding/File=picture.png', 'Load steps/Steps=1, 300',
                           'Implant/Poisson ratio={{0.3|0.31}}', 'Output/Directory=study')
    study = subprocess.Popen([debond, 'scene.prm', *options, '--jobs', '1'], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while study.poll() is None and not os.path.exists('study/variant-001/torque.csv'):
        time.sleep(0.01)
    put(half, 'picture.png', 1000)
    study.wait()
    rows = table('study/study.csv')
    expect(study.returncode == 2 and rows[0]['phi_0_mean'] == '1' and
           'has changed since the scene was read' in rows[1]['reason'], 'a picture that changes during a study: %s' % rows[1])


def check(work, *arguments):
    with tempfile.TemporaryDirectory() as directory:
        os.chdir(directory)
        shutil.copy(os.path.join(here, 'scene.prm'), '.')
        try:
            work(*arguments)
        except (KeyError, TypeError, ValueError, OSError, IndexError) as error:
            failures.append('%s %s: %r' % (work.__name__, arguments[:2], error))
        os.chdir(here)


if module:
    check(check_memory)
else:
    for number, line in enumerate(table(os.path.join(here, 'expected.csv'))):
        check(check_file, with_all or number == 0, *line.values())
    for work in check_reference_curve, check_reference_profiles, check_other_program, check_ensemble, check_change_during_study:
        check(work)
print('\n'.join(failures) or 'all results belong to their files')
sys.exit(bool(failures))
