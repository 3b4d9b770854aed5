"""GltfFile: the JSON and the buffers of a .glb or .gltf file."""

from __future__ import annotations

import base64
import binascii
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote

_MAGIC, _JSON, _BIN = b"glTF", b"JSON", b"BIN\0"
_DATA = "data:"
_TYPES = {".png": "image/png", ".jpg": "image/jpeg", ".jpeg": "image/jpeg", ".webp": "image/webp"}


@dataclass(frozen=True, eq=False)
class GltfFile:
    """Content of a file.

    json : the parsed JSON
    text : the JSON as it is in the file
    data : all buffers, one after the other
    starts : where each buffer starts in data
    chunks : the chunks of a .glb, type and content; empty for a .gltf
    """

    json: dict[str, Any]
    text: bytes
    data: bytes
    starts: tuple[int, ...]
    chunks: tuple[tuple[bytes, bytes], ...]

    def with_data(self, data: bytes, changed: dict[str, Any] | None) -> bytes:
        """The file with other content of its buffers, and other JSON unless `changed` is None."""
        if not self.chunks:
            content = json.loads(self.text) if changed is None else changed
            for number, buffer in enumerate(content["buffers"]):
                part = data[self.starts[number] : self.starts[number] + buffer["byteLength"]]
                head = buffer["uri"].partition(",")[0]
                buffer["uri"] = f"{head},{base64.b64encode(part).decode('ascii')}"
            return _text(content)
        text = self.text if changed is None else _text(changed)
        chunks = [
            (kind, text if kind == _JSON else self._binary(data) if kind == _BIN else old)
            for kind, old in self.chunks
        ]
        return _glb(chunks)

    def _binary(self, data: bytes) -> bytes:
        """The binary chunk: the first buffer, and the bytes that may follow it there."""
        old = dict(self.chunks)[_BIN]
        length = self.json["buffers"][0]["byteLength"]
        return data[:length] + old[length:]


def gltf_file(data: bytes) -> GltfFile:
    """Parses a .glb or a .gltf without other files; ValueError if it is neither."""
    chunks: tuple[tuple[bytes, bytes], ...] = ()
    text = data
    if data[:4] == _MAGIC:
        chunks = _chunks(data)
        text = dict(chunks).get(_JSON, b"")
    content = _parsed(text)
    buffers = [
        _buffer(number, buffer, chunks) for number, buffer in enumerate(content.get("buffers", []))
    ]
    starts = [sum(map(len, buffers[:number])) for number in range(len(buffers))]
    return GltfFile(content, text, b"".join(buffers), tuple(starts), chunks)


def self_contained(data: bytes, folder: Path) -> bytes:
    """A .gltf with the buffers and images of its folder inside; unchanged if it has none there.

    Raises
    ------
    ValueError
        If it is not a glTF file, or a file that it names cannot be read.
    """
    if data[:4] == _MAGIC:
        return data
    content = _parsed(data)
    items = [*_list(content, "buffers"), *_list(content, "images")]
    outside = [
        item
        for item in items
        if isinstance(item, dict)
        and isinstance(item.get("uri"), str)
        and not item["uri"].startswith(_DATA)
    ]
    for item in outside:
        name = unquote(item["uri"])
        try:
            inside = (folder / name).read_bytes()
        except (OSError, ValueError):
            raise ValueError(f"it needs the file {name[:200]}, which cannot be read") from None
        kind = _TYPES.get(Path(name).suffix.lower(), "application/octet-stream")
        item["uri"] = f"{_DATA}{kind};base64,{base64.b64encode(inside).decode('ascii')}"
    return _text(content) if outside else data


def _list(content: dict[str, Any], key: str) -> list[Any]:
    found = content.get(key, [])
    return found if isinstance(found, list) else []


def _parsed(text: bytes) -> dict[str, Any]:
    try:
        content = json.loads(text.decode("utf-8-sig"))
        if not isinstance(content, dict) or not isinstance(content["asset"], dict):
            raise TypeError
    except (ValueError, LookupError, TypeError, RecursionError):
        raise ValueError("it is not a glTF file, or it is incomplete") from None
    return content


def _text(content: dict[str, Any]) -> bytes:
    return json.dumps(content, ensure_ascii=False, separators=(",", ":")).encode("utf-8")


def _chunks(data: bytes) -> tuple[tuple[bytes, bytes], ...]:
    length = int.from_bytes(data[8:12], "little")
    if int.from_bytes(data[4:8], "little") != 2 or length > len(data):
        raise ValueError("it is not a glTF 2 file, or it is incomplete")
    chunks, place = [], 12
    while place + 8 <= length:
        size = int.from_bytes(data[place : place + 4], "little")
        chunks.append((data[place + 4 : place + 8], data[place + 8 : place + 8 + size]))
        place += 8 + size
    return tuple(chunks)


def _glb(chunks: list[tuple[bytes, bytes]]) -> bytes:
    body = b""
    for kind, content in chunks:
        padded = content + (b" " if kind == _JSON else b"\0") * (-len(content) % 4)
        body += len(padded).to_bytes(4, "little") + kind + padded
    return _MAGIC + (2).to_bytes(4, "little") + (12 + len(body)).to_bytes(4, "little") + body


def _buffer(number: int, buffer: dict[str, Any], chunks: tuple[tuple[bytes, bytes], ...]) -> bytes:
    uri = buffer.get("uri")
    length = buffer.get("byteLength")
    if not isinstance(length, int):
        raise ValueError(f"buffer {number} has no length")
    if uri is None:
        content = dict(chunks).get(_BIN, b"") if number == 0 else b""
    elif isinstance(uri, str) and uri.startswith(_DATA) and not chunks:
        try:
            content = base64.b64decode(uri.partition(",")[2], validate=True)
        except (binascii.Error, ValueError):
            raise ValueError(f"the data of buffer {number} cannot be decoded") from None
    else:
        raise ValueError(f"buffer {number} is in another file: save all as one .glb")
    if len(content) < length:
        raise ValueError(f"buffer {number} has {len(content)} of {length} bytes: it is incomplete")
    return content[:length]
