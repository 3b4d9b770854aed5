"""Body: the interface of solids and shells."""

from __future__ import annotations

from typing import Protocol

from .arrays import FloatArray, IndexArray


class Body(Protocol):
    """A mesh at rest whose vertices move: `TetMesh` or `ShellMesh`.

    Its mass is that of its cells, tets or triangles. Its elastic energy is a sum over elements:
    tets, or the triangles and hinges of a shell. Elements have four corners; see `ShellMesh` for
    those of a shell.
    """

    @property
    def vertices(self) -> FloatArray:
        """Rest positions, (n, 3)."""
        ...

    @property
    def cells(self) -> IndexArray:
        """Vertices of the tets, (m, 4), or of the triangles, (m, 3)."""
        ...

    @property
    def volumes(self) -> FloatArray:
        """Volumes of the cells, (m,)."""
        ...

    @property
    def elements(self) -> IndexArray:
        """Corners of the elements, (e, 4)."""
        ...

    @property
    def measures(self) -> FloatArray:
        """Factors of the elements' densities, (e,): for tets their volumes."""
        ...

    @property
    def volume(self) -> float:
        """Volume of the body."""
        ...

    @property
    def vertex_masses(self) -> FloatArray:
        """Each vertex's share of the volumes of its cells, (n,)."""
        ...

    @property
    def surface(self) -> IndexArray:
        """Faces to show, (f, 3)."""
        ...

    @property
    def surface_vertices(self) -> IndexArray:
        """Sorted indices of the vertices of these faces, (s,)."""
        ...

    @property
    def diagonal(self) -> float:
        """Length of the diagonal of the bounding box."""
        ...

    @property
    def components(self) -> IndexArray:
        """Component of each cell, (m,)."""
        ...

    @property
    def fingerprint(self) -> str:
        """Hash of everything that defines the body, 64 hex digits."""
        ...
