"""Files beside a surface file: its materials and textures."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from ...disk.atomic_file import atomic_file
from .layout import Layout
from .mtl import pictures

#: Files of more bytes than this are not read: no material is that large.
LARGEST = 1 << 26


def files_beside(layout: Layout, folder: Path) -> dict[str, bytes]:
    """The files that a layout refers to, and the pictures that its materials name, by name.

    Those that are missing, too large, or not in the folder or below it are left out.
    """
    found = _read(layout.refers_to, folder)
    for name, content in list(found.items()):
        if name.lower().endswith(".mtl"):
            found |= _read(pictures(content.decode("utf-8-sig", "replace")), folder)
    return found


def write_beside(files: Mapping[str, bytes], folder: Path) -> None:
    """Writes files into a folder or below it; those that exist stay as they are.

    Names that lead out of the folder are left out: they may come from a stranger's model.
    """
    for name, content in files.items():
        path = _inside(folder, name)
        if path is None or path.exists():
            continue
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ValueError(f"{path.parent}: cannot be created ({error.strerror})") from None
        with atomic_file(path) as temporary:
            temporary.write_bytes(content)


def _inside(folder: Path, name: str) -> Path | None:
    """The path of a name, None if it is not in the folder or below it."""
    path = (folder / name.replace("\\", "/")).resolve()
    return path if path.is_relative_to(folder.resolve()) else None


def _read(names: Iterable[str], folder: Path) -> dict[str, bytes]:
    found = {}
    for name in dict.fromkeys(names):
        try:
            path = _inside(folder, name)
            if path is not None and path.is_file() and path.stat().st_size <= LARGEST:
                found[name] = path.read_bytes()
        except (OSError, ValueError):
            continue
    return found
