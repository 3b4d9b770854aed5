"""Arrays and a header in a file whose checksum reveals later damage."""

from __future__ import annotations

import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError, safe_open

from .atomic_file import atomic_file
from .safetensors_bytes import safetensors_bytes

Arrays = dict[str, NDArray[Any]]
_CHECKSUM = "crc32"


class ChangedFileError(ValueError):
    """The content of a file differs from what was written."""


def write_checked(path: Path, arrays: Arrays, header: dict[str, str]) -> None:
    """Writes arrays, a header and their checksum in safetensors layout, all or nothing.

    Raises
    ------
    ValueError
        If the file cannot be written.
    """
    content = {name: np.ascontiguousarray(array) for name, array in arrays.items()}
    lines = {**header, _CHECKSUM: _checksum(content, header)}
    with atomic_file(path) as temporary:
        temporary.write_bytes(safetensors_bytes(content, lines))


def read_checked(path: Path) -> tuple[Arrays, dict[str, str]]:
    """Reads the arrays and the header of a file of `write_checked`.

    Raises
    ------
    ChangedFileError
        If the checksum does not match; this is a ValueError.
    ValueError
        If it is not a complete file of this layout, or cannot be read.
    """
    try:
        with safe_open(path, framework="np") as file:
            arrays = {name: file.get_tensor(name) for name in file.keys()}
            header = dict(file.metadata() or {})
    except (SafetensorError, OSError, ValueError, TypeError) as error:
        raise ValueError(f"it is not complete ({error})") from None
    if header.pop(_CHECKSUM, None) != _checksum(arrays, header):
        raise ChangedFileError("its content has changed")
    return arrays, header


def _checksum(arrays: Arrays, header: dict[str, str]) -> str:
    """Checksum of header and arrays, with names, types and shapes, so that none can be swapped."""
    lines = [f"{key}={header[key]}\n" for key in sorted(header)]
    checksum = zlib.crc32("".join(lines).encode())
    for name in sorted(arrays):
        array = np.ascontiguousarray(arrays[name])
        checksum = zlib.crc32(f"{name} {array.dtype.str} {array.shape}\n".encode(), checksum)
        checksum = zlib.crc32(array.data.cast("B") if array.size else b"", checksum)
    return f"{checksum:08x}"
