"""Elastic energy of a body and its derivatives."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import bsr_array, csr_array

from .. import _core
from ..arguments import is_number, shown
from ..material import Material, checked_material
from ..mesh import Body, as_shape, check_body
from .shell_material import Bending, element_material, is_of_stars
from .vertex_stars import VertexStars

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int32]


class ElasticEnergy:
    """Elastic energy of a body: the sum over its elements of measure * density.

    The elements of a solid are tets, and their measure is the volume. A shell has a membrane energy
    in its triangles and a bending energy at its hinges (Grinspun, Hirani, Desbrun, Schroeder 2003).

    Parameters
    ----------
    mesh : TetMesh or ShellMesh
        The rest shape.
    material : Material
        Its moduli may be constant, or given per tet or triangle. A shell is `StableNeoHookean` or
        `StVK`, in plane stress, or `ARAP`.
    bending : "angle" or "tangent", default "angle"
        Measure of the bending of a shell's hinge with angle theta: theta plus a hundredth of 2
        tan(theta / 2) - theta, or 2 tan(theta / 2). Both grow without bound where a hinge folds
        onto itself. The strain is the difference from rest, divided by the slope at rest.

    Raises
    ------
    ValueError
        If `mesh` is not a mesh, or the material is not one of `MATERIALS`, has moduli for another
        number of tets or triangles, or has no form for shells; for a `bending` with `ARAP`.

    Notes
    -----
    A shell bends like a plate of stiffness D = (2 mu + lam') thickness^3 / 12, with lam' of plane
    stress: the energy of a hinge is D/2 strain^2 times its measure, see docs/shells.md.

    A shell of `ARAP` has no hinges. Each vertex has a rotation R, the one nearest to the
    deformation gradients F of its triangles together. The energy is the sum over vertices and their
    triangles of mu * thickness * a third of the area * |F - R|^2: spokes and rims (Sorkine, Alexa
    2007; Chao, Pinkall, Sanan, Schroeder 2010). With a radius larger neighbourhoods share R, see
    `ARAP`.

    Every method takes a shape vector x (3n,) of positions, or vertices (n, 3), and raises
    ValueError for another shape. Energies are invariant under rigid motions of x, and vanish at
    rest.
    """

    def __init__(self, mesh: Body, material: Material, *, bending: Bending = "angle") -> None:
        check_body(mesh, "ElasticEnergy")
        self.mesh = mesh
        self.material = checked_material(material, len(mesh.cells), "ElasticEnergy")
        self.element_material = element_material(
            mesh, self.material, bending=bending, who="ElasticEnergy"
        )

    @cached_property
    def core(self) -> _core.ElasticEnergy:
        """The compiled energy, a function of displacements."""
        return _core.ElasticEnergy(self.mesh.vertices, self.corners, self.element_material.core)

    @property
    def corners(self) -> IndexArray:
        """Corners of the elements that the core sums: all, or the triangles of stars, (m, 4)."""
        if not self._has_stars:
            return self.mesh.elements
        return np.ascontiguousarray(self.mesh.elements[: len(self.mesh.cells)])

    @cached_property
    def stars(self) -> VertexStars | None:
        """The elements of an as-rigid-as-possible surface; None for other bodies."""
        return VertexStars(self.core) if self._has_stars else None

    @property
    def _has_stars(self) -> bool:
        return is_of_stars(self.mesh, self.material)

    def __repr__(self) -> str:
        return f"ElasticEnergy({self.mesh!r}, {self.material.title})"

    def value(self, x: ArrayLike) -> float:
        """Energy at x."""
        return self.value_and_gradient(x)[0]

    def value_and_gradient(self, x: ArrayLike) -> tuple[float, FloatArray]:
        """Energy at x and its gradient (3n,)."""
        value, gradient = self.core.value_and_gradient(self._displacement(x))
        return value, gradient

    def hessian_product(self, x: ArrayLike, v: ArrayLike) -> FloatArray:
        """Hessian at x times v (3n,), matrix-free."""
        direction = as_shape(v, self.mesh.vertices.size, who="ElasticEnergy", what="the direction")
        product: FloatArray = self.core.hessian_product(self._displacement(x), direction)
        return product

    def hessian(self, x: ArrayLike) -> csr_array:
        """Hessian at x, (3n, 3n) sparse symmetric; indefinite under strong compression."""
        return self._matrix(*self.core.hessian_blocks(self._displacement(x)))

    def clamped_hessian(self, x: ArrayLike, *, threshold: float) -> csr_array:
        """Hessian with the signed singular values of every tet clamped to at least `threshold`.

        The paper's Newton matrix (sec. 4.2), after Irving, Teran, Fedkiw 2004. Equal to `hessian`
        where no singular value is below the threshold; for St.Venant-Kirchhoff positive
        semi-definite at threshold 1. For solids; shells have only `projected_hessian`.
        """
        if not (is_number(threshold) and 0 < threshold <= 1):
            raise ValueError(
                f"clamped_hessian: threshold is {shown(threshold)}, but must be in (0, 1]"
            )
        return self._projected(x, _core.Projection.stretches, threshold)

    def projected_hessian(self, x: ArrayLike, *, projection: str = "clamp") -> csr_array:
        """Sum of the elements' Hessians made positive semi-definite, (3n, 3n) sparse symmetric.

        Parameters
        ----------
        x : array_like, (3n,) or (n, 3)
            The shape.
        projection : "clamp" or "absolute", default "clamp"
            Negative eigenvalues of an element's Hessian become zero (Teran, Sifakis, Irving, Fedkiw
            2005), or change their sign (Chen et al. 2024).

        Raises
        ------
        ValueError
            For an unknown projection.
        """
        if projection not in ("clamp", "absolute"):
            raise ValueError(
                f"projected_hessian: unknown projection '{projection}'; known are clamp, absolute"
            )
        return self._projected(x, _core.Projection[projection], 0.0)

    def inverted_tets(self, x: ArrayLike) -> int:
        """Number of tets with det F <= 0 at x; zero for a shell, which has no inside."""
        return int(self.core.inverted_tets(self._displacement(x)))

    def _displacement(self, x: ArrayLike) -> FloatArray:
        rest = self.mesh.vertices.reshape(-1)
        return as_shape(x, rest.size, who="ElasticEnergy") - rest

    def _projected(self, x: ArrayLike, projection: _core.Projection, threshold: float) -> csr_array:
        blocks = self.core.hessian_blocks(
            self._displacement(x), projection=projection, threshold=threshold
        )
        return self._matrix(*blocks)

    def _matrix(
        self, row_start: NDArray[np.int32], columns: NDArray[np.int32], blocks: FloatArray
    ) -> csr_array:
        size = 3 * len(self.mesh.vertices)
        return csr_array(bsr_array((blocks, columns, row_start), shape=(size, size)))
