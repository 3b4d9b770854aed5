"""Where the positions and normals of a Wavefront OBJ file are."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from ..file_content import FileContent
from .layout import Directions, Layout
from .slots import TextSlots

# Spaces may include the continuation of a line on the next one.
_GAP = rb"(?:[ \t\f\v]|\\\r?\n)+"
_LINE = rb"(?:(?<=[\r\n])|\A)(?:[ \t\f\v]|\\\r?\n)*"
_MTL = re.compile(r"\S.*?\.mtl(?=\s|$)", re.IGNORECASE)
_LIBRARY = re.compile(rb"mtllib" + _GAP + rb"([^\r\n#]+)")


def obj_layout(data: bytes, content: FileContent) -> Layout:
    """The layout of an OBJ file that was read as `content`."""
    assert content.polygons is not None
    polygons = content.polygons
    directions: tuple[Directions, ...] = ()
    if polygons.normals is not None and (polygons.normals >= 0).any():
        directions = (Directions(_vectors(data, b"vn"), polygons.normals),)
    libraries = [
        name
        for match in _LIBRARY.finditer(data)
        if _begins_line(data, match.start())
        for name in _names(match[1].decode("utf-8", "replace").strip())
    ]
    return Layout(
        data=data,
        points=_vectors(data, b"v"),
        corners=polygons.corners,
        sizes=polygons.sizes,
        directions=directions,
        refers_to=tuple(dict.fromkeys(libraries)),
    )


def _names(text: str) -> list[str]:
    """The names on a line, which may have spaces inside if they end in .mtl."""
    return _MTL.findall(text) if _MTL.sub("", text).strip() == "" else [text]


def _begins_line(data: bytes, place: int) -> bool:
    """Whether there are only spaces before a place in its line."""
    start = max(data.rfind(end, 0, place) for end in (b"\n", b"\r")) + 1
    return not data[start:place].strip()


def _vectors(data: bytes, keyword: bytes) -> TextSlots:
    """The first three words after a keyword at the start of a line."""
    word = rb"([^\s\\#]+)"
    pattern = re.compile(_LINE + keyword + _GAP + word + _GAP + word + _GAP + word)
    spans = [match.regs[1:] for match in pattern.finditer(data)]
    places: NDArray[np.int64] = np.array(spans, np.int64).reshape(-1, 3, 2)
    return TextSlots(data, places[:, :, 0], places[:, :, 1])
