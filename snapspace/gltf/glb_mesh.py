"""glb_mesh: the mesh of a glTF file, with a primitive for each material."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .glb_file import GlbFile
from .morph_targets import MorphTargets

FloatArray = NDArray[np.float64]


def glb_mesh(
    file: GlbFile, name: str, morphs: MorphTargets, *, colors: FloatArray | None
) -> dict[str, Any]:
    """The entry of a mesh whose primitives share their points and morph targets.

    colors : (s, 3), sRGB of the surface's vertices, which then share one material; None for the
    user's own materials and colours
    """
    drawn, points = morphs.drawn, morphs.drawn.points
    own = colors is None and drawn.look is not None
    shared: dict[str, Any] = {
        "attributes": {
            "POSITION": file.floats(morphs.base[points.vertex], vertices=True, bounds=True),
            "NORMAL": file.floats(morphs.normals[drawn.normal], vertices=True),
        }
    }
    if points.coordinates is not None:
        shared["attributes"]["TEXCOORD_0"] = file.floats(points.coordinates, vertices=True)
    painted = colors[points.vertex] if colors is not None else None
    if own and points.colors is not None:
        painted = points.colors / 255.0
    if painted is not None:
        shared["attributes"]["COLOR_0"] = file.floats(_linear(painted), vertices=True)
    if len(morphs.targets):
        shared["targets"] = [
            {
                "POSITION": file.floats(moved[points.vertex], vertices=True, bounds=True),
                "NORMAL": file.floats(turned[drawn.normal], vertices=True),
            }
            for moved, turned in zip(morphs.targets, morphs.normal_targets, strict=True)
        ]
    ends = np.cumsum(points.counts if own else [len(points.triangles)]).tolist()
    parts = enumerate(zip([0, *ends], ends, strict=False))
    primitives = [
        {**shared, "indices": file.indices(points.triangles[begin:end]), "material": material}
        for material, (begin, end) in parts
        if begin < end
    ]
    mesh: dict[str, Any] = {"name": name, "primitives": primitives}
    if len(morphs.targets) == 0:
        return mesh
    first = morphs.weights[0] if len(morphs.weights) else np.zeros(len(morphs.targets))
    names = [f"mode {number + 1}" for number in range(len(morphs.targets))]
    return {**mesh, "weights": first.tolist(), "extras": {"targetNames": names}}


def _linear(colors: FloatArray) -> FloatArray:
    """Linear colours, as glTF needs for vertices, from sRGB (IEC 61966-2-1)."""
    steep = np.clip((colors + 0.055) / 1.055, 0.0, 1.0) ** 2.4
    return np.where(colors <= 0.04045, colors / 12.92, steep)
