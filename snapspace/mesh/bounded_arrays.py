"""Arrays of bounded size for meshio, whose readers allocate any size that a file names.

A Gmsh file of a few bytes with the node number 2^31 would take 16 GB, and a VTK file with huge
dimensions would exhaust any memory.
"""

from __future__ import annotations

from types import ModuleType
from typing import Any

import numpy as np

#: Largest number of entries of an array. A mesh with more vertices is far too large to be solved.
MOST_ENTRIES = 1 << 26


class BoundedArrays:
    """NumPy, except that functions that allocate a given size raise ValueError for huge ones."""

    def __getattr__(self, name: str) -> Any:
        return getattr(np, name)

    def full(self, shape: Any, *args: Any, **options: Any) -> Any:
        return np.full(_checked(shape), *args, **options)

    def ones(self, shape: Any, *args: Any, **options: Any) -> Any:
        return np.ones(_checked(shape), *args, **options)

    def empty(self, shape: Any, *args: Any, **options: Any) -> Any:
        return np.empty(_checked(shape), *args, **options)

    def arange(self, *ends: Any, **options: Any) -> Any:
        _checked(int(ends[0] if len(ends) == 1 else ends[1] - ends[0]))
        return np.arange(*ends, **options)


def bound_arrays(*modules: ModuleType) -> None:
    """Makes modules of meshio use these functions instead of NumPy's."""
    for module in modules:
        module.np = BoundedArrays()  # type: ignore[attr-defined]


def _checked(shape: Any) -> Any:
    entries = 1.0
    for count in np.atleast_1d(shape).tolist():
        entries *= count
    if entries > MOST_ENTRIES:
        raise ValueError(f"an array of {entries:.3g} entries is too large: renumber its vertices")
    return shape
