"""Executes the examples of doc/howto/python.md, in their order and in one namespace, as a reader would. Usage: page.py ROOT,
where `import debond` finds the module."""

import contextlib
import io
import os
import re
import sys
import tempfile
import traceback


def main():
    os.chdir(sys.argv[1])
    with open("doc/howto/python.md", encoding="utf-8") as file:
        page = file.read()
    temporary = tempfile.TemporaryDirectory(prefix="debond-page-")
    tempfile.tempdir = temporary.name  # where the examples write
    names = {"__name__": "page"}
    blocks = list(re.finditer(r"^```python\n(.*?)^```$", page, re.MULTILINE | re.DOTALL))
    for block in blocks:
        line = page.count("\n", 0, block.start(1))
        prose = re.sub(r"^```.*?^```$", "", page[:block.start()], flags=re.MULTILINE | re.DOTALL)
        heading = re.findall(r"^#+ (.*)$", prose, re.MULTILINE)[-1]
        printed = io.StringIO()
        try:
            with contextlib.redirect_stdout(printed):
                # as many empty lines as are above it, so that the traceback has the lines of the page
                exec(compile("\n" * line + block.group(1), "doc/howto/python.md", "exec"), names)
        except Exception:
            traceback.print_exc()
            sys.exit(f"doc/howto/python.md, line {line + 1}, {heading}: the example does not run")
        print(f"{heading}: runs")
        for said in printed.getvalue().splitlines():
            print("   ", said)
        if "print(" in block.group(1) and not printed.getvalue():
            sys.exit(f"{heading}: nothing is printed")
    if len(blocks) < 8:
        sys.exit(f"{len(blocks)} examples: expected 8 or more")


main()
