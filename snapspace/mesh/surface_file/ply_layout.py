"""Where the positions and normals of a PLY file are."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from ..file_content import FileContent
from ..ply import ply_header
from ..ply_body import PlyBody, PlyElement
from .layout import Directions, Layout
from .slots import BinarySlots, Slots, TextSlots
from .words import words_of

_TEXTURE = re.compile(rb"(?m)^comment TextureFile[ \t]+([^\r\n]+)")


def ply_layout(data: bytes, content: FileContent) -> Layout:
    """The layout of a PLY file that was read as `content`."""
    assert content.polygons is not None
    polygons = content.polygons
    encoding, elements, start = ply_header(data)
    body = PlyBody(data[start:], encoding)
    for element in elements:
        if element.name == "vertex":
            break
        body.read(element)
    if any(item.count_type for item in element.properties):
        raise ValueError("its vertices have lists, and their positions cannot be written")
    places = _Places(data, start, body, element, text=encoding == "ascii")
    names = {item.name for item in element.properties}
    directions: tuple[Directions, ...] = ()
    if {"nx", "ny", "nz"} <= names:
        directions = (Directions(places.slots(("nx", "ny", "nz")), polygons.corners),)
    header = data[:start]
    return Layout(
        data=data,
        points=places.slots(("x", "y", "z")),
        corners=polygons.corners,
        sizes=polygons.sizes,
        directions=directions,
        refers_to=tuple(name.decode("utf-8", "replace") for name in _TEXTURE.findall(header)),
    )


class _Places:
    """The columns of the vertices."""

    def __init__(
        self, data: bytes, start: int, body: PlyBody, element: PlyElement, *, text: bool
    ) -> None:
        self._data, self._start, self._text = data, start, text
        self._first, self._count = body.position, element.count
        self._names = [item.name for item in element.properties]
        self._types = [body.type_of(item) for item in element.properties]

    def slots(self, names: Sequence[str]) -> Slots:
        columns = [self._names.index(name) for name in names]
        row = np.arange(self._count)[:, None]
        if self._text:
            words = words_of(self._data, self._start)
            places = self._first + row * len(self._names) + np.array(columns)
            return TextSlots(self._data, words.starts[places], words.ends[places])
        ends = np.cumsum([kind.itemsize for kind in self._types])
        inside = np.array([ends[c] - self._types[c].itemsize for c in columns])
        first, second, third = (self._types[c] for c in columns)
        offsets = self._start + self._first + row * ends[-1] + inside
        return BinarySlots(self._data, offsets, (first, second, third))
