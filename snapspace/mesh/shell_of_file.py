"""shell_of_file: a surface file as a shell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from .embedded_surface import EmbeddedSurface, single_vertices
from .shell_mesh import ShellMesh
from .surface_file import SurfaceFile
from .surface_file.weld import equal_points


def shell_of_file(file: SurfaceFile, *, thickness: ArrayLike) -> tuple[ShellMesh, EmbeddedSurface]:
    """The shell of a surface file, and the file's own surface, which follows it.

    Parameters
    ----------
    file : SurfaceFile
        Open or closed. Vertices without faces are left out.
    thickness : float or array_like (f,)
        As for `ShellMesh`; in the file's unit of length.

    Returns
    -------
    mesh : ShellMesh
        The file's vertices in their order, with those at equal positions, as at seams of texture
        coordinates, as one: else a shell would be cut open there.
    surface : EmbeddedSurface
        Exact, with the file as its source.

    Raises
    ------
    ValueError
        As for `ShellMesh`.
    """
    compact = file.compact()
    first, group = equal_points(compact.vertices)
    places = group.astype(np.int32)
    mesh = ShellMesh(compact.vertices[first], places[compact.faces], thickness=thickness)
    return mesh, replace(single_vertices(compact.faces, places), source=compact)
