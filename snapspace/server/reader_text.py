"""Messages of errors, for readers who see a page and no program."""

from __future__ import annotations

import re

#: A function or class of the library, at the beginning or behind the name of a file.
_WHO = re.compile(r"(^|: )(?:[a-z]+(?:_[a-z]+)+|(?:[A-Z][a-z]+){2,}): ")


def for_reader(message: str) -> str:
    """The message without the function or class that refused: no page shows its name.

    "bunny.obj: fill_surface: the surface is not closed" becomes "bunny.obj: the surface is not
    closed".
    """
    return _WHO.sub(r"\1", message)


def text_of(error: Exception) -> str:
    """What the page says of an error."""
    if isinstance(error, MemoryError):
        return "the memory of this machine is used up; take fewer samples or a coarser mesh"
    if isinstance(error, ValueError):
        return for_reader(str(error))
    return f"the server has a fault ({type(error).__name__}: {error}); its output tells more"
