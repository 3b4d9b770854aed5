"""Filled and fitted poses on disk, so that an interrupted `interpolate` can go on."""

from __future__ import annotations

import contextlib
import hashlib
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError, safe_open
from safetensors.numpy import save

from .. import __version__
from ..fitting import PoseFit
from ..mesh import EmbeddedSurface, TetMesh
from ..mesh.atomic_file import atomic_file

FloatArray = NDArray[np.float64]
Settings = dict[str, Any]
_UNREADABLE = (SafetensorError, OSError, KeyError, TypeError, ValueError)


class FitCache:
    """A folder with one file for the tets and one for each fitted pose, named by what made them.

    A file is complete or not there; one that cannot be read is made again.
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
        """The tets that fill a surface, if they are there."""
        try:
            arrays, _ = self._load(_key("tets", settings, vertices, faces))
            return TetMesh(arrays["vertices"], arrays["tets"])
        except _UNREADABLE:
            return None

    def save_tets(
        self, vertices: FloatArray, faces: NDArray[np.int32], settings: Settings, mesh: TetMesh
    ) -> None:
        """Keeps the tets that fill a surface."""
        key = _key("tets", settings, vertices, faces)
        self._save(key, {"vertices": mesh.vertices, "tets": mesh.tets}, {})

    def load_fit(
        self, mesh: TetMesh, surface: EmbeddedSurface, target: FloatArray, settings: Settings
    ) -> tuple[FloatArray, PoseFit] | None:
        """The shape (n, 3) fitted to a target (s, 3), and its report, if they are there."""
        try:
            arrays, header = self._load(_fit_key(mesh, surface, target, settings))
            return arrays["shape"], PoseFit(**json.loads(header["fit"]))
        except _UNREADABLE:
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
        """Keeps a fitted shape and its report."""
        key = _fit_key(mesh, surface, target, settings)
        self._save(key, {"shape": shape}, {"fit": json.dumps(asdict(fit))})

    def remove(self) -> None:
        """Deletes what is kept, after the result is safe elsewhere; files of others stay."""
        with contextlib.suppress(OSError):
            for path in self.folder.glob("*.safetensors"):
                path.unlink()
            self.folder.rmdir()

    def _load(self, key: str) -> tuple[dict[str, NDArray[Any]], dict[str, str]]:
        with safe_open(self.folder / f"{key}.safetensors", framework="np") as file:
            arrays = {name: file.get_tensor(name) for name in file.keys()}
            return arrays, dict(file.metadata() or {})

    def _save(self, key: str, arrays: dict[str, NDArray[Any]], header: dict[str, str]) -> None:
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ValueError(f"{self.folder}: cannot make the folder ({error})") from None
        content = {name: np.ascontiguousarray(array) for name, array in arrays.items()}
        with atomic_file(self.folder / f"{key}.safetensors") as path:
            path.write_bytes(save(content, header))


def _fit_key(
    mesh: TetMesh, surface: EmbeddedSurface, target: FloatArray, settings: Settings
) -> str:
    tets = {**settings, "mesh": mesh.fingerprint}
    return _key("pose", tets, target, surface.corners, surface.weights, surface.faces)


def _key(kind: str, settings: Settings, *arrays: NDArray[Any]) -> str:
    # another version may fill and fit in another way
    content = {**settings, "snapspace": __version__}
    digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode())
    for array in arrays:
        digest.update(f"{array.dtype.str} {array.shape}\n".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return f"{kind}-{digest.hexdigest()[:16]}"
