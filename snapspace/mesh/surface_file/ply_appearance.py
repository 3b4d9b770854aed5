"""Appearance of a PLY file."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ..ply import ply_header
from ..ply_body import PlyBody, PlyColumn
from .appearance import Appearance, SurfaceMaterial, Textures, as_colors
from .layout import Layout

#: Names of texture coordinates of a vertex, as programs write them.
_COORDINATES = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"), ("texture_s", "texture_t"))
_COLORS = (
    ("red", "green", "blue"),
    ("diffuse_red", "diffuse_green", "diffuse_blue"),
    ("r", "g", "b"),
)


def ply_appearance(layout: Layout, beside: Mapping[str, bytes]) -> Appearance | None:
    """Colours and texture coordinates of vertices, or of the corners of faces (`texcoord`)."""
    vertex, face = _columns(layout.data)
    normals = layout.corners if {"nx", "ny", "nz"} <= vertex.keys() else None
    colors = _colors(vertex)
    coordinates = _coordinates(layout, vertex, face)
    if normals is None and colors is None and coordinates is None:
        return None
    textures = Textures()
    numbers = [textures.add(name, beside.get(name)) for name in layout.refers_to]
    polygons = len(layout.sizes)
    chosen = np.zeros(polygons, np.int64)
    if "texnumber" in face and len(face["texnumber"].values) == polygons and numbers:
        chosen = np.clip(face["texnumber"].values.astype(np.int64), 0, len(numbers) - 1)
    return Appearance(
        texture_coordinates=coordinates,
        colors=None if colors is None else colors[layout.corners],
        normals=normals,
        materials=tuple(SurfaceMaterial(texture=number) for number in numbers)
        or (SurfaceMaterial(),),
        material_of_polygon=chosen,
        textures=tuple(textures.files),
        missing=tuple(textures.missing),
    )


def _columns(data: bytes) -> tuple[dict[str, PlyColumn], dict[str, PlyColumn]]:
    """The columns of vertices and faces."""
    encoding, elements, start = ply_header(data)
    body = PlyBody(data[start:], encoding)
    found = {element.name: body.read(element) for element in elements}
    return found.get("vertex", {}), found.get("face", {})


def _colors(vertex: dict[str, PlyColumn]) -> NDArray[np.uint8] | None:
    for names in _COLORS:
        if all(name in vertex for name in names):
            values = np.stack([vertex[name].values for name in names], axis=1)
            if values.dtype.kind == "f" and values.size and values.max() > 1.0:
                values = values / 255.0  # bytes of a text
            return as_colors(values)
    return None


def _coordinates(
    layout: Layout, vertex: dict[str, PlyColumn], face: dict[str, PlyColumn]
) -> NDArray[np.float32] | None:
    corners = face.get("texcoord")
    found = None
    if corners is not None and np.array_equal(corners.sizes, 2 * layout.sizes):
        found = corners.values.reshape(-1, 2).astype(np.float32)
    for first, second in _COORDINATES:
        if found is None and first in vertex and second in vertex:
            pairs = np.stack([vertex[first].values, vertex[second].values], axis=1)
            found = pairs.astype(np.float32)[layout.corners]
    if found is None:
        return None
    # counted from the lower left corner, as in OBJ
    return np.nan_to_num(np.stack([found[:, 0], 1.0 - found[:, 1]], axis=1))
