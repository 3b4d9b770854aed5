"""SavedFiles: saves a page's work beside its mesh, and never overwrites other files."""

from __future__ import annotations

import contextlib
import itertools
import json
import os
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from ..disk.atomic_file import atomic_file
from ..mesh import Body as Mesh
from ..mesh import (
    EmbeddedSurface,
    MirrorPlane,
    TetMesh,
    boundary_surface,
    write_surface,
    write_tets,
)
from ..model_file import SUFFIX
from ..problem import PosingProblem, problem_content
from ..reduction import ReducedModel
from .bodies import PROBLEM_SUFFIX
from .body import Body
from .messages import HandleChoice, Saved

MESH_SUFFIX, SURFACE_SUFFIX = ".msh", ".obj"
LONGEST = 100


@dataclass
class SavedFiles:
    """Writes files of one page, and replaces only its own files.

    A file is its own if the page wrote it and nobody has changed it since.
    """

    _own: dict[Path, tuple[int, int]] = field(default_factory=dict)

    def save(
        self,
        body: Body,
        problem: PosingProblem,
        model: ReducedModel | None,
        *,
        name: str | None,
        request: int,
        up: str | None = None,
        mirror: MirrorPlane | None = None,
        painted: Sequence[HandleChoice] = (),
    ) -> Saved:
        """Writes problem file and model, and mesh and surface unless these are in a file already.

        Parameters
        ----------
        body : Body
        problem : PosingProblem
        model : ReducedModel or None
        name : str or None
            Name of the files, without an extension; None: the body's. If other files have that
            name, all become NAME-2, or NAME-3 and so on.
        request : int
            Number of the request, repeated in the answer.
        up : "x", "y" or "z", optional
            Axis that points up, for the problem file.
        mirror : MirrorPlane, optional
            For the problem file.
        painted : sequence of HandleChoice, optional
            Handles as vertices of the body's own surface, so that they look as they were painted.

        Returns
        -------
        Saved
            The paths. If writing fails, no incomplete file is left behind.

        Raises
        ------
        ValueError
            For an invalid file name, or a folder that cannot be written to.
        """
        folder = body.folder
        suffixes = [PROBLEM_SUFFIX]
        suffixes += [] if model is None else [SUFFIX]
        # a shell is its surface
        tets = body.mesh if body.file is None and isinstance(body.mesh, TetMesh) else None
        suffixes += [] if tets is None else [MESH_SUFFIX]
        surface = None if body.surface_file is not None else _own_surface(body)
        suffixes += [] if surface is None else [SURFACE_SUFFIX]
        named = body.name if name is None else checked_name(name)
        with self._reserved(folder, named, suffixes) as stem:
            mesh = body.file
            if tets is not None:
                mesh = folder / f"{stem}{MESH_SUFFIX}"
                self._write(mesh, partial(_write_tets, tets))
            shown = body.surface_file
            if surface is not None:
                shown = folder / f"{stem}{SURFACE_SUFFIX}"
                self._write(shown, partial(_write_surface, surface, body.mesh))
            content = problem_content(
                problem,
                None if mesh is None else os.path.relpath(mesh, folder),
                None if shown is None else os.path.relpath(shown, folder),
                up=up,
                mirror=mirror,
            )
            own = {handle.name: list(handle.vertices) for handle in painted}
            for entry in content["handles"]:
                if entry["name"] in own:
                    entry["painted"] = own[entry["name"]]
            file = folder / f"{stem}{PROBLEM_SUFFIX}"
            self._write(file, lambda path: _write_text(path, json.dumps(content) + "\n"))
            model_file = folder / f"{stem}{SUFFIX}"
            if model is not None:
                self._write(model_file, model.save)
        return Saved(
            request=request,
            problem=str(file),
            model=None if model is None else str(model_file),
            mesh=None if tets is None else str(mesh),
            surface=None if surface is None else str(shown),
        )

    @contextlib.contextmanager
    def _reserved(self, folder: Path, name: str, suffixes: list[str]) -> Iterator[str]:
        """Reserves the name, or the first numbered one that is free, for the block."""
        for number in itertools.count(1):
            stem = name if number == 1 else f"{name}-{number}"
            paths = [folder / f"{stem}{suffix}" for suffix in suffixes]
            if self._reserve(paths):
                break
        try:
            yield stem
        finally:
            self._drop_empty(paths)

    def _reserve(self, paths: list[Path]) -> bool:
        """Makes empty files with these names; False, and makes none, if another file has one."""
        try:
            for path in paths:
                if not self._is_own(path):
                    path.open("x").close()  # fails if the file exists, even as a dangling link
                    self._own[path] = _stamp(path)
        except FileExistsError:
            self._drop_empty(paths)
            return False
        except OSError as error:
            self._drop_empty(paths)
            raise ValueError(
                f"{paths[0].parent}: cannot be written to ({error.strerror}); start the server in "
                "another folder"
            ) from None
        return True

    def _drop_empty(self, paths: list[Path]) -> None:
        """Removes its own files that only reserve a name."""
        for path in paths:
            if self._is_own(path) and not path.stat().st_size:
                path.unlink()
                del self._own[path]

    def _is_own(self, path: Path) -> bool:
        with contextlib.suppress(OSError):
            return path in self._own and self._own[path] == _stamp(path)
        return False

    def _write(self, path: Path, write: Callable[[Path], object]) -> None:
        write(path)
        self._own[path] = _stamp(path)


def checked_name(name: str) -> str:
    """A name that is safe in any folder; ValueError for an unsafe one."""
    reserved = re.fullmatch(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", name, re.IGNORECASE)
    if not re.fullmatch(r"[\w][\w .+()-]*", name) or len(name) > LONGEST or reserved:
        raise ValueError(
            f"save: the name {name[:LONGEST]!r} is not a plain file name; use letters, digits, "
            f"spaces, . - _ + ( ), at most {LONGEST}"
        )
    return name.rstrip(" .")


def plain_name(name: str) -> str:
    """A safe file name: without folders, and with unsafe characters replaced."""
    last = re.split(r"[/\\]", name)[-1]
    cleaned = re.sub(r"[^\w .+()-]", "_", last).strip(" .-")
    return cleaned[-LONGEST:].lstrip(" .-") or "mesh"


def _own_surface(body: Body) -> EmbeddedSurface | None:
    """The surface to write: the user's, or that of a shell, which is its only file."""
    if body.surface is None and not isinstance(body.mesh, TetMesh):
        return boundary_surface(body.mesh)
    return body.surface


def _write_tets(tets: TetMesh, path: Path) -> None:
    write_tets(path, tets)


def _write_surface(surface: EmbeddedSurface, mesh: Mesh, path: Path) -> None:
    write_surface(path, surface.vertices(mesh.vertices), surface.faces)


def _write_text(path: Path, text: str) -> None:
    with atomic_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _stamp(path: Path) -> tuple[int, int]:
    """Inode and modification time, which change when a file is written."""
    state = path.stat()
    return state.st_ino, state.st_mtime_ns
