"""Tables of numbers in text files, parsed at the speed of NumPy."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import NDArray


def parse_numbers(text: str, *, what: str) -> NDArray[np.float64]:
    """The numbers in a text, (k,); ValueError names the first word that is not a number."""
    with warnings.catch_warnings():
        # NumPy before 2.3 warns and returns what it has read so far; later versions raise
        warnings.simplefilter("error", DeprecationWarning)
        try:
            return np.fromstring(text, dtype=np.float64, sep=" ")
        except (DeprecationWarning, ValueError):
            raise ValueError(f"{what}: {_first_non_number(text)!r} is not a number") from None


def take_table(
    numbers: NDArray[np.float64], *, start: int, rows: int, columns: int, what: str
) -> NDArray[np.float64]:
    """The rows x columns numbers from `start`; ValueError if there are fewer."""
    table = numbers[start : start + rows * columns]
    if table.size < rows * columns:
        raise ValueError(
            f"{rows} {what} are announced, but the file holds {table.size // columns}: "
            "it is incomplete"
        )
    return table.reshape(rows, columns)


def as_integers(table: NDArray[np.float64], *, what: str) -> NDArray[np.int64]:
    """Convert numbers that must be whole; ValueError names the first that is not."""
    with np.errstate(invalid="ignore"):
        whole = (table == np.floor(table)) & (np.abs(table) < 2.0**53)
    if not whole.all():
        raise ValueError(f"{what}: {table[~whole].ravel()[0]:g} is not a whole number")
    return table.astype(np.int64)


def _first_non_number(text: str) -> str:
    for word in text.split():
        try:
            float(word)
        except ValueError:
            return word[:40]
    return text.strip()[:40]
