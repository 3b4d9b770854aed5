"""InputError: an error in the input."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

#: Longest message, in characters; names in a file may have any length.
_LONGEST = 800


def one_line(text: str) -> str:
    """The text with control characters escaped, and without the middle if it is long.

    A file may contain any name.
    """
    if len(text) > _LONGEST:
        text = f"{text[: _LONGEST - 300]} ... {text[-290:]}"
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


class InputError(ValueError):
    """A ValueError with its place, which callers can replace by a better one.

    place : the function, file or entry that reports it
    fault : what was given, what was needed, and the cure
    """

    def __init__(self, place: str | Path, fault: str) -> None:
        fault = one_line(fault)
        super().__init__(f"{place}: {fault}")
        self.place = str(place)
        self.fault = fault

    def __reduce__(self) -> tuple[type[InputError], tuple[str, str]]:
        return type(self), (self.place, self.fault)


def fault_of(error: Exception) -> str:
    """The fault, without the place that the error itself names."""
    return error.fault if isinstance(error, InputError) else str(error)


@contextmanager
def located(place: str | Path) -> Iterator[None]:
    """Errors in this block name the given place, such as a file, instead of a function.

    Raises
    ------
    InputError
        For a ValueError or an OSError in the block.
    """
    try:
        yield
    except (ValueError, OSError) as error:
        raise InputError(place, fault_of(error)) from None
