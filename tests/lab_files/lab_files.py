#!/usr/bin/env python3
"""Tables as laboratories write them, in files/, each compared by the program with the curve that it holds.

    lab_files.py DEBOND

A line of expected.csv has the file, what --columns says of it, and either the rows that it holds, ANGLE:TORQUE in deg and
N mm, or behind an exclamation mark words, separated by semicolons, that the one line of the refusal must have. The numbers
are what a person reads in the file. Units are exact by definition: 1 in = 25.4 mm, 1 lbf = 4.4482216152605 N = 16 ozf,
1 kgf = 9.80665 N, 1 gon = 0.9 deg. A line of expected_chuck.csv has a table for Translation z of the chuck, its File
columns, its Control, and words that --check of scene.prm, or the refusal, must have. `lab_files.py DEBOND NAME...` tries
these files only.
"""
import csv
import os
import re
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
debond, chosen = os.path.abspath(sys.argv[1]), sys.argv[2:]
scratch = tempfile.TemporaryDirectory()


def compare(name, columns, rows):
    """What the program says of the file and of a run whose torque.csv has these rows."""
    with open(os.path.join(scratch.name, 'torque.csv'), 'w') as curve:
        curve.write('angle_deg,torque_Nmm\n' + ''.join('%s,%s\n' % row for row in dict.fromkeys(rows)))
    command = [debond, '--compare', scratch.name, name] + (['--columns', columns] if columns else [])
    return subprocess.run(command, cwd=os.path.join(here, 'files'), text=True, capture_output=True)


def is_refused(run, name, words):
    return (run.returncode == 1 and run.stderr.count('\n') == 1 and name in run.stderr and
            all(word.strip() in run.stderr.replace(name, '') for word in words.split(';')))


def why_wrong(name, columns, expected):
    if expected.startswith('!'):
        run = compare(name, columns, [('0', '0'), ('1', '1')])
        return '' if is_refused(run, name, expected[1:]) else \
            'expected a line with%s, got %d, %s' % (expected[1:], run.returncode, run.stdout + run.stderr)
    rows = [tuple(row.split(':')) for row in expected.split()]
    run = compare(name, columns, rows)
    n_rows = re.search(r'; (\d+) rows, ', run.stdout)
    distance = re.search(r'\((\d+) rows; e_mp (\S+) %', run.stdout)
    is_right = n_rows and distance and int(n_rows[1]) == int(distance[1]) == len(rows) and float(distance[2]) < 1e-7
    return '' if run.returncode == 0 and is_right else 'expected %s, got %s' % (expected, run.stdout + run.stderr)


def why_wrong_chuck(name, columns, control, expected):
    entries = ['File=' + name, 'Control=' + control] + (['File columns=' + columns] if columns else [])
    command = [debond, '--check', os.path.join(here, 'scene.prm')]
    for entry in entries:
        command += ['--set', 'Chuck/Translation z/' + entry]
    run = subprocess.run(command, cwd=os.path.join(here, 'files'), text=True, capture_output=True)
    is_right = is_refused(run, name, expected[1:]) if expected.startswith('!') else expected in run.stdout
    return '' if is_right else 'expected %s, got %d, %s' % (expected, run.returncode, run.stdout + run.stderr)


def lines_of(name):
    with open(os.path.join(here, name), newline='') as table:
        return list(csv.reader(table))[1:]


lines = lines_of('expected.csv') + lines_of('expected_chuck.csv')
unlisted = set(os.listdir(os.path.join(here, 'files'))) - {line[0] for line in lines} - {'.gitattributes'}
failures = ['no line of expected.csv: ' + name for name in sorted(unlisted)]
for line in lines:
    if chosen and line[0] not in chosen:
        continue
    why = (why_wrong if len(line) == 3 else why_wrong_chuck)(*line)
    if why:
        failures.append('%s %s: %s' % (line[0], line[1], why.strip()))
print('\n'.join(failures) or '%d tables are read, or refused, as they should be' % len(lines))
sys.exit(bool(failures))
