"""The blended energy of several poses in reduced coordinates, summed over a few tets."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..energy import ShellMaterial
from ..material import Material
from ..problem import InterpolationProblem
from ..subspace import AffineSubspace
from .blended_elements import BlendedElements
from .chosen_tets import check_chosen, check_in_mesh
from .displacement_gradients import displacement_gradients
from .local_rows import (
    LocalRows,
    core_rows,
    dimension_of,
    leading_rows,
    products,
    stored,
)
from .summed_curvatures import summed_curvatures

FloatArray = NDArray[np.float64]


class BlendedCubature(BlendedElements):
    """sum_k w_k E_k(tau + U q) as a sum over the same few tets for all poses.

    After An, Kim, James 2008, with positive weights. Where the density collapses (stable
    neo-Hookean) an evaluation costs 18 r d multiply-adds for r tets, for any number of poses.

    Parameters
    ----------
    tets : (r,) int32
        Which tets of the mesh, or which elements of a shell; ascending without local coordinates.
    weights : (r,) float64
        The volume that each tet stands for in the first pose, or the measure of an element, > 0.
    rows : (r, 9, d) float32, or LocalRows
        Displacement gradients of the modes against the first pose, see `displacement_gradients`.
    material : Material or ShellMaterial
        The density of these tets, with constant moduli or r values of each; for a shell, the
        density of the first pose.
    corners : (poses + 1, r, 4, 3) float64
        Corners of the tets in every pose, followed by those in the mean shape.

    Raises
    ------
    ValueError
        If sizes do not match, including those of the moduli, or a weight is not positive and
        finite.
    """

    def __init__(
        self,
        tets: NDArray[np.int32],
        weights: FloatArray,
        rows: NDArray[np.float32] | LocalRows,
        material: Material | ShellMaterial,
        corners: FloatArray,
    ) -> None:
        check_chosen(tets, weights, rows, material, who="BlendedCubature")
        if corners.ndim != 4 or len(corners) < 3 or corners.shape[1:] != (len(tets), 4, 3):
            raise ValueError(
                f"BlendedCubature: corners must be (poses + 1, {len(tets)}, 4, 3), got "
                f"{corners.shape}"
            )
        self.tets = tets
        self.weights = weights
        self.stored_rows = stored(rows)
        self.material = material
        self.corners = np.ascontiguousarray(corners, np.float64)
        self._core = core.BlendedCubature(*self.core_arguments)

    @classmethod
    def of_tets(
        cls,
        problem: InterpolationProblem,
        subspace: AffineSubspace,
        tets: NDArray[np.int32],
        weights: FloatArray,
        *,
        rows: LocalRows | None = None,
    ) -> BlendedCubature:
        """Makes the cubature of some tets for a subspace attached to the mean shape.

        With all tets, weighted by their volumes in the first pose, it is the exact energy.
        The rows are computed if they are not given.

        Raises
        ------
        ValueError
            As for the constructor, or for a tet that the mesh does not have.
        """
        check_in_mesh(tets, len(problem.mesh.elements), who="BlendedCubature")
        given = displacement_gradients(problem.mesh, subspace.basis, tets) if rows is None else rows
        shapes = np.concatenate([problem.poses.shapes, subspace.tau.reshape(1, -1, 3)])
        corners = shapes[:, problem.mesh.elements[tets]]
        return cls(tets, weights, given, problem.element_material.of_tets(tets), corners)

    def __reduce__(self) -> tuple[type[BlendedCubature], tuple[Any, ...]]:
        """Pickles the arguments; unpickling makes the compiled part again."""
        return type(self), (self.tets, self.weights, self.stored_rows, self.material, self.corners)

    @property
    def core_arguments(self) -> tuple[core.TetRows, FloatArray, core.Material, FloatArray]:
        """Arguments of the compiled part: rows, weights, material, corners (poses + 1, r, 12)."""
        flat = self.corners.reshape(*self.corners.shape[:2], 12)
        return core_rows(self.stored_rows), self.weights, self.material.core, flat

    @property
    def rows(self) -> NDArray[np.float32]:
        """Displacement gradients of the modes against the first pose, (r, 9, d)."""
        return products(self.stored_rows)

    @property
    def dimension(self) -> int:
        """d."""
        return dimension_of(self.stored_rows)

    @property
    def poses(self) -> int:
        """Number of weights."""
        return len(self.corners) - 1

    def rough_hessian(self, q: ArrayLike, weights: FloatArray) -> FloatArray:
        """The Hessian summed in single precision, which is faster: see `summed_curvatures`."""
        return summed_curvatures(self.rows, self.curvatures(q, weights))

    def leading(self, dimension: int) -> BlendedCubature:
        """The cubature of the same tets for the first `dimension` coordinates."""
        rows = leading_rows(self.stored_rows, dimension)
        return BlendedCubature(self.tets, self.weights, rows, self.material, self.corners)

    def in_clusters(self, order: NDArray[np.intp], rows: LocalRows) -> BlendedCubature:
        """The same tets in another order (r,), with these rows."""
        material, corners = self.material.of_tets(order), self.corners[:, order]
        return BlendedCubature(self.tets[order], self.weights[order], rows, material, corners)
