"""Words of a text file as places in its bytes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

_LINE_FEED, _RETURN, _SPACE = 10, 13, 32


@dataclass(frozen=True, eq=False)
class Words:
    """Where the words of a text start and end, (w,), and the first word of each line, (l,).

    Lines without words are left out.
    """

    starts: NDArray[np.int64]
    ends: NDArray[np.int64]
    first_of_line: NDArray[np.int64]


def words_of(data: bytes, start: int = 0) -> Words:
    """The words of the text that begins at `start`; anything up to a space separates them."""
    raw = np.frombuffer(data, np.uint8)[start:]
    inside = np.concatenate([[False], raw > _SPACE, [False]])
    changes = np.flatnonzero(inside[1:] != inside[:-1])
    starts, ends = changes[0::2], changes[1::2]
    breaks = np.flatnonzero((raw == _LINE_FEED) | (raw == _RETURN))
    line = np.searchsorted(breaks, starts)
    first = np.flatnonzero(np.diff(line, prepend=-1))
    return Words(starts + start, ends + start, first)
