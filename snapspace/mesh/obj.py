"""Wavefront OBJ surfaces (.obj): `v` and `f` lines; everything else is skipped."""

from __future__ import annotations

from itertools import repeat
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray, IndexArray
from .file_content import FileContent
from .polygons import corner_array, surface_content

IndexArray64 = NDArray[np.int64]


def read_obj(data: bytes) -> FileContent:
    """Read vertices and faces. Polygons become fans, and the order of the vertices is kept.

    Faces may have the forms `i`, `i/t`, `i/t/n`, `i//n`, with negative (relative) indices.
    """
    coordinates: list[list[str]] = []
    faces = _Faces()
    normals_so_far = 0
    text = data.decode("utf-8", errors="replace").replace("\\\n", " ")
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.partition("#")[0].split()
        if not words:
            continue
        if words[0] == "v":
            if len(words) < 4:
                raise ValueError(f"line {number}: a vertex needs three coordinates")
            coordinates.append(words[1:4])
        elif words[0] == "f":
            faces.add(words[1:], number, len(coordinates), normals_so_far)
        elif words[0] == "vn":
            normals_so_far += 1
    try:
        vertices = np.array(coordinates, dtype=np.float64).reshape(-1, 3)
    except ValueError:
        raise ValueError("a vertex has a coordinate that is not a number") from None
    corners = faces.corners(len(vertices))
    return surface_content(vertices, corners, faces.sizes, faces.normals(normals_so_far))


def write_obj(path: Path, vertices: FloatArray, faces: IndexArray) -> None:
    """Write triangles, and vertices with all digits: reading gives the same numbers."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (faces + 1).tolist()]
    path.write_text("\n".join(lines) + "\n", encoding="ascii", newline="\n")


class _Faces:
    """The `f` lines; their corners are converted together, because files have millions."""

    def __init__(self) -> None:
        self.sizes: list[int] = []
        self._words: list[str] = []
        self._lines: list[int] = []
        self._vertices: list[int] = []
        self._normals: list[int] = []

    def add(self, words: list[str], line: int, vertices_so_far: int, normals_so_far: int) -> None:
        self.sizes.append(len(words))
        self._words += words
        self._lines.append(line)
        self._vertices.append(vertices_so_far)
        self._normals.append(normals_so_far)

    def corners(self, count: int) -> IndexArray64:
        """The vertex of each corner; ValueError if one is not an index of `count` vertices."""
        try:
            given = [int(word.partition("/")[0]) for word in self._words]
        except ValueError:
            raise ValueError(self._first_fault()) from None
        if 0 in given:
            line = self._line(given.index(0))
            raise ValueError(f"line {line}: a face has vertex index 0, but OBJ counts from 1")
        indices = corner_array([index - 1 if index > 0 else index for index in given])
        so_far = np.repeat(np.array(self._vertices, np.int64), self.sizes)
        absolute = np.where(indices < 0, indices + so_far, indices)
        wrong = np.flatnonzero((absolute < 0) | (absolute >= count))
        if wrong.size:
            place = int(wrong[0])
            raise ValueError(
                f"line {self._line(place)}: a face has vertex index {given[place]}, but the file "
                f"has {count} vertices"
            )
        return absolute

    def normals(self, count: int) -> IndexArray64 | None:
        """The normal of each corner, -1 for none or one that does not exist; None without any."""
        if not count:
            return None
        so_far = np.repeat(self._normals, self.sizes).tolist()
        attributes = map(corner_attribute, self._words, repeat(2), so_far)
        used = np.fromiter(attributes, np.int64, len(self._words))
        used[(used < 0) | (used >= count)] = -1
        return used

    def _first_fault(self) -> str:
        for place, word in enumerate(self._words):
            try:
                int(word.partition("/")[0])
            except ValueError:
                return f"line {self._line(place)}: {word[:40]!r} is not a corner of a face"
        raise AssertionError("all corners are indices")

    def _line(self, corner: int) -> int:
        ends = np.cumsum(self.sizes)
        return self._lines[int(np.searchsorted(ends, corner, side="right"))]


def corner_attribute(word: str, place: int, so_far: int) -> int:
    """An index in a corner `i/t/n`: place 1 is its texture coordinate, place 2 its normal.

    `so_far` is the number of such lines so far, for relative indices. -1 for none, or one that is
    not a number.
    """
    parts = word.split("/", 2)
    if len(parts) <= place or not parts[place].lstrip("-").isdecimal() or len(parts[place]) > 18:
        return -1
    index = int(parts[place])
    return index - 1 if index > 0 else so_far + index
