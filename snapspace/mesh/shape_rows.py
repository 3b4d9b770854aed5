"""shape_rows, shape_or_rows, as_shape: checked shapes, and blocks of one per row."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_numbers

FloatArray = NDArray[np.float64]


def shape_rows(shapes: ArrayLike, size: int, *, who: str, what: str = "shapes") -> FloatArray:
    """Shapes or displacements (k, 3n) as float64, one per row; not copied if they are so already.

    Parameters
    ----------
    shapes : array_like, (k, 3n)
    size : int
        3n.
    who, what : str
        Function and argument, for the error.

    Raises
    ------
    ValueError
        For an array of another shape. The error says how to convert (3n, k), (k, n, 3) and (3n,).
    """
    x = as_numbers(who, what, shapes)
    if x.ndim != 2 or x.shape[1] != size:
        raise ValueError(_message(x.shape, size, f"(k, {size}), one shape per row", who, what))
    return x


def shape_or_rows(shapes: ArrayLike, size: int, *, who: str, what: str = "shapes") -> FloatArray:
    """The same for one shape (3n,), which stays a vector, or for several, (k, 3n)."""
    x = as_numbers(who, what, shapes)
    if x.ndim not in (1, 2) or x.shape[-1] != size:
        needed = f"({size},) or (k, {size}), one shape per row"
        raise ValueError(_message(x.shape, size, needed, who, what))
    return x


def as_shape(x: ArrayLike, size: int, *, who: str, what: str = "the shape") -> FloatArray:
    """A shape as (3n,) float64, from (3n,) or (n, 3); ValueError for another shape."""
    positions = as_numbers(who, what, x)
    if positions.size != size:
        raise ValueError(
            f"{who}: {what} has {positions.size} coordinates, but the mesh has {size // 3} "
            f"vertices, which need {size}"
        )
    if positions.shape not in ((size,), (size // 3, 3)):
        raise ValueError(
            f"{who}: {what} has shape {positions.shape}, but must be ({size // 3}, 3), one row per "
            f"vertex, or ({size},)"
        )
    return positions.reshape(-1)


def _message(got: tuple[int, ...], size: int, needed: str, who: str, what: str) -> str:
    return (
        f"{who}: {what} has shape {got}, but a mesh of {size // 3} vertices needs {needed}; "
        f"{_cure(got, size, what)}"
    )


def _cure(got: tuple[int, ...], size: int, what: str) -> str:
    if len(got) == 2 and got[0] == size:
        return f"transpose it: {what}.T"
    if got == (size,):
        return f"a single shape is {what}[None]"
    if got == (size // 3, 3):
        return f"flatten the vertices: {what}.reshape(1, -1)"
    if len(got) == 3 and got[1:] == (size // 3, 3):
        return f"flatten the vertices: {what}.reshape({got[0]}, -1)"
    return "use shapes of this mesh, x0 y0 z0 x1 ..."
