#!/usr/bin/python3
"""Solves a scene with this solver, and with debond if it is given, and compares the results row by row."""
import argparse
import csv
import os
import subprocess
import sys
import tempfile

os.environ.setdefault('OPENBLAS_NUM_THREADS', '1')  # more only disturb each other: all matrices are small
sys.dont_write_bytecode = True

import scene_file  # noqa: E402  (numpy reads the environment when it is imported)

# Differences are measured by the largest value in a group of columns.
GROUPS = {
    'forces [N]': ['chuck_Fx_N', 'chuck_Fy_N', 'chuck_Fz_N', 'force_N'],
    'moments [N mm]': ['chuck_Mx_Nmm', 'chuck_My_Nmm', 'chuck_Mz_Nmm', 'torque_Nmm'],
    'pressure [MPa]': ['pressure_MPa'],
    'shares and phi': ['share_stick', 'share_slip', 'share_open', 'share_pulled', 'phi_mean'],
    'works and energies [N mm]': ['work_Nmm', 'energy_bulk_Nmm', 'energy_interface_Nmm', 'dissipation_Nmm',
                                  'adhesive_work_Nmm', 'viscous_work_Nmm', 'damage_Nmm'],
}
COLUMNS = [column for group in GROUPS.values() for column in group]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('scene', help='scene file of debond')
    parser.add_argument('--debond', metavar='PROGRAM', help='compare with this program')
    parser.add_argument('--set', metavar='ENTRY=VALUE', action='append', default=[],
                        help='override an entry of the scene for both programs; may be repeated')
    parser.add_argument('--within', type=float, default=1e-7, help='tolerance, relative to the largest value of each '
                        'group of columns (default: %(default)g)')
    parser.add_argument('--dissipation-within', type=float, help='another tolerance for the dissipation')
    parser.add_argument('--csv', metavar='FILE', help='write the rows of this solver')
    parser.add_argument('--rows', metavar='FILE', help='take the rows that --csv has written instead of solving again')
    return parser.parse_args()


def read(path):
    with open(path, encoding='utf-8') as lines:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(lines)]


def run_debond(program, scene, changes):
    """The rows of torque.csv, as numbers by column."""
    with tempfile.TemporaryDirectory() as directory:
        result = os.path.join(directory, 'results')
        command = [program, '--threads', '1', scene]
        for change in changes + ['Output/Directory=' + result, 'Output/Fields every=none', 'Output/Curve=Rotation z, Moment z']:
            command += ['--set', change]
        run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if run.returncode:
            sys.exit('%s\nFAILED: debond ended with exit code %d' % (run.stdout, run.returncode))
        return read(os.path.join(result, 'torque.csv'))


def write(path, rows):
    with open(path, 'w', encoding='utf-8', newline='') as lines:
        table = csv.DictWriter(lines, ['time', *COLUMNS], lineterminator='\n')
        table.writeheader()
        table.writerows({name: '%.13g' % row[name] for name in table.fieldnames} for row in rows)


def compare(ours, theirs, within, others):
    """Print the largest difference of every column; whether all are within the tolerance, or that of `others`."""
    if len(ours) != len(theirs) or any(abs(a['time'] - b['time']) > 1e-9 for a, b in zip(ours, theirs)):
        print('FAILED: %d rows here, %d rows of debond, or other times' % (len(ours), len(theirs)))
        return False
    good = True
    print('%-22s %12s %12s %12s %8s' % ('column', 'largest', 'scale', 'difference', 'time'))
    for columns in GROUPS.values():
        scale = max(abs(row[column]) for row in theirs for column in columns)
        for column in columns:
            differences = [abs(a[column] - b[column]) / scale for a, b in zip(ours, theirs)]
            worst = max(range(len(differences)), key=lambda k, d=differences: d[k] if d[k] == d[k] else float('inf'))
            bad = not differences[worst] <= others.get(column, within)
            good = good and not bad
            print('%-22s %12.6g %12.6g %12.1e %8.4g%s' % (column, max(abs(row[column]) for row in theirs), scale,
                                                          differences[worst], theirs[worst]['time'], '  FAILED' * bad))
    return good


def main():
    options = arguments()
    rows = read(options.rows) if options.rows else list(scene_file.Scene(options.scene, options.set).run())
    if options.csv:
        write(options.csv, rows)
    if options.debond:
        theirs = run_debond(options.debond, options.scene, options.set)
        others = {} if options.dissipation_within is None else {'dissipation_Nmm': options.dissipation_within}
        if not compare(rows, theirs, options.within, others):
            sys.exit('FAILED: the two differ by more than %g' % options.within)
    elif not options.csv:
        for row in rows:
            print('time %-8.4g' % row['time'] + ' '.join('%12.6g' % row[column] for column in COLUMNS[:8]))


if __name__ == '__main__':
    main()
