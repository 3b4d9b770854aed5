"""DisplacementRows: displacements of many samples, in memory or in files."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from .. import _core as core
from ..arguments import as_arrays, require_type
from .chosen_rows import chosen_rows

FloatArray = NDArray[np.float64]

#: Columns per block of `DisplacementRows.blocks`. A constant, since the rounding of sums over
#: blocks depends on it.
BLOCK = 3 * 1024


class DisplacementRows(Sequence[FloatArray]):
    """A matrix (k, 3n) of displacements whose rows are separate arrays, in memory or in files.

    Samples may exceed the memory. Operations on all of them work on blocks of columns, so that only
    one block is in memory at a time.

    Parameters
    ----------
    rows : iterable of (3n,) float64
        The rows, not copied; they may be mapped from a file by a `Checkpoint`. A matrix (k, 3n) is
        accepted as well.
    size : int
        3n, for the case that there are no rows.

    Raises
    ------
    ValueError
        If a row is not float64, has another size, or is not contiguous.
    """

    def __init__(self, rows: Iterable[FloatArray], size: int) -> None:
        require_type("DisplacementRows", "rows", rows, Iterable, "give arrays (3n,), or (k, 3n)")
        self.size = size
        self._rows = tuple(rows)
        self._offset: FloatArray | None = None
        for index, row in enumerate(self._rows):
            _check_row(row, index, size)

    def __len__(self) -> int:
        return len(self._rows)

    @overload
    def __getitem__(self, which: int) -> FloatArray: ...
    @overload
    def __getitem__(self, which: slice) -> DisplacementRows: ...
    def __getitem__(self, which: int | slice) -> FloatArray | DisplacementRows:
        """One row (3n,), not to be written to, or some of the rows."""
        if isinstance(which, slice):
            return self._with(self._rows[which])
        row = self._rows[which]
        return _read_only(row[:] if self._offset is None else row + self._offset)

    def select(self, which: ArrayLike) -> DisplacementRows:
        """The rows that a mask (k,) or row numbers (c,) select; ValueError for anything else."""
        chosen = chosen_rows(which, len(self), who="DisplacementRows.select")
        return self._with(tuple(self._rows[i] for i in chosen))

    def followed_by(self, rows: Iterable[FloatArray]) -> DisplacementRows:
        """These rows followed by others (3n,); the offset of these rows is added to all.

        Raises ValueError if the others are shifted already: copying them would fill the memory.
        """
        if not isinstance(rows, DisplacementRows):
            rows = DisplacementRows(rows, self.size)
        if rows._offset is not None or rows.size != self.size:
            raise ValueError(
                f"DisplacementRows: rows of size {rows.size} that are "
                f"{'not ' if rows._offset is None else ''}shifted cannot follow rows of size "
                f"{self.size}; append first, then shift"
            )
        return self._with(self._rows + rows._rows)

    def shifted(self, offset: FloatArray) -> DisplacementRows:
        """The rows plus a vector (3n,), which is added whenever they are read."""
        offset = as_arrays("DisplacementRows", "offset", offset, self.size)
        total = offset if self._offset is None else self._offset + offset
        shifted = self._with(self._rows)
        shifted._offset = total if total.any() else None
        return shifted

    def blocks(self) -> Iterable[tuple[slice, FloatArray]]:
        """Yields the rows in blocks of `BLOCK` columns, as the slice and the block.

        A block (k, columns) is read-only, and valid until the next one. Only its columns are read.
        If the rows are contiguous in memory or in a file, blocks are views.
        """
        memory = np.empty((len(self), min(BLOCK, self.size)))
        for start in range(0, self.size, BLOCK):
            columns = slice(start, min(start + BLOCK, self.size))
            yield columns, self._block(columns, memory)

    def _block(self, columns: slice, memory: FloatArray) -> FloatArray:
        if self._side_by_side is not None:
            block = self._side_by_side[:, columns]
            return _read_only(block if self._offset is None else block + self._offset[columns])
        block = memory[:, : columns.stop - columns.start]
        for target, row in zip(block, self._rows, strict=True):
            target[:] = row[columns]
        if self._offset is not None:
            block += self._offset[columns]
        return _read_only(block)

    def mass_products(
        self, mass: core.MassProducts, others: DisplacementRows, *, threads: int = 0
    ) -> FloatArray:
        """Products d_i^T M d_j of these rows with M times others, (k, len(others)).

        `mass` is from `shared_mass`; M times the others is kept in memory meanwhile. A product is
        bitwise the same whatever the other rows, on any number of threads.
        """
        return mass.multiply(self._rows, self._offset, list(others), threads=threads)

    def combined(self, weights: FloatArray, *, threads: int = 0) -> FloatArray:
        """Weights (j, k) times these rows: (j, 3n). A result row does not depend on other weights.

        This holds if all rows with a nonzero weight are finite. Rows without one do not count.
        threads : default all; the result is bitwise the same for any number
        """
        weights = as_arrays("DisplacementRows", "weights", weights, len(self))
        combined = core.combine_rows(
            self._rows, self.size, np.ascontiguousarray(weights), threads=threads
        )
        if self._offset is not None:
            combined += weights.sum(axis=1)[:, None] * self._offset
        return combined

    def array(self) -> FloatArray:
        """All rows in memory, (k, 3n)."""
        rows = np.empty((len(self), self.size))
        for columns, block in self.blocks():
            rows[:, columns] = block
        return rows

    @cached_property
    def _side_by_side(self) -> FloatArray | None:
        """The rows as a part of the matrix that owns their memory, if they are contiguous."""
        owner = self._rows[0].base if self._rows else None
        if not isinstance(owner, np.ndarray) or owner.ndim != 2 or not owner.flags.c_contiguous:
            return None
        first = _address(self._rows[0])
        for index, row in enumerate(self._rows):
            if row.base is not owner or _address(row) != first + index * owner.strides[0]:
                return None
        # the columns as well: a row may be a part of a longer one
        begin, rest = divmod(first - _address(owner), owner.strides[0])
        if rest or owner.shape[1] != self.size or owner.dtype != np.float64:
            return None
        return owner[begin : begin + len(self)].view(np.ndarray)

    def _with(self, rows: tuple[FloatArray, ...]) -> DisplacementRows:
        # the rows are checked already
        other = DisplacementRows((), self.size)
        other._rows, other._offset = rows, self._offset
        return other

    def __repr__(self) -> str:
        return f"DisplacementRows({len(self)} x {self.size})"


def shared_mass(mass: csr_array) -> core.MassProducts:
    """A mass matrix (n, n) for `mass_products`, whose calls share its memory."""
    return core.MassProducts(mass.indptr, mass.indices, mass.data)


def _check_row(row: FloatArray, index: int, size: int) -> None:
    cure = f"give a float64 array of shape ({size},)"
    require_type("DisplacementRows", f"row {index}", row, np.ndarray, cure)
    if row.dtype != np.float64 or row.shape != (size,) or not row.flags.c_contiguous:
        raise ValueError(
            f"DisplacementRows: row {index} is {row.dtype} of shape {row.shape}, but must be a "
            f"contiguous float64 array of shape ({size},); np.ascontiguousarray makes one"
        )


def _address(array: FloatArray) -> int:
    address: int = array.__array_interface__["data"][0]
    return address


def _read_only(array: FloatArray) -> FloatArray:
    array.flags.writeable = False
    return array
