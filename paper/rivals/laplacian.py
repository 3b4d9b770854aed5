"""The Laplacian of a tet mesh, with linear finite elements."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array

import snapspace as ss

FloatArray = NDArray[np.float64]


def hat_gradients(mesh: ss.TetMesh) -> tuple[FloatArray, FloatArray]:
    """Gradients (m, 4, 3) of the corners' hat functions, and volumes (m,)."""
    corners = mesh.vertices[mesh.tets]
    edges = np.swapaxes(corners[:, 1:] - corners[:, :1], 1, 2)  # columns
    inverse = np.linalg.inv(edges)
    gradients = np.concatenate([-inverse.sum(axis=1, keepdims=True), inverse], axis=1)
    return gradients, np.linalg.det(edges) / 6.0


def tet_laplacian(mesh: ss.TetMesh) -> csr_array:
    """Stiffness matrix (n, n): u^T L u is the integral of |grad u|^2; natural boundary."""
    gradients, volumes = hat_gradients(mesh)
    values = np.einsum("tia,tja,t->tij", gradients, gradients, volumes)
    rows, columns = np.repeat(mesh.tets, 4, axis=1), np.tile(mesh.tets, (1, 4))
    size = (len(mesh.vertices),) * 2
    return coo_array((values.ravel(), (rows.ravel(), columns.ravel())), shape=size).tocsr()


def normal_derivative(mesh: ss.TetMesh) -> csr_array:
    """N (n, n): row i of N u is the integral over the boundary of hat_i times du/dn.

    Gradients are those of the tets behind the boundary's faces. L u - N u vanishes for linear u in
    all vertices, also on the boundary, which L u alone does not.
    """
    gradients, _ = hat_gradients(mesh)
    faces = np.concatenate([np.delete(mesh.tets, k, axis=1) for k in range(4)])
    opposite = np.repeat(np.arange(4), len(mesh.tets))
    tet = np.tile(np.arange(len(mesh.tets)), 4)
    _, first, counts = np.unique(
        np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True
    )
    outer = first[counts == 1]
    tets, corners = mesh.tets[tet[outer]], mesh.vertices[faces[outer]]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2.0
    apexes = mesh.vertices[mesh.tets[tet[outer], opposite[outer]]]
    side = np.sign(np.einsum("fi,fi->f", area, corners[:, 0] - apexes))
    outward = side[:, None] * area
    slopes = np.einsum("fai,fi->fa", gradients[tet[outer]], outward) / 3.0  # of each corner's hat
    rows = np.repeat(faces[outer], 4, axis=1)
    columns, values = np.tile(tets, (1, 3)), np.tile(slopes, (1, 3))
    size = (len(mesh.vertices),) * 2
    return coo_array((values.ravel(), (rows.ravel(), columns.ravel())), shape=size).tocsr()
