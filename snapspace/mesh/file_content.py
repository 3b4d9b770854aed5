"""What a reader found in a mesh file, before anything is checked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

CellArray = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Polygons:
    """Polygons as the file has them, before they become triangles.

    corners : (c,), vertex of each corner, polygon by polygon
    sizes : (p,), number of corners of each polygon
    normals : (c,), normal of each corner in the order of the file, -1 for none; None: no normals
    """

    corners: CellArray
    sizes: CellArray
    normals: CellArray | None = None


@dataclass(frozen=True)
class FileContent:
    """Points and cells of a mesh file.

    Attributes
    ----------
    vertices : ndarray, (n, 3)
    cells : dict
        Cell type ("tetra", "triangle", "tetra10", ...; meshio's names) -> 0-based vertex indices,
        one cell per row, in the order of the file.
    polygons : Polygons, optional
        For a surface, the polygons that the triangles were made from.
    """

    vertices: NDArray[np.float64]
    cells: dict[str, CellArray]
    polygons: Polygons | None = None

    def summary(self) -> str:
        """Say what is there: `812 vertices, 1620 triangle cells`."""
        counts = [f"{len(rows)} {kind} cells" for kind, rows in self.cells.items() if len(rows)]
        return ", ".join([f"{len(self.vertices)} vertices", *(counts or ["no cells"])])
