"""Where the positions and normals of an OFF file are."""

from __future__ import annotations

import re

import numpy as np

from ..file_content import FileContent
from .layout import Directions, Layout
from .slots import TextSlots
from .words import Words, words_of

_COMMENT = re.compile(rb"#[^\r\n]*")
_WITH_NORMALS = (b"NOFF", b"CNOFF")


def off_layout(data: bytes, content: FileContent) -> Layout:
    """The layout of an OFF file that was read as `content`."""
    assert content.polygons is not None
    polygons = content.polygons
    words = words_of(_COMMENT.sub(lambda found: b" " * len(found[0]), data))
    header = data[words.starts[0] : words.ends[0]]
    # the counts may follow on the header's own line
    alone = len(words.first_of_line) > 1 and words.first_of_line[1] == 1
    begin = 2 if alone else 1
    rows = words.first_of_line[begin : begin + len(content.vertices)]
    directions: tuple[Directions, ...] = ()
    if header in _WITH_NORMALS:
        directions = (Directions(_vectors(data, words, rows + 3), polygons.corners),)
    return Layout(
        data=data,
        points=_vectors(data, words, rows),
        corners=polygons.corners,
        sizes=polygons.sizes,
        directions=directions,
    )


def _vectors(data: bytes, words: Words, first: np.ndarray) -> TextSlots:
    places = np.minimum(first[:, None] + np.arange(3), len(words.starts) - 1)
    return TextSlots(data, words.starts[places], words.ends[places])
