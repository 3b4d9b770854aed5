"""Checks of arguments: one clear line for every invalid argument."""

from __future__ import annotations

import math
import operator
import os
from numbers import Integral, Real
from pathlib import Path


def require_count(who: str, name: str, value: int, *, at_least: int) -> int:
    """Return `value` as an int, or raise a ValueError that names `who` and `name`."""
    try:
        count = operator.index(value)
    except TypeError:
        raise ValueError(f"{who}: {name} is {value!r}, but must be a whole number") from None
    if count < at_least:
        raise ValueError(f"{who}: {name} is {count}, but must be at least {at_least}")
    return count


def require_finite(who: str, name: str, value: float) -> float:
    """Return `value` as a float, or raise a ValueError that names `who` and `name`."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{who}: {name} is {value!r}, but must be a number") from None
    if not math.isfinite(number):
        raise ValueError(f"{who}: {name} is {number}, but must be finite")
    return number


def require_positive(who: str, name: str, value: float) -> float:
    """Return `value` as a float, or raise a ValueError that names `who` and `name`."""
    number = require_finite(who, name, value)
    if number <= 0.0:
        raise ValueError(f"{who}: {name} is {number}, but must be positive")
    return number


def is_number(value: object) -> bool:
    """Whether it is a real number, of Python or of NumPy."""
    return isinstance(value, Real)


def is_whole(value: object) -> bool:
    """Whether it is a whole number, of Python or of NumPy."""
    return isinstance(value, Integral)


def check_target(target_error: float) -> None:
    """Raises ValueError unless a target error is a number between 0 and 1."""
    if not (is_number(target_error) and 0 < target_error < 1):
        raise ValueError(
            f"the target error is {target_error!r}, but it must be between 0 and 1: it is relative "
            "to the displacement"
        )


def as_path(who: str, path: str | os.PathLike[str], *, what: str = "file") -> Path:
    """Return `path` as a Path, or raise a ValueError that names `who` and its type."""
    try:
        return Path(path)
    except TypeError:
        raise wrong_type(who, "path", path, f"give the name of a {what}") from None


def wrong_type(who: str, name: str, value: object, cure: str) -> ValueError:
    """The error for an argument of another type; it names `who`, `name`, the type and the cure."""
    return ValueError(f"{who}: {name} is of type {type(value).__name__}; {cure}")
