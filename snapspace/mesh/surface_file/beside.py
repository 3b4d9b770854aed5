"""Files beside a surface file: its materials and textures."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from .layout import Layout
from .mtl import pictures

#: More bytes than this are not read: no material is so large.
LARGEST = 1 << 26


def files_beside(layout: Layout, folder: Path) -> dict[str, bytes]:
    """The files that a layout refers to, and the pictures that its materials name, by name.

    Those that are missing, too large, or not in the folder or below it are left out.
    """
    found = _read(layout.refers_to, folder)
    for name, content in list(found.items()):
        if name.lower().endswith(".mtl"):
            found |= _read(pictures(content.decode("utf-8", "replace")), folder)
    return found


def _read(names: Iterable[str], folder: Path) -> dict[str, bytes]:
    found = {}
    for name in dict.fromkeys(names):
        try:
            path = (folder / name.replace("\\", "/")).resolve()
            inside = path.is_relative_to(folder.resolve())
            if inside and path.is_file() and path.stat().st_size <= LARGEST:
                found[name] = path.read_bytes()
        except (OSError, ValueError):
            continue
    return found
