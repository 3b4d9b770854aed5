"""write_glb: a model's surface with morph targets as one binary glTF file."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arguments import as_numbers, as_path, is_finite, require_type, shown
from ..disk import atomic_file
from ..reduction import ReducedModel, check_model
from .glb_file import GlbFile
from .glb_materials import own_materials, plain_material
from .glb_mesh import glb_mesh
from .morph_targets import MorphTargets
from .sliders import with_sliders

FloatArray = NDArray[np.float64]
#: Quaternions x, y, z, w that turn an axis to y, which is up in glTF.
_HALF = float(np.sqrt(0.5))
#: Distance from the origin, in diagonals, beyond which points are written relative to the node: in
#: single precision they would be rounded by 0.001 %.
_FAR = 100.0
_TO_Y = {"x": (0.0, 0.0, _HALF, _HALF), "y": None, "z": (-_HALF, 0.0, 0.0, _HALF)}


def write_glb(
    path: str | os.PathLike[str],
    model: ReducedModel,
    morphs: MorphTargets,
    *,
    name: str | None = None,
    up: str | None = None,
    frames_per_second: float = 30.0,
    colors: FloatArray | None = None,
) -> Path:
    """Writes the surface of a model with morph targets, and an animation of their weights.

    Parameters
    ----------
    path : path
        Ends in .glb. An existing file is replaced once the new one is complete.
    model : ReducedModel
        Its surface gives the faces. If it comes from the user's own file, it also gives texture
        coordinates, materials, base-colour textures, colours and sharp edges.
    morphs : MorphTargets
        From `mode_targets` or `fitted_targets`. With two or more rows of weights these are the
        frames of an animation, written as weights between 0 and 1, which Blender and engines do not
        clamp; that may take one more target. One row is the initial state.
    name : str, optional
        Name of the mesh and the node. Default: the file's name without its extension.
    up : "x", "y" or "z", default that of the model
        The axis that points up; a rotation of the node turns it to glTF's y. Numbers stay in the
        model's length unit. A body far from the origin for its size is moved there, and back by a
        translation of the node: points are in single precision.
    frames_per_second : float, default 30
    colors : ndarray, (s, 3), optional
        Colours of the vertices, sRGB in [0, 1], instead of the user's own materials. Default: these
        materials, or one like clay.

    Returns
    -------
    Path
        The file; the same input gives the same bytes.

    Raises
    ------
    ValueError
        For arguments of other types, colours of another shape, another extension, an unknown axis,
        or a frame rate that is not positive.

    Warns
    -----
    MeshNotice
        For materials and textures that are missing or damaged, or not PNG or JPEG.
    """
    check_model(model, "write_glb", "give path, model, morphs")
    target = as_path("write_glb", path)
    if target.suffix.lower() != ".glb":
        raise ValueError(f"write_glb: {target} must end in .glb")
    cure = "give those of mode_targets, fitted_targets or still_shape"
    require_type("write_glb", "morphs", morphs, MorphTargets, cure)
    axis = model.up if up is None else up
    if axis not in tuple(_TO_Y):
        raise ValueError(f"write_glb: up is {shown(axis)}, but it must be one of x, y, z")
    if not (is_finite(frames_per_second) and frames_per_second > 0.0):
        rate = shown(frames_per_second)
        raise ValueError(f"write_glb: frames_per_second {rate} must be positive")
    if colors is not None:
        colors = as_numbers("write_glb", "colors", colors)
        if colors.shape != morphs.base.shape:
            raise ValueError(
                f"write_glb: colors have shape {colors.shape}, but must be {morphs.base.shape}, "
                "one row per vertex of the surface"
            )
    require_type("write_glb", "name", name, str | None, "give a string")
    if len(morphs.weights) > 1:
        morphs = with_sliders(morphs)
    file, drawn, origin = GlbFile(), morphs.drawn, _origin(morphs.base)
    if origin is not None:
        morphs = replace(morphs, base=morphs.base - origin)
    if colors is None and drawn.look is not None:
        materials = own_materials(file, drawn.look, both_sides=drawn.both_sides)
    else:
        materials = plain_material(painted=colors is not None, both_sides=drawn.both_sides)
    title = target.stem if name is None else name
    content = {
        "asset": {"version": "2.0", "generator": "Snapspace"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [_node(title, axis, origin)],
        "meshes": [glb_mesh(file, title, morphs, colors=colors)],
        **materials,
    }
    if len(morphs.weights) > 1 and len(morphs.targets):
        content["animations"] = [_animation(file, morphs.weights, frames_per_second)]
    with atomic_file(target) as temporary:
        temporary.write_bytes(file.file_bytes(content))
    return target


def _origin(points: FloatArray) -> FloatArray | None:
    """The middle of points (s, 3) that are far from the origin; None for others."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle: FloatArray = (low + high) / 2.0
    return middle if np.abs(middle).max() > _FAR * np.linalg.norm(high - low) else None


def _node(name: str, axis: str, origin: FloatArray | None) -> dict[str, Any]:
    rotation = _TO_Y[axis]
    node: dict[str, Any] = {"name": name, "mesh": 0}
    if rotation is not None:
        node["rotation"] = list(rotation)
    if origin is not None:  # glTF rotates first
        x, y, z = origin.tolist()
        node["translation"] = {"x": [-y, x, z], "y": [x, y, z], "z": [x, z, -y]}[axis]
    return node


def _animation(file: GlbFile, weights: FloatArray, rate: float) -> dict[str, Any]:
    times = file.floats(np.arange(len(weights)) / rate, vertices=False, bounds=True)
    values = file.floats(weights.reshape(-1), vertices=False)
    return {
        "name": "path",
        "samplers": [{"input": times, "output": values, "interpolation": "LINEAR"}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
    }
