"""Reading tet meshes from files."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from ..arguments import as_path
from ..input_error import located
from ..notice import Notice, notify
from .arrays import FloatArray, IndexArray, as_indices, as_points
from .file_content import CellArray, FileContent
from .input_path import existing_file
from .medit import read_medit
from .quality import tet_volumes
from .repair import repair_tets
from .tet_mesh import TetMesh
from .tetgen import read_tetgen
from .validation import check_indices, check_points
from .veg import read_veg

_SOLID_CELLS = ("hexahedron", "wedge", "pyramid", "polyhedron", "voxel")


class MeshNotice(Notice):
    """A repaired fault of a mesh file that the user should know about."""


def read_tets(path: str | os.PathLike[str], *, repair: bool = False) -> TetMesh:
    """Read a tet mesh.

    Parameters
    ----------
    path : path
        MEDIT .mesh or .meshb; Gmsh .msh (versions 2 and 4, ASCII or binary); .vtk; .vtu; TetGen
        .node or .ele (the other one is beside it); VegaFEM .veg.
    repair : bool, default False
        Repair what can be repaired (see `repair_tets`), with a `MeshNotice` for each repair.

    Returns
    -------
    TetMesh
        Vertices and tets in the order of the file. Cells of lower dimension (triangles, lines) are
        left out. Tets that are all inverted are flipped, with a `MeshNotice`.

    Raises
    ------
    ValueError
        If the file is missing, has an unknown extension, cannot be read, holds no tets, holds
        other solid cells or quadratic tets, or its mesh is not valid (see `TetMesh`). The
        message is one line that begins with the path.
    """
    file = existing_file(as_path("read_tets", path), known=_READERS)
    with located(file):
        content = _READERS[file.suffix.lower()](file)
        tets = _linear_tets(content)
        if repair:
            mesh, notes = repair_tets(content.vertices, tets)
        else:
            tets, notes = _flip_if_all_inverted(content.vertices, tets)
            mesh = TetMesh(content.vertices, tets)
    for note in notes:
        notify(f"{file}: {note}", MeshNotice, stacklevel=2)
    return mesh


def read_tet_arrays(path: str | os.PathLike[str]) -> tuple[FloatArray, IndexArray]:
    """Vertices (n, 3) and tets (m, 4) of a file as they are, including inverted tets.

    For poses, whose tets may be inverted. Raises ValueError for the file as `read_tets` does, and
    for coordinates that are not finite and indices out of range.
    """
    file = existing_file(as_path("read_tets", path), known=_READERS)
    with located(file):
        content = _READERS[file.suffix.lower()](file)
        vertices = as_points(content.vertices, who="read_tets")
        tets = as_indices(_linear_tets(content), corners=4, who="read_tets", what="tets")
        check_points(vertices, who="read_tets")
        check_indices(tets, len(vertices), who="read_tets", what="tet")
    return vertices, tets


def _linear_tets(content: FileContent) -> CellArray:
    """The tets of a file, (m, 4); ValueError if there are none, or other solid cells as well."""
    quadratic = [kind for kind in content.cells if kind.startswith("tetra") and kind != "tetra"]
    if quadratic:
        raise ValueError(
            f"it holds higher-order tets ({content.summary()}); save it with linear tets (Gmsh: "
            "element order 1)"
        )
    if any(kind.startswith(_SOLID_CELLS) for kind in content.cells):
        raise ValueError(
            f"it holds solid cells other than tets ({content.summary()}); split them into tets"
        )
    tets = content.cells.get("tetra")
    if tets is None or not len(tets):
        surface = any(kind.startswith(("triangle", "quad", "polygon")) for kind in content.cells)
        cure = (
            "it seems to be a surface: fill it with tets first (for instance with fTetWild)"
            if surface
            else "a tet mesh is needed"
        )
        raise ValueError(f"it holds no tets ({content.summary()}); {cure}")
    return tets


def _flip_if_all_inverted(points: FloatArray, tets: CellArray) -> tuple[CellArray, list[str]]:
    if tets.min() < 0 or tets.max() >= len(points) or points.shape[1] != 3:
        return tets, []
    with np.errstate(all="ignore"):
        inverted = bool((tet_volumes(points, tets.astype(np.int32)) < 0).all())
    if not inverted:
        return tets, []
    note = f"all {len(tets)} tets were inverted (ordered the other way) and have been flipped"
    return tets[:, [0, 2, 1, 3]], [note]


def _read_with_meshio(path: Path, file_format: str) -> FileContent:
    # imported here: meshio takes a tenth of the time of loading this package
    from .meshio_reader import read_with_meshio

    return read_with_meshio(path, file_format)


_READERS: dict[str, Callable[[Path], FileContent]] = {
    ".mesh": read_medit,
    ".meshb": partial(_read_with_meshio, file_format="MEDIT"),
    ".msh": partial(_read_with_meshio, file_format="Gmsh"),
    ".vtk": partial(_read_with_meshio, file_format="VTK"),
    ".vtu": partial(_read_with_meshio, file_format="VTU"),
    ".node": read_tetgen,
    ".ele": read_tetgen,
    ".veg": read_veg,
}

#: Extensions that `read_tets` supports.
TET_SUFFIXES = tuple(_READERS)
