"""MEDIT ASCII files (.mesh).

We do not use meshio's reader: it rounds the coordinates of `MeshVersionFormatted 1` files to single
precision, which can invert slivers (fTetWild and libigl write full precision under that header).
Format: P. Frey, MEDIT: an interactive mesh visualization software, INRIA RT-0253.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .file_content import CellArray, FileContent
from .number_text import as_integers, parse_numbers, take_table

_CELLS = {
    "edges": ("line", 2),
    "triangles": ("triangle", 3),
    "quadrilaterals": ("quad", 4),
    "tetrahedra": ("tetra", 4),
    "tetrahedrap2": ("tetra10", 10),
    "prisms": ("wedge", 6),
    "pyramids": ("pyramid", 5),
    "hexahedra": ("hexahedron", 8),
    "hexaedra": ("hexahedron", 8),
}
_KEYWORD = re.compile(r"(?<!\S)(?!(?:nan|inf|infinity)(?!\S))[A-Za-z]\w*", re.IGNORECASE)


def read_medit(path: Path) -> FileContent:
    """Read vertices and cells of a MEDIT ASCII file; ValueError if it is not one."""
    text = path.read_text(encoding="utf-8-sig", errors="replace")
    if "#" in text:
        text = re.sub(r"#[^\n]*", "", text)
    keywords = list(_KEYWORD.finditer(text))
    if not keywords or keywords[0].group().lower() != "meshversionformatted":
        raise ValueError("it does not begin with MeshVersionFormatted, as MEDIT files do")
    vertices: NDArray[np.float64] | None = None
    cells: dict[str, CellArray] = {}
    dimension = 3
    ends = [keyword.start() for keyword in keywords[1:]] + [len(text)]
    for keyword, end in zip(keywords, ends, strict=True):
        name = keyword.group().lower()
        body = text[keyword.end() : end]
        if name == "dimension":
            dimension = _count(parse_numbers(body, what="Dimension"), "Dimension")
        elif name == "vertices":
            vertices = _rows(body, dimension + 1, "vertices")[:, :dimension]
        elif name in _CELLS:
            kind, corners = _CELLS[name]
            rows = as_integers(_rows(body, corners + 1, name), what=name)[:, :corners] - 1
            cells[kind] = np.concatenate([cells[kind], rows]) if kind in cells else rows
    if dimension != 3:
        raise ValueError(f"it is {dimension}-dimensional; 3 dimensions are needed")
    if vertices is None:
        raise ValueError("it has no Vertices")
    return FileContent(vertices, cells)


def _rows(body: str, columns: int, what: str) -> NDArray[np.float64]:
    numbers = parse_numbers(body, what=what)
    count = _count(numbers, what)
    if numbers.size > 1 + count * columns:
        raise ValueError(f"{count} {what} are announced, but the file holds more numbers than that")
    return take_table(numbers, start=1, rows=count, columns=columns, what=what)


def _count(numbers: NDArray[np.float64], what: str) -> int:
    if not numbers.size:
        raise ValueError(f"no number follows {what}: it is incomplete")
    count = int(as_integers(numbers[:1], what=what)[0])
    if count < 0:
        raise ValueError(f"the number of {what} is {count}")
    return count
