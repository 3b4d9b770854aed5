"""Where the positions, normals and tangents of a glTF file are."""

from __future__ import annotations

import copy
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray
from .gltf_accessor import Accessor, accessor
from .gltf_file import GltfFile, gltf_file
from .gltf_nodes import mesh_transforms
from .layout import Directions, IntArray, Layout
from .slots import BinarySlots

_SINGLE = np.dtype("<f4")
_TRIANGLES, _STRIP, _FAN = 4, 5, 6


def gltf_layout(data: bytes) -> Layout:
    """The layout of a .glb or a .gltf without other files; ValueError if it is neither."""
    try:
        return _layout(data)
    except (LookupError, TypeError, AttributeError, OverflowError) as error:
        # JSON with types that the format does not have
        raise ValueError(f"it is not a glTF file, or it is incomplete ({error!s:.80})") from None


def _layout(data: bytes) -> Layout:
    file = gltf_file(data)
    points = _Block()
    directions = {"NORMAL": _Block(), "TANGENT": _Block()}
    transforms: list[FloatArray] = []
    corners: list[IntArray] = []
    uses: dict[str, list[IntArray]] = {name: [] for name in directions}
    for mesh, transform in mesh_transforms(file.json).items():
        for primitive in primitives_of(file, mesh):
            attributes = primitive["attributes"]
            known = points.has(attributes["POSITION"])
            begin, count = points.take(file, attributes["POSITION"])
            if not known:
                transforms.append(np.broadcast_to(transform, (count, 3, 4)))
            used = triangles_of(file, primitive, count, transform).ravel()
            corners.append(begin + used)
            for name, block in directions.items():
                first = -1
                if name in attributes:
                    first, length = block.take(file, attributes[name])
                    if length != count:
                        raise ValueError(f"mesh {mesh} has {length} {name} of {count} points")
                uses[name].append(used + first if first >= 0 else np.full_like(used, -1))
    if not corners:
        raise ValueError("it has no triangles in its scene")
    to_world = np.concatenate(transforms)
    plain = (to_world == np.eye(4)[:3]).all()
    joined = np.concatenate(corners)
    return Layout(
        data=file.data,
        points=points.slots(file),
        corners=joined,
        sizes=np.full(len(joined) // 3, 3),
        repeats_points=True,
        directions=tuple(
            Directions(
                block.slots(file),
                np.concatenate(uses[name]),
                "normal" if name == "NORMAL" else "tangent",
            )
            for name, block in directions.items()
            if block.accessors
        ),
        to_world=None if plain else np.ascontiguousarray(to_world),
        finish=lambda changed, new: _finished(file, points, changed, new),
    )


@dataclass
class _Block:
    """Accessors one after the other, each with the row where it starts."""

    accessors: dict[int, tuple[int, Accessor]] = field(default_factory=dict)
    rows: int = 0

    def has(self, number: int) -> bool:
        return number in self.accessors

    def take(self, file: GltfFile, number: int) -> tuple[int, int]:
        """First row and number of rows of an accessor."""
        if number not in self.accessors:
            found = accessor(file, number)
            if found.kind != _SINGLE or found.width < 3:
                raise ValueError(
                    f"accessor {number} has positions or normals that are not single-precision "
                    "(quantized); save it without compression"
                )
            self.accessors[number] = self.rows, found
            self.rows += len(found.offsets)
        begin, found = self.accessors[number]
        return begin, len(found.offsets)

    def slots(self, file: GltfFile) -> BinarySlots:
        offsets = np.concatenate([found.offsets for _, found in self.accessors.values()])
        places = offsets[:, None] + 4 * np.arange(3)
        return BinarySlots(file.data, places, (_SINGLE, _SINGLE, _SINGLE))


def primitives_of(file: GltfFile, mesh: int) -> list[dict[str, Any]]:
    """The primitives of a mesh that have triangles."""
    try:
        primitives = file.json["meshes"][mesh]["primitives"]
        if any("KHR_draco_mesh_compression" in one.get("extensions", {}) for one in primitives):
            raise ValueError(
                f"mesh {mesh} is compressed (Draco); save it without compression "
                "(Blender: leave Compression out)"
            )
        return [
            one
            for one in primitives
            if one.get("mode", _TRIANGLES) in (_TRIANGLES, _STRIP, _FAN)
            and "POSITION" in one["attributes"]
        ]
    except (LookupError, TypeError, AttributeError):
        raise ValueError(f"mesh {mesh} is incomplete") from None


def triangles_of(
    file: GltfFile, primitive: dict[str, Any], count: int, transform: FloatArray
) -> NDArray[np.int64]:
    """Triangles of a primitive as indices into its own points, (t, 3).

    A transform that mirrors flips them, so that outward stays outward (glTF 2.0, 3.7.4).
    """
    found = _triangles(file, primitive, count)
    with np.errstate(invalid="ignore"):  # numbers that are not finite are refused as positions
        mirrors = np.linalg.det(transform[:, :3]) < 0
    return found[:, ::-1] if mirrors else found


def _triangles(file: GltfFile, primitive: dict[str, Any], count: int) -> NDArray[np.int64]:
    index = np.arange(count)
    if "indices" in primitive:
        found = accessor(file, primitive["indices"])
        if found.kind.kind != "u" or found.width != 1:
            raise ValueError(f"accessor {primitive['indices']} has no indices")
        index = found.rows(file.data)[:, 0].astype(np.int64)
    if index.size and index.max() >= count:
        raise ValueError(f"a triangle has vertex index {index.max()}, but there are {count} points")
    mode = primitive.get("mode", _TRIANGLES)
    if mode == _TRIANGLES:
        return index[: len(index) // 3 * 3].reshape(-1, 3)
    number = np.arange(max(0, len(index) - 2))
    if mode == _FAN:
        return np.stack([index[number + 1], index[number + 2], np.full_like(number, index[0])], 1)
    odd = number % 2
    return np.stack([index[number], index[number + 1 + odd], index[number + 2 - odd]], axis=1)


def _finished(file: GltfFile, points: _Block, data: bytes, new: FloatArray) -> bytes:
    """The file with new bytes and new bounds of its positions."""
    content = copy.deepcopy(file.json)
    single = new.astype(np.float32).astype(np.float64)
    for number, (begin, found) in points.accessors.items():
        rows = single[begin : begin + len(found.offsets)]
        about = content["accessors"][number]
        bounds = {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        if not all(_same_bound(about.get(key), value) for key, value in bounds.items()):
            about |= bounds
    return file.with_data(data, None if content == file.json else content)


def _same_bound(stated: Any, value: list[float]) -> bool:
    """Whether a bound in the JSON is the same in single precision."""
    try:
        return np.array_equal(np.array(stated, np.float32), np.array(value, np.float32))
    except (TypeError, ValueError, OverflowError):
        return False
