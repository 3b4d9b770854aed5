"""libigl's as-rigid-as-possible surfaces, spokes and rims, as an oracle."""

from __future__ import annotations

import igl
import numpy as np
from numpy.typing import NDArray

from snapspace import ShellMesh

FloatArray = NDArray[np.float64]

#: Corners of the edges in the columns of `igl.cotmatrix_entries`, half the cotangents of the angles
#: opposite to them.
EDGES = ((1, 2), (2, 0), (0, 1))


def libigl_energy(mesh: ShellMesh, x: FloatArray) -> float:
    """The energy that libigl minimises: with its cotangents, and a third of each cell.

    Cells are vertices; one has all edges of the triangles at it. The best rotation of each is the
    nearest one to its covariance, by a singular value decomposition.
    """
    rest, shape, faces = mesh.vertices, x.reshape(-1, 3), mesh.triangles
    weights = igl.cotmatrix_entries(np.ascontiguousarray(rest), faces.astype(np.int64))
    edges = [(shape[faces[:, a]] - shape[faces[:, b]]) for a, b in EDGES]
    at_rest = [(rest[faces[:, a]] - rest[faces[:, b]]) for a, b in EDGES]
    covariances = np.zeros((len(rest), 3, 3))
    for k, (e, p) in enumerate(zip(edges, at_rest, strict=True)):
        part = weights[:, k, None, None] * e[:, :, None] * p[:, None, :]
        for corner in range(3):
            np.add.at(covariances, faces[:, corner], part)
    U, _, Vt = np.linalg.svd(covariances)
    U[:, :, 2] *= np.sign(np.linalg.det(U @ Vt))[:, None]
    rotations, energy = U @ Vt, 0.0
    for k, (e, p) in enumerate(zip(edges, at_rest, strict=True)):
        for corner in range(3):
            missed = e - np.einsum("fij,fj->fi", rotations[faces[:, corner]], p)
            energy += float(weights[:, k] @ (missed**2).sum(axis=1)) / 3.0
    return energy


def libigl_shape(
    mesh: ShellMesh, pinned: NDArray[np.int32], places: FloatArray, *, iterations: int
) -> FloatArray:
    """libigl's local-global iterations from rest, with pinned vertices (p,) at places (p, 3)."""
    data = igl.ARAPData()
    data.energy, data.max_iter = igl.ARAP_ENERGY_TYPE_SPOKES_AND_RIMS, iterations
    rest = np.ascontiguousarray(mesh.vertices)
    igl.arap_precomputation(rest, mesh.triangles.astype(np.int64), 3, pinned, data)
    return np.asarray(igl.arap_solve(np.ascontiguousarray(places), data, rest))
