"""The blended energy of an as-rigid-as-possible surface, summed over a few stars."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..energy import ShellMaterial
from ..problem import InterpolationProblem
from ..subspace import AffineSubspace
from .blended_elements import BlendedElements
from .chosen_tets import check_chosen, check_in_mesh
from .star_poses import StarPoses
from .summed_curvatures import summed_curvatures

FloatArray = NDArray[np.float64]


class BlendedStars(BlendedElements):
    """sum_k w_k E_k(tau + U q) of `ARAP` as a sum over the same few stars in all poses.

    The rest of the energy is a quadratic form, which is exact; see `VertexStars`. The rotations of
    a star differ from pose to pose, so an evaluation costs 18 r d multiply-adds for r stars and
    each pose whose weight is not zero.

    Parameters
    ----------
    tets : (r,) int32
        Indices of the stars, ascending. With one-rings, these are their central vertices.
    weights : (r,) float64
        The area in the first pose that each star stands for, > 0.
    rows : (poses, r, 9, d) float32
        The nine numbers of the modes in each pose.
    material : ShellMaterial
        The densities of the stars per area of the first pose, poses * r rows.
    origins : (poses, r, 9) float64
        The nine numbers of the mean shape, displaced from each pose.
    forms : (poses, d + 1, d + 1) float64
        The rest of each energy: (q, 1)^T M (q, 1) with a symmetric matrix M.

    Raises
    ------
    ValueError
        If sizes do not match, or a weight is not positive and finite.
    """

    def __init__(
        self,
        tets: NDArray[np.int32],
        weights: FloatArray,
        rows: NDArray[np.float32],
        material: ShellMaterial,
        origins: FloatArray,
        forms: FloatArray,
    ) -> None:
        if rows.ndim != 4 or not len(rows):
            raise ValueError(f"BlendedStars: rows must be (poses, r, 9, d), got {rows.shape}")
        poses, r, _, d = rows.shape
        check_chosen(tets, weights, rows[0], None, who="BlendedStars")
        material.check_tets(poses * r, "BlendedStars")
        for name, array, shape in (
            ("origins", origins, (poses, r, 9)),
            ("forms", forms, (poses, d + 1, d + 1)),
        ):
            if array.shape != shape:
                raise ValueError(f"BlendedStars: {name} must be {shape}, got {array.shape}")
        self.tets = tets
        self.weights = weights
        self.rows = np.ascontiguousarray(rows, np.float32)
        self.material = material
        self.origins = np.ascontiguousarray(origins)
        self.forms = np.ascontiguousarray(forms)
        self._core = core.BlendedStars(*self.core_arguments)

    @classmethod
    def of_tets(
        cls,
        problem: InterpolationProblem,
        subspace: AffineSubspace,
        tets: NDArray[np.int32],
        weights: FloatArray,
        *,
        forms: FloatArray | None = None,
    ) -> BlendedStars:
        """Makes the cubature of some stars, for a subspace at the mean shape.

        With all stars, weighted by their areas in the first pose, it is the exact energy. `forms`
        are computed if they are not given.

        Raises
        ------
        ValueError
            As for the constructor, or for a star that the surface does not have.
        """
        poses = StarPoses(problem)
        check_in_mesh(tets, len(poses.measures), who="BlendedStars")
        rows = poses.rows(subspace.basis, tets).reshape(len(tets), -1, 9, subspace.dimension)
        return cls(
            tets,
            weights,
            rows.swapaxes(0, 1),
            poses.material_of(tets),
            poses.origins(subspace.tau, tets),
            poses.forms(subspace) if forms is None else forms,
        )

    def __reduce__(self) -> tuple[type[BlendedStars], tuple[Any, ...]]:
        """Pickles the arguments; unpickling makes the compiled part again."""
        arguments = self.tets, self.weights, self.rows, self.material, self.origins, self.forms
        return type(self), arguments

    @property
    def core_arguments(
        self,
    ) -> tuple[NDArray[np.float32], FloatArray, core.Material, FloatArray, FloatArray]:
        """Arguments of the compiled part: rows (poses * r, 9, d), weights, material, the others."""
        flat = self.rows.reshape(-1, 9, self.dimension)
        return flat, self.weights, self.material.core, self.origins, self.forms

    @property
    def dimension(self) -> int:
        """d."""
        return int(self.rows.shape[3])

    @property
    def poses(self) -> int:
        """Number of weights."""
        return len(self.rows)

    @property
    def dirichlet_forms(self) -> FloatArray:
        """The Dirichlet energies of the poses, q^T D q: matrices (poses, d, d).

        A pose's energy is its Dirichlet energy minus a term from the rotations, which grows only
        linearly. So a weighted sum of energies has a minimum if the same sum of these matrices is
        positive definite, and none if it is indefinite.
        """
        d, moduli = self.dimension, self.material.moduli[:, 0].reshape(self.poses, -1)
        scaled = self.rows * np.sqrt(moduli * self.weights)[..., None, None]
        flat = scaled.reshape(self.poses, -1, d).astype(np.float64)
        forms: FloatArray = self.forms[:, :d, :d] + flat.swapaxes(1, 2) @ flat
        return forms

    def rough_hessian(self, q: ArrayLike, weights: FloatArray) -> FloatArray:
        """The Hessian summed in single precision, which is faster: see `summed_curvatures`."""
        curvatures = self.curvatures(q, weights)
        d = self.dimension
        form: FloatArray = np.einsum("k,kij->ij", weights, self.forms[:, :d, :d])
        return summed_curvatures(self.core_arguments[0], curvatures) + 2.0 * form

    def leading(self, dimension: int) -> BlendedStars:
        """The cubature of the same stars for the first `dimension` coordinates."""
        kept = [*range(dimension), self.dimension]
        return BlendedStars(
            self.tets,
            self.weights,
            self.rows[..., :dimension],
            self.material,
            self.origins,
            self.forms[:, kept][:, :, kept],
        )

    def without_form(self) -> BlendedStars:
        """The sum over stars alone, without the quadratic form."""
        forms = np.zeros_like(self.forms)
        return BlendedStars(self.tets, self.weights, self.rows, self.material, self.origins, forms)
