"""Appearance of a Wavefront OBJ file."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..obj import corner_attribute
from .appearance import Appearance, SurfaceMaterial, Textures, as_colors, as_normals
from .layout import IntArray, Layout
from .mtl import read_mtl


def obj_appearance(layout: Layout, beside: Mapping[str, bytes]) -> Appearance | None:
    """Texture coordinates, colours (`v x y z r g b`) and materials; None without any of them.

    A file that only names a missing library of materials has an appearance that says so.
    """
    lines = _Lines(layout.data)
    textures = Textures()
    known: dict[str, SurfaceMaterial] = {}
    for library in layout.refers_to:
        if library in beside:
            text = beside[library].decode("utf-8-sig", "replace")
            known |= read_mtl(text, dict(beside), textures)
        else:
            textures.missing.append(library)
    normals = as_normals(next((one.of_corner for one in layout.directions), None))
    colors = lines.colors(len(layout.points.values))
    looks = [lines.coordinates, colors, normals]
    if all(one is None for one in looks) and not known and not textures.missing:
        return None
    names, of_polygon = np.unique(np.array(lines.materials, np.object_), return_inverse=True)
    return Appearance(
        texture_coordinates=lines.coordinates,
        colors=None if colors is None else colors[layout.corners],
        normals=normals,
        materials=tuple(known.get(name, SurfaceMaterial(name)) for name in names.tolist()),
        material_of_polygon=of_polygon.reshape(-1).astype(np.int64),
        textures=tuple(textures.files),
        missing=tuple(textures.missing),
    )


class _Lines:
    """The lines of a file that describe the look of its polygons.

    materials : name of each polygon's material, empty for none
    coordinates : (c, 2), or None if no corner has any
    """

    def __init__(self, data: bytes) -> None:
        self.materials: list[str] = []
        self._colors: list[tuple[int, list[str]]] = []
        self._vertices = 0
        rows: list[list[str]] = []
        corners: list[int] = []
        material = ""
        text = data.decode("utf-8", errors="replace").replace("\\\r\n", " ").replace("\\\n", " ")
        for line in text.splitlines():
            words = line.partition("#")[0].split()
            match words[0] if words else "":
                case "v":
                    if len(words) == 7:
                        self._colors.append((self._vertices, words[4:]))
                    self._vertices += 1
                case "vt":
                    rows.append([*words[1:3], "0", "0"][:2])
                case "f":
                    corners += [corner_attribute(word, 1, len(rows)) for word in words[1:]]
                    self.materials.append(material)
                case "usemtl":
                    material = line.partition("#")[0].strip()[len("usemtl") :].strip()
        self.coordinates = _at_corners(rows, np.array(corners, np.int64))

    def colors(self, count: int) -> np.ndarray | None:
        """Colours of the vertices, white where they have none, (n, 3); None without any."""
        if not self._colors:
            return None
        vertices = [vertex for vertex, _ in self._colors]
        try:
            values = np.array([words for _, words in self._colors], np.float64)
        except ValueError:
            return None
        colors = np.full((count, 3), 255, np.uint8)
        colors[vertices] = as_colors(values / (255.0 if values.max() > 1.0 else 1.0))
        return colors


def _at_corners(rows: list[list[str]], corners: IntArray) -> np.ndarray | None:
    exists = (corners >= 0) & (corners < len(rows))
    if not exists.any():
        return None
    try:
        points = np.array(rows, np.float32)
    except ValueError:
        return None
    found = np.zeros((len(corners), 2), np.float32)
    found[exists] = points[corners[exists]]
    found[:, 1] = 1.0 - found[:, 1]  # OBJ counts from the lower left corner
    return np.nan_to_num(found)
