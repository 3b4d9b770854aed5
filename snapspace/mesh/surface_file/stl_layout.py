"""Where the corners and normals of an STL file are."""

from __future__ import annotations

import numpy as np

from ..stl_rows import HEADER, TRIANGLE, text_spans, triangle_count
from .layout import Directions, Layout
from .slots import BinarySlots, Slots, TextSlots


def stl_layout(data: bytes) -> Layout:
    """The layout of an STL file, text or binary; ValueError if it is neither."""
    count = triangle_count(data)
    points: Slots
    normals: Slots
    if count is None:
        vertex_spans, normal_spans = text_spans(data)
        points = TextSlots(data, vertex_spans[:, :, 0], vertex_spans[:, :, 1])
        normals = TextSlots(data, normal_spans[:, :, 0], normal_spans[:, :, 1])
        count = len(normal_spans)
    else:
        rows = HEADER + TRIANGLE.itemsize * np.arange(count)[:, None]
        single = np.dtype("<f4")
        types = (single, single, single)
        normals = BinarySlots(data, rows + 4 * np.arange(3), types)
        places = (rows + 12 + 4 * np.arange(9)).reshape(-1, 3)
        points = BinarySlots(data, places, types)
    return Layout(
        data=data,
        points=points,
        corners=np.arange(3 * count),
        sizes=np.full(count, 3),
        repeats_points=True,
        directions=(Directions(normals, np.repeat(np.arange(count), 3)),),
    )
