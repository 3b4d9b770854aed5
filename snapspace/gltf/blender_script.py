"""write_blender: a model as a Python script that makes shape keys in Blender."""

from __future__ import annotations

import base64
import zlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..arguments import as_path, require_type, shown
from ..disk.atomic_file import atomic_file
from ..mesh import EmbeddedSurface
from ..reduction import ReducedModel, check_model
from .morph_targets import MorphTargets

_SCRIPT = '''"""Shape keys made by Snapspace. Run it in Blender 4.2 or later:

open it in the text editor and press Alt+P, or give it to `blender --python`.

The shape keys are added to the mesh that the model was made from, which keeps its faces, UVs and
materials. This is the active object, or else the only such mesh of the scene without shape keys. It
may have been moved and scaled. It may also have been rotated if its vertex coordinates are those of
its file, up to rotations by right angles. Vertices are matched by their positions.
If there is no such mesh, a new object is made, without UVs. A shape is the sum of the keys; the
training samples have values from -1 to 1. If the script is run again, it replaces its keys.
"""

import base64
import itertools
import zlib

import bpy
import numpy as np
from mathutils import Euler
from mathutils.kdtree import KDTree

NAME = {name!r}
#: The axis that points up.
UP = {up!r}
#: Euler angles that rotate this axis to Blender's z.
UPRIGHT = {{"x": (0, -np.pi / 2, 0), "y": (np.pi / 2, 0, 0), "z": (0, 0, 0)}}[UP]
#: Vertices that are closer than this share of the diagonal are the same.
CLOSE = 1e-4


def array(text, kind, *shape):
    return np.frombuffer(zlib.decompress(base64.b85decode(text)), kind).reshape(*shape)


#: Vertices at rest, their displacements, and the corners of the faces.
REST = array({rest!r}, "<f4", -1, 3)
KEYS = {keys!r}
MOVES = array({moves!r}, "<f4", len(KEYS), len(REST), 3)
CORNERS = array({corners!r}, "<i4", -1)
STARTS = array({starts!r}, "<i4", -1)
#: All rotations by right angles; the identity is the first.
SIGNED = [
    np.eye(3)[list(order)] * np.array(signs)[:, None]
    for order in itertools.permutations(range(3))
    for signs in itertools.product((1, -1), repeat=3)
]
TURNS = [turn for turn in SIGNED if np.linalg.det(turn) > 0]


def new_object():
    mesh = bpy.data.meshes.new(NAME)
    faces = [CORNERS[a:b].tolist() for a, b in zip(STARTS[:-1], STARTS[1:])]
    mesh.from_pydata(REST.tolist(), [], faces)
    mesh.shade_smooth()
    made = bpy.data.objects.new(NAME, mesh)
    made.rotation_euler = UPRIGHT
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    return made


def points_of(one):
    keys = one.data.shape_keys
    points = keys.key_blocks[0].data if keys else one.data.vertices
    found = np.empty(3 * len(points), np.float32)
    points.foreach_get("co", found)
    return found.reshape(-1, 3)


def in_unit_box(points):
    low, high = points.min(axis=0), points.max(axis=0)
    size = np.linalg.norm(high - low)
    return (points - (low + high) / 2) / size, size


HOME, SIZE = in_unit_box(REST)
TREE = KDTree(len(HOME))
for number, place in enumerate(HOME):
    TREE.insert(place, number)
TREE.balance()


def in_order(places):
    same = places.shape == HOME.shape and np.abs(places - HOME).max() < CLOSE
    return np.arange(len(HOME)) if same else None


def nearest(places):
    if not np.abs(places.max(axis=0) - HOME.max(axis=0)).max() < CLOSE:
        return None
    found = [TREE.find(place) for place in places]
    same = max(distance for _, _, distance in found) < CLOSE
    return np.array([number for _, number, _ in found]) if same else None


def moves_for(one):
    """The matrix of moves to the object's frame, and the number of each vertex in REST, or None."""
    if one is None or one.type != "MESH" or len(one.data.vertices) < 2:
        return None
    points = points_of(one)
    upright = np.array(Euler(UPRIGHT).to_matrix())
    as_it_stands = np.array(one.matrix_world)[:3, :3].T @ upright
    for match in (in_order, nearest):
        for turn in [as_it_stands, *TURNS]:
            places, size = in_unit_box(points @ turn)
            own = match(places)
            if own is not None:
                return size / SIZE * np.linalg.inv(turn), own
    return None


if bpy.context.mode != "OBJECT":
    bpy.ops.object.mode_set(mode="OBJECT")
active = bpy.context.view_layer.objects.active
fit = moves_for(active)
if fit is None:
    meshes = [one for one in bpy.context.scene.objects if one.type == "MESH"]
    free = [one for one in meshes if not one.data.shape_keys and moves_for(one)]
    active = free[0] if len(free) == 1 else new_object()
    fit = moves_for(active)
back, own = fit
if active.data.shape_keys is None:
    active.shape_key_add(name="Basis", from_mix=False)
rest = points_of(active)
blocks = active.data.shape_keys.key_blocks
for name, moves in zip(KEYS, MOVES):
    key = blocks.get(name) or active.shape_key_add(name=name, from_mix=False)
    key.data.foreach_set("co", (rest + moves[own] @ back).astype(np.float32).ravel())
    key.slider_min, key.slider_max = -1.0, 1.0
    if name == {mean!r}:
        key.value = 1.0
active.data.update()
'''
#: The key of the base shape to which all others are added, if that is not the rest shape.
MEAN = "Mean"
#: Shapes that differ by less than this share of the diagonal are the same.
_SAME = 1e-9


