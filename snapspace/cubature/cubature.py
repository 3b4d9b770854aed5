"""The elastic energy in reduced coordinates, summed over a few tets (cubature)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..arguments import as_coordinates, require_dimension, require_type
from ..energy import ShellMaterial
from ..material import Material
from ..problem import PosingProblem, require_posing_problem
from ..subspace import AffineSubspace, check_subspace
from .chosen_tets import check_chosen, check_in_mesh
from .elements import posed_elements_of
from .local_rows import LocalRows, core_rows, dimension_of, leading_rows, products, stored
from .summed_curvatures import summed_curvatures

FloatArray = NDArray[np.float64]


class Cubature:
    """E(tau + U q) as a sum of the energies of a few tets with positive weights.

    After An, Kim, James 2008, "Optimizing cubature for efficient integration of subspace
    deformations". An evaluation costs 18 r d multiply-adds for r tets, whatever the material, and
    fewer with local coordinates. Rows are rounded to 5e-7 of their entries; value, gradient and
    Hessian are consistent to full precision. The tets of a shell are its elements, triangles and
    hinges.

    Parameters
    ----------
    tets : (r,) int32
        Which tets of the mesh, or which elements of a shell; ascending without local coordinates.
    weights : (r,) float64
        The volume that each tet stands for, or the measure of an element, > 0.
    rows : (r, 9, d) float32, or LocalRows
        Displacement gradients of the modes in these tets, see `displacement_gradients`.
    material : Material or ShellMaterial
        The density of these tets, with constant moduli or r values of each.
    remainder : (d, d), optional
        Matrix K of the rest of the energy, q^T K q, see `Elements`. Default: nothing.

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
        remainder: FloatArray | None = None,
    ) -> None:
        check_chosen(tets, weights, rows, material, who="Cubature")
        self.tets = tets
        self.weights = weights
        self.stored_rows = stored(rows)
        self.material = material
        self.remainder = remainder
        self._core = core.Cubature(self.core_rows, self.weights, material.core)

    @classmethod
    def of_tets(
        cls,
        problem: PosingProblem,
        subspace: AffineSubspace,
        tets: NDArray[np.int32],
        weights: FloatArray,
        *,
        rows: LocalRows | None = None,
        remainder: FloatArray | None = None,
    ) -> Cubature:
        """Makes the cubature of some tets for a subspace attached to the rest shape.

        With all tets, weighted by their volumes, it is the exact energy. The rows, and the rest of
        the energy, see `Elements`, are computed if they are not given.

        Raises
        ------
        ValueError
            As for the constructor, or for a tet that the mesh does not have.
        """
        require_posing_problem(problem, "Cubature")
        check_subspace(subspace, "Cubature")
        cure = "give an array (r,) of int32"
        require_type("Cubature", "tets", tets, np.ndarray, cure)
        elements = posed_elements_of(problem)
        check_in_mesh(tets, len(elements.measures), who="Cubature")
        if remainder is None:
            remainder = elements.remainder(subspace.basis)
        given = elements.gradients(subspace.basis, tets) if rows is None else rows
        return cls(tets, weights, given, elements.material.of_tets(tets), remainder)

    def __reduce__(self) -> tuple[type[Cubature], tuple[Any, ...]]:
        """Pickles the arguments; unpickling makes the compiled part again."""
        arguments = self.tets, self.weights, self.stored_rows, self.material, self.remainder
        return type(self), arguments

    def __repr__(self) -> str:
        return f"Cubature(dimension {self.dimension}, {len(self.tets)} tets)"

    @property
    def rows(self) -> NDArray[np.float32]:
        """Displacement gradients of the modes, (r, 9, d)."""
        return products(self.stored_rows)

    @property
    def core_rows(self) -> core.TetRows:
        """The rows in the form that compiled energies need."""
        return core_rows(self.stored_rows)

    @property
    def dimension(self) -> int:
        """d."""
        return dimension_of(self.stored_rows)

    def value(self, q: ArrayLike) -> float:
        """Energy at q (d,)."""
        return self.value_and_gradient(q)[0]

    def value_and_gradient(self, q: ArrayLike) -> tuple[float, FloatArray]:
        """Energy at q and its gradient (d,)."""
        at = self._at(q)
        value, gradient = self._core.value_and_gradient(at)
        if self.remainder is not None:
            half = self.remainder @ at
            value, gradient = value + float(at @ half), gradient + 2.0 * half
        return value, gradient

    def hessian(self, q: ArrayLike) -> FloatArray:
        """Hessian at q, (d, d)."""
        return self._with_remainder(self._core.derivatives(self._at(q))[2])

    def stresses(self, q: ArrayLike) -> NDArray[np.float32]:
        """First Piola-Kirchhoff stresses of the tets times their weights, (r, 9)."""
        stresses: NDArray[np.float32] = self._core.stresses(self._at(q))
        return stresses

    def curvatures(self, q: ArrayLike) -> NDArray[np.float32]:
        """Hessians of the tets by their displacement gradients, times weights, (r, 9, 9)."""
        curvatures: NDArray[np.float32] = self._core.curvatures(self._at(q))
        return curvatures

    def rough_hessian(self, q: ArrayLike) -> FloatArray:
        """The Hessian summed in single precision, which is faster: see `summed_curvatures`."""
        return self._with_remainder(summed_curvatures(self.rows, self.curvatures(q)))

    def leading(self, dimension: int) -> Cubature:
        """The cubature of the same tets for the first `dimension` coordinates.

        ValueError unless there are that many.
        """
        require_dimension("Cubature", dimension, self.dimension)
        remainder = self.remainder
        if remainder is not None:
            remainder = np.ascontiguousarray(remainder[:dimension, :dimension])
        rows = leading_rows(self.stored_rows, dimension)
        return Cubature(self.tets, self.weights, rows, self.material, remainder)

    def in_clusters(self, order: NDArray[np.intp], rows: LocalRows) -> Cubature:
        """The same tets in another order (r,), with these rows."""
        material = self.material.of_tets(order)
        return Cubature(self.tets[order], self.weights[order], rows, material, self.remainder)

    def without_remainder(self) -> Cubature:
        """The sum over tets alone."""
        return Cubature(self.tets, self.weights, self.stored_rows, self.material)

    def _at(self, q: ArrayLike) -> FloatArray:
        return as_coordinates("Cubature", q, self.dimension)

    def _with_remainder(self, hessian: FloatArray) -> FloatArray:
        return hessian if self.remainder is None else hessian + 2.0 * self.remainder
