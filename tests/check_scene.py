#!/usr/bin/env python3
"""Runs a scene in the ways that its comments name and checks the results against what they expect. The language of
these comments is described in doc/developers/tests.md.

    tests/check_scene.py build/release/debond SCENE.prm DIRECTORY            all runs of the scene
    tests/check_scene.py build/release/debond SCENE.prm DIRECTORY RUN        this one alone

Results go to the directory. Prints a line for each expectation and, for the table of doc/evidence/stability.md, a row
for each run. Exit code 0 if everything is as expected. DEBOND_TEST_THREADS is the number of threads.
"""
import csv
import json
import math
import os
import re
import shlex
import shutil
import subprocess
import sys

COMMENT = re.compile(r'\s*#\s*(let|expect|wrong|refused|failed|slow run|run)(?:\s+([^\s:]+))?:\s*(.*?)\s*$')
UNREAD = re.compile(r'\s*#\s*((let|wrong|refused|failed|slow run|run)\b[^.]*:|expect\b)')  # meant to be one, with a slip of the pen
QUANTITY = re.compile(r'(?P<name>\w+)(?: of (?P<kind>variant|run) (?P<which>\S+?))?'
                      r'(?: (?:(?P<measure>max|last)|(?P<how>at|ripple after) (?P<where>\w+)(?: (?P<place>\S+))?))?')
EXPECTATION = re.compile(r'(?:in (?P<all>rows|curve|variants)(?: where (?P<where>.+?))?: )?'
                         r'(?P<left>.+?) (?P<relation>=|below|above) (?P<right>.+?)'
                         r'(?: within (?P<tolerance>.+?)(?P<percent> %)?)?')
BUILT_IN = {function.__name__: function for function in (abs, max, min, range, sum)}


class Problem(Exception):
    """What makes an expectation fail other than a wrong number."""


def equal(a, b):
    return abs(a - b) <= 1e-9 * max(1., abs(b))


class Results:
    """What a run or a variant has written: numbers of its summary, and rows."""

    def __init__(self, summary, rows=(), messages=()):
        self.summary, self.rows, self.messages = summary, list(rows), list(messages)
        self.curve, self.variants = [], []  # rows of the curve between those of the steps, Results

    def column(self, name):
        if not self.rows or name not in self.rows[0]:
            raise Problem(f'the rows have no column {name}')
        return [row[name] for row in self.rows]

    def at(self, name, where, place):
        self.column(name), self.column(where)
        for row in reversed(self.rows):
            if equal(row[where], place):
                return row[name]
        raise Problem('there is no such row')

    def ripple(self, name, where, start):
        """Largest less smallest value over the mean, from START on."""
        self.column(where)
        values = [value for value, row in zip(self.column(name), self.rows) if row[where] >= start or equal(row[where], start)]
        if len(values) < 2:
            raise Problem('there are no such rows')
        return (max(values) - min(values)) / abs(sum(values) / len(values))


def number_of(text):
    """A number or a truth, None for other text."""
    try:
        return {'true': 1., 'false': 0.}.get(text) if text in ('true', 'false') else float(text)
    except (TypeError, ValueError):
        return None


def numbers_of(table):
    return {name: float(value) if isinstance(value, (bool, int, float)) else None for name, value in table.items()
            if not isinstance(value, (str, list, dict))}


def read_csv(name):
    with open(name, newline='') as file:
        return [{key: number_of(value) for key, value in row.items()} for row in csv.DictReader(file)]


def read_json(name):
    with open(name) as file:
        return json.load(file)


def read_run(directory):
    summary = read_json(directory + '/summary.json')
    names = [directory + '/' + name for name in ('reactions.csv', 'torque.csv')]
    rows = next((read_csv(name) for name in names if os.path.exists(name)), [])
    results = Results(numbers_of(summary), rows, summary.get('warnings', []) + summary.get('remarks', []))
    if os.path.exists(directory + '/curve.csv'):
        results.curve = read_csv(directory + '/curve.csv')
    return results


