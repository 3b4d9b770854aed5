"""Reading triangle surfaces from files."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial
from pathlib import Path

from ..input_error import located
from .arrays import FloatArray, IndexArray, as_indices, as_points
from .file_content import FileContent
from .input_path import existing_file
from .meshio_reader import read_with_meshio
from .obj import read_obj
from .off import read_off
from .ply import read_ply
from .validation import check_indices, check_points


def read_surface(path: str | os.PathLike[str]) -> tuple[FloatArray, IndexArray]:
    """Read a triangle surface, for instance a pose of a mesh's surface.

    Parameters
    ----------
    path : path
        Wavefront .obj, .off, .ply (ASCII or binary) or .stl.

    Returns
    -------
    vertices : ndarray, (n, 3) float64
        In the order of the file, including vertices without faces, so that vertex i corresponds
        between poses. (An .stl file has no shared vertices: equal points are merged, in the order
        in which they first occur.)
    faces : ndarray of int32, (f, 3)
        Polygons are triangulated as fans; order and orientation as in the file.

    Raises
    ------
    ValueError
        If the file is missing, has an unknown extension, cannot be read, has no faces, coordinates
        that are not finite, or an index out of range. The message is one line that begins with
        the path.
    """
    file = existing_file(path, known=_READERS)
    with located(file):
        content = _READERS[file.suffix.lower()](file)
        triangles = content.cells.get("triangle")
        if triangles is None or not len(triangles):
            raise ValueError(f"it has no faces ({len(content.vertices)} vertices)")
        vertices = as_points(content.vertices, who="read_surface")
        faces = as_indices(triangles, corners=3, who="read_surface", what="faces")
        check_points(vertices, who="read_surface")
        check_indices(faces, len(vertices), who="read_surface", what="face")
    return vertices, faces


_READERS: dict[str, Callable[[Path], FileContent]] = {
    ".obj": read_obj,
    ".off": read_off,
    ".ply": read_ply,
    ".stl": partial(read_with_meshio, file_format="STL"),
}

#: Extensions that `read_surface` knows.
SURFACE_SUFFIXES = tuple(_READERS)
