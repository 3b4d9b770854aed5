"""Displacement gradients of modes, tet by tet."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from ..mesh import Body, ShellMesh

FloatArray = NDArray[np.float64]


def displacement_gradients(
    mesh: Body, basis: FloatArray, tets: NDArray[np.int32], *, threads: int | None = None
) -> NDArray[np.float32]:
    """Gradients d u_a / d x_b of all modes in tets (r,), (r, 9, d) float32, entry 3 a + b.

    A tet's rows times q give the displacement gradient of U q, which is constant in the tet. The
    rows are formed from differences of nodal values, since sums over the four vertices would lose
    digits on slivers. For the elements of a shell see core/element/rest_shell.h.
    """
    modes = np.ascontiguousarray(basis.T)
    rows: NDArray[np.float32] = core.mode_gradients(
        mesh.vertices,
        modes,
        mesh.elements[tets],
        shell=isinstance(mesh, ShellMesh),
        threads=threads or 0,
    )
    return rows
