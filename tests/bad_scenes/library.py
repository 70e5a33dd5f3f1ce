"""Reads scenes for run.sh in one process, as the program would: it takes half a second to start.

    library.py DIRECTORY

Each question from the pipe DIRECTORY/question is a directory and the words behind `debond`, with a NUL behind each, or nothing: no
more will come. The answer, to DIRECTORY/answer, is the exit code of a scene that is refused when it is read, with the message in
DIRECTORY/message; or `none`: the program has to say it. Each scene is read by a process of its own, in which none has been read
before.
"""

import contextlib
import io
import os
import sys

import _debond
import debond
from debond.__main__ import main

with contextlib.suppress(ImportError):
    import debond.calibrate  # noqa: F401: now, and not in every process


def message_of(scene, *words):
    """Exit code and what is said, or None: it is no plain scene, or it is not refused."""
    if scene.startswith("-") or any(word != "--set" for word in words[::2]) or len(words) % 2:
        return None
    try:
        entries = _debond.changed(_debond.read_file(scene), list(words[1::2]), "--set")
        if any(entry.name == "Task" and entry.value == "calibrate" for entry in entries):
            said = io.StringIO()
            with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
                code = main(["calibrate", scene, *(f"--set={word}" for word in words[1::2])])
            return code, said.getvalue()
        if not any("{{" in entry.value for entry in entries):
            _debond.Scene(entries, scene, _debond.Team(0))
    except debond.SceneError as error:
        return 1, f"{error}\n"
    return None


def answer(directory, words):
    here, *words = (word.decode() for word in words)
    os.chdir(here)
    code, said = message_of(*words) or ("none", "")
    with open(os.path.join(directory, "message"), "w", encoding="utf-8") as file:
        file.write(said)
    with open(os.path.join(directory, "code"), "w", encoding="utf-8") as file:
        file.write(f"{code}\n")


def serve(directory):
    while True:
        with open(os.path.join(directory, "question"), "rb") as file:
            words = file.read().split(b"\0")[:-1]
        if not words:
            return
        child = os.fork()
        if child == 0:
            try:
                answer(directory, words)
            except BaseException:  # bytes that are no text, say
                os._exit(1)
            os._exit(0)
        is_answered = os.waitpid(child, 0)[1] == 0
        with open(os.path.join(directory, "answer"), "w", encoding="utf-8") as file:
            file.write(open(os.path.join(directory, "code"), encoding="utf-8").read() if is_answered else "none\n")


serve(os.path.abspath(sys.argv[1]))
