"""GlbFile: the container of binary glTF 2.0."""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

FLOAT, UNSIGNED_INT = 5126, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
_MAGIC, _JSON, _BIN = 0x46546C67, 0x4E4F534A, 0x004E4942
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3"}


class GlbFile:
    """Arrays of one binary buffer, and the JSON that describes them (glTF 2.0, sec. 4).

    The same arrays and JSON give the same bytes.
    """

    def __init__(self) -> None:
        self._views: list[dict[str, Any]] = []
        self._accessors: list[dict[str, Any]] = []
        self._parts: list[bytes] = []
        self._size = 0

    def floats(self, values: NDArray[Any], *, vertices: bool, bounds: bool = False) -> int:
        """Adds an array (k,), (k, 2) or (k, 3) in single precision; returns its accessor's index.

        vertices : whether the array is an attribute of vertices
        bounds : adds the smallest and largest values, as positions and times need
        """
        array = np.ascontiguousarray(values, np.float32)
        about: dict[str, Any] = {}
        if bounds:
            rows = array.reshape(len(array), -1)
            about = {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        return self._add(array, FLOAT, ARRAY_BUFFER if vertices else None, about)

    def indices(self, faces: NDArray[Any]) -> int:
        """Adds faces (f, 3) as one row of indices; returns its accessor's index."""
        return self._add(
            np.ascontiguousarray(faces, np.uint32).reshape(-1),
            UNSIGNED_INT,
            ELEMENT_ARRAY_BUFFER,
            {},
        )

    def picture(self, data: bytes) -> int:
        """Adds the bytes of a PNG or JPEG file; returns the index of its buffer view."""
        return self._view(data + b"\0" * (-len(data) % 4), {"byteLength": len(data)})

    def file_bytes(self, content: dict[str, Any]) -> bytes:
        """The file: `content` is the JSON without buffers, views and accessors."""
        whole = {
            **content,
            "accessors": self._accessors,
            "bufferViews": self._views,
            "buffers": [{"byteLength": self._size}],
        }
        text = json.dumps(whole, separators=(",", ":"), sort_keys=True).encode()
        text += b" " * (-len(text) % 4)
        binary = b"".join(self._parts)
        size = 12 + 8 + len(text) + 8 + len(binary)
        header = struct.pack("<III", _MAGIC, 2, size)
        chunks = struct.pack("<II", len(text), _JSON) + text
        return header + chunks + struct.pack("<II", len(binary), _BIN) + binary

    def _add(
        self, array: NDArray[Any], component: int, target: int | None, about: dict[str, Any]
    ) -> int:
        kind = {} if target is None else {"target": target}
        view = self._view(array.tobytes(), {"byteLength": array.nbytes, **kind})
        width = 1 if array.ndim == 1 else array.shape[1]
        self._accessors.append(
            {
                "bufferView": view,
                "componentType": component,
                "count": len(array),
                "type": _TYPES[width],
                **about,
            }
        )
        return len(self._accessors) - 1

    def _view(self, data: bytes, about: dict[str, Any]) -> int:
        """Adds bytes, a multiple of four for alignment; returns the view's index."""
        self._views.append({"buffer": 0, "byteOffset": self._size, **about})
        self._parts.append(data)
        self._size += len(data)
        return len(self._views) - 1
