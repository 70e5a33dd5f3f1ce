#!/usr/bin/env python3
"""Runs the commands that README.md, CONTRIBUTING.md and the pages of doc print.

    commands.py --list                      page, line and command
    commands.py --check [BUILD]             every command is in commands.txt, and the other way round; names and files in
                                            commands that are not run exist, and with BUILD the tests in its ctest
    commands.py --run BUILD SCRATCH         runs those with `run` in commands.txt, in the order of the pages;
    commands.py --nightly BUILD SCRATCH     those with `nightly`, too

A command is a line of a block (indented, or fenced as sh) or a span in backticks, with arguments, that begins with a
program. Continuations are joined, comments taken off. BUILD is the build tree, SCRATCH a directory that is emptied: it
gets copies of doc, prm and tests, links to all else, and results. A command that is in several pages runs once, in the
first. Exit code: 1 if something is wrong, 77 if all that ran is right but a program that others need is not there.
"""
import argparse
import collections
import glob
import os
import re
import shutil
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
TABLE = 'tests/commands/commands.txt'
COMMAND = re.compile(r'''(?:[A-Z][A-Z_]*=\S+\ +)*(?:
    (?:build/[\w/]+|\./\w+|(?:doc|tests)/[\w/]+\.(?:sh|py))(?=\ |$)
    | debond\ +(?=-|\S+\.prm)
    | (?:mpirun(?=\ +-)|cmake|ctest|cpack|srun|sbatch|gnuplot|pvpython|paraview|(?:/usr/bin/)?python3?|pip3?|venv/bin/\w+|git|sh|bash|sudo|apt|apt-get|dpkg
        |podman|docker|jupyter|xvfb-run|export|cd|cmp|ln|cp|mv|mkdir|cut|grep|sed|awk|cat|head|tail|man|curl|wget|tar|ninja|make)\ +(?=\S)
    )''', re.X)
TOOL = re.compile('(?:export|cd|cmp|ln|cp|mv|mkdir|cut|grep|sed|awk|cat|head|tail|man|git|sh|bash)\\ ')  # within a sentence a part of a command
CHANGES_BUILD = re.compile(r'(?:^|&&|;|\|)\s*(?:sudo\s+)?(?:cmake|ctest|ninja|make|apt|apt-get|dpkg|pip3?|venv/|podman|docker|git|\./quickstart)(?:\s|$|\w)')
Command = collections.namedtuple('Command', 'page line text')
Entry = collections.namedtuple('Entry', 'line kind words text')  # words: after the kind


def without_comment(line):
    quote = ''
    for i, c in enumerate(line):
        if quote:
            quote = '' if c == quote else quote
        elif c in '"\'':
            quote = c
        elif c == '#' and i and line[i - 1] in ' \t':
            return line[:i]
    return line


def commands_of(page):
    found, prose, fence, parts = [], [], None, []
    with open(os.path.join(ROOT, page), encoding='utf-8') as file:
        for number, line in enumerate(file, 1):
            bare = line.strip()
            prose.append('')
            if bare.startswith('```'):
                fence = bare[3:] if fence is None else None
            elif parts or fence in ('sh', 'bash', 'shell') or fence is None and line.startswith('    '):
                bare = without_comment(bare).strip()
                if parts or COMMAND.match(bare):
                    parts.append((number, bare.rstrip('\\').strip()))
                    if not bare.endswith('\\'):
                        found.append(Command(page, parts[0][0], ' '.join(part for _, part in parts)))
                        parts = []
                elif fence is None:
                    prose[-1] = line  # the second line of an item of a list
            elif fence is None:
                prose[-1] = line
    # spans in backticks, which may go on in the next line
    number = 1
    for paragraph in re.split(r'(\n[ \t]*\n)', ''.join(line or '\n' for line in prose)):
        for span in re.finditer(r'`([^`]+)`', paragraph):
            text = ' '.join(span[1].split())
            if COMMAND.match(text) and ' ' in text and not TOOL.match(text):
                found.append(Command(page, number + paragraph[:span.start()].count('\n'), text))
        number += paragraph.count('\n')
    return sorted(found, key=lambda command: command.line)


def all_commands():
    os.chdir(ROOT)
    pages = ['README.md', 'CONTRIBUTING.md'] + sorted(glob.glob('doc/**/*.md', recursive=True))
    return [command for page in pages for command in commands_of(page)]


