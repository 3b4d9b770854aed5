"""Materials of glTF files: the user's own ones, or clay."""

from __future__ import annotations

import warnings
from typing import Any

from ..mesh import Appearance, MeshNotice, SurfaceMaterial
from .glb_file import GlbFile

Color = tuple[float, float, float]
_CLAY, _WHITE = (0.72, 0.63, 0.53), (1.0, 1.0, 1.0)
#: The first bytes of the image formats that glTF supports.
_KINDS = {b"\x89PNG": "image/png", b"\xff\xd8\xff": "image/jpeg"}


def plain_material(*, painted: bool, both_sides: bool) -> dict[str, Any]:
    """The entries of a file with one material: clay, or white where points have colours."""
    clay = _entry("clay", _WHITE if painted else _CLAY, 0.8, both_sides=both_sides)
    return {"materials": [clay]}


def own_materials(file: GlbFile, look: Appearance, *, both_sides: bool) -> dict[str, Any]:
    """The entries of the user's materials, and of their base-colour textures.

    Warns of images that are neither PNG nor JPEG, which glTF does not support.
    """
    pictures: dict[int, int] = {}
    images: list[dict[str, Any]] = []
    for number, data in enumerate(look.textures):
        kind = next((kind for start, kind in _KINDS.items() if data.startswith(start)), None)
        if kind is not None:
            pictures[number] = len(images)
            images.append({"bufferView": file.picture(data), "mimeType": kind})
    left_out = len(look.textures) - len(images)
    if left_out:
        warnings.warn(
            f"the .glb file is written without {left_out} of {len(look.textures)} textures: glTF "
            "has PNG and JPEG only; save them as PNG",
            MeshNotice,
            stacklevel=3,
        )
    content: dict[str, Any] = {
        "materials": [_material(one, pictures, both_sides=both_sides) for one in look.materials]
    }
    if images:
        textures = [{"source": number} for number in range(len(images))]
        content |= {"images": images, "textures": textures}
    return content


def _material(
    about: SurfaceMaterial, pictures: dict[int, int], *, both_sides: bool
) -> dict[str, Any]:
    entry = _entry(about.name, about.color, about.roughness, both_sides=both_sides)
    if about.texture in pictures:
        entry["pbrMetallicRoughness"]["baseColorTexture"] = {"index": pictures[about.texture]}
    if about.alpha_cutoff is not None:
        entry |= {"alphaMode": "MASK", "alphaCutoff": about.alpha_cutoff}
    return entry


def _entry(name: str, color: Color, roughness: float, *, both_sides: bool) -> dict[str, Any]:
    entry: dict[str, Any] = {
        "pbrMetallicRoughness": {
            "baseColorFactor": [*color, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": roughness,
        }
    }
    if name:
        entry["name"] = name
    return {**entry, "doubleSided": True} if both_sides else entry
