"""Values from JSON content: each function returns the value, or says what it got instead."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ..input_error import one_line


@contextmanager
def within(place: str | Path) -> Iterator[None]:
    """Puts the place, a file or an entry, before the message of a ValueError."""
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{place}: {one_line(str(error))}") from None


def as_object(value: Any, what: str, *, known: set[str] | None = None) -> dict[str, Any]:
    """`value` if it is an object with only known keys; ValueError otherwise."""
    if not isinstance(value, dict):
        raise ValueError(f"{what} must be an object {{...}}, got {_shown(value)}")
    for key in value:
        if known is not None and key not in known:
            raise ValueError(f"{what}: unknown entry '{key}'; known are {', '.join(sorted(known))}")
    return value


def as_list(value: Any, what: str, *, items: tuple[str, ...] = ()) -> list[Any]:
    """`value` if it is a list, of exactly these items if any are given; ValueError otherwise."""
    if not isinstance(value, list):
        raise ValueError(f"{what} must be a list, got {_shown(value)}")
    if items and len(value) != len(items):
        raise ValueError(f"{what} must be [{', '.join(items)}], got {_shown(value)}")
    return value


def as_text(value: Any, what: str) -> str:
    """`value` if it is a string; ValueError otherwise."""
    if not isinstance(value, str):
        raise ValueError(f"{what} must be a string, got {_shown(value)}")
    return value


def as_number(value: Any, what: str) -> float:
    """`value` if it is a number that fits a float; ValueError otherwise."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{what} must be a number, got {_shown(value)}")
    try:
        return float(value)
    except OverflowError:
        raise ValueError(f"{what} is too large a number, got {_shown(value)}") from None


def as_index(value: Any, what: str, *, below: int) -> int:
    """`value` if it is an integer in [0, below); ValueError otherwise."""
    if isinstance(value, bool) or not isinstance(value, int):
        raise ValueError(f"{what} must be an index, got {_shown(value)}")
    if not 0 <= value < below:
        raise ValueError(f"{what} index is {_shown(value)}, but must be from 0 to {below - 1}")
    return value


def as_three(value: Any, what: str) -> tuple[float, float, float]:
    """`value` if it is a list of three numbers; ValueError otherwise."""
    x, y, z = (as_number(item, what) for item in as_list(value, what, items=("x", "y", "z")))
    return x, y, z


def _shown(value: Any) -> str:
    """The value in at most one short line."""
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
