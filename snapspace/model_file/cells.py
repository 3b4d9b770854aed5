"""The cells of a body as arrays: tets, or the triangles and the thickness of a shell."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..mesh import Body, ShellMesh
from .container import Arrays, Types

TETS: dict[str, Types] = {"tets": np.int32}
#: The thickness has one entry, or one per triangle.
SHELL: dict[str, Types] = {"triangles": np.int32, "thickness": np.float64}


def cell_arrays(mesh: Body) -> Arrays:
    """The arrays of a body except vertices; the names are those of TETS or SHELL."""
    if isinstance(mesh, ShellMesh):
        thickness = np.atleast_1d(np.asarray(mesh.thickness, np.float64))
        return {"triangles": mesh.triangles, "thickness": thickness}
    return {"tets": mesh.cells}


def thickness(arrays: Arrays) -> NDArray[np.float64] | float:
    """The thickness of a shell, for `ShellMesh`."""
    values = arrays["thickness"]
    return float(values[0]) if values.size == 1 else values
