"""facing_outward: orients every part of a surface outward, except for cavities."""

from __future__ import annotations

import numpy as np

from ..doctor.components import face_components
from ..mesh.arrays import FloatArray, IndexArray
from ..mesh.signed_distance import SignedDistance

#: Distance from the surface, in diagonals, at which a point is clearly on one side of it.
BESIDE = 1e-6


def facing_outward(vertices: FloatArray, faces: IndexArray, *, closed: bool = True) -> IndexArray:
    """The faces of a surface, turned so that their normals leave the solid.

    If the enclosed volume is negative, all faces are turned. Then a part that still faces inward is
    turned as well, unless there is solid all around it: it is the wall of a cavity. Programs that
    mirror parts of a character often leave them inside out.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
        Of diagonal one.
    faces : ndarray of int32, (f, 3)
    closed : bool, default True
        False for a surface with holes: all faces are turned, or none.

    Returns
    -------
    ndarray of int32, (f, 3)
    """
    component = face_components(faces, len(vertices))
    volumes = np.bincount(component, np.linalg.det(vertices[faces]))  # times six
    turned = np.ascontiguousarray(faces[:, ::-1])
    if volumes.sum() < 0:
        faces, turned, volumes = turned, faces, -volumes
    inward = (volumes < 0)[component]
    if not closed or not inward.any():
        return faces
    surface = SignedDistance(vertices, faces)
    beneath = vertices[faces].mean(axis=1) - BESIDE * surface.face_normals
    is_empty = surface.windings(beneath[inward]) < 1
    wrong = np.bincount(component[inward], is_empty, minlength=len(volumes)) > 0
    return np.where(wrong[component, None], turned, faces)
