"""Mutations of model and sample files with valid checksums, so that readers look further."""

from __future__ import annotations

import json
import zlib
from collections.abc import Callable
from random import Random
from typing import Any

import numpy as np

from snapspace.model_file.container import checksum
from snapspace.snapshots.snapshot_file import _checksum as samples_checksum

_DTYPES = {"F64": "<f8", "F32": "<f4", "I64": "<i8", "I32": "<i4", "I16": "<i2"}
_VALUES: list[Any] = [
    None, True, False, 0, 1, -1, 3, 1.5, -0.5, float("nan"), float("inf"), 1e308, 2**31, 2**63,
    10**400, "", "stvk", "x" * 300, "\ud800", [], {}, [[]], [1, 2, 3], [None], {"model": "arap"},
]  # fmt: skip
_NUMBERS = [0.0, 1.0, -1.0, np.nan, np.inf, -np.inf, 1e308, -1e308, 1e-320]
_INTEGERS = [0, 1, -1, 7, 255, 2**15 - 1, 2**31 - 1, -(2**31)]

Header = dict[str, Any]


def changed_container(data: bytes, random: Random) -> bytes:
    """The container with changed entries, numbers or shapes, and a matching checksum."""
    header, arrays = _parsed(data)
    metadata: Header = dict(header["__metadata__"])
    for _ in range(random.choice((1, 1, 2, 3))):
        if not arrays or random.random() < 0.5:
            _change_words(metadata, random)
        else:
            _change_array(arrays, random)
    return _joined(metadata, arrays)


def _parsed(data: bytes) -> tuple[Header, dict[str, np.ndarray]]:
    size = int.from_bytes(data[:8], "little")
    header = json.loads(data[8 : 8 + size])
    arrays = {}
    for name, entry in header.items():
        if name != "__metadata__":
            begin, end = (8 + size + offset for offset in entry["data_offsets"])
            values = np.frombuffer(data[begin:end], _DTYPES[entry["dtype"]])
            arrays[name] = values.reshape(entry["shape"]).copy()
    return header, arrays


def _change_words(metadata: Header, random: Random) -> None:
    if not metadata:
        return
    name = random.choice(sorted(metadata))
    try:
        value = json.loads(metadata[name])
    except ValueError:
        metadata[name] = str(random.choice(_VALUES))
        return
    metadata[name] = json.dumps(_changed(value, random))


def _changed(value: Any, random: Random) -> Any:
    """A JSON value with one of its entries replaced, left out or repeated."""
    if isinstance(value, dict) and value and random.random() < 0.9:
        key = random.choice(sorted(value))
        if random.random() < 0.1:
            return {name: entry for name, entry in value.items() if name != key}
        return {**value, key: _changed(value[key], random)}
    if isinstance(value, list) and value and random.random() < 0.8:
        at = random.randrange(len(value))
        kept = random.choice(([], [_changed(value[at], random)], [value[at]] * 2))
        return [*value[:at], *kept, *value[at + 1 :]]
    return random.choice(_VALUES)


def _change_array(arrays: dict[str, np.ndarray], random: Random) -> None:
    name = random.choice(sorted(arrays))
    array = arrays[name]
    change: Callable[[], np.ndarray] = random.choice(
        (
            lambda: _with_entry(array, random),
            lambda: _with_entry(array, random),
            lambda: _with_entry(array, random),
            lambda: array[: max(0, len(array) - 1)] if array.ndim else array,
            lambda: np.concatenate([array, array[:1]]) if array.ndim else array,
            lambda: array.ravel(),
            lambda: array[:0] if array.ndim else array,
            lambda: array[None],
            lambda: array.astype(random.choice(sorted(_DTYPES.values()))),
            lambda: np.full_like(array, random.choice((0, 1))),
        )
    )
    if random.random() < 0.05:
        del arrays[name]
    else:
        with np.errstate(all="ignore"):
            arrays[name] = change()


def _with_entry(array: np.ndarray, random: Random) -> np.ndarray:
    if not array.size:
        return array
    values = _NUMBERS if array.dtype.kind == "f" else _INTEGERS
    array.flat[random.randrange(array.size)] = np.clip(random.choice(values), *_range(array.dtype))
    return array


def _range(dtype: np.dtype) -> tuple[float, float]:
    if dtype.kind == "f":
        return -np.inf, np.inf
    return int(np.iinfo(dtype).min), int(np.iinfo(dtype).max)


def _joined(metadata: Header, arrays: dict[str, np.ndarray]) -> bytes:
    content = {name: np.ascontiguousarray(array) for name, array in arrays.items()}
    if "checksum" in metadata:
        metadata["checksum"] = checksum(content, _encodable(metadata))
    elif "reports" in metadata and "format" in metadata:
        metadata["crc32"] = samples_checksum(content, _encodable(metadata))
    elif "reports" in metadata:
        words = _encodable(metadata)["reports"].encode()
        crc = zlib.crc32(words)
        for name in ("indices", "displacements"):
            crc = zlib.crc32(content.get(name, np.empty(0)).tobytes(), crc)
        metadata["crc32"] = f"{crc:08x}"
    header: Header = {"__metadata__": metadata}
    offset = 0
    for name, array in content.items():
        dtype = next(key for key, value in _DTYPES.items() if np.dtype(value) == array.dtype)
        ends = [offset, offset + array.nbytes]
        header[name] = {"dtype": dtype, "shape": list(array.shape), "data_offsets": ends}
        offset += array.nbytes
    text = json.dumps(header).encode()
    text += b" " * (-len(text) % 8)
    return len(text).to_bytes(8, "little") + text + b"".join(a.tobytes() for a in content.values())


def _encodable(metadata: Header) -> Header:
    return {key: value.encode("utf-8", "replace").decode() for key, value in metadata.items()}
