"""Files of finished samples: safetensors layout, a checksum, and rows that are memory-mapped."""

from __future__ import annotations

import json
import os
import zlib
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..disk.atomic_file import atomic_file
from .snapshots import SampleReport

FloatArray = NDArray[np.float64]
Samples = dict[int, tuple[FloatArray, SampleReport]]

#: Bytes that the checksum reads at a time.
PIECE = 1 << 22


def write_samples(
    path: Path,
    indices: Sequence[int],
    displacements: Sequence[FloatArray],
    reports: Sequence[SampleReport],
    *,
    run: str = "",
) -> None:
    """Writes numbers, displacements (3n,) and reports; the file is either complete or absent.

    `run` is the key of the run that solved them, if it is known.

    The displacements are not copied. The layout is that of safetensors (the size of a JSON header
    in eight bytes, the header, then the arrays), with an array `indices` (j,) and an array
    `displacements` (j, 3n).

    Raises
    ------
    ValueError
        If the file cannot be written.
    """
    numbers = np.asarray(indices, "<i8")
    arrays = [numbers, *(np.ascontiguousarray(row, "<f8") for row in displacements)]
    words = json.dumps([asdict(report) for report in reports])
    checksum = zlib.crc32((words + run).encode())
    for array in arrays:
        checksum = zlib.crc32(array.data.cast("B"), checksum)
    size, width = numbers.nbytes, arrays[-1].size
    origin = {"run": run} if run else {}
    header = {
        "__metadata__": {"reports": words, "crc32": f"{checksum:08x}", **origin},
        "indices": _entry("I64", [len(numbers)], 0),
        "displacements": _entry("F64", [len(numbers), width], size),
    }
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 8)  # the arrays are aligned
    with atomic_file(path) as temporary, temporary.open("xb") as file:
        file.write(len(text).to_bytes(8, "little") + text)
        for array in arrays:
            file.write(array.data.cast("B"))


def read_indices(path: Path) -> list[int]:
    """Numbers of the samples in a file. Only header and size are checked; nothing else is read.

    Raises ValueError, which names the fault, and OSError.
    """
    with path.open("rb") as file:
        return _read_header(file)[0]


def read_run(path: Path) -> str:
    """The key of the run that solved the samples of a file, or "" if it has none.

    Raises ValueError, which names the fault, and OSError.
    """
    with path.open("rb") as file:
        return _read_header(file)[3].get("run", "")


def read_samples(path: Path) -> Samples:
    """Displacements (3n,) and reports of a file by sample number, after checking its checksum.

    The displacements are memory-mapped: the system reads them when they are used, and may drop them
    from memory again. If a file cannot be mapped, they are read into memory.

    Raises ValueError, which names the fault, and OSError.
    """
    with path.open("rb") as file:
        indices, shape, offset, metadata = _read_header(file)
        file.seek(offset - 8 * len(indices))
        words = metadata["reports"] + metadata.get("run", "")
        if _checksum(file, words) != metadata["crc32"]:
            raise ValueError("its content has changed")
        reports = _reports(metadata, len(indices))
        rows = _rows(file, shape, offset)
    return {i: (row, report) for i, row, report in zip(indices, rows, reports, strict=True)}


def _rows(file: BinaryIO, shape: tuple[int, int], offset: int) -> FloatArray:
    try:
        mapped = np.memmap(file, "<f8", mode="r", offset=offset, shape=shape)
    except OSError:  # the file system cannot map files, or too many are mapped
        file.seek(offset)
        content = file.read(8 * shape[0] * shape[1])
        return np.frombuffer(content, "<f8").reshape(shape).astype(np.float64, copy=False)
    # a plain array, since results computed from a memmap would be memmaps
    return mapped.view(np.ndarray)


def _read_header(file: BinaryIO) -> tuple[list[int], tuple[int, int], int, dict[str, str]]:
    """Numbers, shape and position of the displacements, and metadata."""
    length = os.fstat(file.fileno()).st_size
    size = int.from_bytes(file.read(8), "little")
    if not 0 < size <= length - 8:
        raise ValueError("it is incomplete")
    try:
        header = json.loads(file.read(size))
        metadata = header.pop("__metadata__")
        count, width = (int(number) for number in header["displacements"]["shape"])
        expected = {
            "indices": _entry("I64", [count], 0),
            "displacements": _entry("F64", [count, width], 8 * count),
        }
        known = header == expected and metadata.keys() - {"run"} == {"reports", "crc32"}
    except (ValueError, KeyError, TypeError, AttributeError):
        known = False
    if not known or count < 1 or width < 1:
        raise ValueError("it is not a samples file of this version")
    offset = 8 + size + 8 * count
    if length != offset + 8 * count * width:
        raise ValueError("it is incomplete")
    indices = np.frombuffer(file.read(8 * count), "<i8").tolist()
    return indices, (count, width), offset, metadata


def _reports(metadata: dict[str, str], count: int) -> list[SampleReport]:
    try:
        reports = [SampleReport(**entry) for entry in json.loads(metadata["reports"])]
    except (ValueError, TypeError):
        reports = []
    if len(reports) != count:
        raise ValueError("its reports cannot be read")
    return reports


def _checksum(file: BinaryIO, words: str) -> str:
    """Checksum of words and the rest of the file. It is read, since a map would fill the memory."""
    checksum = zlib.crc32(words.encode())
    while piece := file.read(PIECE):
        checksum = zlib.crc32(piece, checksum)
    return f"{checksum:08x}"


def _entry(dtype: str, shape: list[int], begin: int) -> dict[str, Any]:
    size = 8 * int(np.prod(shape))
    return {"dtype": dtype, "shape": shape, "data_offsets": [begin, begin + size]}
