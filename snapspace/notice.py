"""Notices: warnings that inform the user but do not indicate a mistake in the program."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

#: The notices of the innermost `collected_notices` of this thread.
_collected: ContextVar[list[str] | None] = ContextVar("_collected", default=None)


class Notice(UserWarning):
    """Base of all notices; the command line shows each as one line."""


def notify(text: str, kind: type[Notice], *, stacklevel: int = 1) -> None:
    """Warns with a notice, and adds it to those that the caller collects.

    text : what the user should know
    stacklevel : as for `warnings.warn`, seen from the caller
    """
    collected = _collected.get()
    if collected is not None:
        collected.append(text)
    warnings.warn(text, kind, stacklevel=stacklevel + 1)


@contextmanager
def collected_notices() -> Iterator[list[str]]:
    """The notices of this thread, in order, as they appear; they are still shown as warnings.

    `warnings.catch_warnings` would catch those of other threads as well.
    """
    collected: list[str] = []
    token = _collected.set(collected)
    try:
        yield collected
    finally:
        _collected.reset(token)
