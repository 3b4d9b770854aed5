"""Read-only arrays."""

from __future__ import annotations

from typing import TypeVar

from .arrays import FloatArray, IndexArray

_Array = TypeVar("_Array", FloatArray, IndexArray)


def frozen(array: _Array) -> _Array:
    """The array itself, now read-only."""
    array.setflags(write=False)
    return array
