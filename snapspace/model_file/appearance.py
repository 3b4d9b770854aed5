"""What the page needs to draw a surface with the user's own materials."""

from __future__ import annotations

import warnings
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from ..mesh import Appearance, EmbeddedSurface, MeshNotice, SurfaceFile
from ..mesh.polygons import fan_corners
from ..mesh.surface_file.weld import in_order
from .container import Arrays

#: Textures of more bytes in all stay out of the page, which is read as a whole.
MOST_TEXTURE_BYTES = 1 << 25

IntArray = NDArray[np.int64]
_Drawn = tuple[Arrays, dict[str, Any] | None]
#: What of a surface is not shown.
_Notes = list[str]

# Of files in use: the models that grow share one, and a user is told once what is not shown.
_KNOWN: WeakKeyDictionary[SurfaceFile, tuple[_Drawn, _Notes]] = WeakKeyDictionary()


def appearance_arrays(surface: EmbeddedSurface) -> _Drawn:
    """Arrays and entries of a surface's own materials; none if its file has nothing to show.

    The page draws points: a vertex of the surface with one normal, texture coordinate and colour.
    Triangles are sorted by material.

    Returns
    -------
    arrays : dict
        own_points (r,), the vertex of each point; own_triangles (f, 3), points; own_creases (r,),
        points of a vertex with the same number share a normal, absent without sharp edges;
        own_coordinates (r, 2), absent without a texture; own_colors (r, 3), sRGB; own_texture_0
        and so on, picture files.
    about : dict or None
        "materials", each with its color, texture, roughness, alpha_cutoff and number of triangles.

    Warns
    -----
    MeshNotice
        Where materials are damaged, textures are missing, or they are too large for a page; once
        for a file.
    """
    return ({}, None) if surface.source is None else file_arrays(surface.source)


def file_arrays(source: SurfaceFile) -> _Drawn:
    """`appearance_arrays` of a surface that is in no mesh yet."""
    arrays, about = _known(source)[0]
    return dict(arrays), about


def appearance_notes(source: SurfaceFile) -> tuple[str, ...]:
    """What of a surface's own materials is not shown, and why; warns as `appearance_arrays`."""
    return tuple(_known(source)[1])


def _known(source: SurfaceFile) -> tuple[_Drawn, _Notes]:
    if source not in _KNOWN:
        notes: _Notes = []
        _KNOWN[source] = _drawn(source, notes), notes
        for note in notes:
            warnings.warn(note, MeshNotice, stacklevel=4)
    return _KNOWN[source]


def _drawn(source: SurfaceFile, notes: _Notes) -> _Drawn:
    look = _look(source, notes)
    if look is None or not _shows_anything(look):
        return {}, None
    sizes = np.diff(source.starts)
    corners = fan_corners(sizes)
    of_triangle = np.repeat(look.material_of_polygon, sizes - 2)
    order = np.argsort(of_triangle, kind="stable")
    corners = corners[order]
    textured = any(material.texture is not None for material in look.materials)
    vertices = source.corners.astype(np.int64)
    creases = _creases(vertices, look.normals)
    columns = [vertices, creases]
    if textured and look.texture_coordinates is not None:
        columns += [*look.texture_coordinates.view(np.int32).T]
    if look.colors is not None:
        columns.append(look.colors @ np.array([1 << 16, 1 << 8, 1]))
    first, point = _distinct(columns)
    arrays: Arrays = {
        "own_points": vertices[first].astype(np.int32),
        "own_triangles": point[corners].astype(np.int32),
    }
    if creases.any():
        arrays["own_creases"] = creases[first].astype(np.int32)
    if textured and look.texture_coordinates is not None:
        arrays["own_coordinates"] = look.texture_coordinates[first]
    if look.colors is not None:
        arrays["own_colors"] = look.colors[first]
    total = sum(map(len, look.textures))
    if total <= MOST_TEXTURE_BYTES:
        for number, data in enumerate(look.textures):
            arrays[f"own_texture_{number}"] = np.frombuffer(data, np.uint8)
    else:
        notes.append(
            f"the textures of {source.name} have {total >> 20} MB, and are not shown: a page takes "
            f"{MOST_TEXTURE_BYTES >> 20} MB; save smaller ones"
        )
    counts = np.bincount(of_triangle, minlength=len(look.materials)).tolist()
    return arrays, {"materials": _materials(look, counts, arrays)}


def _look(source: SurfaceFile, notes: _Notes) -> Appearance | None:
    """The file's appearance, None if it is damaged; adds notes of what is not shown."""
    try:
        look = source.appearance
    except ValueError as error:
        notes.append(f"{error}; the surface is shown without them")
        return None
    if look is not None and look.missing:
        names = ", ".join(look.missing[:3]) + (" ..." if len(look.missing) > 3 else "")
        notes.append(
            f"not found beside {source.name}, or no PNG, JPEG, WebP, GIF or BMP: {names}; the "
            "surface is shown without them"
        )
    return look


def _shows_anything(look: Appearance) -> bool:
    """Whether there is more than one white material without texture, and normals."""
    plain = all(one.texture is None and min(one.color) >= 1.0 for one in look.materials)
    return not plain or look.colors is not None


def _creases(vertices: IntArray, normals: IntArray | None) -> IntArray:
    """For each corner, which of its vertex's normals it has, counted from 0, (c,)."""
    if normals is None:
        return np.zeros(len(vertices), np.int64)
    pairs, number = np.unique(np.stack([vertices, normals], 1), axis=0, return_inverse=True)
    _, starts, counts = np.unique(pairs[:, 0], return_index=True, return_counts=True)
    within = np.arange(len(pairs)) - np.repeat(starts, counts)
    return np.asarray(within[number.reshape(-1)])


def _distinct(columns: list[IntArray]) -> tuple[IntArray, IntArray]:
    """First of each distinct row of columns, ascending, and each row's number among them.

    Column by column: sorting whole rows takes ten times as long.
    """
    number = np.zeros(len(columns[0]), np.int64)
    for column in columns:
        low = int(column.min(initial=0))
        span = int(column.max(initial=0)) - low + 1
        _, number = np.unique(number * span + (column.astype(np.int64) - low), return_inverse=True)
    _, first, number = np.unique(number, return_index=True, return_inverse=True)
    return in_order(first, number)


def _materials(look: Appearance, counts: list[int], arrays: Arrays) -> list[dict[str, Any]]:
    return [
        {
            "color": list(one.color),
            "texture": one.texture if f"own_texture_{one.texture}" in arrays else None,
            "roughness": one.roughness,
            "alpha_cutoff": one.alpha_cutoff,
            "triangles": count,
        }
        for one, count in zip(look.materials, counts, strict=True)
    ]
