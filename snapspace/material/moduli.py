"""Moduli of materials: checks, and conversion from Young's modulus and Poisson's ratio."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_numbers

FloatArray = NDArray[np.float64]


def checked_modulus(value: ArrayLike, who: str, name: str) -> float | FloatArray:
    """The modulus as a float, or as a read-only array (m,).

    Raises
    ------
    ValueError
        For another shape, a value that is negative or not finite, or a `mu` of zero.
    """
    array = _numbers(value, who, name)
    wrong = ~(np.isfinite(array) & (array >= 0))
    needed = "zero or positive"
    if name == "mu":
        wrong |= array == 0
        needed = "positive: it is the shear modulus"
    if wrong.any():
        where, first = _first(array, wrong)
        raise ValueError(f"{who}: {name}{where} is {first}, but it must be {needed}")
    if array.ndim == 0:
        return float(array)
    kept = array.copy()
    kept.flags.writeable = False
    return kept


def lame_of_young(
    youngs_modulus: ArrayLike, poisson_ratio: ArrayLike, who: str
) -> tuple[FloatArray, FloatArray]:
    """lam and mu from Young's modulus > 0 and Poisson's ratio in [0, 0.5); ValueError otherwise."""
    young = _numbers(youngs_modulus, who, "youngs_modulus")
    poisson = _numbers(poisson_ratio, who, "poisson_ratio")
    wrong = ~(np.isfinite(young) & (young > 0))
    if wrong.any():
        where, first = _first(young, wrong)
        raise ValueError(f"{who}: youngs_modulus{where} is {first}, but it must be positive")
    wrong = ~((poisson >= 0) & (poisson < 0.5))
    if wrong.any():
        where, first = _first(poisson, wrong)
        raise ValueError(
            f"{who}: poisson_ratio{where} is {first}, but it must be in [0, 0.5); use 0.49 for "
            "a material that keeps its volume"
        )
    mu = young / (2 * (1 + poisson))
    return young * poisson / ((1 + poisson) * (1 - 2 * poisson)), mu


def _numbers(value: ArrayLike, who: str, name: str) -> FloatArray:
    try:
        array = as_numbers(who, name, value)
    except ValueError:
        raise ValueError(f"{who}: {name} must be a number, or one per tet, got {value!r}") from None
    if array.ndim > 1 or array.size == 0:
        raise ValueError(
            f"{who}: {name} has shape {array.shape}, but it must be a number, or one per tet"
        )
    return array


def _first(array: FloatArray, wrong: NDArray[np.bool_]) -> tuple[str, float]:
    """The text for the place of the first wrong entry, and the entry."""
    if array.ndim == 0:
        return "", float(array)
    place = int(np.flatnonzero(wrong)[0])
    return f" of tet {place}", float(array[place])
