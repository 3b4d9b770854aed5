"""The part of a PLY file below its header: the rows of its elements."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .number_text import parse_numbers

_BYTE_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}
ENCODINGS = ("ascii", *_BYTE_ORDERS)


@dataclass(frozen=True)
class PlyProperty:
    """One property of an element; `count_type` is empty unless it is a list. Types as NumPy's."""

    name: str
    count_type: str
    value_type: str


@dataclass(frozen=True)
class PlyElement:
    """One kind of row: the number of rows and their properties."""

    name: str
    count: int
    properties: list[PlyProperty] = field(default_factory=list)


@dataclass(frozen=True)
class PlyColumn:
    """Values of a property; for lists, all values one after the other and the size of each."""

    values: NDArray[Any]
    sizes: NDArray[np.int64]


class PlyBody:
    """A cursor over the rows. Text is first parsed into doubles and then read like binary data."""

    def __init__(self, data: bytes, encoding: str) -> None:
        self._text = encoding == "ascii"
        self._order = _BYTE_ORDERS.get(encoding, "=")
        self._data = (
            parse_numbers(data.decode("latin-1"), what="rows").tobytes() if self._text else data
        )
        self._position = 0

    @property
    def position(self) -> int:
        """Where the next row starts: a byte, or the number of a word in a text."""
        return self._position // 8 if self._text else self._position

    def read(self, element: PlyElement) -> dict[str, PlyColumn]:
        """Read all rows of the next element; ValueError if they are not all there."""
        if not element.count or not element.properties:  # rows without bytes, however many
            empty = PlyColumn(np.empty(0), np.empty(0, dtype=np.int64))
            return {item.name: empty for item in element.properties}
        start = self._position
        sizes = [size for size, _ in self._row(element)]
        self._position = start
        columns = self._read_equal_rows(element, sizes)
        return self._read_row_by_row(element) if columns is None else columns

    def type_of(self, item: PlyProperty) -> np.dtype[Any]:
        """The type of a property's values in the file; in a text, double."""
        return self._dtype(item.value_type)

    def _dtype(self, kind: str) -> np.dtype[Any]:
        return np.dtype("f8") if self._text else np.dtype(self._order + kind)

    def _read_equal_rows(
        self, element: PlyElement, sizes: list[int]
    ) -> dict[str, PlyColumn] | None:
        """Read rows whose lists are all as long as those of the first row; None if they are not."""
        fields: list[Any] = []
        for index, (item, size) in enumerate(zip(element.properties, sizes, strict=True)):
            if item.count_type:
                fields.append((f"size {index}", self._dtype(item.count_type)))
            fields.append((f"value {index}", self._dtype(item.value_type), (size,)))
        layout = np.dtype(fields)
        if self._position + element.count * layout.itemsize > len(self._data):
            return None
        rows = np.frombuffer(self._data, layout, element.count, self._position)
        columns = {}
        for index, (item, size) in enumerate(zip(element.properties, sizes, strict=True)):
            if item.count_type and not (rows[f"size {index}"] == size).all():
                return None
            columns[item.name] = PlyColumn(
                rows[f"value {index}"].ravel(), np.full(element.count, size, dtype=np.int64)
            )
        self._position += element.count * layout.itemsize
        return columns

    def _read_row_by_row(self, element: PlyElement) -> dict[str, PlyColumn]:
        rows = [self._row(element) for _ in range(element.count)]
        columns = {}
        for item, cells in zip(element.properties, zip(*rows, strict=True), strict=True):
            sizes = np.array([size for size, _ in cells], dtype=np.int64)
            columns[item.name] = PlyColumn(np.concatenate([values for _, values in cells]), sizes)
        return columns

    def _row(self, element: PlyElement) -> list[tuple[int, NDArray[Any]]]:
        row = []
        for item in element.properties:
            size = _whole(self._take(item.count_type, 1)[0]) if item.count_type else 1
            row.append((size, self._take(item.value_type, size)))
        return row

    def _take(self, kind: str, count: int) -> NDArray[Any]:
        dtype = self._dtype(kind)
        end = self._position + count * dtype.itemsize
        if count < 0 or end > len(self._data):
            raise ValueError("it ends before all its rows: it is incomplete")
        values = np.frombuffer(self._data, dtype, count, self._position)
        self._position = end
        return values


def _whole(count: Any) -> int:
    """The length of a list; ValueError if it is not finite or not a whole number."""
    if not np.isfinite(count) or count != np.floor(count):
        raise ValueError(f"a list is announced with {count:g} values")
    return int(count)
