"""StarPoses: the stars of a surface in all poses of a blend."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..energy import ShellMaterial, VertexStars
from ..problem import InterpolationProblem
from ..subspace import AffineSubspace

FloatArray = NDArray[np.float64]
Result = TypeVar("Result")


class StarPoses:
    """The stars of a blend of `ARAP`. Every pose has its own, with the same hats.

    Parameters
    ----------
    problem : InterpolationProblem
        Of `ShellPoses` and `ARAP`.
    """

    def __init__(self, problem: InterpolationProblem) -> None:
        stars = problem.pose_energies.stars
        assert stars is not None
        self.stars: list[VertexStars] = stars
        self._shapes = problem.pose_shapes

    @property
    def measures(self) -> FloatArray:
        """The areas of the stars in the first pose, (s,)."""
        return self.stars[0].measures

    def rows(self, basis: FloatArray, which: NDArray[np.int32]) -> NDArray[np.float32]:
        """The nine numbers of modes (3n, d) in some stars (r,) and each pose, (r, 9 poses, d)."""
        modes = np.ascontiguousarray(basis)
        rows = np.empty((len(which), 9 * len(self.stars), modes.shape[1]), np.float32)

        def fill(k: int) -> None:
            rows[:, 9 * k : 9 * k + 9] = self.stars[k].gradients(modes, which)

        self._for_poses(fill)
        return rows

    def material_of(self, which: NDArray[np.int32]) -> ShellMaterial:
        """Densities per area of the first pose of some stars (r,), poses * r rows."""
        rows = [one.material.moduli[which].copy() for one in self.stars]
        for one, moduli in zip(self.stars, rows, strict=True):
            moduli[:, 0] *= one.measures[which] / self.measures[which]
        return ShellMaterial(self.stars[0].material.kind, np.concatenate(rows))

    def origins(self, shape: FloatArray, which: NDArray[np.int32]) -> FloatArray:
        """The nine numbers of a shape (3n,), displaced from each pose, (poses, r, 9)."""
        parts = [
            one.gradients((shape - pose)[:, None], which)[..., 0]
            for one, pose in zip(self.stars, self._shapes, strict=True)
        ]
        return np.stack(parts)

    def forms(self, subspace: AffineSubspace) -> FloatArray:
        """The quadratic part of each energy: (q, 1)^T M (q, 1), (poses, d + 1, d + 1)."""
        modes = np.ascontiguousarray(subspace.basis)
        shapes = subspace.tau - self._shapes
        return np.stack(self._for_poses(lambda k: self.stars[k].remainder_beside(modes, shapes[k])))

    def _for_poses(self, work: Callable[[int], Result]) -> list[Result]:
        """Results of work(pose), on all processors: SciPy's sparse products take one each."""
        with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
            return list(pool.map(work, range(len(self.stars))))
