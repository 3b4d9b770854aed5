"""Writing tet meshes and triangle surfaces to files."""

from __future__ import annotations

import contextlib
import io
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import as_path, require_type
from ..disk.atomic_file import atomic_file
from ..notice import notify
from .arrays import FloatArray, IndexArray, as_indices, as_points
from .input_path import writable_path
from .obj import write_obj
from .off import write_off
from .ply import write_ply
from .read import MeshNotice
from .stl import write_stl
from .surface import compact_surface
from .tet_mesh import TetMesh
from .validation import check_indices, check_points

_Options = Mapping[str, object]
# meshio's names of the formats of tet meshes, and its options: binary wherever there is a choice
_TET_FORMATS: dict[str, tuple[str, _Options]] = {
    ".msh": ("gmsh", {"binary": True}),
    ".vtu": ("vtu", {"binary": True}),
    ".vtk": ("vtk", {"binary": True}),
    ".mesh": ("medit", {}),
}
# Largest share of the diagonal by which single precision moves vertices without a notice.
_ROUNDED = 1e-4
# Gmsh's data sections hold scalars, vectors and 3 x 3 tensors only; MEDIT files hold none.
_GMSH_COMPONENTS = (1, 3, 9)


def write_tets(
    path: str | os.PathLike[str],
    mesh: TetMesh,
    *,
    vertices: ArrayLike | None = None,
    point_data: Mapping[str, ArrayLike] | None = None,
) -> None:
    """Write a tet mesh; reading it again gives the same numbers.

    Parameters
    ----------
    path : path
        .msh (Gmsh 4.1, binary), .vtu or .vtk (binary, for ParaView), .mesh (MEDIT, ASCII).
    mesh : TetMesh
    vertices : array_like, (n, 3), optional
        A deformed shape to write instead of `mesh.vertices`.
    point_data : mapping of names to (n,) or (n, k) arrays, optional
        Values at the vertices; 1, 3 or 9 per vertex for .msh, none for .mesh.

    Raises
    ------
    ValueError
        For an unknown extension, a folder that does not exist or cannot be written, wrong shapes,
        or values that are not finite. An existing file at `path` then stays as it was.
    """
    require_type("write_tets", "mesh", mesh, TetMesh, "give path, mesh")
    cure = "give a dictionary of arrays by name"
    require_type("write_tets", "point_data", point_data, Mapping | None, cure)
    file = writable_path(as_path("write_tets", path), known=_TET_FORMATS)
    points = _shape_to_write(mesh, vertices)
    data = {
        name: _checked_data(name, values, len(points), file.suffix.lower())
        for name, values in (point_data or {}).items()
    }
    cells = [("tetra", mesh.tets)]
    cell_data: dict[str, list[IndexArray]] = {}
    if file.suffix.lower() == ".msh":
        # One volume with number 1: Gmsh needs an entity to show and to select what it reads.
        ones = np.ones(len(mesh.tets), dtype=np.int32)
        cell_data = {"gmsh:physical": [ones], "gmsh:geometrical": [ones]}
        data["gmsh:dim_tags"] = np.tile([3.0, 1.0], (len(points), 1)).astype(np.int32)
    file_format, options = _TET_FORMATS[file.suffix.lower()]
    with atomic_file(file) as temporary:
        content = {"points": points, "cells": cells, "point_data": data, "cell_data": cell_data}
        _write_with_meshio(temporary, content, file_format, options)