def read_study(directory):
    """Results of each variant: its row of study.csv, and its own."""
    study = Results({})
    for number, row in enumerate(read_csv(directory + '/study.csv'), 1):
        own = f'{directory}/variant-{number:03}'
        variant = read_run(own) if os.path.exists(own + '/summary.json') else Results({})
        variant.summary.update(row)
        study.variants.append(variant)
    return study


def read_calibration(directory):
    """Best values of unknowns, widths of their 95 % intervals as NAME_width, half widths with a candidate as
    NAME_after_experiment_2, e_mp and e_rel of the first curve. What cannot be told is infinite."""
    text = read_json(directory + '/calibration.json')

    def number(value):
        return math.inf if value is None else float(value)
    summary = {name: number(text['curves'][0][name]) for name in ('e_mp', 'e_rel')}
    for name, unknown in text['unknowns'].items():
        summary[name] = number(unknown['value'])
        upper = number(unknown['upper_95'])
        summary[name + '_width'] = upper if upper == math.inf else upper - number(unknown['lower_95'])
    for candidate in text['candidates']:
        for name, width in candidate['half_widths'].items():
            summary[f'{name}_after_experiment_{candidate["experiment"]}'] = number(width)
    return Results(summary)


def read_results(directory):
    for name, read in (('calibration.json', read_calibration), ('study.csv', read_study), ('summary.json', read_run)):
        if os.path.exists(directory + '/' + name):
            return read(directory)
    return Results({})


