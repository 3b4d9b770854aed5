"""Error messages for readers who see a page and no program."""

from __future__ import annotations

import re

#: A function or class of the library, at the beginning or after a file name.
_WHO = re.compile(r"(^|: )(?:[a-z]+(?:_[a-z]+)+|(?:[A-Z][a-z]+){2,}): ")


def for_reader(message: str) -> str:
    """The message without the name of the function or class that raised it.

    "bunny.obj: fill_surface: the surface is not closed" becomes "bunny.obj: the surface is not
    closed".
    """
    return _WHO.sub(r"\1", message)


def text_of(error: Exception) -> str:
    """The text of an error for the page."""
    if isinstance(error, MemoryError):
        return "the memory of this machine is used up; use fewer samples or a coarser mesh"
    if isinstance(error, ValueError):
        return for_reader(str(error))
    return f"the server has a fault ({type(error).__name__}: {error}); its output has the details"
