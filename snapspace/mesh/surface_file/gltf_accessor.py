"""Accessors of a glTF file: typed rows in its buffers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .gltf_file import GltfFile

_COMPONENTS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


@dataclass(frozen=True, eq=False)
class Accessor:
    """Where the numbers of an accessor are: offsets of its rows (n,), type and width."""

    offsets: NDArray[np.int64]
    kind: np.dtype[Any]
    width: int

    def rows(self, data: bytes) -> NDArray[Any]:
        """The numbers, (n, width)."""
        raw = np.frombuffer(data, np.uint8)
        places = self.offsets[:, None] + np.arange(self.kind.itemsize * self.width)
        return np.ascontiguousarray(raw[places]).view(self.kind)


def accessor(file: GltfFile, number: int) -> Accessor:
    """The accessor with an index; ValueError if it is compressed, sparse or out of range."""
    try:
        about = file.json["accessors"][number]
        kind, width = np.dtype(_COMPONENTS[about["componentType"]]), _WIDTHS[about["type"]]
        count = about["count"]
        if "sparse" in about or "bufferView" not in about:
            raise ValueError(f"accessor {number} is sparse; save the file without sparse accessors")
        view = file.json["bufferViews"][about["bufferView"]]
        if "EXT_meshopt_compression" in view.get("extensions", {}):
            raise ValueError("its buffers are compressed (meshopt); save it without compression")
        start = view.get("byteOffset", 0) + about.get("byteOffset", 0)
        stride = view.get("byteStride", kind.itemsize * width)
        end = start + stride * (count - 1) + kind.itemsize * width
        buffer = view["buffer"]
        if not all(isinstance(value, int) for value in (count, start, stride, buffer)):
            raise TypeError
        within = 0 <= start and stride > 0 and (not count or end <= _length(file, buffer))
    except (LookupError, TypeError):
        raise ValueError(f"accessor {number} is incomplete, or not of a known type") from None
    if not within or count < 0:
        raise ValueError(f"accessor {number} ends after its buffer: the file is incomplete")
    offsets = file.starts[buffer] + start + stride * np.arange(count, dtype=np.int64)
    return Accessor(offsets, kind, width)


def _length(file: GltfFile, buffer: int) -> int:
    return int(file.json["buffers"][buffer]["byteLength"])