class Run:
    """A way to run the scene, with what is expected of it."""

    def __init__(self, name, options, is_slow):
        self.name, self.options, self.is_slow = name, shlex.split(options), is_slow
        self.own, self.wrong, self.stop = [], [], None  # the last: how it stops, and words of the message
        self.results, self.outcome, self.detail, self.verdicts = None, '', '', []

    def start(self, debond, scene, directory):
        """Runs the program; sets the results, and the outcome of a run that stops."""
        shutil.rmtree(directory, ignore_errors=True)
        threads = os.environ.get('DEBOND_TEST_THREADS')
        done = subprocess.run([debond, scene, '--force', *self.options, *(['--threads', threads] if threads else []),
                               '--set', 'Output/Directory=' + directory, '--set', 'Expert/Output/Console=quiet',
                               '--set', 'Output/Report=false'], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.results = read_results(directory)
        # a study of which variants have failed is judged by those that it has
        if done.returncode != 0 and not (done.returncode == 2 and self.results.variants and not self.stop):
            message = ' '.join(done.stdout.split())
            print(message)
            kind, words = self.stop or ('', ())
            is_known = bool(words) and all(word in message for word in words) and done.returncode in (1, 2)
            self.outcome = 'stopped' if not is_known else 'refused' if done.returncode == 1 else kind
            self.detail = f'"... {words[0] if is_known else message} ..."'

    def judge(self, scene):
        """Sets the outcome of a run that has ended: right, or wrong where it is not as expected."""
        stopped = bool(self.outcome)
        self.outcome = self.outcome or 'right'
        for expectation in self.own if stopped else self.own or scene.expected:
            verdict = Verdict(expectation, scene, self)
            self.verdicts.append(verdict)
            is_first = self.outcome == 'right' and not verdict.is_met or not self.detail
            self.outcome = self.outcome if verdict.is_met else 'wrong'
            if is_first:
                self.detail = f'{verdict.quantity}: {verdict.measured}'
        for value in self.wrong:
            self.verdicts.append(Verdict(value, scene, self))
            self.outcome += '' if self.verdicts[-1].is_met else ' in another way'
        for verdict in self.verdicts:
            print(verdict.line)
        return self.outcome == ('wrong' if self.wrong else self.stop[0] if self.stop else 'right') and \
            all(verdict.is_readable for verdict in self.verdicts)

    def row(self, scene_name):
        numbers = [self.results.summary.get(name) for name in ('newton_iterations', 'smallest_step', 'largest_energy_defect')]
        warned = sum(row.get('warnings', 0) > 0 for row in self.results.rows)
        return ' | '.join(['| ' + scene_name, self.name, self.outcome, self.detail,
                           *('' if value is None else f'{value:.{digits}g}' for value, digits in zip(numbers, (8, 2, 2))),
                           f'{warned} |'])


class Scene:
    """The comments of a scene."""

    def __init__(self, name):
        self.constants, self.runs, self.expected = {}, [], []
        with open(name) as file:
            for line in file:
                match = COMMENT.match(line)
                if match:
                    self.read(*match.groups())
                elif UNREAD.match(line):
                    raise Problem(f'this comment is none that is read: {line.strip()}')
                elif self.runs and re.match(r'\s*#\s+--set ', line):  # the run goes on
                    self.runs[-1].options += shlex.split(line.strip(' #\n'))
        if not self.runs:
            self.runs = [Run('default', '', False)]
        for run in self.runs:
            if not (run.own or self.expected or run.stop):
                raise Problem(f'nothing is expected of the run {run.name}')
        if self.expected and all(run.own or run.stop for run in self.runs):
            raise Problem('what is expected before the first run is asked of none: each has its own')

    def read(self, keyword, name, text):
        text = re.sub(r'\s\s+\(.*', '', text)
        if keyword in ('run', 'slow run'):
            self.runs.append(Run(name, text, keyword == 'slow run'))
        elif keyword == 'let':
            symbol, value = text.split(' = ', 1)
            symbol, _, arguments = symbol.rstrip(')').partition('(')
            self.constants[symbol] = self.value(f'lambda {arguments}: {value}' if arguments else value, {})
        elif keyword == 'expect':
            (self.runs[-1].own if self.runs else self.expected).append(text)
        elif keyword == 'wrong':
            self.runs[-1].wrong.append(text)
        else:
            self.runs[-1].stop = keyword, (*(self.runs[-1].stop or ((), ()))[1], text)

    def value(self, text, names):
        """Value of a formula in Python."""
        mathematics = {name: value for name, value in vars(math).items() if name[0] != '_'}
        try:
            return eval(text, {'__builtins__': {}, **mathematics, **BUILT_IN, **self.constants, **names})
        except Problem:
            raise
        except Exception as error:
            raise Problem(f'cannot evaluate {text}: {error}') from error

    def results_of(self, kind, which, own):
        """Results of another variant or run; OWN if none is named."""
        if kind == 'variant' and 0 < int(which) <= len(own.variants):
            return own.variants[int(which) - 1]
        others = [run.results for run in self.runs if run.name == which and run.results]
        if kind == 'run' and others:
            return others[0]
        if kind:
            raise Problem(f'there is no {kind} {which}')
        return own

    def quantity(self, match, own, row):
        """Value of a quantity of the results OWN; in the row of this number and content, if there is one."""
        name, measure, how, where, place = match.group('name', 'measure', 'how', 'where', 'place')
        results = self.results_of(match['kind'], match['which'], own)
        if measure == 'max':
            return max(map(abs, results.column(name)))
        if measure == 'last':
            return results.column(name)[-1]
        if how:
            if place is None and row is None:
                raise Problem(f'there is no value of {where}')
            place = self.value(place, {**own.summary, **(row[1] if row else {})}) if place else row[1][where]
            return results.at(name, where, place) if how == 'at' else results.ripple(name, where, place)
        if row and match['kind'] and name in results.rows[0]:
            if len(results.rows) != len(own.rows):
                raise Problem('the other run has another number of rows')
            return results.rows[row[0]][name]
        if row and not match['kind'] and name in row[1]:
            return row[1][name]
        if name not in results.summary:
            raise Problem(f'summary.json has no number {name}')
        return results.summary[name]

    def formula(self, text, own, row=None):
        """Value of a formula, in which quantities of several words stand in brackets."""
        whole = QUANTITY.fullmatch(text)
        if whole and (' ' in text or text in own.summary):
            return self.quantity(whole, own, row)
        names = {**own.summary, **(row[1] if row else {}), 'rows': len(own.rows),
                 'said': lambda words: sum(words in message for message in own.messages)}

        def substitute(match):
            inner = QUANTITY.fullmatch(match[1])
            if not inner:
                raise Problem(f'cannot read [{match[1]}]')
            names[f'quantity_{len(names)}'] = self.quantity(inner, own, row)
            return f'quantity_{len(names) - 1}'
        return self.value(re.sub(r'\[([^\]]*)\]', substitute, text), names)


class Verdict:
    """Whether results are as an expectation says: of all its places the one that is nearest to the edge of its band."""

    def __init__(self, expectation, scene, run):
        self.expectation, self.is_readable, self.is_met = expectation, True, False
        self.value, self.low, self.high, self.measured = math.nan, -math.inf, math.inf, ''
        self.quantity = re.split(' = | below | above ', expectation)[0]
        try:
            match = EXPECTATION.fullmatch(expectation)
            if not match or (match['relation'] == '=') == (match['tolerance'] is None) and match['right'] != 'null':
                raise Problem('cannot read this expectation')
            places = [self.band(match, scene, *place) for place in self.places(match, scene, run.results)]
            if not places:
                raise Problem('there are none')
            self.value, self.low, self.high, where = min(places, key=self.room)
            self.measured = f'{self.value:.8g}{where}'
            self.is_met = self.low <= self.value <= self.high
        except Problem as problem:
            self.measured, self.is_readable = str(problem), False
        self.line = f'ok: {expectation}' if self.is_met else f'FAILED: {expectation}: {self.measured}'

    @staticmethod
    def room(place):
        value, low, high, _ = place
        return -math.inf if math.isnan(value) else min(value - low, high - value)

    @staticmethod
    def places(match, scene, results):
        """Results, row and description of each place that is meant."""
        if not match['all']:
            return [(results, None, '')]
        if match['all'] in ('rows', 'curve'):
            every = [(results, row, f' in row {row[0]}') for row in enumerate(getattr(results, match['all']))]
        else:
            every = [(one, None, f' in {match["all"][:-1]} {number}')
                     for number, one in enumerate(getattr(results, match['all']), 1)]
        return [place for place in every if not match['where'] or scene.formula(match['where'], place[0], place[1])]

    @staticmethod
    def band(match, scene, results, row, where):
        """Value, lowest and highest that is allowed."""
        value = scene.formula(match['left'], results, row)
        if match['right'] == 'null':
            return (1. if value is None else 0.), 1., 1., where
        if value is None:
            raise Problem(f'{match["left"]} is null{where}')
        bound = scene.formula(match['right'], results, row)
        if match['relation'] == 'below':
            return value, -math.inf, math.nextafter(bound, -math.inf), where
        if match['relation'] == 'above':
            return value, math.nextafter(bound, math.inf), math.inf, where
        room = scene.formula(match['tolerance'], results, row) * (0.01 * abs(bound) if match['percent'] else 1.)
        return value, bound - room, bound + room, where


def main():
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    debond, scene_file, directory = sys.argv[1:4]
    directory = os.path.abspath(directory)
    scene = Scene(scene_file)
    chosen = [run for run in scene.runs if run.name == sys.argv[4]] if len(sys.argv) == 5 else \
             [run for run in scene.runs if not run.is_slow]
    if not chosen:
        sys.exit(f'the scene has no run {sys.argv[4]}')
    for run in chosen:
        run.start(debond, scene_file, directory if len(chosen) == 1 else f'{directory}/{run.name}')
    all_met = True
    for run in chosen:
        if len(chosen) > 1:
            print(run.name)
        all_met = run.judge(scene) and all_met
        print(run.row(os.path.splitext(os.path.basename(scene_file))[0]))
    os.makedirs(directory, exist_ok=True)
    with open(directory + '/expectations.csv', 'w') as file:
        file.write('value,low,high,expectation\n')
        for run in chosen:
            for verdict in run.verdicts:
                file.write(f'{verdict.value!r},{verdict.low!r},{verdict.high!r},{verdict.expectation}\n')
    return 0 if all_met else 1


if __name__ == '__main__':
    try:
        sys.exit(main())
    except Problem as problem:
        sys.exit(str(problem))
