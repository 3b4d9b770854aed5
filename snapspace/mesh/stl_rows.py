"""The two kinds of STL file: which kind a file is, and where its numbers are."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

#: A triangle of a binary file: 50 bytes.
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
#: Header and number of triangles of a binary file.
HEADER = 84

_WORD = rb"\s+([^\s]+)\s+([^\s]+)\s+([^\s]+)"
_VERTEX = re.compile(rb"(?i)\bvertex" + _WORD)
_NORMAL = re.compile(rb"(?i)\bfacet\s+normal" + _WORD)
_NO_STL = "it is not an STL file, or it is incomplete"

Spans = NDArray[np.int64]


def triangle_count(data: bytes) -> int | None:
    """Number of triangles of a binary file, None for a text file.

    The size decides: many programs begin binary files with "solid", the first word of text files.

    Raises
    ------
    ValueError
        If it is neither.
    """
    count = int.from_bytes(data[80:HEADER], "little") if len(data) >= HEADER else -1
    if count >= 0 and len(data) == HEADER + count * TRIANGLE.itemsize:
        return count
    begin = data[:2048].lower()
    if begin[:512].lstrip()[:5] == b"solid" and (b"facet" in begin or b"endsolid" in begin):
        return None
    if 0 < count <= (len(data) - HEADER) // TRIANGLE.itemsize:
        return count  # some programs add bytes at the end
    raise ValueError(_NO_STL)


def text_spans(data: bytes) -> tuple[Spans, Spans]:
    """Where the words of all vertices (3 t, 3, 2) and normals (t, 3, 2) of a text file are."""
    vertices, normals = (
        np.array([match.regs[1:] for match in pattern.finditer(data)], np.int64).reshape(-1, 3, 2)
        for pattern in (_VERTEX, _NORMAL)
    )
    if len(vertices) != 3 * len(normals):
        raise ValueError(f"{_NO_STL} ({len(vertices)} vertices of {len(normals)} triangles)")
    return vertices, normals
