"""Checkpoint: finished samples on disk, so that an interrupted run can go on."""

from __future__ import annotations

import hashlib
import json
import shutil
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError
from safetensors.numpy import load_file, save

from ..mesh.atomic_file import atomic_file
from ..problem import Problem
from .snapshots import SampleReport

FloatArray = NDArray[np.float64]


def run_key(problem: Problem, parameters: FloatArray, options: dict[str, Any]) -> str:
    """Hash of everything that the solutions depend on, 16 hex digits."""
    content = {"problem": problem.fingerprint, **options}
    digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode())
    digest.update(np.ascontiguousarray(parameters, dtype="<f8").tobytes())
    return digest.hexdigest()[:16]


class Checkpoint:
    """A folder of finished samples for one run: the same problem, samples and solver options.

    Parameters
    ----------
    folder : Path
        Made when the first samples are saved. Each save adds one file that is either complete or
        not there.
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)

    @classmethod
    def beside(cls, output: Path, key: str) -> Checkpoint:
        """The checkpoint of a run that writes `output`: a folder beside it, named by its key."""
        return cls(output.with_name(f"{output.name}.partial-{key}"))

    def save(
        self, indices: Sequence[int], shapes: FloatArray, reports: Sequence[SampleReport]
    ) -> None:
        """Adds finished samples: their numbers, displacements (j, 3n) and reports.

        Raises
        ------
        ValueError
            If the folder or the file cannot be written.
        """
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ValueError(f"{self.folder}: cannot make the checkpoint ({error})") from None
        content = save(
            {"indices": np.asarray(indices, np.int64), "shapes": np.ascontiguousarray(shapes)},
            {"reports": json.dumps([asdict(report) for report in reports])},
        )
        with atomic_file(
            self.folder / f"samples-{min(indices):05d}-{len(indices)}.safetensors"
        ) as path:
            path.write_bytes(content)

    def load(self) -> dict[int, tuple[FloatArray, SampleReport]]:
        """All finished samples by number: displacements (3n,) and report.

        Files that are not readable are skipped: their samples are solved again.
        """
        found: dict[int, tuple[FloatArray, SampleReport]] = {}
        for path in sorted(self.folder.glob("samples-*.safetensors")):
            try:
                tensors = load_file(path)
                reports = [
                    SampleReport(**entry) for entry in json.loads(_metadata(path)["reports"])
                ]
                samples = zip(tensors["indices"], tensors["shapes"], reports, strict=True)
                found.update({int(index): (shape, report) for index, shape, report in samples})
            except (SafetensorError, OSError, KeyError, ValueError, TypeError):
                continue
        return found

    def remove(self) -> None:
        """Deletes the folder, after the result is safe elsewhere."""
        shutil.rmtree(self.folder, ignore_errors=True)


def _metadata(path: Path) -> dict[str, str]:
    with path.open("rb") as file:
        size = int.from_bytes(file.read(8), "little")
        header: dict[str, Any] = json.loads(file.read(size))
    metadata: dict[str, str] = header["__metadata__"]
    return metadata
