"""DisplayShapes: shapes of a subspace for the screen, as fast as the basis can be read."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..subspace import AffineSubspace

#: (n, 3), in double for computing or in single for the screen.
Vertices = TypeVar("Vertices", NDArray[np.float64], NDArray[np.float32])


class DisplayShapes:
    """Shapes tau + U q in single precision.

    The first shape makes a copy of the basis: the first 16 modes in single precision, the others
    in 16 bits. It takes little more than a quarter of the basis's memory.

    Parameters
    ----------
    subspace : AffineSubspace
    """

    def __init__(self, subspace: AffineSubspace) -> None:
        self._subspace = subspace
        self._rows: core.ShapeRows | None = None

    def shape(self, q: NDArray[np.float64]) -> NDArray[np.float32]:
        """The shape (3n,) of coordinates (d,), or of the leading ones with the others zero.

        The error of an entry is at most sum_i |q_i| max |mode_i| / 65534 over the modes after the
        first 16, plus the rounding of single precision. On bodies it is less than 2e-5 of the
        largest displacement.
        """
        if self._rows is None:
            self._rows = core.ShapeRows(self._subspace.tau, self._subspace.basis.T)
        return self._rows.shape(q)
