"""Appearance of a glTF file."""

from __future__ import annotations

import base64
import binascii
from typing import Any

import numpy as np

from .appearance import Appearance, SurfaceMaterial, Textures, as_colors
from .gltf_accessor import accessor
from .gltf_file import GltfFile, gltf_file
from .gltf_layout import primitives_of, triangles_of
from .gltf_nodes import mesh_transforms
from .layout import IntArray, Layout


def gltf_appearance(data: bytes, layout: Layout) -> Appearance:
    """Materials with base colours, their textures, colours of vertices, and normals.

    Texture coordinates are those of the base-colour texture, with its KHR_texture_transform.
    """
    file = gltf_file(data)
    textures = Textures()
    materials: list[SurfaceMaterial] = []
    numbers: dict[int, int] = {}
    coordinates, colors, of_triangle = [], [], []
    for mesh, transform in mesh_transforms(file.json).items():
        for primitive in primitives_of(file, mesh):
            attributes = primitive["attributes"]
            count = len(accessor(file, attributes["POSITION"]).offsets)
            used = triangles_of(file, primitive, count, transform).ravel()
            number = int(primitive.get("material", -1))
            about = file.json["materials"][number] if number >= 0 else {}
            if number not in numbers:
                numbers[number] = len(materials)
                materials.append(_material(file, about, textures))
            of_triangle.append(np.full(len(used) // 3, numbers[number]))
            coordinates.append(_coordinates(file, attributes, about)[used])
            colors.append(_colors(file, attributes, count)[used])
    joined, painted = np.concatenate(coordinates), np.concatenate(colors)
    return Appearance(
        texture_coordinates=joined if joined.any() else None,
        colors=painted if (painted != 255).any() else None,
        normals=_normals(layout),
        materials=tuple(materials),
        material_of_polygon=np.concatenate(of_triangle).astype(np.int64),
        textures=tuple(textures.files),
        missing=tuple(textures.missing),
    )


def _normals(layout: Layout) -> IntArray | None:
    """Equal normals of a file have the same index: seams of the texture are not edges."""
    found = next((one for one in layout.directions if one.kind == "normal"), None)
    if found is None:
        return None
    _, number = np.unique(found.slots.values, axis=0, return_inverse=True)
    return np.where(found.of_corner >= 0, number.reshape(-1)[found.of_corner], -1)


def _material(file: GltfFile, about: dict[str, Any], textures: Textures) -> SurfaceMaterial:
    base, link = _base(about)
    color = base.get("baseColorFactor", base.get("diffuseFactor", (1, 1, 1)))
    red, green, blue = (float(value) for value in color[:3])
    cut = about.get("alphaMode", "OPAQUE") != "OPAQUE"
    return SurfaceMaterial(
        name=str(about.get("name", "")),
        color=(red, green, blue),
        texture=None if link is None else _texture(file, link["index"], textures),
        roughness=float(base.get("roughnessFactor", 1.0)),
        alpha_cutoff=float(about.get("alphaCutoff", 0.5)) if cut else None,
    )


def _base(about: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any] | None]:
    """The entry that gives a material its colour, and the link to its texture."""
    glossy = about.get("extensions", {}).get("KHR_materials_pbrSpecularGlossiness")
    base = glossy or about.get("pbrMetallicRoughness", {})
    return base, base.get("diffuseTexture" if glossy else "baseColorTexture")


def _texture(file: GltfFile, number: int, textures: Textures) -> int | None:
    about = file.json["textures"][number]
    webp = about.get("extensions", {}).get("EXT_texture_webp", {})
    source = webp.get("source", about.get("source"))
    if source is None:
        return textures.add(f"texture {number}", None)
    image = file.json["images"][source]
    return textures.add(
        str(image.get("name", f"image {source}")) + f"#{source}", _image(file, image)
    )


def _image(file: GltfFile, image: dict[str, Any]) -> bytes | None:
    if "bufferView" in image:
        view = file.json["bufferViews"][image["bufferView"]]
        start = file.starts[view.get("buffer", 0)] + view.get("byteOffset", 0)
        return file.data[start : start + view["byteLength"]]
    try:
        return base64.b64decode(image["uri"].partition("base64,")[2], validate=True)
    except (binascii.Error, ValueError):
        return None


def _coordinates(file: GltfFile, attributes: dict[str, Any], about: dict[str, Any]) -> np.ndarray:
    """Texture coordinates of a primitive's points, zeros without any."""
    link = _base(about)[1] or {}
    moved = link.get("extensions", {}).get("KHR_texture_transform", {})
    name = f"TEXCOORD_{moved.get('texCoord', link.get('texCoord', 0))}"
    if name not in attributes:
        return np.zeros((len(accessor(file, attributes["POSITION"]).offsets), 2), np.float32)
    values = accessor(file, attributes[name]).rows(file.data)[:, :2]
    points = values.astype(np.float32)
    if values.dtype.kind == "u":
        points /= np.iinfo(values.dtype).max
    angle = float(moved.get("rotation", 0.0))
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    scaled = points * np.array(moved.get("scale", (1, 1)), np.float64)
    placed = scaled @ turn.T + np.array(moved.get("offset", (0, 0)), np.float64)
    return np.asarray(np.nan_to_num(placed), np.float32)


def _colors(file: GltfFile, attributes: dict[str, Any], count: int) -> np.ndarray:
    """Colours of a primitive's points, white without any."""
    if "COLOR_0" not in attributes:
        return np.full((count, 3), 255, np.uint8)
    return as_colors(accessor(file, attributes["COLOR_0"]).rows(file.data)[:, :3], linear=True)
