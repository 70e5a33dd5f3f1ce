#!/usr/bin/env python3
"""Error over seconds for interfaces from soft to stiff: picture and table of doc/evidence/stiffness.md.

    doc/studies/stiffness.py                # runs prm/studies/stiffness.prm, one variant at a time on one thread (some minutes), and draws
    doc/studies/stiffness.py --draw         # runs nothing, draws what is there
    doc/studies/stiffness.py --publish      # also copies picture and table into doc
    doc/studies/stiffness.py --reference    # makes the references again: two minutes, 3 GB

What is there already is not run again; remove output/studies/stiffness for that. DEBOND names the program. gnuplot is needed to draw."""
import csv
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

TOP = Path(__file__).resolve().parents[2]
RESULTS, DATA = Path('output/studies'), Path('prm/studies/data')
STIFFNESSES = ('622', '1800', '1e4', '1e5', '1e6')
COARSE = Path('prm/studies/data/work_precision_torque.csv')  # of the first, of another family of meshes


def run(scene):
    subprocess.run([os.environ.get('DEBOND', 'build/release/debond'), 'prm/studies/%s.prm' % scene, '--jobs', '1', '--threads', '1'], check=True)


def start():
    """Seconds that a process takes to start, which variants of a study share: the least of five."""
    file = RESULTS / 'start'
    if '--draw' not in sys.argv:
        seconds = []
        for _ in range(5):
            begin = time.monotonic()
            subprocess.run([os.environ.get('DEBOND', 'build/release/debond'), '--version'], check=True, stdout=subprocess.DEVNULL)
            seconds.append(time.monotonic() - begin)
        file.write_text('%.2f\n' % min(seconds), encoding='utf-8')
    return float(file.read_text(encoding='utf-8'))


def rows(path):
    with open(path) as file:
        return list(csv.DictReader(line for line in file if not line.startswith('#')))


def curve(variant, name):
    directory = RESULTS / 'stiffness_reference' / ('variant-%03d' % variant)
    return [(float(row['angle_deg']), float(row['torque_Nmm'])) for row in rows(directory / name) if float(row['time']) > 1]


def difference(points, lines):
    """Largest difference of a curve of points from one so dense that lines join its points, over the largest torque."""
    angles, torques = np.transpose(points)
    return np.abs(np.interp(angles, *np.transpose(lines)) - torques).max() / torques.max()


def make_references():
    run('stiffness_reference')
    for i, eps in enumerate(STIFFNESSES):
        points, kept = curve(i + 1, 'torque.csv'), []
        T_max = max(torque for _, torque in points)
        for k, point in enumerate(points):  # up to 1 % of T_max or 0.2 degrees apart
            after = points[k + 1] if k + 1 < len(points) else None
            if not kept or after is None or abs(after[1] - kept[-1][1]) > .01 * T_max or after[0] > kept[-1][0] + .2:
                kept.append(point)
        with open(DATA / ('stiffness_%s.csv' % eps), 'w') as file:
            file.write('# Made by doc/studies/stiffness.py --reference: cells fitted 40, 13, 22, 18 and 28, 10, 8, %s MPa/mm.\n' % eps +
                       '# Cells fitted 28, 9, 16, 13 and 20, 7, 6 differ by %.1e of T_max at most.\n' %
                       difference(points, curve(i + 1 + len(STIFFNESSES), 'curve.csv')) + 'angle_deg,torque_Nmm\n' +
                       ''.join('%.8g,%.8g\n' % point for point in kept))
    other = [(float(row['angle_deg']), float(row['torque_Nmm'])) for row in rows(COARSE)]
    print('At 622 MPa/mm, from splines on 200 x 200 x 14 cells: %.1e' % difference(other[1:], [(0, 0)] + curve(1, 'curve.csv')))


def family(row):
    if row['Bone / Cells'].startswith('fitted'):
        return 'splines that follow the rim'
    graded = ' graded to the rim' if row['Expert / Bone / Cells under implant'] != 'none' else ''
    return {'trilinear': 'trilinear', 'quadratic': 'quadratic', 'spline': 'splines'}[row['Bone / Element']] + graded


def gather():
    """The table to draw, and lines of Markdown: a mesh each, seconds of a process and error for every stiffness."""
    lines, meshes, before = [], {}, start()
    for row in rows(RESULTS / 'stiffness/study.csv'):
        cells = '%s / %s' % (row['Bone / Cells'], row['Implant / Cells'])
        seconds = before + float(row['wall_seconds']) + float(row.get('seconds_shared_set_up') or 0)
        error = float(row['difference_max'])
        lines.append((row['Interface / Normal stiffness'], family(row), cells, seconds, error))
        meshes.setdefault((family(row), cells), {})[row['Interface / Normal stiffness']] = (seconds, error)
    with open(RESULTS / 'stiffness.csv', 'w') as file:
        file.write('stiffness,family,cells,seconds,error\n')
        lines.sort(key=lambda line: STIFFNESSES.index(line[0]))  # a line of the picture in rows that follow each other
        file.writelines('%s,%s,"%s",%.3g,%.3g\n' % line for line in lines)
    head = ['cells of bone / implant'] + ['%s MPa/mm' % eps for eps in STIFFNESSES]
    table = ['| %s |' % ' | '.join(head), '|%s' % (' --- |' * len(head))]
    for (kind, cells), of in meshes.items():
        table.append('| %s, %s | ' % (kind, cells.replace('fitted ', '')) +
                     ' | '.join('%.2g s: %.1e' % of[eps] if eps in of else '' for eps in STIFFNESSES) + ' |')
    return '\n'.join(table)


def publish(table):
    subprocess.run(['doc/studies/publish.py', 'doc/evidence/stiffness.md', 'stiffness', 'all:1,3,5,10,12'], input=table, text=True, check=True)
    for name in ('stiffness.png', 'stiffness.svg'):
        shutil.copy(RESULTS / name, 'doc/images')


def main(options):
    if not options <= {'--draw', '--publish', '--reference'}:
        sys.exit(__doc__)
    os.chdir(TOP)
    if '--reference' in options:
        make_references()
        return
    if '--draw' not in options:
        run('stiffness')
    table = gather()
    subprocess.run(['gnuplot', 'doc/studies/stiffness.gp'], check=True)
    print(table)
    if '--publish' in options:
        publish(table)


if __name__ == '__main__':
    main(set(sys.argv[1:]))
