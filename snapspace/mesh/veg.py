"""VegaFEM text files (.veg): sections *VERTICES, *ELEMENTS TET, *INCLUDE.

Format: J. Barbic, F. S. Sin, D. Schroeder, Vega FEM Library, user's manual. Materials, sets and
regions are skipped.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from .file_content import FileContent
from .labelled_rows import first_label, parse_labelled_rows
from .number_text import as_integers

_KINDS = {"TET": ("tetra", 4), "TETS": ("tetra", 4), "CUBIC": ("hexahedron", 8)}
_DEEPEST_INCLUDE = 8


def read_veg(path: Path) -> FileContent:
    """Read vertices and elements of a VegaFEM file; ValueError if it is not one.

    Numbering starts at 0 or 1, like that of the vertices.
    """
    sections = _sections(path)
    if "VERTICES" not in sections or "ELEMENTS" not in sections:
        raise ValueError("it needs the sections *VERTICES and *ELEMENTS, as VegaFEM files have")
    table = parse_labelled_rows(sections["VERTICES"], columns=4, what="vertices")
    base = first_label(table, what="vertices")
    lines = sections["ELEMENTS"]
    name = lines[0].upper() if lines else ""
    if name not in _KINDS:
        raise ValueError(f"its elements are {name[:40]!r}; TET is needed")
    kind, corners = _KINDS[name]
    rows = as_integers(
        parse_labelled_rows(lines[1:], columns=1 + corners, what="elements"), what="elements"
    )
    return FileContent(np.ascontiguousarray(table[:, 1:4]), {kind: rows[:, 1:] - base})


def _sections(path: Path) -> dict[str, list[str]]:
    """Lines of each section; a second section of the same name (sets, regions) is left out."""
    sections: dict[str, list[str]] = {}
    current: list[str] = []
    for line in _lines(path, depth=0):
        if line.startswith("*"):
            current = []
            sections.setdefault(line[1:].split()[0].upper() if line[1:].split() else "", current)
        else:
            current.append(line)
    return sections


def _lines(path: Path, *, depth: int) -> Iterator[str]:
    """Lines without comments and blanks; included files are spliced in."""
    if depth > _DEEPEST_INCLUDE:
        raise ValueError(f"*INCLUDE is nested more than {_DEEPEST_INCLUDE} files deep: {path.name}")
    for raw in path.read_text(encoding="utf-8-sig", errors="replace").splitlines():
        line = raw.partition("#")[0].strip()
        if line[:8].upper() == "*INCLUDE":
            included = path.parent / line[8:].strip()
            if not included.is_file():
                raise ValueError(f"it includes {included.name}, which does not exist")
            yield from _lines(included, depth=depth + 1)
        elif line:
            yield line
