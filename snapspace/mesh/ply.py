"""Stanford polygon files (.ply): reads ASCII and binary in both byte orders, writes binary.

We do not use meshio's reader: it supports neither `vertex_index` (a common name of the faces'
property) nor 16-bit types nor elements other than vertices and faces.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .arrays import FloatArray, IndexArray
from .file_content import FileContent
from .number_text import as_integers
from .ply_body import ENCODINGS, PlyBody, PlyElement, PlyProperty
from .polygons import surface_content

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip


def read_ply(data: bytes) -> FileContent:
    """Read vertices and faces. Polygons become fans, and the order of the vertices is kept."""
    encoding, elements, start = ply_header(data)
    body = PlyBody(data[start:], encoding)
    vertices: NDArray[np.float64] | None = None
    indices, sizes = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    for element in elements:
        columns = body.read(element)
        if element.name == "vertex":
            if not {"x", "y", "z"} <= columns.keys():
                raise ValueError("its vertices have no x, y, z")
            vertices = np.stack([columns[axis].values for axis in "xyz"], axis=1)
        elif element.name == "face":
            corners = columns.get("vertex_indices", columns.get("vertex_index"))
            if corners is None:
                raise ValueError("its faces have no vertex_indices")
            indices, sizes = _indices(corners.values), corners.sizes
    if vertices is None:
        raise ValueError("it has no vertices")
    return surface_content(vertices.astype(np.float64), indices, sizes)


def write_ply(path: Path, vertices: FloatArray, faces: IndexArray) -> None:
    """Write a binary little-endian file: double coordinates, int32 triangles."""
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = np.empty(len(faces), dtype=[("size", "u1"), ("corners", "<i4", (3,))])
    rows["size"], rows["corners"] = 3, faces
    path.write_bytes(header.encode() + vertices.astype("<f8").tobytes() + rows.tobytes())


def ply_header(data: bytes) -> tuple[str, list[PlyElement], int]:
    """Encoding, elements, and where the rows start; ValueError if it is not a header."""
    marker = data.find(b"\nend_header")
    start = data.find(b"\n", marker + 1) + 1
    if data[:3] != b"ply" or marker < 0 or start == 0:
        raise ValueError("it does not begin with a header from ply to end_header")
    encoding = ""
    elements: list[PlyElement] = []
    for line in data[:marker].decode("latin-1").splitlines():
        match line.split():
            case ["format", name, *_]:
                encoding = name
            case ["element", name, count]:
                elements.append(PlyElement(name, _count(count)))
            case ["property", "list", size, kind, name] if elements:
                elements[-1].properties.append(PlyProperty(name, _type(size), _type(kind)))
            case ["property", kind, name] if elements:
                elements[-1].properties.append(PlyProperty(name, "", _type(kind)))
    if encoding not in ENCODINGS:
        raise ValueError(f"its format is {encoding[:40]!r}; known are {', '.join(ENCODINGS)}")
    return encoding, elements, start


def _indices(values: NDArray[Any]) -> NDArray[np.int64]:
    """Vertex indices. Indices from text are doubles, and may not be whole numbers."""
    if values.dtype.kind == "f":
        return as_integers(values.astype(np.float64), what="vertex_indices")
    return values.astype(np.int64)


def _count(word: str) -> int:
    if not word.isdecimal():
        raise ValueError(f"the count of an element is {word[:40]!r}")
    return int(word)


def _type(name: str) -> str:
    if name not in _TYPES:
        raise ValueError(f"the type {name[:40]!r} is not known")
    return _TYPES[name]
