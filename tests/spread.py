#!/usr/bin/env python3
"""Runs tests in several configurations and lists how far each number that they check varies, and how near it comes to
the edge of its band.

A configuration is a build, the kernels of OpenBLAS, and a number of threads. Kernels of another processor round in another
way; those of an older one run everywhere. Numbers are those of `# expect:` and `# wrong:` comments, with the band that
the comment states, those that compare.sh compares, with its tolerances, and deviations that programs report, with their
limits. In the list, sorted by the margin:

  margin     least distance from an edge of the band, in spreads; 0 where some are inside and others outside
  spread     largest less smallest value (of the distances from an edge that is computed, too)
  room       that least distance
  configuration  the one that comes nearest

Exit code 1 if a margin is below --margin or a test fails. Results, and the list as spread.csv, go to the directory
--results. Ctrl+C lists what is done so far. The programs of the tests must have been built (target test_programs).

    tests/spread.py --build build/release                       with the kernels of this processor, and Prescott's
    tests/spread.py --build build/release build/plain --kernels default Haswell --threads 1 2 -R 'verification|shapes'
"""
import argparse
import csv
import itertools
import json
import math
import os
import re
import shutil
import subprocess
import sys

NUMBER = re.compile(r'[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.])')
HERE = os.path.dirname(os.path.abspath(__file__))


def tests_of(build, chosen, left_out):
    """Names, commands and working directories of tests that ctest knows and that check numbers."""
    listed = json.loads(subprocess.check_output(['ctest', '--test-dir', build, '--show-only=json-v1']))
    for test in listed['tests']:
        command = test.get('command', [])
        if re.search(r'check_scene|compare\.sh', ' '.join(command[:2])) and \
                re.search(chosen, test['name']) and not (left_out and re.search(left_out, test['name'])):
            properties = {p['name']: p['value'] for p in test['properties']}
            yield test['name'], command, properties.get('WORKING_DIRECTORY', build)


def run(command, where, build, results, environment):
    """Runs a test that writes to its own directory below RESULTS; returns its exit code and that directory."""
    directory = command[2 if command[0].endswith('compare.sh') else 4]  # after check_scene.py, the program and the scene
    own = os.path.join(results, os.path.relpath(directory, build))
    shutil.rmtree(own, ignore_errors=True)
    os.makedirs(own)
    environment = {**environment, 'DEBOND_TEST_NUMBERS': os.path.join(own, 'reports.csv')}
    with open(own + '.log', 'w') as log:
        code = subprocess.run([own if word == directory else word for word in command], cwd=where, stdout=log,
                              stderr=log, env={**os.environ, **environment}).returncode
    return code, own


def numbers_of(command, own):
    """What a test has measured: {what: (value, low, high)}."""
    found = {}
    for name in 'expectations.csv', 'reports.csv':
        if os.path.exists(os.path.join(own, name)):
            with open(os.path.join(own, name)) as file:
                for line in file:
                    value, low, high, what = line.rstrip('\n').split(',', 3)
                    if value != 'value':
                        numbers = float(value), float(low), float(high)
                        found[what] = max(found.get(what, numbers), numbers)
    expected, output = command[1], os.path.join(own, 'output')
    if command[0].endswith('compare.sh') and os.path.exists(expected) and os.path.exists(output):
        with open(expected) as one, open(output) as other:
            for n, (line, now) in enumerate(zip(one, other), 1):
                for k, (a, b) in enumerate(zip(NUMBER.findall(line), NUMBER.findall(now)), 1):
                    a, b = float(a), float(b)
                    room = max(1e-6, 1e-8 * abs(a))
                    found[f'line {n} number {k}: {line.strip()}'] = b, a - room, a + room
    return found


def margin_of(values):
    """Margin, spread, room and the number of the configuration that is nearest to the edge."""
    worst = math.inf, 0., math.inf, 0
    for edge in (1, 2):
        if all(math.isinf(v[edge]) for v in values):
            continue
        rooms = [(v[0] - v[edge]) * (1 if edge == 1 else -1) for v in values]
        if min(rooms) == math.inf:  # as it is meant to be
            continue
        if not all(map(math.isfinite, rooms)):
            return 0., math.inf, math.nan, 0
        spread = max(max(rooms) - min(rooms), max(v[0] for v in values) - min(v[0] for v in values))
        flips = min(rooms) < 0. <= max(rooms)
        room = 0. if flips else min(map(abs, rooms))
        margin = room / spread if spread > 0. else math.inf
        worst = min(worst, (margin, spread, room, rooms.index(min(rooms, key=abs))))
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--build', nargs='+', default=['build/release'], help='build directories (build/release)')
    parser.add_argument('--kernels', nargs='+', default=['default', 'Prescott'],
                        help='of OpenBLAS: default for those of this processor, Prescott, Haswell, Zen, SkylakeX, ...')
    parser.add_argument('--threads', nargs='+', default=['1'], help='(1)')
    parser.add_argument('-R', default='', help='tests, a regular expression as of ctest (all)')
    parser.add_argument('-E', default='', help='tests to be left out')
    parser.add_argument('--margin', type=float, default=3., help='spreads (3)')
    parser.add_argument('--results', default='output/spread', help='directory (output/spread)')
    options = parser.parse_args()
    configurations = list(itertools.product(map(os.path.abspath, options.build), options.kernels, options.threads))
    measured, codes, commands = {}, {}, {}
    for configuration in configurations:
        for test, *how in tests_of(configuration[0], options.R, options.E):
            commands.setdefault(test, {})[configuration] = how
    try:
        for test, of in commands.items():
            for (build, kernels, threads), (command, where) in of.items():
                name = f'{os.path.basename(build)} {kernels} {threads}'
                environment = {'DEBOND_TEST_THREADS': threads,
                               **({} if kernels == 'default' else {'OPENBLAS_CORETYPE': kernels})}
                code, own = run(command, where, build,
                                os.path.join(os.path.abspath(options.results), name.replace(' ', '_')), environment)
                codes.setdefault(test, {})[name] = code
                for what, value in numbers_of(command, own).items():
                    measured.setdefault((test, what), {})[name] = value
    except KeyboardInterrupt:
        print('Stopped; of the tests so far:')
    rows = []
    for (test, what), values in measured.items():
        margin, spread, room, nearest = margin_of(list(values.values()))
        rows.append((margin, spread, room, list(values)[nearest], test, what))
    rows.sort()
    os.makedirs(options.results, exist_ok=True)
    with open(os.path.join(options.results, 'spread.csv'), 'w', newline='') as file:
        writer = csv.writer(file)
        writer.writerow(('margin', 'spread', 'room', 'configuration', 'test', 'number'))
        writer.writerows(rows)
    failed = [(test, name, code) for test, of in codes.items() for name, code in of.items() if code != 0]
    for test, name, code in failed:
        print(f'FAILED: {test} in {name}: exit code {code}')
    for row in rows[:20]:
        print('margin %.3g spreads, spread %.3g, room %.3g, %s: %s: %s' % row)
    poor = sum(row[0] < options.margin for row in rows)
    print(f'{len(rows)} numbers of {len(codes)} tests in {len(configurations)} configurations, {poor} with a margin below '
          f'{options.margin:g} spreads')
    sys.exit(1 if failed or poor or not rows else 0)


if __name__ == '__main__':
    main()