def write_blender(
    path: str | Path,
    model: ReducedModel,
    morphs: MorphTargets,
    *,
    name: str | None = None,
    up: str | None = None,
) -> Path:
    """Writes a script that makes a mesh with shape keys in Blender. The script needs no extension.

    Parameters
    ----------
    path : str or Path
        Ends in .py.
    model : PosingModel or InterpolationModel
    morphs : MorphTargets
        From `mode_targets` or `fitted_targets`.
    name : str, optional
        Name of the object. Default: the file's name without its extension.
    up : "x", "y" or "z", default the model's own
        Axis that points up.

    Returns
    -------
    Path
        The script. Keys are displacements from the rest shape, scaled so that the training samples
        have values between -1 and 1. Faces are those of the surface's file, if it is known. If the
        base is another shape, as in most blends, the key Mean has that shape and the value 1.

    Raises
    ------
    ValueError
        For arguments of other types, an unknown extension or axis, or if the file cannot be
        written.
    """
    check_model(model, "write_blender", "give path, model, morphs")
    cure = "give those of mode_targets"
    require_type("write_blender", "morphs", morphs, MorphTargets, cure)
    path = as_path("write_blender", path)
    if path.suffix.lower() != ".py":
        raise ValueError(f"{path}: the name of a script for Blender must end in .py")
    if up not in (None, "x", "y", "z"):
        raise ValueError(f"write_blender: up is {shown(up)}, but it must be one of x, y, z")
    require_type("write_blender", "name", name, str | None, "give a string")
    corners, starts = _polygons(model.surface)
    rest = model.surface.vertices(model.problem.mesh.vertices)
    moves = morphs.targets * _largest_weights(model, morphs)[:, None, None]
    keys = [f"Mode {number + 1}" for number in range(len(moves))]
    if np.abs(morphs.base - rest).max() > _SAME * model.problem.mesh.diagonal:
        keys, moves = [MEAN, *keys], np.concatenate([(morphs.base - rest)[None], moves])
    content = _SCRIPT.format(
        name=path.stem if name is None else name,
        up=getattr(model, "up", "z") if up is None else up,
        rest=_text(rest.astype("<f4")),
        keys=keys,
        mean=MEAN,
        moves=_text(moves.astype("<f4")),
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
