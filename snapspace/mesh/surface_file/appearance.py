"""Appearance: texture coordinates, colours, materials and textures of a surface file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray
from .layout import IntArray

Coordinates = NDArray[np.float32]
Colors = NDArray[np.uint8]

#: The first bytes of PNG, JPEG, GIF and BMP files.
_MAGIC = (b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"GIF8", b"BM")


@dataclass(frozen=True)
class SurfaceMaterial:
    """The material of polygons.

    color : red, green and blue in [0, 1], linear; the texture is multiplied by it
    texture : index of its base-colour texture, or None
    roughness : 0 for a mirror, 1 for chalk
    alpha_cutoff : texels with a smaller alpha are not drawn; None: all are
    """

    name: str = ""
    color: tuple[float, float, float] = (1.0, 1.0, 1.0)
    texture: int | None = None
    roughness: float = 0.6
    alpha_cutoff: float | None = None


@dataclass(frozen=True, eq=False)
class Appearance:
    """The look of the polygons of a surface file.

    texture_coordinates : (c, 2), of each corner, from the upper left corner of the texture to the
        right and down; None: the file has none
    colors : (c, 3), sRGB of each corner; None: the file has none
    normals : (c,), corners of a vertex with the same number share a normal, those with other
        numbers have an edge between them; None: the file has none
    materials : at least one
    material_of_polygon : (p,)
    textures : PNG, JPEG, WebP, GIF or BMP files
    missing : names of files beside this one that are missing, or not images of these formats
    """

    texture_coordinates: Coordinates | None
    colors: Colors | None
    normals: IntArray | None
    materials: tuple[SurfaceMaterial, ...]
    material_of_polygon: IntArray
    textures: tuple[bytes, ...] = ()
    missing: tuple[str, ...] = ()

    @property
    def shows_anything(self) -> bool:
        """Whether there is anything besides normals and one white material without texture."""
        plain = all(one.texture is None and min(one.color) >= 1.0 for one in self.materials)
        return not plain or self.colors is not None


class Textures:
    """Pictures by name, each of them once."""

    def __init__(self) -> None:
        self.files: list[bytes] = []
        self.missing: list[str] = []
        self._numbers: dict[str, int | None] = {}

    def add(self, name: str, data: bytes | None) -> int | None:
        """The index of a picture, or None if it is missing or browsers cannot draw it."""
        if name not in self._numbers:
            if data is not None and _is_picture(data):
                self._numbers[name] = len(self.files)
                self.files.append(data)
            else:
                self._numbers[name] = None
                self.missing.append(name)
        return self._numbers[name]


def _is_picture(data: bytes) -> bool:
    """Whether browsers can draw a file."""
    return data.startswith(_MAGIC) or (data[:4] == b"RIFF" and data[8:12] == b"WEBP")


def as_colors(values: NDArray[Any], *, linear: bool = False) -> Colors:
    """Colours as bytes in sRGB: from bytes, from words, or from numbers in [0, 1]."""
    if values.dtype == np.uint8 and not linear:
        return np.ascontiguousarray(values, np.uint8)
    numbers = values.astype(np.float64)
    if values.dtype.kind in "ui":
        numbers /= np.iinfo(values.dtype).max
    numbers = np.clip(np.nan_to_num(numbers), 0.0, 1.0)
    if linear:
        numbers = np.where(
            numbers <= 0.0031308, 12.92 * numbers, 1.055 * numbers ** (1 / 2.4) - 0.055
        )
    return np.rint(255.0 * numbers).astype(np.uint8)


def linear_color(srgb: Sequence[float]) -> tuple[float, float, float]:
    """A colour in sRGB, each number in [0, 1], as linear numbers."""
    values: FloatArray = np.clip(np.array(srgb[:3], np.float64), 0.0, 1.0)
    low, high = values / 12.92, ((values + 0.055) / 1.055) ** 2.4
    red, green, blue = np.where(values <= 0.04045, low, high).tolist()
    return red, green, blue


def as_normals(of_corner: IntArray | None) -> IntArray | None:
    """Normals of corners, or None if no corner has one."""
    return None if of_corner is None or not (of_corner >= 0).any() else of_corner
