"""TetGen's pairs of text files (.node, .ele).

We do not use meshio's reader: it hangs on an empty or truncated file. Format: H. Si, TetGen user's
manual, section 5.2.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .file_content import FileContent
from .labelled_rows import first_label, parse_labelled_rows
from .number_text import as_integers

_KINDS = {4: "tetra", 10: "tetra10"}


def read_tetgen(path: Path) -> FileContent:
    """Read a pair of files, given either one; ValueError if it is not such a pair.

    Numbering starts at 0 or 1, like that of the vertices.
    """
    sibling = path.with_suffix(".ele" if path.suffix.lower() == ".node" else ".node")
    if not sibling.is_file():
        raise ValueError(f"TetGen's {sibling.name} must be beside it, but is not there")
    nodes, elements = (path, sibling) if sibling.suffix == ".ele" else (sibling, path)
    vertices = parse_labelled_rows(_lines(nodes), columns=4, what="vertices")
    base = first_label(vertices, what="vertices")
    lines = _lines(elements)
    header = lines[0].split() if lines else []
    corners = int(header[1]) if len(header) > 1 and header[1].isdecimal() else 4
    if corners not in _KINDS:
        raise ValueError(f"its elements have {corners} corners; 4 are needed")
    rows = as_integers(parse_labelled_rows(lines, columns=1 + corners, what="tets"), what="tets")
    return FileContent(np.ascontiguousarray(vertices[:, 1:]), {_KINDS[corners]: rows[:, 1:] - base})


def _lines(path: Path) -> list[str]:
    raw = path.read_text(encoding="utf-8-sig", errors="replace").splitlines()
    return [line for text in raw if (line := text.partition("#")[0].strip())]
