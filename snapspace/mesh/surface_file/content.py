"""Points and triangles of surface files, by format."""

from __future__ import annotations

from codecs import BOM_UTF8
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray, as_indices
from ..file_content import FileContent
from ..obj import read_obj
from ..off import read_off
from ..ply import read_ply
from ..polygons import surface_content
from ..validation import check_indices
from .gltf_layout import gltf_layout
from .layout import Layout
from .obj_layout import obj_layout
from .off_layout import off_layout
from .ply_layout import ply_layout
from .stl_layout import stl_layout
from .weld import close_points, equal_points

# Distance below which points of different frames are equal: a few roundings of the largest term.
_ROUNDING = 5e-7

_Reader = Callable[[bytes], FileContent]

# Formats with one point per corner: reading needs their layout.
_REPEATING: dict[str, Callable[[bytes], Layout]] = {
    ".stl": stl_layout,
    ".glb": gltf_layout,
    ".gltf": gltf_layout,
}
_LAYOUTS: dict[str, Callable[[bytes, FileContent], Layout]] = {
    ".obj": obj_layout,
    ".off": off_layout,
    ".ply": ply_layout,
}


def without_mark(suffix: str, data: bytes) -> bytes:
    """The bytes without the byte order mark that Windows editors put before a text."""
    return data.removeprefix(BOM_UTF8) if suffix in _LAYOUTS else data


def layout_of(suffix: str, data: bytes) -> Layout:
    """Where the numbers of a file are.

    ValueError if they are not where the reader found them, or an index is out of range.
    """
    if suffix in _REPEATING:
        return _REPEATING[suffix](data)
    content = READERS[suffix](data)
    triangles = as_indices(content.cells["triangle"], corners=3, who="open_surface", what="faces")
    check_indices(triangles, len(content.vertices), who="open_surface", what="face")
    layout = _LAYOUTS[suffix](data, content)
    found = layout.points.values
    if not np.array_equal(found, content.vertices, equal_nan=True):
        raise ValueError(
            f"the places of its positions are unclear ({len(found)} found, {len(content.vertices)} "
            "read); save it again with another program"
        )
    return layout


def vertices_of(layout: Layout) -> tuple[FloatArray, NDArray[np.intp]]:
    """The vertices of a layout (n, 3), and the vertex of each of its points (k,)."""
    points = layout.world_points()
    if not layout.repeats_points:
        return points, np.arange(len(points))
    first, vertex = equal_points(points)
    if layout.to_world is not None:  # single precision rounds differently in different frames
        some, group = close_points(points[first], _ROUNDING * layout.largest_term())
        first, vertex = first[some], group[vertex]
    return points[first], vertex


def _welded(suffix: str) -> _Reader:
    def read(data: bytes) -> FileContent:
        layout = _REPEATING[suffix](data)
        vertices, vertex = vertices_of(layout)
        return surface_content(vertices, vertex[layout.corners].astype(np.int64), layout.sizes)

    return read


#: Readers of surface files by extension.
READERS: dict[str, _Reader] = {
    ".obj": read_obj,
    ".off": read_off,
    ".ply": read_ply,
    **{suffix: _welded(suffix) for suffix in _REPEATING},
}