def write_surface(path: str | os.PathLike[str], vertices: ArrayLike, faces: ArrayLike) -> None:
    """Write a triangle surface.

    Parameters
    ----------
    path : path
        Wavefront .obj or .off (text, all digits), .ply (binary, double) or .stl (binary, single
        precision, no shared vertices).
    vertices : array_like, (n, 3)
        May be all vertices of a tet mesh: only those that faces use are written, in their order
        (see `compact_surface`).
    faces : array_like of int, (f, 3)
        0-based, outward; at least one.

    Raises
    ------
    ValueError
        For an unknown extension, a folder that does not exist or cannot be written, wrong shapes,
        coordinates that are not finite, an index out of range, or no faces. An existing file at
        `path` then stays as it was.

    Warns
    -----
    MeshNotice
        If single precision moves vertices by more than 1e-4 of the diagonal, as happens far from
        the origin.
    """
    file = writable_path(as_path("write_surface", path), known=_SURFACE_WRITERS)
    points = as_points(vertices, who="write_surface")
    triangles = as_indices(faces, corners=3, who="write_surface", what="faces")
    if not len(triangles):
        raise ValueError("write_surface: there are no faces; at least one is needed")
    check_points(points, who="write_surface")
    check_indices(triangles, len(points), who="write_surface", what="face")
    points, triangles = compact_surface(points, triangles)
    with atomic_file(file) as temporary:
        _SURFACE_WRITERS[file.suffix.lower()](temporary, points, triangles)
    if file.suffix.lower() == ".stl":
        _notify_rounded(points, file)


def _notify_rounded(points: FloatArray, file: Path) -> None:
    """A notice if single precision changes the shape."""
    farthest, diagonal = np.abs(points).max(), np.linalg.norm(np.ptp(points, axis=0))
    moved = 0.5 * float(np.finfo(np.float32).eps) * farthest
    if moved > _ROUNDED * diagonal:
        notify(
            f"{file}: .stl has single precision, which moves vertices so far from the origin by up "
            f"to {moved:.2g}, {100 * moved / diagonal:.2g} % of the diagonal; write .obj or .ply, "
            "or move the mesh to the origin",
            MeshNotice,
            stacklevel=3,
        )


def _shape_to_write(mesh: TetMesh, vertices: ArrayLike | None) -> FloatArray:
    if vertices is None:
        return mesh.vertices
    points = as_points(vertices, who="write_tets")
    if points.shape != mesh.vertices.shape:
        raise ValueError(
            f"write_tets: vertices must have shape {mesh.vertices.shape}, like the mesh's own, "
            f"got {points.shape}"
        )
    check_points(points, who="write_tets")
    return points


def _checked_data(name: str, values: ArrayLike, count: int, suffix: str) -> FloatArray | IndexArray:
    array = np.asarray(values)
    who = f"write_tets: point_data[{name!r}]"
    if not name or not name.isprintable() or '"' in name or name.startswith("gmsh:"):
        raise ValueError(f"{who}: such a name cannot be written; use letters, digits, _")
    if array.dtype.kind not in "fiub" or array.ndim not in (1, 2) or len(array) != count:
        raise ValueError(
            f"{who} must be numbers of shape ({count},) or ({count}, k), got {array.dtype} of "
            f"shape {array.shape}"
        )
    components = 1 if array.ndim == 1 else array.shape[1]
    if suffix == ".mesh":
        raise ValueError(f"{who}: MEDIT files hold no such data; write .vtu, .vtk or .msh")
    if suffix == ".msh" and components not in _GMSH_COMPONENTS:
        raise ValueError(f"{who} has {components} values per vertex; .msh takes 1, 3 or 9")
    array = np.asarray(array, dtype=np.float64)
    if not np.isfinite(array).all():
        raise ValueError(f"{who} has values that are not finite")
    return array


def _write_with_meshio(
    path: Path, content: Mapping[str, Any], file_format: str, options: _Options
) -> None:
    # imported here: it takes a tenth of the time of loading this package
    import meshio

    # meshio prints advice to the console
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        try:
            meshio.write(path, meshio.Mesh(**content), file_format=file_format, **options)
        except meshio.WriteError as error:
            raise ValueError(f"the file cannot be written as {file_format}: {error}") from None


_SURFACE_WRITERS: dict[str, Callable[[Path, FloatArray, IndexArray], None]] = {
    ".obj": write_obj,
    ".ply": write_ply,
    ".off": write_off,
    ".stl": write_stl,
}

#: Extensions that `write_tets` and `write_surface` support.
TET_OUTPUTS, SURFACE_OUTPUTS = tuple(_TET_FORMATS), tuple(_SURFACE_WRITERS)
