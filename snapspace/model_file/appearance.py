"""The arrays with which the page draws a surface in the user's own materials."""

from __future__ import annotations

import warnings
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from ..mesh import Appearance, EmbeddedSurface, MeshNotice, SurfaceFile
from ..mesh.surface_file.drawn_points import drawn_points
from ..mesh.surface_file.own_look import own_look
from .container import Arrays

#: Textures of more bytes in total are left out of the page, which is read as a whole.
MOST_TEXTURE_BYTES = 1 << 25

_Drawn = tuple[Arrays, dict[str, Any] | None]
#: Notes about what is not shown of a surface.
_Notes = list[str]

# Results for files in use: growing models share a file, and the user gets its notes only once.
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
        If materials are damaged, or textures are missing or too large for a page; once per file.
    """
    return ({}, None) if surface.source is None else file_arrays(surface.source)


def file_arrays(source: SurfaceFile) -> _Drawn:
    """`appearance_arrays` of a surface that is not embedded in a mesh yet."""
    arrays, about = _known(source)[0]
    return dict(arrays), about


def appearance_notes(source: SurfaceFile) -> tuple[str, ...]:
    """Which of a surface's own materials are not shown, and why; warns as `appearance_arrays`."""
    return tuple(_known(source)[1])


def _known(source: SurfaceFile) -> tuple[_Drawn, _Notes]:
    if source not in _KNOWN:
        notes: _Notes = []
        _KNOWN[source] = _drawn(source, notes), notes
        for note in notes:
            warnings.warn(note, MeshNotice, stacklevel=4)
    return _KNOWN[source]


def _drawn(source: SurfaceFile, notes: _Notes) -> _Drawn:
    look = own_look(source, notes, without="the surface is shown without them")
    if look is None or not look.shows_anything:
        return {}, None
    textured = any(material.texture is not None for material in look.materials)
    points = drawn_points(source, look, coordinates=textured)
    arrays: Arrays = {
        "own_points": points.vertex.astype(np.int32),
        "own_triangles": points.triangles.astype(np.int32),
    }
    if points.crease.any():
        arrays["own_creases"] = points.crease.astype(np.int32)
    if points.coordinates is not None:
        arrays["own_coordinates"] = points.coordinates
    if points.colors is not None:
        arrays["own_colors"] = points.colors
    total = sum(map(len, look.textures))
    if total <= MOST_TEXTURE_BYTES:
        for number, data in enumerate(look.textures):
            arrays[f"own_texture_{number}"] = np.frombuffer(data, np.uint8)
    else:
        notes.append(
            f"the textures of {source.name} have {total >> 20} MB, and are not shown: a page takes "
            f"{MOST_TEXTURE_BYTES >> 20} MB; save smaller ones"
        )
    return arrays, {"materials": _materials(look, points.counts, arrays)}


def _materials(look: Appearance, counts: tuple[int, ...], arrays: Arrays) -> list[dict[str, Any]]:
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
