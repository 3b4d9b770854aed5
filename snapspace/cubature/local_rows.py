"""LocalRows: displacement gradients of tets that share a few local coordinates."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .. import _core as core

#: Local coordinates are worth their error where they take at most this share of the numbers.
MOST = 0.8


@dataclass(frozen=True, eq=False)
class LocalRows:
    """Displacement gradients of modes in tets, one product of two maps per cluster.

    The first map takes the reduced coordinates q (d,) to the local coordinates of a cluster, a few
    linear combinations of q. The second map takes these to the displacement gradients of its tets.
    An evaluation reads both maps instead of nine rows of d numbers for each tet.

    sizes : (k, 2) int32, numbers of tets and of local coordinates (rank) of each cluster. Numbers
        of tets are multiples of eight, except the last.
    rows : float32, one cluster after the other, tets x 9 x rank
    modes : (ranks, d) float32, one cluster after the other

    `core` raises ValueError if sizes do not match.
    """

    sizes: NDArray[np.int32]
    rows: NDArray[np.float32]
    modes: NDArray[np.float32]

    def __repr__(self) -> str:
        sizes = f"{self.tets} tets, {len(self.sizes)} clusters"
        return f"LocalRows(dimension {self.dimension}, {sizes})"

    @property
    def core(self) -> core.TetRows:
        """The rows in the form that compiled energies need."""
        return core.TetRows(self.sizes, self.rows, self.modes)

    @property
    def tets(self) -> int:
        """Number of tets of all clusters."""
        return int(self.sizes[:, 0].sum())

    @property
    def dimension(self) -> int:
        """d."""
        return int(self.modes.shape[1])

    @property
    def numbers(self) -> int:
        """Number of entries that an evaluation reads; without clusters it is 9 r d."""
        return self.rows.size + self.modes.size

    @property
    def saves(self) -> bool:
        """Whether the saving is worth the error: see `MOST`."""
        return self.numbers <= MOST * 9 * self.tets * self.dimension

    @cached_property
    def products(self) -> NDArray[np.float32]:
        """The same gradients as rows of all coordinates, (r, 9, d)."""
        products, first, place = [], 0, 0
        for tets, rank in self.sizes.tolist():
            own = self.rows[place : place + 9 * tets * rank].reshape(9 * tets, rank)
            product = own @ self.modes[first : first + rank]
            products.append(product.reshape(tets, 9, -1))
            first, place = first + rank, place + own.size
        return np.concatenate(products)

    def leading(self, dimension: int) -> LocalRows:
        """The gradients of the first `dimension` modes."""
        modes = np.ascontiguousarray(self.modes[:, :dimension])
        return LocalRows(self.sizes, self.rows, modes)


def stored(rows: NDArray[np.float32] | LocalRows) -> NDArray[np.float32] | LocalRows:
    """Rows of one piece in memory."""
    return rows if isinstance(rows, LocalRows) else np.ascontiguousarray(rows, np.float32)


def core_rows(rows: NDArray[np.float32] | LocalRows) -> core.TetRows:
    """The rows in the form that compiled energies need."""
    return rows.core if isinstance(rows, LocalRows) else core.TetRows(rows)


def products(rows: NDArray[np.float32] | LocalRows) -> NDArray[np.float32]:
    """Rows of all coordinates, (r, 9, d)."""
    return rows.products if isinstance(rows, LocalRows) else rows


def leading_rows(
    rows: NDArray[np.float32] | LocalRows, dimension: int
) -> NDArray[np.float32] | LocalRows:
    """The rows of the first coordinates, in the form that an evaluation reads less of."""
    if not isinstance(rows, LocalRows):
        return rows[:, :, :dimension]
    fewer = rows.leading(dimension)
    return fewer if fewer.saves else fewer.products


def dimension_of(rows: NDArray[np.float32] | LocalRows) -> int:
    """d."""
    return rows.dimension if isinstance(rows, LocalRows) else rows.shape[2]