def table():
    """Entries by command, and what is to be done before a page."""
    entries, before, errors = {}, {}, []
    with open(os.path.join(ROOT, TABLE), encoding='utf-8') as file:
        for number, line in enumerate(file, 1):
            if not line.strip() or line.startswith('#'):
                continue
            what, bar, text = line.partition(' | ')
            kind, *words = what.split()
            text = ' '.join(text.split())
            if not bar or kind.rstrip(':') not in ('run', 'nightly', 'by', 'none', 'before') or kind in ('by', 'none', 'before') and not words:
                errors.append('%s:%d: not `run | ...`, `nightly | ...`, `by TEST | ...`, `none: REASON | ...` or `before PAGE | ...`' % (TABLE, number))
            elif kind == 'before':
                before.setdefault(words[0], []).append(text)
            elif kind in ('run', 'nightly') and CHANGES_BUILD.search(text):
                errors.append('%s:%d: is not run by a test, it would build or install: %s' % (TABLE, number, text))
            elif text in entries:
                errors.append('%s:%d: stands in line %d, too: %s' % (TABLE, number, entries[text].line, text))
            else:
                entries[text] = Entry(number, kind.rstrip(':'), words, text)
    return entries, before, errors


def tests_of(build):
    answer = subprocess.run(['ctest', '-N'], cwd=build, stdout=subprocess.PIPE, universal_newlines=True, check=True).stdout
    names = set()
    for name in re.findall(r'^ *Test +#\d+: (.*)', answer, re.M):
        first, *others = name.split(' (')[0].split(', ')  # those that cannot run here have the reason behind, together
        names |= {first} | {first.split('/')[0] + '/' + other for other in others}
    return names


def unknown_names(text):
    """Of a command that is not run: scripts, scenes and other files, and the names that scripts are given."""
    read = lambda name: open(os.path.join(ROOT, name), encoding='utf-8').read()
    script = None
    for word in text.replace('"', ' ').replace("'", ' ').split():
        if word in ('&&', '|'):
            script = None
        elif re.fullmatch(r'(doc|tests|prm|source|python)/[\w/.-]+', word):
            if not os.path.exists(os.path.join(ROOT, word)):
                yield 'there is no ' + word
            elif word.endswith(('.sh', '.py')) and script is None:
                script = word
        elif script and (re.fullmatch('[a-z][a-z0-9_]+', word) or re.match('--[a-z]', word)):
            if not re.search(r'(?<![\w-])%s(?![\w-])' % re.escape(word), read(script) + read('doc/paper/reproduce.sh')):
                if not os.path.exists(os.path.join(ROOT, 'prm/paper', word + '.prm')):
                    yield '%s does not know %s' % (script, word)


# Which package has a program of a command, or a module of a block of Python, that the program itself does not need.
PACKAGES = {'gnuplot': 'gnuplot', 'pvpython': 'paraview', 'paraview': 'paraview', 'xvfb-run': 'xvfb', '--target site': 'furo', 'mpirun': 'openmpi-bin',
            'jupyter': 'jupyter', 'pandas': 'python3-pandas', 'numpy': 'python3-numpy', 'scipy': 'python3-scipy', 'emcee': 'python3-emcee',
            'matplotlib': 'python3-matplotlib', 'mpi4py': 'python3-mpi4py', 'dask': 'python3-dask', 'concurrent': 'python3', 'debond': 'python3'}


def lacking_packages(commands):
    """What ./quickstart does not install, and the page has not told to install before it is used."""
    installed = re.search(r'^packages=\((.*?)\)', open(os.path.join(ROOT, 'quickstart'), encoding='utf-8').read(), re.M | re.S)[1].split() + ['python3']
    uses = [(command.page, command.line, name) for command in commands for name in PACKAGES
            if command.text.startswith(name + ' ') or name[0] == '-' and name in command.text]
    for page in {command.page for command in commands}:
        text = open(os.path.join(ROOT, page), encoding='utf-8').read()
        for block in re.finditer(r'^```python\n(.*?)^```', text, re.M | re.S):
            names = re.findall(r'^\s*(?:import|from) (\w+)', block[1], re.M) + ['pandas'] * bool(re.search(r'\.(frame|table)\(\)', block[1]))
            uses += [(page, text[:block.start()].count('\n') + 1, name) for name in names if name not in sys.stdlib_module_names]
    for page, line, name in uses:
        before = ''.join(open(os.path.join(ROOT, page), encoding='utf-8').readlines()[:line])
        if PACKAGES[name] not in installed and not re.search(r'apt install[^`\n]*\b' + PACKAGES[name], before.replace('`apt\ninstall', '`apt install')):
            yield '%s:%d: %s is used, and nothing above says: apt install %s' % (page, line, name, PACKAGES[name])


