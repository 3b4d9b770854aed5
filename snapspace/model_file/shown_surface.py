"""The surface of a model as arrays: faces, tet vertices that vertices follow, its file and look."""

from __future__ import annotations

import zlib
from typing import Any

import numpy as np

from ..mesh import Body, EmbeddedSurface, SurfaceFile, boundary_surface
from .appearance import appearance_arrays
from .container import Arrays, check_shapes

DTYPES: dict[str, type] = {
    "surface_faces": np.int32,
    "surface_corners": np.int32,
    "surface_weights": np.float64,
}
#: The user's file, compressed, and its entry in the header.
SOURCE = "surface_source"
#: The materials and textures that the file refers to, one after the other.
BESIDE = "surface_beside"
#: The entry with what the page draws, since the page does not read surface files.
APPEARANCE = "appearance"
#: Files of more bytes are not stored; pass them to `snapspace pose --surface` for writing.
LARGEST_SOURCE = 1 << 26


def surface_arrays(surface: EmbeddedSurface) -> Arrays:
    """The arrays of a surface; the names are those of DTYPES, SOURCE, BESIDE and own_ ones.

    Those are of `appearance_arrays`, without textures that are in BESIDE.
    """
    arrays: Arrays = {
        "surface_faces": surface.faces,
        "surface_corners": surface.corners,
        "surface_weights": surface.weights,
    }
    source = _kept(surface)
    if source is not None:
        arrays[SOURCE] = np.frombuffer(zlib.compress(source.data, 6), np.uint8)
        beside = _kept_beside(source)
        if beside:
            arrays[BESIDE] = np.frombuffer(b"".join(beside.values()), np.uint8)
        look, _ = appearance_arrays(surface)
        places = places_of(look, beside)
        arrays |= {name: array for name, array in look.items() if places.get(name) is None}
    return arrays


def own_arrays(surface: EmbeddedSurface, mesh: Body) -> Arrays:
    """The arrays of a surface; none for the boundary of the tets, if it is from no file."""
    own = surface.source is not None or not surface.is_boundary(mesh)
    return surface_arrays(surface) if own else {}


def surface_content(surface: EmbeddedSurface) -> dict[str, Any]:
    """The entries of a surface that are not arrays, as JSON."""
    source = _kept(surface)
    if source is None:
        return {}
    content: dict[str, Any] = {SOURCE: {"name": source.name, "used_only": source.used_only}}
    beside = _kept_beside(source)
    if beside:
        content[BESIDE] = [[name, len(data)] for name, data in beside.items()]
    look, about = appearance_arrays(surface)
    if about is not None:
        content[APPEARANCE] = about | {"textures": list(places_of(look, beside).values())}
    return content


def places_of(look: Arrays, beside: dict[str, bytes]) -> dict[str, tuple[int, int] | None]:
    """By the name of each texture, where it starts in BESIDE and its size; None: not there."""
    starts: dict[bytes, int] = {}
    start = 0
    for data in beside.values():
        starts.setdefault(data, start)
        start += len(data)
    textures = {
        name: array.tobytes() for name, array in look.items() if name.startswith("own_texture_")
    }
    return {
        name: (starts[data], len(data)) if data in starts else None
        for name, data in textures.items()
    }


def dtypes(arrays: Arrays) -> dict[str, type]:
    """Types of the arrays that a file must have: all of a surface's if it has any of them."""
    needed = DTYPES if any(name in arrays for name in (*DTYPES, SOURCE)) else {}
    return needed | {name: np.uint8 for name in (SOURCE, BESIDE) if name in arrays}


def surface(arrays: Arrays, content: dict[str, Any], mesh: Body) -> EmbeddedSurface:
    """The surface in a file's arrays, or the boundary of its tets; ValueError for bad arrays."""
    if not dtypes(arrays):
        return boundary_surface(mesh)
    s = len(arrays["surface_corners"])
    check_shapes(arrays, {"surface_corners": (s, 4), "surface_weights": (s, 4)})
    for name, count in (("surface_faces", s), ("surface_corners", len(mesh.vertices))):
        indices = arrays[name]
        if indices.size and (indices.min() < 0 or indices.max() >= count):
            raise ValueError(f"'{name}' has an index that is not between 0 and {count - 1}")
    return EmbeddedSurface(
        arrays["surface_faces"],
        arrays["surface_corners"],
        arrays["surface_weights"],
        source=_source(arrays, content),
    )


def _kept(surface: EmbeddedSurface) -> SurfaceFile | None:
    source = surface.source
    return source if source is not None and len(source.data) <= LARGEST_SOURCE else None


def _source(arrays: Arrays, content: dict[str, Any]) -> SurfaceFile | None:
    """The user's file; ValueError if it cannot be unpacked or is larger than stored files."""
    if SOURCE not in arrays:
        return None
    about = content[SOURCE]
    unpacking = zlib.decompressobj()
    try:
        data = unpacking.decompress(arrays[SOURCE].tobytes(), LARGEST_SOURCE)
    except zlib.error as error:
        raise ValueError(f"'{SOURCE}' cannot be unpacked ({error})") from None
    if not unpacking.eof:
        raise ValueError(f"'{SOURCE}' is incomplete, or larger than {LARGEST_SOURCE} bytes")
    return SurfaceFile(
        str(about["name"]),
        data,
        used_only=bool(about["used_only"]),
        beside=_beside(arrays, content),
    )


def _kept_beside(source: SurfaceFile) -> dict[str, bytes]:
    """The files beside the file, unless they are too large to be stored."""
    size = sum(map(len, source.beside.values()))
    return dict(source.beside) if size <= LARGEST_SOURCE else {}


def _beside(arrays: Arrays, content: dict[str, Any]) -> dict[str, bytes]:
    """Materials and textures; ValueError if their sizes are not those of the array."""
    if BESIDE not in arrays:
        return {}
    data = arrays[BESIDE].tobytes()
    entries = [(str(name), int(size)) for name, size in content[BESIDE]]
    total = sum(size for _, size in entries)
    if any(size < 0 for _, size in entries) or total != len(data):
        raise ValueError(f"'{BESIDE}' has {len(data)} bytes, but its files have {total}")
    found, start = {}, 0
    for name, size in entries:
        found[name] = data[start : start + size]
        start += size
    return found
