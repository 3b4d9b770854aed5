"""Checkpoint: finished samples on disk, so that an interrupted run can continue."""

from __future__ import annotations

import hashlib
import json
import shutil
import warnings
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arguments import as_path
from ..disk import flushed_folder
from ..notice import Notice
from ..problem import Problem
from .sample_file import Samples, read_indices, read_run, read_samples, write_samples
from .snapshots import SampleReport

FloatArray = NDArray[np.float64]


class CheckpointNotice(Notice):
    """A checkpoint's file cannot be written, or is damaged and its samples are solved again."""


class UnsavedSamplesError(ValueError):
    """Finished samples could not be written. The error has them, so that they can be saved later.

    indices, displacements, reports : the arguments of the `Checkpoint.save` that failed
    """

    def __init__(
        self,
        message: str,
        indices: Sequence[int],
        displacements: Sequence[FloatArray],
        reports: Sequence[SampleReport],
    ) -> None:
        super().__init__(message)
        self.indices = indices
        self.displacements = displacements
        self.reports = reports


def run_key(problem: Problem, parameters: FloatArray, options: dict[str, Any]) -> str:
    """Hash of everything that the solutions depend on, 16 hex digits."""
    content = {"problem": problem.fingerprint, **options}
    digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode())
    digest.update(np.ascontiguousarray(parameters, dtype="<f8").tobytes())
    return digest.hexdigest()[:16]


class Checkpoint:
    """A folder of finished samples for one run: the same problem, samples and solver options.

    `solve_snapshots` refuses the folder of another run, since its shapes are for other parameters.

    Parameters
    ----------
    folder : Path
        The folder, created when the first samples are saved. Each save adds one file that is either
        complete or absent, even if the process is killed. A checksum detects later damage.
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = as_path("Checkpoint", folder, what="folder")

    def __repr__(self) -> str:
        return f"Checkpoint({str(self.folder)!r})"

    @classmethod
    def beside(cls, output: Path, key: str) -> Checkpoint:
        """The checkpoint of a run that writes `output`: a folder beside it, named by its key."""
        return cls(output.with_name(f"{output.name}.partial-{key}"))

    def save(
        self,
        indices: Sequence[int],
        displacements: Iterable[FloatArray],
        reports: Sequence[SampleReport],
        *,
        run: str = "",
    ) -> list[FloatArray]:
        """Adds finished samples: their numbers, displacements (3n,) and reports.

        `run` is the `run_key` of the run that solved them.

        Returns
        -------
        list of (3n,)
            The same displacements, mapped read-only from the file; the caller can drop its own.

        Raises
        ------
        UnsavedSamplesError
            A ValueError: the folder or the file cannot be written, for instance because the disk
            is full. Samples saved before are kept, and no part of the new file is left behind.
        """
        rows = list(displacements)
        path = self.folder / f"samples-{min(indices):05d}-{len(indices)}.safetensors"
        try:
            if not self.folder.is_dir():
                self.folder.mkdir(parents=True, exist_ok=True)
                flushed_folder(self.folder.parent)
            write_samples(path, indices, rows, reports, run=run)
            samples = read_samples(path)
        except (OSError, ValueError) as error:
            reason = str(error).removeprefix(f"{path}: ")
            size = 1e-6 * sum(row.nbytes for row in rows)
            raise UnsavedSamplesError(
                f"{self.folder}: {len(indices)} finished samples, {size:.1f} MB, are not saved: "
                f"{reason}; {len(self.numbers())} samples are kept there, and once the cause is "
                "removed the same call continues from them",
                indices,
                rows,
                reports,
            ) from None
        return [samples[int(index)][0] for index in indices]

    def load(self, *, run: str = "") -> Samples:
        """All finished samples by number: displacements (3n,) mapped from the files, and reports.

        Damaged files are skipped with a `CheckpointNotice`. Raises ValueError for samples of a run
        other than the given one; without a key, samples of any run are loaded.
        """
        found: Samples = {}
        for path in self._files():
            try:
                found.update(read_samples(path))
                solved_by = read_run(path)
            except (OSError, ValueError) as error:
                reason = getattr(error, "strerror", None) or error
                notice = f"{path}: not used ({reason}); its samples are solved again"
                warnings.warn(notice, CheckpointNotice, stacklevel=2)
                continue
            if run and solved_by not in ("", run):
                raise ValueError(
                    f"{self.folder}: these samples are of another run: the problem, the parameters "
                    "or the solver options differ; give another folder, or delete this one with "
                    "Checkpoint.remove()"
                )
        return found

    def numbers(self) -> set[int]:
        """Numbers of the finished samples, from the files' headers and sizes: fast."""
        numbers: set[int] = set()
        for path in self._files():
            try:
                numbers.update(read_indices(path))
            except (OSError, ValueError):
                continue  # `load` warns about it
        return numbers

    def remove(self) -> None:
        """Deletes the folder, once the result is safe elsewhere.

        Rows that are still mapped remain usable. Systems that cannot delete mapped files (Windows)
        keep the files.
        """
        shutil.rmtree(self.folder, ignore_errors=True)

    def _files(self) -> Iterator[Path]:
        return iter(sorted(self.folder.glob("samples-*.safetensors")))
