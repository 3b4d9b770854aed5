"""AffineSubspace: the shapes tau + U q."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from .. import _core as core
from ..arguments import as_numbers, require_dimension, require_type
from ..blas import single_threaded_blas
from ..displacements import DisplacementRows, shared_mass
from ..mesh import apply_mass, check_mass, shape_or_rows

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class AffineSubspace:
    """The shapes tau + U q (paper, eq. 4).

    tau : (3n,) reference shape, x0 y0 z0 x1 ...
    basis : (3n, d) U, with M-orthonormal columns; those of a PCA are sorted, best first
    mass : (n, n) scalar mass matrix M of the reference shape
    snapshot_energies : (k,) squared M-norm of all snapshots along each column, and the remainder
    beyond the last column. For every d, the sum of the entries beyond d is the squared error of the
    first d columns. For a PCA in M the entries are eigenvalues of the Gram matrix. None for a basis
    that was not made from snapshots

    `affine_subspace` makes one from any directions. Raises ValueError for arrays of other shapes or
    types, and for another mass matrix.
    """

    tau: FloatArray
    basis: FloatArray
    mass: csr_array
    snapshot_energies: FloatArray | None = None

    def __post_init__(self) -> None:
        who = "AffineSubspace"
        for name, axes in (("tau", 1), ("basis", 2), ("snapshot_energies", 1)):
            array = getattr(self, name)
            if array is None and name == "snapshot_energies":
                continue
            require_type(who, name, array, np.ndarray, f"give an array of {axes} axes")
            if array.ndim != axes or array.dtype.kind not in "fiu":
                raise ValueError(
                    f"{who}: {name} must be numbers with {axes} axes, got {array.dtype} of shape "
                    f"{array.shape}"
                )
        check_mass(self.mass, self.tau.size, who=who)
        if len(self.basis) != self.tau.size:
            raise ValueError(
                f"{who}: the basis is {self.basis.shape}, but tau has {self.tau.size} coordinates; "
                f"give ({self.tau.size}, d), one direction per column"
            )

    @property
    def dimension(self) -> int:
        """Number d of the basis's columns."""
        return int(self.basis.shape[1])

    @property
    def lumped(self) -> bool:
        """Whether the mass matrix is diagonal."""
        return bool(self.mass.nnz == self.mass.shape[0])

    @property
    def energy_fraction(self) -> float | None:
        """Share of the snapshots' squared M-norm within the subspace (paper, sec. 5.2).

        None for a basis that was not made from snapshots.
        """
        if self.snapshot_energies is None:
            return None
        return float(self.snapshot_energies[: self.dimension].sum() / self.snapshot_energies.sum())

    def leading(self, dimension: int) -> AffineSubspace:
        """The subspace of the first columns; for a PCA the best one of that dimension.

        ValueError unless the dimension is a whole number from 1 to that of the subspace.
        """
        cure = "a larger dimension needs more snapshots"
        require_dimension("AffineSubspace", dimension, self.dimension, cure=cure)
        basis = np.asfortranarray(self.basis[:, :dimension])
        return AffineSubspace(self.tau, basis, self.mass, self.snapshot_energies)

    def in_single_precision(self) -> AffineSubspace:
        """The subspace with its basis rounded to single precision, which files store without loss.

        Its columns are M-orthonormal to about 1e-7, and shapes change by about 1e-7 of their
        displacements.
        """
        basis = self.basis.astype(np.float32).astype(np.float64)
        return AffineSubspace(self.tau, basis, self.mass, self.snapshot_energies)

    @single_threaded_blas
    def coordinates(self, shapes: ArrayLike) -> FloatArray:
        """Coordinates q = U^T M (x - tau) of the M-projection of shapes.

        Parameters
        ----------
        shapes : array_like, (3n,) or (k, 3n)
            One shape, or one per row.

        Returns
        -------
        ndarray
            (d,), or (k, d) with one sample per row.

        Raises
        ------
        ValueError
            For an array of another shape.
        """
        x = shape_or_rows(shapes, self.tau.size, who="AffineSubspace.coordinates")
        coordinates: FloatArray = apply_mass(self.mass, x - self.tau) @ self.basis
        return coordinates

    def row_coordinates(self, displacements: DisplacementRows) -> FloatArray:
        """q = U^T M u, (k, d), of displacements u from tau, without a copy of all of them."""
        cure = "give snapshots.displacements; coordinates takes shapes (k, 3n)"
        require_type("row_coordinates", "displacements", displacements, DisplacementRows, cure)
        return displacements.mass_products(shared_mass(self.mass), self._directions)

    def shape(self, q: ArrayLike) -> FloatArray:
        """tau + U q, (3n,), for coordinates (d,), or for the leading ones with the others zero.

        ValueError for more coordinates, or an array of another shape.
        """
        coordinates = as_numbers("AffineSubspace.shape", "q", q)
        if coordinates.ndim != 1 or len(coordinates) > self.dimension:
            raise ValueError(
                f"AffineSubspace.shape: q has shape {coordinates.shape}, but must be "
                f"({self.dimension},) or shorter; shapes takes rows (k, {self.dimension})"
            )
        return core.reconstruct(self.tau, self.basis.T[: len(coordinates)], coordinates)

    def shapes(self, coordinates: ArrayLike) -> FloatArray:
        """tau + U q, (k, 3n), for coordinates (k, d).

        A shape does not depend on the others, and equals the result of `shape` up to rounding. The
        basis is read once, not once for each shape. ValueError for an array of another shape.
        """
        rows = as_numbers("AffineSubspace.shapes", "coordinates", coordinates)
        if rows.ndim != 2 or rows.shape[1] != self.dimension:
            raise ValueError(
                f"AffineSubspace.shapes: coordinates have shape {rows.shape}, but must be "
                f"(k, {self.dimension}), one sample per row"
            )
        shapes = self._directions.combined(rows)
        shapes += self.tau
        return shapes

    def __repr__(self) -> str:
        return f"AffineSubspace(dimension {self.dimension}, {self.tau.size // 3} vertices)"

    @property
    def _directions(self) -> DisplacementRows:
        return DisplacementRows(np.ascontiguousarray(self.basis.T), self.tau.size)


def check_subspace(subspace: object, who: str) -> None:
    """Raises a ValueError in the name of `who` for anything but a subspace, such as a basis."""
    cure = "give that of snapshot_pca or affine_subspace"
    require_type(who, "subspace", subspace, AffineSubspace, cure)
