"""Parts of a surface that are not the body, such as cloth, hair or eyelashes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh.quality import triangle_areas
from .components import face_components

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.int32]


def minor_parts(
    vertices: FloatArray, faces: IndexArray, chosen: NDArray[np.integer]
) -> NDArray[np.bool_]:
    """The faces of those components that have a chosen vertex, if these are the smaller half.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    faces : ndarray of int, (f, 3)
    chosen : ndarray of int
        Vertices, such as those at holes.

    Returns
    -------
    ndarray of bool, (f,)
        All False if these components have half of the surface's area or more.
    """
    component = face_components(faces, len(vertices))
    is_chosen = np.zeros(len(vertices), np.bool_)
    is_chosen[chosen] = True
    found = np.zeros(int(component.max()) + 1, np.bool_)
    found[component[is_chosen[faces].any(axis=1)]] = True
    minor = found[component]
    areas = triangle_areas(vertices, faces)
    return minor if areas[minor].sum() < 0.5 * areas.sum() else np.zeros_like(minor)
