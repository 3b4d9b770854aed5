"""Reading with meshio: its messages are silenced, and all its failures become ValueError."""

from __future__ import annotations

import contextlib
import io
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import meshio
import numpy as np
from meshio.gmsh import _gmsh22, _gmsh40, _gmsh41
from meshio.vtk import _vtk_42, _vtk_51

from .bounded_arrays import bound_arrays
from .file_content import CellArray, FileContent

bound_arrays(_gmsh22, _gmsh40, _gmsh41, _vtk_42, _vtk_51)

# The readers of the formats, not meshio.read, which prints and calls sys.exit on bad files.
_READERS: dict[str, Callable[[str], Any]] = {
    "MEDIT": meshio.medit.read,
    "Gmsh": meshio.gmsh.read,
    "VTK": meshio.vtk.read,
    "VTU": meshio.vtu.read,
}


def read_with_meshio(path: Path, file_format: str) -> FileContent:
    """Read a file of a named format; ValueError with one line if it cannot be read."""
    noise = io.StringIO()
    try:
        with (
            contextlib.redirect_stdout(noise),
            contextlib.redirect_stderr(noise),
            warnings.catch_warnings(),
            np.errstate(all="ignore"),
        ):
            # NumPy before 2.3 only warns when text is not numbers
            warnings.simplefilter("ignore")
            warnings.filterwarnings("error", message=".*read to its end.*")
            mesh = _READERS[file_format](str(path))
            points = np.asarray(mesh.points, dtype=np.float64)
            if points.ndim != 2:
                raise ValueError("its vertices are not a table")
            return FileContent(points, _cells_by_type(mesh.cells))
    except (Exception, SystemExit) as error:
        # meshio has no common exception: bad files give KeyError, IndexError, struct.error, ...
        reason = f" ({' '.join(str(error).split())[:160]})" if str(error) else ""
        raise ValueError(f"it is not a {file_format} file, or it is incomplete{reason}") from None


def _cells_by_type(blocks: list[Any]) -> dict[str, CellArray]:
    by_type: dict[str, list[CellArray]] = {}
    for block in blocks:
        rows = np.asarray(block.data, dtype=np.int64)
        if rows.ndim != 2:
            raise ValueError(f"its {block.type} cells are not a table")
        by_type.setdefault(block.type, []).append(rows)
    return {kind: np.concatenate(parts) for kind, parts in by_type.items()}
