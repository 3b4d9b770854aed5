"""Laplacians of meshes with linear elements."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import sparse

from snapspace.mesh import TetMesh


def laplacian(mesh: TetMesh, *, scale: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Any:
    """The Laplacian of the mesh scaled along the axes, with a tenth of its vertices held softly.

    The vertices are ordered such that neighbours are near each other."""
    vertices, tets = mesh.vertices * scale, mesh.tets
    edges = vertices[tets[:, 1:]] - vertices[tets[:, :1]]
    gradients = np.linalg.inv(edges).transpose(0, 2, 1)
    gradients = np.concatenate([-gradients.sum(axis=1, keepdims=True), gradients], axis=1)
    volumes = np.abs(np.linalg.det(edges)) / 6
    local = np.einsum("t,tic,tjc->tij", volumes, gradients, gradients)
    n = len(vertices)
    i, j = np.repeat(tets, 4, axis=1).ravel(), np.tile(tets, (1, 4)).ravel()
    A = sparse.csc_array((local.ravel(), (i, j)), shape=(n, n))
    held = vertices[:, 0] < np.quantile(vertices[:, 0], 0.1)
    A = sparse.csc_array(A + sparse.diags_array(held * np.median(A.diagonal())))
    order = sparse.csgraph.reverse_cuthill_mckee(A, symmetric_mode=True)
    return A[order][:, order]
