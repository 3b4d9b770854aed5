"""DisplayShapes: shapes of a subspace for the screen, as fast as memory delivers the basis."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..subspace import AffineSubspace

#: (n, 3), in double for computing or in single for the screen.
Vertices = TypeVar("Vertices", NDArray[np.float64], NDArray[np.float32])


class DisplayShapes:
    """Shapes tau + U q in single precision. The basis is copied for the first of them.

    Parameters
    ----------
    subspace : AffineSubspace
    """

    def __init__(self, subspace: AffineSubspace) -> None:
        self._subspace = subspace
        self._rows: core.ShapeRows | None = None

    def shape(self, q: NDArray[np.float64]) -> NDArray[np.float32]:
        """The shape (3n,) of coordinates (d,), or of the leading ones with the others zero.

        With d modes a coordinate is off by at most (d + 5) 2^-24 times the largest that its terms
        can add up to: on bodies by less than 1e-6 of the displacement, and the rounding of the
        coordinate itself.
        """
        if self._rows is None:
            self._rows = core.ShapeRows(self._subspace.tau, self._subspace.basis.T)
        return self._rows.shape(q)
