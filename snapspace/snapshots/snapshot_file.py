"""Files of snapshots: full solutions with their parameters, for use in another run."""

from __future__ import annotations

import json
import os
import zlib
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError, safe_open

from ..arguments import as_path, wrong_type
from ..disk.atomic_file import atomic_file
from ..disk.safetensors_bytes import safetensors_bytes
from ..displacements import DisplacementRows
from ..mesh.input_path import existing_file, writable_path
from ..problem import Problem
from .snapshots import SampleReport, Snapshots, check_snapshots

Arrays = dict[str, NDArray[np.float64]]

SAMPLES_SUFFIX = ".samples"
FORMAT, VERSION = "snapspace-samples", "1"


def save_snapshots(snapshots: Snapshots, path: str | os.PathLike[str]) -> Path:
    """Writes full solutions with their parameters, reports and the fingerprint of their problem.

    The layout is that of safetensors, with arrays `parameters` (k, p) and `displacements` (k, 3n)
    in double precision and a checksum. The file does not contain the mesh.

    Parameters
    ----------
    snapshots : Snapshots
    path : path
        Must end in .samples, in an existing folder.

    Returns
    -------
    Path
        The file. If writing fails, no incomplete file is left behind.

    Raises
    ------
    ValueError
        For an unknown extension, or if the file cannot be written.
    """
    check_snapshots(snapshots, "save_snapshots")
    target = writable_path(as_path("save_snapshots", path), known=[SAMPLES_SUFFIX])
    arrays = {
        "parameters": np.ascontiguousarray(snapshots.parameters, "<f8"),
        "displacements": np.ascontiguousarray(snapshots.displacements.array(), "<f8"),
    }
    header = {
        "format": FORMAT,
        "version": VERSION,
        "fingerprint": snapshots.problem.fingerprint,
        "reports": json.dumps([asdict(report) for report in snapshots.reports]),
    }
    header["crc32"] = _checksum(arrays, header)
    with atomic_file(target) as temporary:
        temporary.write_bytes(safetensors_bytes(arrays, header))
    return target


def load_snapshots(path: str | os.PathLike[str], problem: Problem) -> Snapshots:
    """The snapshots of a file, as snapshots of a problem.

    Parameters
    ----------
    path : path
        A file of `save_snapshots`.
    problem : Problem
        The problem of the samples, or an equal one, such as `model.problem`.

    Raises
    ------
    ValueError
        If there is no such file, it is damaged or of another kind, or its samples are of another
        problem, with another mesh, material or domain, or other handles or poses.
    """
    if not hasattr(problem, "fingerprint"):  # any class may be a problem
        raise wrong_type("load_snapshots", "problem", problem, "give path, problem")
    file = existing_file(as_path("load_snapshots", path), known=[SAMPLES_SUFFIX])
    arrays, header = _read(file)
    if header["fingerprint"] != problem.fingerprint:
        raise ValueError(
            f"{file}: these samples are of another problem than {problem!r}: mesh, material, "
            "domain, handles or poses differ; solve them again"
        )
    try:
        reports = [SampleReport(**entry) for entry in json.loads(header["reports"])]
        rows = DisplacementRows(arrays["displacements"], problem.base.size)
        return Snapshots(problem, arrays["parameters"], rows, reports)
    except (TypeError, ValueError, RecursionError) as error:
        raise ValueError(
            f"{file}: these samples do not fit together ({error}); write them again"
        ) from None


def _read(file: Path) -> tuple[Arrays, dict[str, str]]:
    """Arrays and header, after all checks that do not need the problem."""
    try:
        with safe_open(file, framework="np") as content:
            arrays = {name: content.get_tensor(name) for name in content.keys()}
            header = dict(content.metadata() or {})
    except (SafetensorError, OSError, ValueError) as error:
        raise ValueError(f"{file}: not a complete samples file ({error}); write it again") from None
    if header.get("format") != FORMAT or header.get("version") != VERSION:
        raise ValueError(
            f"{file}: not a samples file of this version; `snapspace validate --save-reference` "
            "writes one"
        )
    if header.get("crc32") != _checksum(arrays, header):
        raise ValueError(f"{file}: its content has changed since it was written; write it again")
    wrong = [name for name in ("fingerprint", "reports") if name not in header]
    for name in ("parameters", "displacements"):
        array = arrays.get(name)
        if array is None or array.dtype != np.float64 or array.ndim != 2:
            wrong.append(name)
        elif name == "parameters" and not np.isfinite(array).all():
            wrong.append(name)
    if wrong or len(arrays) != 2:
        raise ValueError(
            f"{file}: {wrong[0] if wrong else 'unknown array'}: not as in a samples file; write it "
            "again"
        )
    return arrays, header


def _checksum(arrays: Arrays, header: dict[str, Any]) -> str:
    words = [f"{key}={header[key]}\n" for key in sorted(header) if key != "crc32"]
    checksum = zlib.crc32("".join(words).encode())
    for name in sorted(arrays):
        # not by memoryview.cast, which empty arrays refuse
        content = np.ascontiguousarray(arrays[name]).reshape(-1).view(np.uint8).data
        checksum = zlib.crc32(content, checksum)
    return f"{checksum:08x}"