def check(build):
    commands, (entries, _, errors) = all_commands(), table()
    pages = {command.text for command in commands}
    errors += lacking_packages(commands)
    for command in commands:
        if command.text not in entries:
            errors.append('%s:%d: this command is not in %s: %s' % (command.page, command.line, TABLE, command.text))
        elif entries[command.text].kind in ('by', 'none'):
            errors += ['%s:%d: %s: %s' % (command.page, command.line, what, command.text) for what in unknown_names(command.text)]
    tests = tests_of(build) if build else None
    workflows = ''.join(open(name, encoding='utf-8').read() for name in glob.glob('.github/workflows/*.yml'))
    for entry in entries.values():
        if entry.text not in pages:
            errors.append('%s:%d: no page has this command any more: %s' % (TABLE, entry.line, entry.text))
        if entry.kind == 'by' and entry.words == ['ci']:
            if 'run: ' + entry.text + '\n' not in workflows + '\n':
                errors.append('%s:%d: .github/workflows does not run %s' % (TABLE, entry.line, entry.text))
        elif entry.kind == 'by' and tests is not None:
            errors += ['%s:%d: there is no test %s' % (TABLE, entry.line, test) for test in entry.words if test not in tests and test.split('/')[0] not in tests]
    if errors:
        print('\n'.join(errors))
        print('Each command of the pages has one line in %s, which says at its top how it is run.' % TABLE)
        return 1
    kinds = collections.Counter(entry.kind for entry in entries.values())
    print('%d commands in %d pages: ' % (len(entries), len({command.page for command in commands})) +
          ', '.join('%s %d' % pair for pair in sorted(kinds.items())))
    return 0


def make_scratch(build, scratch):
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(os.path.join(scratch, 'build'))
    for name in os.listdir(ROOT):
        if name in ('doc', 'prm', 'tests'):
            shutil.copytree(os.path.join(ROOT, name), os.path.join(scratch, name))  # pictures and numbers are written there
        elif name not in ('build', 'output', '.git'):
            os.symlink(os.path.join(ROOT, name), os.path.join(scratch, name))
    os.symlink(build, os.path.join(scratch, 'build/release'))
    os.mkdir(os.path.join(scratch, 'output'))


def run(kinds, build, scratch):
    if check(build):
        return 1
    commands, (entries, before, errors) = all_commands(), table()
    if errors:
        print('\n'.join(errors))
        return 1
    make_scratch(build, scratch)
    environment = {name: value for name, value in os.environ.items() if not name.startswith('DEBOND')}
    environment.update(PATH=build + os.pathsep + environment['PATH'], OMPI_MCA_rmaps_base_oversubscribe='1',
                       PRTE_MCA_rmaps_default_mapping_policy=':oversubscribe', OMPI_ALLOW_RUN_AS_ROOT='1', OMPI_ALLOW_RUN_AS_ROOT_CONFIRM='1')
    done, failed, lacking, begin = set(), 0, set(), time.time()
    for command in commands:
        entry = entries.get(command.text)
        if entry is None or entry.kind not in kinds or command.text in done:
            continue
        done.add(command.text)
        text, expected, needs = command.text, 0, []
        for word in entry.words:
            name, _, value = word.partition('=')
            if name == 'exit':
                expected = int(value)
            elif name == 'needs':
                needs = value.split(',')
            else:
                text = re.sub(r'(?<![\w.])%s(?![\w])' % re.escape(name), value, text)
        needs = [program for program in needs + [text.split()[0]] if '/' not in program and program not in ('cd', 'export') and not shutil.which(program, path=environment['PATH'])]
        needs = [program for program in needs if '=' not in program]
        if needs:
            print('%s:%d: not run, there is no %s: %s' % (command.page, command.line, needs[0], text), flush=True)
            lacking.update(needs)
            continue
        for first in before.pop(command.page, []):
            subprocess.run(['bash', '-ec', first], cwd=scratch, env=environment, check=True,
                           stdout=subprocess.DEVNULL)
        start = time.time()
        answer = subprocess.run(['bash', '-o', 'pipefail', '-ec', text], cwd=scratch, env=environment, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        print('%6.1f s  %s:%d: %s' % (time.time() - start, command.page, command.line, text), flush=True)
        if answer.returncode != expected:
            failed += 1
            print('exit code %d, not %d; its last lines:' % (answer.returncode, expected))
            print('\n'.join('    ' + line for line in answer.stdout.decode(errors='replace').splitlines()[-30:]), flush=True)
    print('%d commands in %.0f s, %d failed' % (len(done), time.time() - begin, failed))
    return 1 if failed else 77 if lacking else 0


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument('--list', action='store_true')
parser.add_argument('--check', nargs='?', const='', metavar='BUILD')
parser.add_argument('--run', nargs=2, metavar=('BUILD', 'SCRATCH'))
parser.add_argument('--nightly', nargs=2, metavar=('BUILD', 'SCRATCH'))
options = parser.parse_args()
if options.list:
    for command in all_commands():
        print('%s:%d: %s' % command)
elif options.check is not None:
    sys.exit(check(options.check))
elif options.run or options.nightly:
    build, scratch = map(os.path.abspath, options.run or options.nightly)
    sys.exit(run(('run', 'nightly') if options.nightly else ('run',), build, scratch))
else:
    parser.error('--list, --check, --run or --nightly')
