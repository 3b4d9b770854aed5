"""The triangles of an as-rigid-as-possible surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..material import ARAP, Material
from ..mesh import ShellMesh

#: Name of the density in the core, and length of its rows; see core/material/shell_arap.h.
KIND, NUMBERS = "shell-arap", 12


def arap_triangles(
    mesh: ShellMesh, poses: NDArray[np.float64], material: Material
) -> NDArray[np.float64]:
    """Rows (k, f, 12) of the density in poses (k, n, 3): moduli times thickness, tangent frames."""
    moduli = np.zeros((len(mesh.triangles), 3))
    moduli[:, 0] = material.mu * mesh.thickness
    # all shells have the same frames, but rows of others are longer
    triangles = np.ascontiguousarray(mesh.elements[: len(mesh.triangles)])
    rows = _core.shell_moduli(np.ascontiguousarray(poses), triangles, "shell-stvk", moduli)
    return np.ascontiguousarray(np.asarray(rows)[:, :, :NUMBERS])


def star_hats(mesh: ShellMesh, poses: NDArray[np.float64], material: ARAP) -> _core.StarHats | None:
    """The stars of a surface, the same in all poses (k, n, 3); None for one-rings.

    The radius is relative to the mean diagonal of the poses.
    """
    if material.radius == 0.0:
        return None
    diagonals = np.linalg.norm(np.ptp(poses, axis=1), axis=1)
    radius = material.radius * float(np.mean(diagonals))
    return _core.star_hats(np.ascontiguousarray(poses), mesh.triangles, radius)
