"""SnapshotGram: inner products of snapshots, and errors that follow from them alone."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import eigh
from scipy.sparse import csr_array

from ..arguments import require_count
from ..blas import single_threaded_blas
from ..mesh import check_mass
from ..problem import Problem, require_problem
from .chosen_rows import chosen_rows
from .displacement_rows import DisplacementRows, shared_mass

FloatArray = NDArray[np.float64]

#: Number of new rows whose products are formed in one call, which reads all earlier rows once.
#: Ctrl-C takes effect between two calls.
TOGETHER = 32


class SnapshotGram:
    """Matrix (k, k) of inner products d_i^T M d_j of displacements, which grows as they are solved.

    The method of snapshots (paper, sec. 5.2) finds the best subspace from it, and the errors of
    unseen samples follow as well. Memory: the matrix, and M times `TOGETHER` displacements while
    rows are added.

    Parameters
    ----------
    mass : csr_array, (n, n)
        Scalar mass matrix M of the norm.
    offset : (3n,), optional
        Added to all displacements, to measure them from another shape. Default: zero.
    """

    def __init__(self, mass: csr_array, *, offset: FloatArray | None = None) -> None:
        check_mass(mass, who="SnapshotGram")
        self.mass = mass
        rows = DisplacementRows((), 3 * mass.shape[0])
        self._rows = rows if offset is None else rows.shifted(offset)
        self._matrix = np.zeros((0, 0))

    @classmethod
    def of(cls, problem: Problem, *, lumped: bool = False) -> SnapshotGram:
        """For displacements from a problem's `base`; products are of displacements from its `tau`.

        ValueError for something other than a problem.
        """
        require_problem(problem, "SnapshotGram.of")
        return cls(problem.mass(lumped=lumped), offset=problem.base - problem.tau)

    def __repr__(self) -> str:
        return f"SnapshotGram({len(self)} displacements)"

    def __len__(self) -> int:
        return len(self._rows)

    @property
    def matrix(self) -> FloatArray:
        """The inner products of all rows, (k, k), exactly symmetric, read-only."""
        matrix = self._matrix.view()
        matrix.flags.writeable = False
        return matrix

    def copy(self) -> SnapshotGram:
        """A copy that can grow on its own."""
        return self.select(np.ones(len(self), bool))

    def select(self, which: ArrayLike) -> SnapshotGram:
        """The products of the rows that a mask (k,) or row numbers select; they can grow alone."""
        some = SnapshotGram(self.mass)
        places = chosen_rows(which, len(self), who="SnapshotGram.select")
        some._rows, some._matrix = self._rows.select(places), self._matrix[np.ix_(places, places)]
        return some

    def add(self, rows: Iterable[FloatArray], *, threads: int = 0) -> None:
        """Appends displacements (3n,): their products with each other and with all earlier ones.

        The result is bitwise the same however the rows are split into calls, and on any number of
        threads (0 for all). Rows are not copied, and later calls read them again; rows that are
        mapped from files need no memory.

        Raises
        ------
        ValueError
            If a row is not a float64 array of shape (3n,).
        """
        before, every = len(self), self._rows.followed_by(rows)
        matrix = np.zeros((len(every), len(every)))
        matrix[:before, :before] = self._matrix
        mass = shared_mass(self.mass)
        for first in range(before, len(every), TOGETHER):
            end = min(first + TOGETHER, len(every))
            products = every[:end].mass_products(mass, every[first:end], threads=threads)
            for i in range(first, end):
                matrix[i, : i + 1] = matrix[: i + 1, i] = products[: i + 1, i - first]
        self._rows, self._matrix = every, matrix

    @single_threaded_blas
    def held_out_error(self, training: ArrayLike, unseen: ArrayLike, dimension: int) -> FloatArray:
        """Relative errors |x - P x|_M / |x|_M of the best subspace for unseen samples.

        P is the M-projection onto the first directions of the PCA of the training rows.

        Parameters
        ----------
        training, unseen : array_like of int, or masks (k,)
            Indices or masks of the rows.
        dimension : int
            d; if the training rows span less, all their directions are used.

        Returns
        -------
        ndarray, one per unseen row
            Between 0 and 1, and never larger for a larger d; 0 for a zero row. They come from
            differences of squares, so errors below 1e-7 are rounding.

        Raises
        ------
        ValueError
            For a dimension below 1, or without training rows.
        """
        dimension = require_count("SnapshotGram", "dimension", dimension, at_least=1)
        errors = self.held_out_errors(training, unseen)
        last: FloatArray = errors[min(dimension, len(errors) - 1)]
        return last

    @single_threaded_blas
    def held_out_errors(self, training: ArrayLike, unseen: ArrayLike) -> FloatArray:
        """The same for all dimensions, (k + 1, unseen): row d is for d directions.

        k is the number of directions of the training rows; ValueError without training rows.
        """
        known, new = (
            chosen_rows(which, len(self), who="SnapshotGram.held_out_errors")
            for which in (training, unseen)
        )
        if len(known) == 0:
            raise ValueError("SnapshotGram: there are no training rows, but at least one is needed")
        squared = self._matrix[new, new]
        eigenvalues, vectors = eigh(self._matrix[np.ix_(known, known)])
        # below the rounding of the largest, directions are noise
        real = eigenvalues > len(known) * np.finfo(float).eps * max(eigenvalues[-1], 0.0)
        directions = (vectors[:, real] / np.sqrt(eigenvalues[real]))[:, ::-1]
        held = np.cumsum((directions.T @ self._matrix[np.ix_(known, new)]) ** 2, axis=0)
        left = np.maximum(squared - np.vstack([np.zeros_like(squared), held]), 0.0)
        zero = squared == 0.0
        errors: FloatArray = np.sqrt(left / np.where(zero, 1.0, squared))
        return errors
