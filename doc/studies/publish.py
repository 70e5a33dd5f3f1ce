#!/usr/bin/env python3
"""Puts tables in Markdown, apart by blank lines, from the standard input into doc/evidence.
    doc/studies/publish.py PAGE MARK NAME...

Each goes to doc/evidence/tables/MARK_NAME.csv (MARK.csv if NAME is all). Those whose NAME ends with + stand in PAGE as well, between
<!-- numbers: MARK --> and <!-- end -->; with NAME:1,3 only rows 1 and 3 of it, from 0 on, and a link.
"""
import importlib.util
import os
import re
import sys

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..')
SPEC = importlib.util.spec_from_file_location('page_numbers', os.path.join(TOP, 'doc', 'numbers.py'))
PAGES = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(PAGES)  # goes to the top of the project


def main(page, mark, *names):
    in_page = []
    for name, text in zip(names, re.split(r'\n\s*\n', sys.stdin.read().strip())):
        name, _, chosen = name.partition(':')
        head, rows = PAGES.rows_of_markdown(text)
        file = mark if name == 'all' else mark + '_' + name.rstrip('+')
        with open(PAGES.TABLES + file + '.csv', 'w', encoding='utf-8') as lines:
            lines.write(PAGES.csv_of(head, rows))
        if chosen:
            in_page.append(PAGES.table(head, [rows[int(i)] for i in chosen.split(',')]) + PAGES.link(file, rows))
        elif name.endswith('+'):
            in_page.append(PAGES.table(head, rows))
    old = PAGES.text_of(page)
    new = re.sub(r'(<!-- numbers: %s -->).*?(<!-- end -->)' % mark, lambda match: match[1] + ''.join(in_page) + match[2], old, flags=re.S)
    with open(page, 'w', encoding='utf-8') as lines:
        lines.write(new)


if __name__ == '__main__':
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
