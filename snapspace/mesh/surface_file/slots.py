"""Slots: the places in a file's bytes that hold vectors, and new numbers for them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray
from ..number_text import parse_numbers

#: New bytes for a range of old ones: where it starts and ends, and the replacement.
Patch = tuple[int, int, bytes]


class Slots(Protocol):
    """Places of k vectors (x, y, z) in the bytes of a file."""

    @property
    def values(self) -> FloatArray:
        """The vectors in the file, (k, 3)."""

    def patches(self, rows: NDArray[np.intp], values: FloatArray) -> list[Patch]:
        """Replacements that write values (r, 3) into the slots of the given rows (r,)."""


@dataclass(frozen=True, eq=False)
class TextSlots:
    """Numbers in text: where the words of each vector start and end, (k, 3) each."""

    data: bytes
    starts: NDArray[np.int64]
    ends: NDArray[np.int64]

    @cached_property
    def values(self) -> FloatArray:
        """The vectors in the file, (k, 3), read-only."""
        data = self.data
        spans = zip(self.starts.ravel().tolist(), self.ends.ravel().tolist(), strict=True)
        text = b" ".join([data[start:end] for start, end in spans]).decode("latin-1")
        values = parse_numbers(text, what="coordinates").reshape(-1, 3)
        values.setflags(write=False)
        return values

    def patches(self, rows: NDArray[np.intp], values: FloatArray) -> list[Patch]:
        """Patches with all digits, so that reading gives the same numbers."""
        return [
            (start, end, repr(value).encode())
            for start, end, value in zip(
                self.starts[rows].ravel().tolist(),
                self.ends[rows].ravel().tolist(),
                values.ravel().tolist(),
                strict=True,
            )
        ]


@dataclass(frozen=True, eq=False)
class BinarySlots:
    """Numbers in binary: where each one starts, (k, 3), and the type of each column."""

    data: bytes
    offsets: NDArray[np.int64]
    types: tuple[np.dtype[np.generic], np.dtype[np.generic], np.dtype[np.generic]]

    @property
    def values(self) -> FloatArray:
        """The vectors in the file, (k, 3)."""
        raw = np.frombuffer(self.data, np.uint8)
        columns = []
        for axis, kind in enumerate(self.types):
            places = self.offsets[:, axis, None] + np.arange(kind.itemsize)
            columns.append(np.ascontiguousarray(raw[places]).view(kind).ravel().astype(np.float64))
        return np.stack(columns, axis=1)

    def patches(self, rows: NDArray[np.intp], values: FloatArray) -> list[Patch]:
        """Patches in the types of the file; ValueError for integer types."""
        patches: list[Patch] = []
        for axis, kind in enumerate(self.types):
            if kind.kind != "f":
                raise ValueError(
                    f"its coordinates are whole numbers ({kind.name}), which cannot hold a "
                    "posed shape; save it with float coordinates"
                )
            with np.errstate(over="ignore"):
                raw = values[:, axis].astype(kind).tobytes()
            size = kind.itemsize
            patches += [
                (start, start + size, raw[k * size : (k + 1) * size])
                for k, start in enumerate(self.offsets[rows, axis].tolist())
            ]
        return patches


def patched(data: bytes, patches: list[Patch]) -> bytes:
    """The bytes with all patches applied; they may not overlap."""
    pieces, end = [], 0
    for start, stop, new in sorted(patches, key=lambda patch: patch[0]):
        pieces += [data[end:start], new]
        end = stop
    return b"".join([*pieces, data[end:]])
