"""largest_component: the largest connected part of some tets, without unused vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from snapspace.mesh.components import tet_components


def largest_component(
    vertices: NDArray[np.float64], tets: NDArray[np.int64] | NDArray[np.int32]
) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Keep the component with the most tets; its vertices are renumbered in the same order.

    Parameters
    ----------
    vertices : ndarray, (n, 3)
    tets : ndarray of int, (m, 4)
        At least one tet.

    Returns
    -------
    vertices : ndarray, (k, 3)
        The vertices of the component's tets.
    tets : ndarray of int32, (j, 4)
        The component's tets.
    """
    used, renumbered = np.unique(tets, return_inverse=True)
    local = renumbered.reshape(tets.shape).astype(np.int32)
    kept = local[tet_components(local, len(used)) == 0]
    used_here, renumbered = np.unique(kept, return_inverse=True)
    return vertices[used[used_here]], renumbered.reshape(kept.shape).astype(np.int32)
