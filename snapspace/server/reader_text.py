"""Error messages for readers who see a page instead of a program."""

from __future__ import annotations

import logging
import re

from .messages import Failed

#: A function or class of the library, at the beginning or after a file name.
_WHO = re.compile(r"(^|: )(?:[a-z]+(?:_[a-z]+)+|(?:[A-Z][a-z]+){2,}): ")


def for_reader(message: str) -> str:
    """The message without the name of the function or class that raised it.

    "bunny.obj: fill_surface: the surface is not closed" becomes "bunny.obj: the surface is not
    closed".
    """
    return _WHO.sub(r"\1", message)


def failure(request: int, error: Exception) -> Failed:
    """The message that a request failed, in one line; bugs are logged."""
    if not isinstance(error, MemoryError | ValueError):
        logging.getLogger(__name__).error("request %d failed", request, exc_info=error)
    return Failed(request=request, message=_text_of(error).replace("\n", " "))


def _text_of(error: Exception) -> str:
    if isinstance(error, MemoryError):
        return "this machine is out of memory; use fewer samples or a coarser mesh"
    if isinstance(error, ValueError):
        return for_reader(str(error))
    return f"the server has a bug ({type(error).__name__}: {error}); its output has the details"
