#!/usr/bin/env python3
"""Tables as laboratories write them, in files/, each compared by the program with the curve that it holds.

    lab_files.py DEBOND

A line of expected.csv has the file, what --columns says of it, and either the rows that it holds, ANGLE:TORQUE in deg and
N mm, or behind an exclamation mark words, separated by semicolons, that the one line of the refusal must have. The numbers
are what a person reads in the file. Units are exact by definition: 1 in = 25.4 mm, 1 lbf = 4.4482216152605 N = 16 ozf,
1 kgf = 9.80665 N, 1 gon = 0.9 deg. `lab_files.py DEBOND NAME...` tries these files only.
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


def why_wrong(name, columns, expected):
    if expected.startswith('!'):
        run = compare(name, columns, [('0', '0'), ('1', '1')])
        words = [word.strip() for word in expected[1:].split(';')]
        missing = [word for word in words if word not in run.stderr.replace(name, '')]
        return '' if run.returncode == 1 and run.stderr.count('\n') == 1 and name in run.stderr and not missing else \
            'expected a line with %s, got %d, %s' % (missing or words, run.returncode, run.stdout + run.stderr)
    rows = [tuple(row.split(':')) for row in expected.split()]
    run = compare(name, columns, rows)
    n_rows = re.search(r'; (\d+) rows, ', run.stdout)
    distance = re.search(r'\((\d+) rows; e_mp (\S+) %', run.stdout)
    is_right = n_rows and distance and int(n_rows[1]) == int(distance[1]) == len(rows) and float(distance[2]) < 1e-7
    return '' if run.returncode == 0 and is_right else 'expected %s, got %s' % (expected, run.stdout + run.stderr)


with open(os.path.join(here, 'expected.csv'), newline='') as table:
    lines = [line for line in csv.reader(table)][1:]
unlisted = set(os.listdir(os.path.join(here, 'files'))) - {line[0] for line in lines} - {'.gitattributes'}
failures = ['no line of expected.csv: ' + name for name in sorted(unlisted)]
for line in lines:
    why = why_wrong(*line) if not chosen or line[0] in chosen else ''
    if why:
        failures.append('%s %s: %s' % (line[0], line[1], why.strip()))
print('\n'.join(failures) or '%d tables are read, or refused, as they should be' % len(lines))
sys.exit(bool(failures))
