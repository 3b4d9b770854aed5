"""VertexStars: the elements of a surface that is as rigid as possible."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from .. import _core
from ..blas import single_threaded_blas
from .arap_triangles import KIND
from .shell_material import ShellMaterial

FloatArray = NDArray[np.float64]


class VertexStars:
    """The elements of a surface that is as rigid as possible, for cubatures.

    Its energy is a quadratic form of the displacements plus the sum over stars of measure *
    density, a function of nine numbers per star; neither part is negative. The form says how much
    the triangles of a star differ from the star's best affine map. See core/energy/vertex_stars.h.

    measures : (n,), a third of the area around each vertex
    material : ShellMaterial of the stars
    """

    def __init__(self, energy: _core.ElasticEnergy) -> None:
        stars = energy.stars()
        self.measures: FloatArray = stars.areas()
        rows = stars.numbers()
        rows[:, 0] = stars.weights() / self.measures
        self.material = ShellMaterial(KIND, rows)
        starts, corners, gradients = stars.corners()
        count = len(self.measures)
        # three rows per star, for the three columns of its gradient
        stars_of = np.repeat(np.arange(count), np.diff(starts))
        row = (3 * stars_of[:, None] + np.arange(3)).reshape(-1)
        entries = gradients.reshape(-1), (row, np.repeat(corners, 3))
        self._gradients = csr_array(entries, shape=(3 * count, count))
        starts, columns, values = stars.remainder()
        self._remainder = csr_array((values, columns, starts), shape=(count, count))

    def __len__(self) -> int:
        return len(self.measures)

    @single_threaded_blas
    def gradients(self, basis: FloatArray, stars: NDArray[np.integer[Any]]) -> FloatArray:
        """The nine numbers of displacements (3n, d) in some stars (r,), (r, 9, d)."""
        rows = self._gradients[(3 * stars[:, None] + np.arange(3)).reshape(-1)]
        parts = [np.asarray(rows @ basis[a::3]) for a in range(3)]  # (3 r, d) of each coordinate a
        both = np.stack(parts).reshape(3, len(stars), 3, -1).swapaxes(0, 1)
        return np.ascontiguousarray(both.reshape(len(stars), 9, -1))

    @single_threaded_blas
    def remainder(self, basis: FloatArray) -> FloatArray:
        """The quadratic form of modes (3n, d): a matrix K (d, d) of the energy q^T K q."""
        form = np.zeros((basis.shape[1], basis.shape[1]))
        for a in range(3):
            part = np.ascontiguousarray(basis[a::3])
            form += part.T @ self._forces(part)
        return np.asarray((form + form.T) / 2.0)

    def remainder_at(self, displacements: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The quadratic form at displacements (g, 3n), (g,), and its gradients (g, 3n)."""
        columns = displacements.reshape(len(displacements), -1, 3)
        forces = np.stack([self._forces(u) for u in columns])
        energies = np.einsum("gna,gna->g", columns, forces)
        return energies, 2.0 * forces.reshape(displacements.shape)

    def _forces(self, columns: FloatArray) -> FloatArray:
        return np.asarray(self._remainder @ columns, np.float64)
