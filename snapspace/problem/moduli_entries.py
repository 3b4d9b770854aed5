"""Moduli in files: by name, or by Young's modulus and Poisson's ratio."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..material import Material

FloatArray = NDArray[np.float64]
Value = float | FloatArray

_YOUNG, _POISSON = "young", "poisson"
#: Entries that can define every material, instead of its moduli.
NAMES = (_YOUNG, _POISSON)


def moduli_of(
    entries: dict[str, Any], kind: type[Material], *, of_each: Callable[[Any, str], Value]
) -> dict[str, Value]:
    """Moduli by name.

    Parameters
    ----------
    entries : moduli of the class by name, or both "young" and "poisson"
    kind : class of the material
    of_each : callable(value, name)
        Checks and converts a value.

    Raises
    ------
    ValueError
        For a mixture of both forms, one of "young" and "poisson" alone, or values out of range.
    """
    values = {key: of_each(entry, key) for key, entry in entries.items()}
    given = values.keys() & set(NAMES)
    if not given:
        return values
    others = values.keys() - given
    if others:
        raise ValueError(
            f"'{min(others)}' and '{min(given)}' say the same thing in two ways; give "
            f"{' and '.join(kind.names())}, or {_YOUNG} and {_POISSON}"
        )
    if len(given) < 2:
        (missing,) = set(NAMES) - given
        raise ValueError(f"'{min(given)}' also needs the entry '{missing}'")
    made = kind.from_young(youngs_modulus=values[_YOUNG], poisson_ratio=values[_POISSON])
    return {name: getattr(made, name) for name in kind.names()}
