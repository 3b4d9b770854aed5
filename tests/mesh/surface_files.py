"""Surface files with everything that users have in them: a cube of quads, as text and bytes."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float64)
QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
NORMALS = np.array([[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1]], float)


def obj(variant: str) -> bytes:
    """Windows line ends, groups, materials, UVs, face normals, vertex colours.

    With "relative" every other face has negative indices, which not every program reads.
    """
    lines = ["# Blender", "  # v 9 9 9", "mtllib cube.mtl", "o Cube", "usemtl red"]
    lines += [f"v  {x:.6f} {y:.6f} {z:.6f} 0.5 0.25 1" for x, y, z in CUBE]
    lines += ["v 7 7 7", "vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1"]
    lines += [f"vn {x:g} {y:g} {z:g}" for x, y, z in NORMALS]
    for number, quad in enumerate(QUADS):
        if number == 3:
            lines += ["g top", "usemtl blue", "s 1"]
        if variant == "relative" and number % 2:
            words = [f"{v - 9}/{k - 4}/{number - 6}" for k, v in enumerate(quad)]
        else:
            words = [f"{v + 1}/{k + 1}/{number + 1}" for k, v in enumerate(quad)]
        lines.append("f " + " ".join(words))
    return "\r\n".join([*lines, "l 1 2", ""]).encode()


def off() -> bytes:
    """Colours behind the coordinates and the faces, and a comment."""
    rows = [f"{x:g}  {y:g} {z:g} 255 0 {v} 255" for v, (x, y, z) in enumerate(CUBE)]
    faces = ["4 " + " ".join(map(str, quad)) + " 0.5 0.5 0.5" for quad in QUADS]
    return "\n".join(["COFF", "# 1 2 3", "8 6 0", *rows, "", *faces, ""]).encode()


def ply(encoding: str) -> bytes:
    """A first element of another kind, colours, vertex normals and a texture coordinate."""
    header = [
        f"ply\nformat {encoding} 1.0\ncomment TextureFile skin.png\nelement camera 1",
        "property double focus\nelement vertex 8\nproperty uchar red\nproperty float x",
        "property float y\nproperty float z\nproperty float nx\nproperty float ny",
        "property float nz\nproperty float s\nelement face 6",
        "property list uchar int vertex_indices\nproperty uchar flag\nend_header\n",
    ]
    outward = (2.0 * CUBE - 1.0) / np.sqrt(3.0)
    order = ">" if "big" in encoding else "<"
    body = b"7.5\n" if encoding == "ascii" else struct.pack(f"{order}d", 7.5)
    for number, (place, normal) in enumerate(zip(CUBE, outward, strict=True)):
        row = (number, *place.tolist(), *normal.tolist(), 0.125)
        if encoding == "ascii":
            body += (" ".join(f"{value:g}" for value in row) + "\n").encode()
        else:
            body += struct.pack(f"{order}B7f", *row)
    for number, quad in enumerate(QUADS):
        if encoding == "ascii":
            body += (" ".join(map(str, (4, *quad, number))) + "\n").encode()
        else:
            body += struct.pack(f"{order}B4iB", 4, *quad, number)
    return "\n".join(header).encode() + body


def triangles() -> NDArray[np.int64]:
    return np.array([t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))])


def stl(kind: str) -> bytes:
    """A text, or binary with a header that begins as texts do and attributes (colours)."""
    normals = np.repeat(NORMALS, 2, axis=0)
    if kind == "binary":
        rows = b"".join(
            struct.pack("<12fH", *normal, *CUBE[triangle].ravel(), 1000 + number)
            for number, (normal, triangle) in enumerate(zip(normals, triangles(), strict=True))
        )
        return b"solid COLOR=".ljust(80, b"x") + struct.pack("<I", 12) + rows
    text = "solid my cube\n"
    for normal, triangle in zip(normals, triangles(), strict=True):
        text += "  facet normal {:e} {:e} {:e}\n    outer loop\n".format(*normal)
        text += "".join("      vertex {:e} {:e} {:e}\n".format(*p) for p in CUBE[triangle])
        text += "    endloop\n  endfacet\n"
    return (text + "endsolid my cube\n").encode()


def gltf(folder: Path, *, kind: str) -> Path:
    """Two meshes below turned nodes, four corners per side with UVs, normals, tangents, a texture.

    The first mesh has the sides 0 to 2, the second the others, twice as large and moved back by its
    node. kind is glb, or gltf with the buffer in another file.
    """
    arrays: list[NDArray[np.generic]] = []
    accessors, meshes = [], []
    for part, shift, scale in ((range(3), 0.0, 1.0), (range(3, 6), 5.0, 0.5)):
        position = np.concatenate([CUBE[QUADS[side]] for side in part]) * scale + shift
        normal = np.repeat(NORMALS[list(part)], 4, axis=0)
        tangent = np.concatenate([np.roll(normal, 1, axis=1), np.ones((12, 1))], axis=1)
        uv = np.tile([[0, 0], [1, 0], [1, 1], [0, 1]], (3, 1))
        index = (4 * np.arange(3)[:, None] + np.array([0, 1, 2, 0, 2, 3])).ravel()
        first = len(accessors)
        for values, name in ((position, "VEC3"), (normal, "VEC3"), (tangent, "VEC4"), (uv, "VEC2")):
            arrays.append(values.astype("<f4"))
            accessors.append(
                {"bufferView": len(arrays) - 1, "componentType": 5126, "count": 12, "type": name}
            )
        accessors[first] |= {"min": position.min(0).tolist(), "max": position.max(0).tolist()}
        arrays.append(index.astype("<u2"))
        accessors.append(
            {"bufferView": len(arrays) - 1, "componentType": 5123, "count": 18, "type": "SCALAR"}
        )
        names = ("POSITION", "NORMAL", "TANGENT", "TEXCOORD_0")
        attributes = {name: first + k for k, name in enumerate(names)}
        meshes.append(
            {
                "name": f"part {first}",
                "primitives": [{"attributes": attributes, "indices": first + 4, "material": 0}],
            }
        )
    pixel = base64.b64decode(
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNkYPhfDwAChwGA60e6kgAAAABJRU5ErkJggg=="
    )
    raw, views = b"", []
    for content in [*(array.tobytes() for array in arrays), pixel]:
        views.append({"buffer": 0, "byteOffset": len(raw), "byteLength": len(content)})
        raw += content + bytes(-len(content) % 4)
    document = {
        "asset": {"version": "2.0", "generator": "a test"}, "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [
            {"name": "body", "children": [1, 2], "translation": [1, 0, 0],
             "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]},
            {"mesh": 0},
            {"mesh": 1, "scale": [2, 2, 2], "translation": [-10, -10, -10]},
        ],
        "meshes": meshes, "accessors": accessors, "bufferViews": views,
        "images": [{"bufferView": len(views) - 1, "mimeType": "image/png"}],
        "textures": [{"source": 0}],
        "materials": [{"name": "skin", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "buffers": [{"byteLength": len(raw)}], "extras": {"author": "Zoë"},
    }  # fmt: skip
    path = folder / f"cube.{kind}"
    if kind == "gltf":
        document["buffers"] = [{"byteLength": len(raw), "uri": "cube.bin"}]
        (folder / "cube.bin").write_bytes(raw)
        path.write_text(json.dumps(document, indent=1), encoding="utf-8")
        return path
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    chunks += struct.pack("<I4s", len(raw), b"BIN\0") + raw
    path.write_bytes(b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks)
    return path


def write_file(folder: Path, kind: str) -> Path:
    """One of KINDS in a folder."""
    if kind in ("glb", "gltf"):
        return gltf(folder, kind=kind)
    suffix, _, variant = kind.partition(" ")
    content = {
        "obj": lambda: obj(variant),
        "off": off,
        "ply": lambda: ply(variant),
        "stl": lambda: stl(variant),
    }
    path = folder / f"cube.{suffix}"
    path.write_bytes(content[suffix]())
    return path


KINDS = (
    *("obj", "obj relative", "off", "ply ascii", "ply binary_little_endian"),
    *("ply binary_big_endian", "stl ascii", "stl binary", "glb", "gltf"),
)
