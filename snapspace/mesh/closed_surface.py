"""Whether a triangle surface encloses a solid."""

from __future__ import annotations

import numpy as np

from ..input_error import InputError
from .arrays import FloatArray, IndexArray
from .edges import edges_of


def check_closed(faces: IndexArray, *, who: str) -> None:
    """Raise ValueError unless the faces form a closed, consistently oriented surface.

    Parameters
    ----------
    faces : ndarray of int, (f, 3)
    who : str
        The start of the message.

    Raises
    ------
    ValueError
        If there are no faces, or a directed edge does not occur as often as its reverse: at a
        boundary edge, or between two faces of opposite orientation. The message gives the number of
        such edges and the first one.
    """
    if not len(faces):
        raise InputError(who, "the surface has no faces; at least four are needed")
    edges = edges_of(faces)
    boundary = np.flatnonzero(edges.uses % 2 == 1)
    if boundary.size:
        first, second = edges.ends[boundary[0]]
        raise InputError(
            who,
            f"the surface is not closed, it has {boundary.size} boundary edges (the first "
            f"between vertices {first} and {second}): fill its holes, and merge vertices that "
            "coincide",
        )
    turned = np.flatnonzero(edges.balance)
    if turned.size:
        first, second = edges.ends[turned[0]]
        raise InputError(
            who,
            f"neighbouring faces have opposite orientations at {turned.size} edges (the "
            f"first between vertices {first} and {second}): orient all faces consistently",
        )


def is_flat(vertices: FloatArray, faces: IndexArray) -> bool:
    """Whether faces (f, 3), f > 0, lie in a plane, up to 1e-9 of their extent."""
    used = np.zeros(len(vertices), np.bool_)
    used[faces] = True
    points = vertices[used]
    offset = points - points.mean(axis=0)
    normal = np.linalg.eigh(offset.T @ offset)[1][:, 0]
    return float(np.abs(offset @ normal).max()) <= 1e-9 * float(np.abs(offset).max())


def enclosed_volume(vertices: FloatArray, faces: IndexArray) -> float:
    """Volume inside a closed surface by the divergence theorem.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    faces : ndarray of int, (f, 3)
        Closed.

    Returns
    -------
    float
        Positive if the faces are outward, negative if they are inward; a part that the surface
        encloses several times counts that many times.
    """
    a, b, c = np.moveaxis(vertices[faces] - vertices[faces[0, 0]], 1, 0)
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)
