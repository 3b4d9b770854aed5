"""Rows that begin with their own number, below a header that counts them.

VegaFEM and TetGen files are made of these.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .number_text import as_integers, parse_numbers, take_table


def parse_labelled_rows(lines: list[str], *, columns: int, what: str) -> NDArray[np.float64]:
    """Parse a header line `count ...` and the rows below it, numbers separated by blanks or commas.

    Parameters
    ----------
    lines : list of str
        Without comments and blank lines.
    columns : int
        Number of columns to read, including the label; further ones (attributes, markers) are left
        out.
    what : str
        What the rows are, for messages.

    Returns
    -------
    ndarray, (count, columns)

    Raises
    ------
    ValueError
        If rows are missing, too many, too short or of different lengths, or hold other text.
    """
    if not lines:
        raise ValueError(f"the number of {what} is missing: it is incomplete")
    header = as_integers(parse_numbers(lines[0].replace(",", " "), what=what)[:1], what=what)
    count, rows = int(header[0]) if header.size else -1, lines[1:]
    if count != len(rows):
        raise ValueError(f"{count} {what} are announced, but the file holds {len(rows)}")
    if not rows:
        return np.empty((0, columns))
    width = len(rows[0].replace(",", " ").split())
    if width < columns:
        raise ValueError(f"{what} have {width} numbers in a row; {columns} are needed")
    numbers = parse_numbers("\n".join(rows).replace(",", " "), what=what)
    if numbers.size != count * width:
        raise ValueError(f"its {what} do not all have {width} numbers in a row")
    return take_table(numbers, start=0, rows=count, columns=width, what=what)[:, :columns]


def first_label(rows: NDArray[np.float64], *, what: str) -> int:
    """The first label, 0 or 1; ValueError unless the labels in the first column count up by 1."""
    labels = as_integers(rows[:, 0], what=what)
    first = int(labels[0]) if labels.size else 0
    if first not in (0, 1) or not np.array_equal(labels, first + np.arange(len(labels))):
        raise ValueError(f"its {what} are not numbered consecutively from 0 or 1")
    return first
