"""Checks of arguments: one clear line for every invalid argument."""

from __future__ import annotations

import math
import operator
import os
import sys
from collections.abc import Callable
from numbers import Integral, Real
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def require_count(who: str, name: str, value: int, *, at_least: int | None = None) -> int:
    """Return `value` as an int, or raise a ValueError that names `who` and `name`."""
    try:
        count = operator.index(value)
    except TypeError:
        raise ValueError(f"{who}: {name} is {shown(value)}, but must be a whole number") from None
    if at_least is not None and count < at_least:
        raise ValueError(f"{who}: {name} is {count}, but must be at least {at_least}")
    if count > sys.maxsize:
        raise ValueError(f"{who}: {name} is {shown(count)}, but must be at most {sys.maxsize}")
    return count


def require_finite(who: str, name: str, value: float) -> float:
    """Return `value` as a float, or raise a ValueError that names `who` and `name`."""
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{who}: {name} is {shown(value)}, but must be a number") from None
    if not math.isfinite(number):
        raise ValueError(f"{who}: {name} is {number}, but must be finite")
    return number


def require_positive(who: str, name: str, value: float) -> float:
    """Return `value` as a float, or raise a ValueError that names `who` and `name`."""
    number = require_finite(who, name, value)
    if number <= 0.0:
        raise ValueError(f"{who}: {name} is {number}, but must be positive")
    return number


def require_type(who: str, name: str, value: object, kinds: Any, cure: str) -> None:
    """ValueError that names `who`, `name`, the type and the cure, for a value of other types."""
    if not isinstance(value, kinds):
        raise wrong_type(who, name, value, cure)


def require_function(who: str, name: str, value: object) -> None:
    """Raises a ValueError in the name of `who` unless the argument is a function or None."""
    require_type(who, name, value, Callable | None, "give a function, or None")


def as_numbers(who: str, name: str, values: ArrayLike) -> FloatArray:
    """An array of float64, not copied if it is one already; ValueError for anything but numbers."""
    try:
        array = np.asarray(values)
        if array.dtype.kind in "cmM":  # NumPy would drop imaginary parts, and count days
            raise ValueError
        return np.asarray(array, np.float64)
    except (TypeError, ValueError, OverflowError):
        kind = type(values).__name__
        raise ValueError(
            f"{who}: {name} must be numbers, in rows of one length, but are of type {kind}"
        ) from None


def as_arrays(who: str, name: str, values: ArrayLike, *shape: int) -> FloatArray:
    """One array of a shape, or several, (..., *shape), as float64; ValueError for other shapes."""
    array = as_numbers(who, name, values)
    if array.shape[-len(shape) :] != shape:
        needed = ", ".join(map(str, shape))
        raise ValueError(f"{who}: {name} have shape {array.shape}, but must be (..., {needed})")
    return array


def as_rows(who: str, name: str, values: ArrayLike) -> FloatArray:
    """Rows (k, p) as float64; ValueError for another number of axes, such as a single row."""
    rows = as_numbers(who, name, values)
    if rows.ndim != 2:
        cure = f"; a single one is {name}[None]" if rows.ndim == 1 else ""
        raise ValueError(
            f"{who}: {name} have shape {rows.shape}, but must be (k, p), one sample per row{cure}"
        )
    return rows


def as_coordinates(who: str, q: ArrayLike, dimension: int) -> FloatArray:
    """Reduced coordinates (d,) as float64; ValueError for another number of them."""
    values = as_numbers(who, "q", q)
    if values.shape != (dimension,):
        raise ValueError(
            f"{who}: q must have one entry per dimension, ({dimension},), but has the shape "
            f"{values.shape}"
        )
    return values


def require_dimension(
    who: str,
    dimension: int,
    largest: int,
    *,
    cure: str = "give a number up to that of the model",
) -> None:
    """ValueError unless the dimension is a whole number from 1 to the largest.

    cure : what to do about a number out of range
    """
    if not is_whole(dimension):
        raise wrong_type(who, "dimension", dimension, "give a whole number")
    if not 1 <= dimension <= largest:
        raise ValueError(f"{who}: dimension {dimension} is not between 1 and {largest}; {cure}")


def shown(value: object) -> str:
    """The value in one short line, an array by its shape."""
    if isinstance(value, np.ndarray):
        return f"an array of shape {value.shape}"
    text = " ".join(repr(value).split())
    return text if len(text) <= 200 else f"{text[:200]}..."


def is_number(value: object) -> bool:
    """Whether the value is a real number, of Python or of NumPy."""
    return isinstance(value, Real)


def is_finite(value: object) -> bool:
    """Whether the value is a real number, of Python or of NumPy, that is finite as a float."""
    try:
        return isinstance(value, Real) and math.isfinite(value)
    except OverflowError:  # a whole number beyond 1e308
        return False


def is_whole(value: object) -> bool:
    """Whether the value is a whole number, of Python or of NumPy."""
    return isinstance(value, Integral)


def check_target(target_error: float) -> None:
    """Raises ValueError unless a target error is a number between 0 and 1."""
    if not (is_number(target_error) and 0 < target_error < 1):
        raise ValueError(
            f"the target error is {shown(target_error)}, but it must be between 0 and 1: it is "
            "relative to the displacement"
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
