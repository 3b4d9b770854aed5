"""write_glb: a model's surface with morph targets as one binary glTF file."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..disk import atomic_file
from ..reduction import ReducedModel
from .glb_file import GlbFile
from .morph_targets import MorphTargets

#: Quaternions x, y, z, w that turn an axis to y, which is up in glTF.
_HALF = float(np.sqrt(0.5))
_TO_Y = {"x": (0.0, 0.0, _HALF, _HALF), "y": None, "z": (-_HALF, 0.0, 0.0, _HALF)}
_CLAY, _WHITE = (0.72, 0.63, 0.53, 1.0), (1.0, 1.0, 1.0, 1.0)


def write_glb(
    path: str | os.PathLike[str],
    model: ReducedModel,
    morphs: MorphTargets,
    *,
    name: str = "snapspace",
    up: str | None = None,
    frames_per_second: float = 30.0,
    colors: NDArray[np.float64] | None = None,
) -> Path:
    """Writes the surface of a model with morph targets, and an animation of their weights.

    Parameters
    ----------
    path : path
        Ends in .glb. An existing file is replaced once the new one is complete.
    model : ReducedModel
        Its surface has the faces.
    morphs : MorphTargets
        From `mode_targets` or `fitted_targets`. With two or more rows of weights these are the
        frames of an animation; one row is the initial state.
    name : str
        Name of mesh and node.
    up : "x", "y" or "z", default that of the model
        The axis that points up; a rotation of the node turns it to glTF's y. Numbers stay in the
        model's length unit.
    frames_per_second : float, default 30
    colors : ndarray, (s, 3), optional
        Colours of the vertices, sRGB in [0, 1]. Default: one material for all.

    Returns
    -------
    Path
        The file; its bytes are the same for the same input.

    Raises
    ------
    ValueError
        For another extension, an unknown axis, or a frame rate that is not positive.
    """
    target = Path(path)
    if target.suffix.lower() != ".glb":
        raise ValueError(f"write_glb: {target} must end in .glb")
    axis = model.up if up is None else up
    if axis not in _TO_Y:
        raise ValueError(f"write_glb: up is '{axis}', but it must be one of x, y, z")
    if not (np.isfinite(frames_per_second) and frames_per_second > 0.0):
        raise ValueError(f"write_glb: frames_per_second {frames_per_second} must be positive")
    file = GlbFile()
    content = {
        "asset": {"version": "2.0", "generator": "Snapspace"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [_node(name, axis)],
        "materials": [_material(_CLAY if colors is None else _WHITE)],
        "meshes": [_mesh(file, name, morphs, model.surface.faces, colors)],
    }
    if len(morphs.weights) > 1:
        content["animations"] = [_animation(file, morphs.weights, frames_per_second)]
    with atomic_file(target) as temporary:
        temporary.write_bytes(file.bytes(content))
    return target


def _node(name: str, axis: str) -> dict[str, Any]:
    rotation = _TO_Y[axis]
    node: dict[str, Any] = {"name": name, "mesh": 0}
    return node if rotation is None else {**node, "rotation": list(rotation)}


def _material(color: tuple[float, ...]) -> dict[str, Any]:
    roughness = {"baseColorFactor": list(color), "metallicFactor": 0.0, "roughnessFactor": 0.8}
    return {"name": "clay", "pbrMetallicRoughness": roughness}


def _mesh(
    file: GlbFile,
    name: str,
    morphs: MorphTargets,
    faces: NDArray[np.int32],
    colors: NDArray[np.float64] | None,
) -> dict[str, Any]:
    attributes = {
        "POSITION": file.floats(morphs.base, vertices=True, bounds=True),
        "NORMAL": file.floats(morphs.normals, vertices=True),
    }
    if colors is not None:
        attributes["COLOR_0"] = file.floats(_linear(colors), vertices=True)
    primitive = {"attributes": attributes, "indices": file.indices(faces), "material": 0}
    mesh: dict[str, Any] = {"name": name, "primitives": [primitive]}
    if len(morphs.targets) == 0:
        return mesh
    primitive["targets"] = [
        {
            "POSITION": file.floats(moved, vertices=True, bounds=True),
            "NORMAL": file.floats(turned, vertices=True),
        }
        for moved, turned in zip(morphs.targets, morphs.normal_targets, strict=True)
    ]
    first = morphs.weights[0] if len(morphs.weights) else np.zeros(len(morphs.targets))
    names = [f"mode {number + 1}" for number in range(len(morphs.targets))]
    return {**mesh, "weights": first.tolist(), "extras": {"targetNames": names}}


def _linear(colors: NDArray[np.float64]) -> NDArray[np.float64]:
    """Colours of glTF's vertices are linear; these are sRGB (IEC 61966-2-1)."""
    steep = np.clip((colors + 0.055) / 1.055, 0.0, 1.0) ** 2.4
    return np.where(colors <= 0.04045, colors / 12.92, steep)


def _animation(file: GlbFile, weights: NDArray[np.float64], rate: float) -> dict[str, Any]:
    times = file.floats(np.arange(len(weights)) / rate, vertices=False, bounds=True)
    values = file.floats(weights.reshape(-1), vertices=False)
    return {
        "name": "path",
        "samplers": [{"input": times, "output": values, "interpolation": "LINEAR"}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
    }
