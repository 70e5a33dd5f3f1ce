"""Files of results, which other programs may read at any time."""

import os

from .errors import RunError


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
        if os.path.exists(part):
            os.remove(part)
        raise RunError(f"cannot write {path}: {error.strerror}") from None
