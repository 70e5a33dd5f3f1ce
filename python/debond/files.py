"""Files of results, which other programs may read at any time, and what is said while they are made."""

import csv
import hashlib
import io
import json
import os
import pathlib
import sys

from .errors import RunError


def say(text, file=None, end="\n") -> None:
    """Prints a text at once. A pipe that nobody reads any more, as of `| head`, or a full disk ends nothing: files count."""
    file = file or sys.stdout
    try:
        print(text, file=file, end=end, flush=True)
    except OSError:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, file.fileno())
        os.close(nowhere)


def heeding(console, say):
    """What says texts to `say`, warnings alone if Expert / Output / Console, whose value is given, is quiet."""
    return say if console != "quiet" else lambda text: say(text) if text.startswith("warning") else None


def write_whole(path, text: str) -> None:
    """Writes a text file whole or not at all, also if several processes write it or the machine stops. Raises RunError."""
    path = os.fspath(path)
    part = f"{path}.{os.getpid()}.part"
    try:
        with open(part, "w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    except OSError as error:
        pathlib.Path(part).unlink(missing_ok=True)
        raise RunError(f"cannot write {path}: {error.strerror}") from None


def write_json(path, content) -> None:
    """The same of what JSON can say."""
    write_whole(path, json.dumps(content, indent=2, ensure_ascii=False) + "\n")


def make_directory(directory) -> None:
    """A directory of results, and those above it. Raises RunError."""
    try:
        os.makedirs(directory, exist_ok=True)
    except OSError as error:
        raise RunError(f"cannot write {directory}: {error.strerror}") from None


def run_in(directory, function, task):
    """What a function makes of a task, in a process that may have been started elsewhere: files are named relative to this
    directory."""
    os.chdir(directory)
    return function(task)


def digest_of(path) -> str:
    """Stands for the content of a file."""
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def csv_text(header, rows, digits: int = 17) -> str:
    """Text of a table as debond has them: numbers with so many digits at most (17 give them back exactly), nan for what is not
    known, true and false. rows: lists, or dictionaries that have all of the header."""

    def text_of(item):
        if isinstance(item, bool):
            return "true" if item else "false"
        return f"{item:.{digits}g}" if isinstance(item, float) and digits < 17 else str(item)

    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows(
        [header, *(map(text_of, [row[name] for name in header] if isinstance(row, dict) else row) for row in rows)])
    return stream.getvalue()
