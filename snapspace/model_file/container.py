"""The container of model files: safetensors layout, a JSON header and raw arrays, a checksum."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError, safe_open

from ..disk.atomic_file import atomic_file
from ..disk.safetensors_bytes import safetensors_bytes
from . import timings

Arrays = dict[str, NDArray[Any]]
#: The type of an array, or the types that it may have.
Types = type | tuple[type, ...]


def write_container(path: Path, arrays: Arrays, header: dict[str, str]) -> None:
    """Writes arrays and header with their checksum, either the whole file or none."""
    arrays = {name: np.ascontiguousarray(array) for name, array in arrays.items()}
    header = {**header, "checksum": checksum(arrays, header)}
    content = safetensors_bytes(arrays, header)
    with atomic_file(path) as temporary:
        temporary.write_bytes(content)


def read_container(path: Path) -> tuple[Arrays, dict[str, str]]:
    """Arrays and header of a file; ValueError if it is not a complete container."""
    try:
        with safe_open(path, framework="np") as file:
            arrays = {name: file.get_tensor(name) for name in file.keys()}
            return arrays, dict(file.metadata() or {})
    except OSError as error:
        raise ValueError(
            f"{path}: the model cannot be read ({error.strerror or error}); copy it again"
        ) from None
    except (SafetensorError, ValueError, TypeError, LookupError, AttributeError):
        # their messages name parts of the container, which users do not know
        raise ValueError(
            f"{path}: not a complete snapspace model; copy or build it again"
        ) from None


def check_dtypes(path: Path, arrays: Arrays, dtypes: Mapping[str, Types]) -> None:
    """ValueError unless every array exists and has its type, or one of several."""
    for name, dtype in dtypes.items():
        if name not in arrays:
            raise ValueError(f"{path}: the array '{name}' is missing; build the model again")
        known = [np.dtype(one) for one in (dtype if isinstance(dtype, tuple) else (dtype,))]
        if arrays[name].dtype not in known:
            raise ValueError(
                f"{path}: the array '{name}' is {arrays[name].dtype}, not "
                f"{' or '.join(map(str, known))}; build the model again"
            )


def check_finite(path: Path, arrays: Arrays) -> None:
    """ValueError for an array with a number that is NaN or infinite."""
    for name, array in arrays.items():
        if array.dtype.kind != "f" or np.isfinite(array).all():
            continue
        place = ", ".join(map(str, np.argwhere(~np.isfinite(array))[0]))
        raise ValueError(
            f"{path}: the array '{name}' has a number at [{place}] that is not finite; build the "
            "model again"
        )


def parsed(header: dict[str, str], key: str) -> dict[str, Any]:
    """The JSON object of a header's entry.

    Raises
    ------
    KeyError, ValueError
        If there is no such entry, or it is not an object, is nested too deeply, or has an integer
        of more than 20 digits.
    """
    try:
        content = json.loads(header[key], parse_int=_integer)
    except RecursionError:
        raise ValueError(f"'{key}' is nested too deeply") from None
    if not isinstance(content, dict):
        raise ValueError(f"'{key}' is not a JSON object")
    return content


def _integer(digits: str) -> int:
    if len(digits) > 20:
        raise ValueError(f"an integer has {len(digits)} digits")
    return int(digits)


def check_shapes(arrays: Arrays, shapes: Mapping[str, tuple[int, ...]]) -> None:
    """ValueError unless every array has its shape; the caller adds the path to the message."""
    for name, shape in shapes.items():
        if arrays[name].shape != shape:
            raise ValueError(f"'{name}' has shape {arrays[name].shape}, not {shape}")


def checksum(arrays: Arrays, header: dict[str, str]) -> str:
    """SHA-256 of arrays and header, 64 hex digits.

    It is the same for identical runs, because it leaves out the timings, which have their own
    checksum.
    """
    digest = hashlib.sha256()
    for key in sorted(header):
        if key not in ("checksum", timings.TIMINGS, timings.CHECKSUM):
            digest.update(f"{key}={header[key]}\n".encode())
    for name in sorted(arrays):
        array = arrays[name]
        digest.update(f"{name} {array.dtype.str} {array.shape}\n".encode())
        digest.update(array.tobytes())
    return digest.hexdigest()
