"""FitCache: filled and fitted poses on disk, so an interrupted `interpolate` can resume."""

from __future__ import annotations

import contextlib
import hashlib
import json
import warnings
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import __version__
from ..disk import flushed_folder, read_checked, write_checked
from ..fitting import PoseFit
from ..mesh import EmbeddedSurface, TetMesh
from ..snapshots import CheckpointNotice

FloatArray = NDArray[np.float64]
Settings = dict[str, Any]
# Errors raised by content that another version wrote.
_UNREADABLE = (KeyError, TypeError, ValueError)


class FitCache:
    """A folder with one file for the tets and one for each fitted pose, named by their inputs.

    A file is complete or absent, and has a checksum. A damaged file is made again, with a
    `CheckpointNotice`.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @classmethod
    def beside(cls, output: Path) -> FitCache:
        """The cache of a run that writes `output`: a folder beside it."""
        return cls(output.with_name(f"{output.name}.poses"))

    def load_tets(
        self, vertices: FloatArray, faces: NDArray[np.int32], settings: Settings
    ) -> TetMesh | None:
        """The tets that fill a surface, or None if they are not saved."""
        path = self._path(_key("tets", settings, vertices, faces))
        with _skipping_unusable(path, "the surface is filled again"):
            arrays, _ = self._load(path)
            return TetMesh(arrays["vertices"], arrays["tets"])
        return None

    def save_tets(
        self, vertices: FloatArray, faces: NDArray[np.int32], settings: Settings, mesh: TetMesh
    ) -> None:
        """Saves the tets that fill a surface."""
        key = _key("tets", settings, vertices, faces)
        self._save(key, {"vertices": mesh.vertices, "tets": mesh.tets}, {})

    def load_fit(
        self, mesh: TetMesh, surface: EmbeddedSurface, target: FloatArray, settings: Settings
    ) -> tuple[FloatArray, PoseFit] | None:
        """The shape (n, 3) fitted to a target (s, 3) and its report, or None if not saved."""
        path = self._path(_fit_key(mesh, surface, target, settings))
        with _skipping_unusable(path, "its pose is fitted again"):
            arrays, header = self._load(path)
            shape, fit = arrays["shape"], PoseFit(**json.loads(header["fit"]))
            if shape.shape != mesh.vertices.shape:
                raise ValueError("its shape is of another mesh")
            return shape, fit
        return None

    def save_fit(
        self,
        mesh: TetMesh,
        surface: EmbeddedSurface,
        target: FloatArray,
        settings: Settings,
        shape: FloatArray,
        fit: PoseFit,
    ) -> None:
        """Saves a fitted shape and its report."""
        key = _fit_key(mesh, surface, target, settings)
        self._save(key, {"shape": shape}, {"fit": json.dumps(asdict(fit))})

    def remove(self) -> None:
        """Deletes the saved files when the result is safe elsewhere; other files stay."""
        with contextlib.suppress(OSError):
            for path in self.folder.glob("*.safetensors"):
                path.unlink()
            self.folder.rmdir()

    def _path(self, key: str) -> Path:
        return self.folder / f"{key}.safetensors"

    def _load(self, path: Path) -> tuple[dict[str, NDArray[Any]], dict[str, str]]:
        """Arrays and header; FileNotFoundError, or ValueError if damaged or of other inputs."""
        if not path.is_file():
            raise FileNotFoundError(path)
        arrays, header = read_checked(path)
        if header["key"] != path.stem:
            raise ValueError("it was made from other inputs")
        return arrays, header

    def _save(self, key: str, arrays: dict[str, NDArray[Any]], header: dict[str, str]) -> None:
        if not self.folder.is_dir():
            try:
                self.folder.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                raise ValueError(f"{self.folder}: cannot create the folder ({error})") from None
            flushed_folder(self.folder.parent)
        write_checked(self._path(key), arrays, {**header, "key": key})


@contextlib.contextmanager
def _skipping_unusable(path: Path, consequence: str) -> Iterator[None]:
    """Leaves the block silently if a file is missing, and with a notice if it is damaged."""
    try:
        yield
    except FileNotFoundError:
        return
    except _UNREADABLE as error:
        reason = f"no entry {error}" if isinstance(error, KeyError) else error
        notice = f"{path}: not used ({reason}); {consequence}"
        warnings.warn(notice, CheckpointNotice, stacklevel=4)


def _fit_key(
    mesh: TetMesh, surface: EmbeddedSurface, target: FloatArray, settings: Settings
) -> str:
    tets = {**settings, "mesh": mesh.fingerprint}
    return _key("pose", tets, target, surface.corners, surface.weights, surface.faces)


def _key(kind: str, settings: Settings, *arrays: NDArray[Any]) -> str:
    # another version may fill and fit differently
    content = {**settings, "snapspace": __version__}
    digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode())
    for array in arrays:
        digest.update(f"{array.dtype.str} {array.shape}\n".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return f"{kind}-{digest.hexdigest()[:16]}"
