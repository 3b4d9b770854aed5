"""SurfaceFile: a surface file that can be written again with new positions."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...arguments import as_path, require_type
from ...disk.atomic_file import atomic_file
from ...input_error import InputError, located
from ..arrays import FloatArray, IndexArray, as_indices, as_points
from ..input_path import existing_file, writable_path
from ..polygons import fan_corners
from ..validation import check_indices, check_points
from .appearance import Appearance
from .beside import files_beside, write_beside
from .carried import carried
from .content import READERS, layout_of, vertices_of, without_mark
from .gltf_appearance import gltf_appearance
from .gltf_file import self_contained
from .layout import Layout
from .obj_appearance import obj_appearance
from .ply_appearance import ply_appearance
from .slots import Patch, patched

# Formats that programs write with y up: glTF by its specification, OBJ by convention. The others
# come from scanners and solid modelling, with z up.
_Y_UP = (".obj", ".glb", ".gltf")
# Vertices that move by less than this share of the largest coordinate stay as they are.
_STILL = 1e-12


@dataclass(frozen=True, eq=False, repr=False)
class SurfaceFile:
    """The bytes of a surface file, and the places of its positions.

    Parameters
    ----------
    name : str
        The file's name; its extension determines the format.
    data : bytes
        The whole file. A byte order mark before a text is dropped.
    used_only : bool, default False
        Whether vertices without faces are left out of `vertices` (they stay in the file).
    beside : mapping of str to bytes
        Files that this one refers to, by name: materials (.mtl) and pictures.

    Raises
    ------
    ValueError
        For an unknown extension. Faults in the content are found on first use.

    Notes
    -----
    `with_vertices` replaces the old positions by new ones. Normals and tangents in the file follow
    the deformation of their faces. Everything else stays byte for byte: faces, quads and polygons,
    their order, texture coordinates, groups, materials, colours, names. In .stl and glTF files each
    corner has its own point: equal points are one vertex here, in the order in which they first
    occur, and move together. A .gltf becomes a single file, with its buffers and images inside.
    """

    name: str
    data: bytes
    used_only: bool = False
    beside: Mapping[str, bytes] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"SurfaceFile({self.name}, {len(self.data)} bytes)"

    def __post_init__(self) -> None:
        require_type("SurfaceFile", "name", self.name, str, "give the name of a file")
        require_type("SurfaceFile", "data", self.data, bytes, "give the bytes of the file")
        if self.suffix not in READERS:
            raise ValueError(
                f"SurfaceFile: unknown extension {self.suffix!r}; known are {', '.join(READERS)}"
            )
        object.__setattr__(self, "data", without_mark(self.suffix, self.data))

    @property
    def suffix(self) -> str:
        """The extension, such as .obj."""
        return Path(self.name).suffix.lower()

    @property
    def up(self) -> str:
        """Axis that usually points up in this format: y in .obj, .glb and .gltf, else z."""
        return "y" if self.suffix in _Y_UP else "z"

    @property
    def vertices(self) -> FloatArray:
        """The vertices at rest, (n, 3); the same as those of `read_surface`."""
        return self._vertices[0]

    @property
    def corners(self) -> IndexArray:
        """Vertex of each corner of each polygon, (c,), polygon by polygon."""
        vertex = self._vertices[1]
        return np.asarray(vertex[self._layout.corners], np.int32)

    @property
    def starts(self) -> IndexArray:
        """Where each polygon starts in `corners`, and where the last one ends, (p + 1,)."""
        return np.concatenate([[0], np.cumsum(self._layout.sizes)]).astype(np.int32)

    @property
    def faces(self) -> IndexArray:
        """Triangles, (f, 3): each polygon as a fan around its first corner."""
        return np.asarray(self.corners[fan_corners(self._layout.sizes)], np.int32)

    @property
    def refers_to(self) -> tuple[str, ...]:
        """Names of other files that this one refers to, such as materials, relative to it."""
        return self._layout.refers_to

    @cached_property
    def appearance(self) -> Appearance | None:
        """Texture coordinates, colours, materials and textures; None if the file has none.

        ValueError if they are damaged. Textures are the base colours only.
        """
        try:
            if self.suffix in (".glb", ".gltf"):
                return gltf_appearance(self.data, self._layout)
            if self.suffix == ".obj":
                return obj_appearance(self._layout, self.beside)
            if self.suffix == ".ply":
                return ply_appearance(self._layout, self.beside)
        except (LookupError, TypeError, AttributeError, OverflowError) as error:
            raise ValueError(f"{self.name}: its materials are damaged ({error!s:.80})") from None
        return None

    def compact(self) -> SurfaceFile:
        """The same file without its vertices that no face uses."""
        return self._changed(used_only=True)

    def with_vertices(self, vertices: ArrayLike) -> bytes:
        """The file with other positions.

        Parameters
        ----------
        vertices : array_like, (n, 3)
            In the order of `self.vertices`.

        Returns
        -------
        bytes
            Vertices that do not move keep their bytes; if none moves, the file is unchanged.

        Raises
        ------
        ValueError
            For another shape, coordinates that are not finite or too large for the file's type, or
            a file with whole numbers as coordinates.
        """
        layout, (rest, vertex) = self._layout, self._vertices
        new = as_points(vertices, who="SurfaceFile")
        if new.shape != rest.shape:
            raise ValueError(
                f"SurfaceFile: {self.name} has {len(rest)} vertices, but {len(new)} are given"
            )
        check_points(new, who="SurfaceFile")
        scale = float(np.abs(rest).max(initial=0.0))
        moved: NDArray[np.bool_] = np.any(np.abs(new - rest) > _STILL * scale, axis=1)
        rows = np.flatnonzero((vertex >= 0) & moved[vertex])
        if not rows.size:
            return self.data
        old = layout.points.values
        world = layout.world_points().copy()
        world[rows] = new[vertex[rows]]
        points = old.copy()
        points[rows] = layout.local_points(world)[rows]
        patches = layout.points.patches(rows, points[rows])
        patches += self._carried(old, points)
        return layout.finish(patched(layout.data, patches), points)

    def write(self, path: str | os.PathLike[str], vertices: ArrayLike) -> None:
        """Writes the file with other positions, see `with_vertices`.

        Materials and textures of `beside` that are missing in its folder are written as well.
        ValueError as for `with_vertices`, for a path with another extension, or for one that cannot
        be written; an existing file then stays as it was.
        """
        file = writable_path(as_path("SurfaceFile.write", path), known=(self.suffix,))
        with located(file):
            content = self.with_vertices(vertices)
        with atomic_file(file) as temporary:
            temporary.write_bytes(content)
        write_beside(self.beside, file.parent)

    def _carried(self, old: FloatArray, new: FloatArray) -> list[Patch]:
        """Patches of normals and tangents."""
        patches: list[Patch] = []
        corners = fan_corners(self._layout.sizes)
        triangles = self._layout.corners[corners]
        for directions in self._layout.directions:
            values = directions.slots.values
            rows, turned = carried(directions, values, old, new, triangles, corners)
            patches += directions.slots.patches(rows, turned)
        return patches

    def _changed(self, **changes: Any) -> SurfaceFile:
        """The same file with other fields; its bytes are not read again."""
        other = replace(self, **changes)
        if "_layout" in vars(self):
            vars(other)["_layout"] = self._layout
        return other

    @cached_property
    def _layout(self) -> Layout:
        return layout_of(self.suffix, self.data)

    @cached_property
    def _vertices(self) -> tuple[FloatArray, NDArray[np.intp]]:
        vertices, vertex = vertices_of(self._layout)
        if self.used_only:
            used = np.zeros(len(vertices), np.bool_)
            used[vertex[self._layout.corners]] = True
            new = np.where(used, np.cumsum(used) - 1, -1)
            vertices, vertex = vertices[used], new[vertex]
        vertices.setflags(write=False)
        return vertices, vertex


def open_surface(path: str | os.PathLike[str]) -> SurfaceFile:
    """Opens a surface file, so that it can be written again with new positions.

    Parameters
    ----------
    path : path
        .obj, .off, .ply, .stl, .glb or .gltf, the formats of `read_surface`.

    Returns
    -------
    SurfaceFile
        With the file's bytes in memory, and the materials and textures in its folder or below.

    Raises
    ------
    ValueError
        As for `read_surface`, and if positions cannot be located in the file.

    Examples
    --------
    >>> spot = open_surface("spot.obj")
    >>> spot.write("twice.obj", 2.0 * spot.vertices)
    """
    file = existing_file(as_path("open_surface", path), known=READERS)
    with located(file):
        data = file.read_bytes()
        if file.suffix.lower() == ".gltf":
            data = self_contained(data, file.parent)
        surface = SurfaceFile(file.name, data)
        checked_surface(surface.vertices, surface.faces)
        beside = files_beside(surface._layout, file.parent)
    return surface._changed(beside=beside) if beside else surface


def checked_surface(
    vertices: ArrayLike, triangles: ArrayLike, *, who: str = "read_surface"
) -> tuple[FloatArray, IndexArray]:
    """Vertices (n, 3) and faces (f, 3) of a file; ValueError if they are not a surface."""
    points = as_points(vertices, who=who)
    try:
        shape = np.shape(triangles)
    except ValueError:  # rows of different lengths, which `as_indices` refuses
        shape = ()
    if shape[:1] == (0,):
        raise InputError(who, f"it has no faces ({len(points)} vertices)")
    faces = as_indices(triangles, corners=3, who=who, what="faces")
    check_points(points, who=who)
    check_indices(faces, len(points), who=who, what="face")
    return points, faces
