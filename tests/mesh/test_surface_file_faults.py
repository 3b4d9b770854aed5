"""Damaged surface files are refused in one line, never with another exception."""

from __future__ import annotations

import json
import random
from pathlib import Path

import pytest

from snapspace import open_surface

from .surface_files import KINDS, gltf, write_file


@pytest.mark.parametrize("kind", KINDS)
def test_damaged_bytes(tmp_path: Path, kind: str) -> None:
    """Cut, overwritten and doubled stretches; what is still read is written, too."""
    file = write_file(tmp_path, kind)
    data, chance = file.read_bytes(), random.Random(kind)
    for _ in range(60):
        start = chance.randrange(len(data))
        stop = min(len(data), start + chance.choice((1, 1, 4, 40)))
        new = chance.choice((b"", b"9", b"-1", b"\0", b"nan", b"]", data[start:stop] * 2))
        file.write_bytes(data[:start] + new + data[stop:])
        try:
            surface = open_surface(file)
            surface.with_vertices(surface.vertices * 2.0)
        except ValueError as error:
            assert "\n" not in str(error)


@pytest.mark.parametrize("value", [None, -1, 1.5, "x", [], {}, [[]], [None], 10**30])
def test_json_of_other_types(tmp_path: Path, value: object) -> None:
    """Each entry of a glTF file in turn is replaced."""
    file = gltf(tmp_path, kind="gltf")
    text = file.read_text(encoding="utf-8")
    refused = 0
    for place in _places(json.loads(text)):
        content = json.loads(text)
        parent = content
        for key in place[:-1]:
            parent = parent[key]
        parent[place[-1]] = value
        file.write_text(json.dumps(content), encoding="utf-8")
        try:
            surface = open_surface(file)
            surface.with_vertices(surface.vertices * 2.0)
        except ValueError as error:
            refused += 1
            assert "\n" not in str(error)
    assert refused > 20


def _places(value: object, above: tuple[object, ...] = ()) -> list[tuple[object, ...]]:
    items = list(value.items()) if isinstance(value, dict) else []
    if isinstance(value, list):
        items = list(enumerate(value))[:3]
    return [
        place for key, below in items for place in [(*above, key), *_places(below, (*above, key))]
    ]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda c: c["nodes"].append({"mesh": 0}) or c["scenes"][0]["nodes"].append(3),
         r"mesh 0 is used by several nodes; make a copy"),
        (lambda c: c["accessors"][0].update(componentType=5122), "quantized"),
        (lambda c: c["meshes"][0]["primitives"][0].update(
            extensions={"KHR_draco_mesh_compression": {}}), r"compressed \(Draco\)"),
        (lambda c: c["bufferViews"][0].update(extensions={"EXT_meshopt_compression": {}}),
         r"compressed \(meshopt\)"),
        (lambda c: c["accessors"][0].update(count=10**9), "ends after its buffer"),
        (lambda c: c["buffers"][0].update(uri="none.bin"), "needs the file none.bin"),
        (lambda c: c.update(nodes=[{}]), "incomplete|no triangles"),
    ],
)  # fmt: skip
def test_what_cannot_be_posed_has_a_cure(tmp_path: Path, change: object, message: str) -> None:
    file = gltf(tmp_path, kind="gltf")
    content = json.loads(file.read_text(encoding="utf-8"))
    change(content)  # type: ignore[operator]
    file.write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(ValueError, match=message):
        open_surface(file)
