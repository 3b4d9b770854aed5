"""counted: a number with its noun, for messages."""

from __future__ import annotations


def counted(count: int, one: str, several: str | None = None) -> str:
    """The number and the noun: 1 hole, 3 holes. `several` is the plural, by default with an s."""
    return f"{count} {one if count == 1 else several or one + 's'}"
