"""Object File Format surfaces (.off): a header, vertices, polygons."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .arrays import FloatArray, IndexArray
from .file_content import FileContent
from .number_text import as_integers, parse_numbers, take_table
from .polygons import corner_array, surface_content

_HEADERS = ("OFF", "COFF", "NOFF", "CNOFF", "STOFF")


def read_off(data: bytes) -> FileContent:
    """Read vertices and faces. Polygons become fans; colours and normals are skipped."""
    text = data.decode("utf-8", errors="replace")
    lines = [line for raw in text.splitlines() if (line := raw.partition("#")[0].strip())]
    header = lines[0].split() if lines else []
    if not header or header[0] not in _HEADERS:
        raise ValueError("it does not begin with OFF")
    # the counts may follow on the header's own line
    lines[0] = " ".join(header[1:])
    lines = lines[1:] if len(header) == 1 else lines
    counts = as_integers(parse_numbers(lines[0] if lines else "", what="the counts"), what="counts")
    if counts.size < 2 or counts.min() < 0:
        raise ValueError("the numbers of vertices and faces are missing: it is incomplete")
    vertex_count, face_count = int(counts[0]), int(counts[1])
    if len(lines) < 1 + vertex_count + face_count:
        raise ValueError(
            f"{vertex_count} vertices and {face_count} faces are announced, but the file holds "
            f"{len(lines) - 1} lines: it is incomplete"
        )
    corners, sizes = _polygons(lines[1 + vertex_count : 1 + vertex_count + face_count])
    return surface_content(_vertices(lines[1 : 1 + vertex_count]), corners, sizes)


def write_off(path: Path, vertices: FloatArray, faces: IndexArray) -> None:
    """Write triangles, and vertices with all digits."""
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
    lines += [f"{x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    lines += [f"3 {a} {b} {c}" for a, b, c in faces.tolist()]
    path.write_text("\n".join(lines) + "\n", encoding="ascii", newline="\n")


def _vertices(lines: list[str]) -> FloatArray:
    if not lines:
        return np.empty((0, 3))
    width = len(lines[0].split())
    numbers = parse_numbers("\n".join(lines), what="vertices")
    if width < 3 or numbers.size != width * len(lines):
        raise ValueError("its vertices do not all have the same number of coordinates (3 or more)")
    table = take_table(numbers, start=0, rows=len(lines), columns=width, what="vertices")
    return np.ascontiguousarray(table[:, :3])


def _polygons(lines: list[str]) -> tuple[np.ndarray[tuple[int], np.dtype[np.int64]], list[int]]:
    corners: list[int] = []
    sizes: list[int] = []
    for number, line in enumerate(lines):
        words = line.split()
        try:
            size = int(words[0])
            polygon = [int(word) for word in words[1 : 1 + size]]
        except ValueError:
            raise ValueError(f"face {number} is not a list of indices: {line[:40]!r}") from None
        if len(polygon) != size:
            raise ValueError(f"face {number} announces {size} corners, but has {len(polygon)}")
        corners += polygon
        sizes.append(size)
    return corner_array(corners), sizes
