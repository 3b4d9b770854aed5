"""Whether a triangle surface encloses a solid."""

from __future__ import annotations

import numpy as np

from ..input_error import InputError
from .arrays import FloatArray, IndexArray


def check_closed(faces: IndexArray, *, who: str) -> None:
    """Raise ValueError unless the faces form a closed surface and are oriented alike.

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
    edges, balance, uses = _edge_balance(faces)
    boundary = np.flatnonzero(uses % 2 == 1)
    if boundary.size:
        first, second = edges[boundary[0]]
        raise InputError(
            who,
            f"the surface is not closed, it has {boundary.size} boundary edges (the first "
            f"between vertices {first} and {second}): fill its holes, and merge vertices that "
            "coincide",
        )
    turned = np.flatnonzero(balance)
    if turned.size:
        first, second = edges[turned[0]]
        raise InputError(
            who,
            f"neighbouring faces have opposite orientations at {turned.size} edges (the "
            f"first between vertices {first} and {second}): orient all faces alike",
        )


def _edge_balance(faces: IndexArray) -> tuple[IndexArray, IndexArray, IndexArray]:
    """Undirected edges (e, 2), their upward less their downward uses (e,), and all uses (e,)."""
    directed = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    edges, edge = np.unique(np.sort(directed, axis=1), axis=0, return_inverse=True)
    upward = np.where(directed[:, 0] < directed[:, 1], 1, -1)
    # the inverse had the shape of its input in one version of NumPy
    edge = edge.reshape(-1)
    balance = np.zeros(len(edges), np.int32)
    np.add.at(balance, edge, upward)
    return edges, balance, np.bincount(edge, minlength=len(edges)).astype(np.int32)


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
