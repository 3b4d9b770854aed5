"""shell_of_file: a surface file as a shell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, IndexArray
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
        The file's vertices in their order. Vertices at equal positions, as at seams of texture
        coordinates, become one; otherwise a shell would be cut open there.
    surface : EmbeddedSurface
        An exact embedding, with the file as its source.

    Raises
    ------
    ValueError
        As for `ShellMesh`.
    """
    compact = file.compact()
    mesh = ShellMesh(*welded(compact.vertices, compact.faces)[:2], thickness=thickness)
    return mesh, welded_surface(compact)


def welded(vertices: FloatArray, faces: IndexArray) -> tuple[FloatArray, IndexArray, IndexArray]:
    """Vertices (w, 3) at different positions, in order; faces (f, 3) of these; and indices.

    The indices (w,) are those of the first vertex at each position.
    """
    first, group = equal_points(vertices)
    return vertices[first], group.astype(np.int32)[faces], first.astype(np.int32)


def welded_surface(file: SurfaceFile) -> EmbeddedSurface:
    """A file's own surface, whose vertices follow those of `welded`."""
    group = equal_points(file.vertices)[1].astype(np.int32)
    return replace(single_vertices(file.faces, group), source=file)
