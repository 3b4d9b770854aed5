"""Wavefront OBJ surfaces (.obj): `v` and `f` lines; everything else is skipped."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .arrays import FloatArray, IndexArray
from .file_content import FileContent
from .polygons import corner_array, surface_content


def read_obj(data: bytes) -> FileContent:
    """Read vertices and faces. Polygons become fans, and the order of the vertices is kept.

    Faces may have the forms `i`, `i/t`, `i/t/n`, `i//n`, with negative (relative) indices.
    """
    coordinates: list[list[str]] = []
    corners: list[int] = []
    normals: list[int] = []
    normals_so_far = 0
    sizes: list[int] = []
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
            polygon = [_corner(word, len(coordinates), number) for word in words[1:]]
            corners += polygon
            normals += [corner_attribute(word, 2, normals_so_far) for word in words[1:]]
            sizes.append(len(polygon))
        elif words[0] == "vn":
            normals_so_far += 1
    try:
        vertices = np.array(coordinates, dtype=np.float64).reshape(-1, 3)
    except ValueError:
        raise ValueError("a vertex has a coordinate that is not a number") from None
    # a normal that does not exist is none
    used = np.array(normals, dtype=np.int64)
    used[(used < 0) | (used >= normals_so_far)] = -1
    return surface_content(vertices, corner_array(corners), sizes, used)


def write_obj(path: Path, vertices: FloatArray, faces: IndexArray) -> None:
    """Write triangles, and vertices with all digits: reading gives the same numbers."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (faces + 1).tolist()]
    path.write_text("\n".join(lines) + "\n", encoding="ascii", newline="\n")


def _corner(word: str, vertices_so_far: int, line: int) -> int:
    try:
        index = int(word.split("/", 1)[0])
    except ValueError:
        raise ValueError(f"line {line}: {word[:40]!r} is not a corner of a face") from None
    if index == 0:
        raise ValueError(f"line {line}: a face has vertex index 0, but OBJ counts from 1")
    # a relative index that reaches before the first vertex stays negative and is refused later
    return index - 1 if index > 0 else vertices_so_far + index


def corner_attribute(word: str, place: int, so_far: int) -> int:
    """An index in a corner `i/t/n`: place 1 is its texture coordinate, place 2 its normal.

    `so_far` is the number of these lines up to there, for relative indices. -1 for none, or one
    that is no number.
    """
    parts = word.split("/", 2)
    if len(parts) <= place or not parts[place].lstrip("-").isdecimal() or len(parts[place]) > 18:
        return -1
    index = int(parts[place])
    return index - 1 if index > 0 else so_far + index
