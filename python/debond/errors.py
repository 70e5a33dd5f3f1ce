"""What debond raises: mistakes of the user, and runs that could not be finished."""


import os


class InputError(ValueError):
    """Anything wrong with what a user gave: a scene, a file, a call. The text is one line; `entry` ("Interface / Sliding
    threshold"), `value` and `place` ("scene.prm:12") say where, as far as they are known."""

    entry = value = place = why = None

    @classmethod
    def of_entry(cls, entry: str, why: str, value=None):
        """The mistake `why` in what `entry` gives, whose text is `value`: ENTRY = 'VALUE': WHY."""
        error = cls(entry + ("" if value is None else f" = '{shortened(value)}'") + ": " + why)
        error.entry, error.value, error.why = entry, value, why
        return error


class SceneError(InputError):
    """A mistake in a scene or in a call."""


def expect(is_so: bool, what: str, value, expected: str) -> None:
    """Of an argument of a call. Raises SceneError."""
    if not is_so:
        raise SceneError(f"{what}: {value!r:.60}: expected {expected}")


def path_of(value, what: str, expected: str = "the name of a file") -> str:
    """The text of a name of a file or directory. Raises SceneError."""
    expect(isinstance(value, (str, os.PathLike)), what, value, expected)
    return os.fspath(value)


class RunError(RuntimeError):
    """A run that could not be finished; the text says where and why. Rows before are kept by Simulation."""


class Interrupted(RuntimeError):
    """A signal has ended what was at work: its number, and a text that says how it goes on."""


def shortened(text: str) -> str:
    """What a user has written as it is shown in messages: the end of a very long text is left out."""
    return text if len(text) <= 300 else text[:300] + "..."
