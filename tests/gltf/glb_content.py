"""Reads binary glTF with nothing of the package: JSON and arrays by the specification."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np

_DTYPES = {5126: "<f4", 5125: "<u4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}


class GlbContent:
    """The JSON of a file, and its accessors as arrays."""

    def __init__(self, path: Path) -> None:
        content = path.read_bytes()
        magic, version, size = struct.unpack_from("<4sII", content, 0)
        assert (magic, version, size) == (b"glTF", 2, len(content))
        length, kind = struct.unpack_from("<I4s", content, 12)
        assert kind == b"JSON"
        self.json: dict[str, Any] = json.loads(content[20 : 20 + length])
        self._binary = content[20 + length + 8 :]

    def array(self, accessor: int) -> Any:
        about = self.json["accessors"][accessor]
        view = self.json["bufferViews"][about["bufferView"]]
        width = _WIDTHS[about["type"]]
        dtype = np.dtype(_DTYPES[about["componentType"]])
        start, count = view["byteOffset"], about["count"] * width
        array = np.frombuffer(self._binary, dtype, count, start)
        return array.reshape(-1, width) if width > 1 else array

    def picture(self, image: int) -> bytes:
        view = self.json["bufferViews"][self.json["images"][image]["bufferView"]]
        return self._binary[view["byteOffset"] :][: view["byteLength"]]

    @property
    def primitive(self) -> dict[str, Any]:
        found: dict[str, Any] = self.json["meshes"][0]["primitives"][0]
        return found

    def shape(self, weights: Any) -> Any:
        """Positions for weights (m,) of the targets."""
        positions = self.array(self.primitive["attributes"]["POSITION"]).astype(float)
        for weight, target in zip(weights, self.primitive["targets"], strict=True):
            positions += weight * self.array(target["POSITION"])
        return positions

    def animated_weights(self) -> Any:
        """Weights (k, m) of the animation's frames."""
        (sampler,) = self.json["animations"][0]["samplers"]
        count = len(self.primitive["targets"])
        return self.array(sampler["output"]).reshape(-1, count)
