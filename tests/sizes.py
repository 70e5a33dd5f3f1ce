#!/usr/bin/env python3
"""Prints how large the program is, and fails where a file or a function is too long to read.

Usage: sizes.py ROOT

Code lines are those that hold more than comments and white space, statements are semicolons outside of strings and
comments, both after .clang-format. A comment line holds nothing but a comment.
"""
import pathlib
import re
import sys

FILE, FUNCTION, COMMENTS = 450, 60, 0.30  # longest file and function [code lines], comment lines per code line
TOKEN = re.compile(r'R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*(?:.|\n)*?\*/')


def without(text, comments_only):
    """text with comments, and strings unless comments_only, blanked; lines stay."""
    def blank(match):
        word = match.group(0)
        if word[0] != "/" and comments_only:
            return word
        return ("" if word[0] == "/" else '""') + "\n" * word.count("\n")
    return TOKEN.sub(blank, text)


def code_lines(text):
    return sum(bool(line.strip()) for line in text.split("\n"))


def longest_function(bare):
    """Lines of the longest body, the names of namespaces and types left out."""
    longest, lines = 0, bare.split("\n")
    opened = []  # (line, whether it is a function, what stands before it)
    head = ""
    for number, line in enumerate(lines):
        for letter in line:
            if letter == "{":
                inside = any(is_function for _, is_function, _ in opened)
                is_function = (not inside and ")" in head
                               and not re.search(r"\b(namespace|class|struct|enum|union)\b[^()]*$", head))
                opened.append((number, is_function, head))
                head = ""
            elif letter == "}":
                begin, is_function, head = opened.pop()
                if is_function:
                    longest = max(longest, code_lines("\n".join(lines[begin + 1:number])))
                if is_function or not re.search(r"\)[^()]*:[^:]", head):  # else a member is initialised in braces
                    head = ""
            elif letter == ";":
                head = ""
            else:
                head += letter
        head += " "
    return longest


def main():
    root = pathlib.Path(sys.argv[1])
    faults = []

    def measure(title, folders, kinds=(".cc", ".h")):
        code = statements = comments = types = 0
        for path in sorted(path for folder in folders for path in (root / folder).rglob("*") if path.suffix in kinds):
            text = path.read_text()
            bare = without(text, False)
            lines = code_lines(without(text, True))
            code += lines
            comments += code_lines(text) - lines
            statements += bare.count(";")
            types += len(re.findall(r"^\s*(?:template <[^;{]*>\s*)?(?:class|struct)\b[^;()]*\{", bare, re.M))
            if title.startswith("program") and lines > FILE:
                faults.append(f"{path}: {lines} code lines, at most {FILE}")
            if title.startswith("program") and (longest := longest_function(bare)) > FUNCTION:
                faults.append(f"{path}: a function of {longest} code lines, at most {FUNCTION}")
        print(f"{title}: {code} code lines, {statements} statements, {types} classes and structs, "
              f"{comments / code:.3f} comment lines per code line")
        return comments / code

    measure("program, source and include", ("source", "include"))
    measure("tests, .cc only", ("tests",), (".cc",))
    for room in ("interface", "system"):
        if measure(room, (f"source/{room}", f"include/debond/{room}")) < COMMENTS:
            faults.append(f"{room}: less than {COMMENTS} comment lines per code line")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


sys.exit(main())
