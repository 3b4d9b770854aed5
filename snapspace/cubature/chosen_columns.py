"""ChosenColumns: the columns that a nonnegative fit has chosen, and their inner products."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

#: Columns whose products are computed together, of all candidates and of those that were chosen.
PART, CHOSEN_PART = 512, 128


class ChosenColumns:
    """Some of the candidate columns in double precision, and their products with each other.

    A column stays in its row of memory until it is removed, and a later one reuses the row. Moving
    rows together would take as long as their products. Sums are the same for any number of threads.

    Parameters
    ----------
    columns : (c, k) float32
        The candidates, each contiguous.
    target : (k,)
        The vector to fit.
    most : int
        The largest number of columns that are chosen at the same time.
    threads : int, optional
        Default: all.
    """

    def __init__(
        self,
        columns: NDArray[np.float32],
        target: FloatArray,
        most: int,
        *,
        threads: int | None = None,
    ) -> None:
        most = min(most, len(columns))
        self._columns, self._target = columns, target
        self._workers = threads or os.cpu_count() or 1
        self._own = np.zeros((most, len(target)))
        self._products = np.empty((most, most))
        self._moments = np.empty(most)
        self._rows: IndexArray = np.zeros(0, np.intp)  # of the chosen columns
        self._free: IndexArray = np.arange(most)  # rows of no column

    @property
    def gram(self) -> FloatArray:
        """Products of the chosen columns with each other."""
        return self._products[np.ix_(self._rows, self._rows)]

    @property
    def moments(self) -> FloatArray:
        """Their products with the target."""
        return self._moments[self._rows]

    def candidate_products(self, residual: FloatArray) -> NDArray[np.float32]:
        """Products (c,) of all candidates with a residual."""
        return self._in_parts(self._columns, residual.astype(np.float32), PART)

    def add(self, fresh: IndexArray) -> None:
        """Adds candidates after those that are chosen."""
        if not len(fresh):
            return
        new, self._free = self._free[: len(fresh)], self._free[len(fresh) :]
        self._rows = np.concatenate([self._rows, new])
        columns = self._columns[fresh].astype(np.float64)
        self._own[new] = columns
        self._moments[new] = columns @ self._target
        # products with unused rows mean nothing
        products = self._in_parts(self._own[: self._used], columns.T, CHOSEN_PART)
        self._products[: self._used, new] = products
        self._products[new, : self._used] = products.T

    def keep(self, kept: NDArray[np.bool_]) -> None:
        """Removes the chosen columns outside a mask."""
        self._free = np.sort(np.concatenate([self._free, self._rows[~kept]]))
        self._rows = self._rows[kept]

    def residual(self, weights: FloatArray) -> FloatArray:
        """The target minus the weighted sum of the chosen columns, (k,)."""
        by_row = np.zeros(self._used)
        by_row[self._rows] = weights
        return self._target - by_row @ self._own[: self._used]

    @property
    def _used(self) -> int:
        """Number of rows up to the last one of a chosen column."""
        return int(self._rows.max(initial=-1)) + 1

    def _in_parts(self, rows: NDArray[Any], others: NDArray[Any], part: int) -> NDArray[Any]:
        """rows @ others, in parts of several rows, on all threads."""
        starts = range(0, len(rows), part)
        with ThreadPoolExecutor(max_workers=self._workers) as pool:
            return np.concatenate([*pool.map(lambda at: rows[at : at + part] @ others, starts)])
