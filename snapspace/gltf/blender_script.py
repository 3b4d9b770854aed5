"""write_blender: a model as a Python script that makes shape keys in Blender."""

from __future__ import annotations

import base64
import zlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..disk.atomic_file import atomic_file
from ..mesh import EmbeddedSurface
from ..reduction import ReducedModel
from .morph_targets import MorphTargets

_SCRIPT = '''"""Shape keys of {name}, made by Snapspace. Run it in Blender 4.2 or later:

open it in the text editor and press Alt+P, or `blender --python {file}`.

If the active object is a mesh of {count} vertices, it gets the shape keys, and keeps its faces, UVs
and materials; otherwise the only such mesh of the scene without shape keys. If there is none, a new
object is made, without UVs. A shape is the sum of the keys; values from -1 to 1 are those of the
training samples.
"""

import base64
import zlib

import bpy
import numpy as np

NAME = {name!r}
#: Axis that points up.
UP = {up!r}


def array(text, kind, *shape):
    return np.frombuffer(zlib.decompress(base64.b85decode(text)), kind).reshape(*shape)


BASE = array({base!r}, "<f4", -1, 3)
TARGETS = array({targets!r}, "<f4", -1, len(BASE), 3)
CORNERS = array({corners!r}, "<i4", -1)
STARTS = array({starts!r}, "<i4", -1)


def new_object():
    mesh = bpy.data.meshes.new(NAME)
    faces = [CORNERS[a:b].tolist() for a, b in zip(STARTS[:-1], STARTS[1:])]
    mesh.from_pydata(BASE.tolist(), [], faces)
    mesh.shade_smooth()
    made = bpy.data.objects.new(NAME, mesh)
    made.rotation_euler = {{"x": (0, -np.pi / 2, 0), "y": (np.pi / 2, 0, 0), "z": (0, 0, 0)}}[UP]
    bpy.context.scene.collection.objects.link(made)
    return made


def fits(one):
    return one is not None and one.type == "MESH" and len(one.data.vertices) == len(BASE)


active = bpy.context.view_layer.objects.active
if not fits(active):
    found = [one for one in bpy.context.scene.objects if fits(one) and not one.data.shape_keys]
    active = found[0] if len(found) == 1 else new_object()
if active.data.shape_keys is None:
    active.shape_key_add(name="Basis", from_mix=False)
for number, target in enumerate(TARGETS, start=1):
    key = active.shape_key_add(name=f"Mode {{number}}", from_mix=False)
    key.data.foreach_set("co", (BASE + target).ravel())
    key.slider_min, key.slider_max = -1.0, 1.0
active.data.update()
'''


def write_blender(
    path: str | Path,
    model: ReducedModel,
    morphs: MorphTargets,
    *,
    name: str | None = None,
    up: str | None = None,
) -> Path:
    """Writes a script that makes a mesh with shape keys in Blender; it needs no extension.

    Parameters
    ----------
    path : str or Path
        Ends in .py.
    model : PosingModel or InterpolationModel
    morphs : MorphTargets
        Of `mode_targets` or `fitted_targets`.
    name : str, optional
        Of the object. Default: the file's name without its extension.
    up : "x", "y" or "z", default the model's own
        Axis that points up.

    Returns
    -------
    Path
        The script. Keys are displacements from the base, scaled so that the training samples have
        values between -1 and 1; faces are those of the surface's file where it is known.

    Raises
    ------
    ValueError
        For an unknown extension, or if the file cannot be written.
    """
    path = Path(path)
    if path.suffix.lower() != ".py":
        raise ValueError(f"{path}: the name of a script for Blender must end in .py")
    corners, starts = _polygons(model.surface)
    targets = morphs.targets * _largest_weights(model, morphs)[:, None, None]
    content = _SCRIPT.format(
        name=path.stem if name is None else name,
        file=path.name,
        count=len(morphs.base),
        up=getattr(model, "up", "z") if up is None else up,
        base=_text(morphs.base.astype("<f4")),
        targets=_text(targets.astype("<f4")),
        corners=_text(corners.astype("<i4")),
        starts=_text(starts.astype("<i4")),
    )
    with atomic_file(path) as temporary:
        temporary.write_text(content, encoding="utf-8")
    return path


def _largest_weights(model: ReducedModel, morphs: MorphTargets) -> NDArray[np.float64]:
    """The largest weight of each target in the given shapes, or else in the training samples."""
    weights = morphs.weights
    known = model.training_coordinates
    if len(weights) == 0 and known.shape[1:] == (len(morphs.targets),):
        weights = known
    largest: NDArray[np.float64] = np.abs(weights).max(axis=0, initial=0.0)
    return np.where(largest > 0, largest, 1.0)


def _polygons(surface: EmbeddedSurface) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Corners and starts of the faces, those of the surface's file where it is known."""
    source = surface.source
    if source is not None and len(source.vertices) == len(surface.corners):
        return source.corners.astype(np.int64), source.starts.astype(np.int64)
    faces = surface.faces
    return faces.ravel().astype(np.int64), 3 * np.arange(len(faces) + 1, dtype=np.int64)


def _text(array: NDArray[np.generic]) -> str:
    return base64.b85encode(zlib.compress(array.tobytes(), 9)).decode("ascii")
