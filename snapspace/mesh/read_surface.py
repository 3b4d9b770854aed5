"""Reading triangle surfaces from files."""

from __future__ import annotations

import os

import numpy as np

from ..arguments import as_path
from ..input_error import located
from .arrays import FloatArray, IndexArray
from .input_path import existing_file
from .surface_file.content import READERS, without_mark
from .surface_file.gltf_file import self_contained
from .surface_file.surface_file import checked_surface


def read_surface(path: str | os.PathLike[str]) -> tuple[FloatArray, IndexArray]:
    """Read a triangle surface, for instance a pose of a mesh's surface.

    Parameters
    ----------
    path : path
        Wavefront .obj, .off, .ply (ASCII or binary), .stl (ASCII or binary), .glb or .gltf.

    Returns
    -------
    vertices : ndarray, (n, 3) float64
        In the order of the file, including vertices without faces, so that vertex i corresponds
        between poses. An .stl file has no shared vertices, and a glTF file has several at seams:
        their equal points are merged, in the order in which they first occur. Meshes of a glTF file
        are in the frame of its scene.
    faces : ndarray of int32, (f, 3)
        Polygons are triangulated as fans; order and orientation as in the file.

    Raises
    ------
    ValueError
        If the file is missing, has an unknown extension, cannot be read, has no faces, coordinates
        that are not finite, or an index out of range. The message is one line that begins with
        the path.

    See Also
    --------
    open_surface : keeps everything else in the file as well, to write it again.
    """
    file = existing_file(as_path("read_surface", path), known=READERS)
    suffix = file.suffix.lower()
    with located(file):
        data = file.read_bytes()
        if suffix == ".gltf":
            data = self_contained(data, file.parent)
        content = READERS[suffix](without_mark(suffix, data))
        triangles = content.cells.get("triangle", np.empty((0, 3), np.int64))
        return checked_surface(content.vertices, triangles)


#: Extensions that `read_surface` supports.
SURFACE_SUFFIXES = tuple(READERS)
