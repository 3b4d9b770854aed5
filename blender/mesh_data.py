"""Data of a mesh object: points, triangles, handles from vertex groups, poses from shape keys."""

import bpy
import numpy as np

#: The shape key that shows the solved shape.
RESULT = "Snapspace"
#: Shape keys that were baked have names that begin with this.
BAKED = "Baked"
#: Vertices with at least this weight belong to a group's handle.
WEIGHT = 0.5
#: Scales along two axes that differ by less than this share count as equal.
SAME_SCALE = 1e-4


def check_scale(owner: bpy.types.Object) -> None:
    """ValueError if an object's scale differs between axes, which would change its solid."""
    scale = np.abs(owner.matrix_world.to_scale())
    if scale.max() > (1 + SAME_SCALE) * scale.min():
        raise ValueError(f"{owner.name}: its scale is not uniform; apply it (Ctrl+A, Scale)")


def rest_points(mesh: bpy.types.Mesh) -> np.ndarray:
    """Points (s, 3) of the rest shape, in the object's frame: those of the basis key, if any."""
    keys = mesh.shape_keys
    return key_points(keys.key_blocks[0]) if keys else _read(mesh.vertices)


def key_points(key: bpy.types.ShapeKey) -> np.ndarray:
    """Points (s, 3) of a shape key."""
    return _read(key.data)


def _read(points: bpy.types.bpy_prop_collection) -> np.ndarray:
    values = np.empty(3 * len(points), np.float32)
    points.foreach_get("co", values)
    return values.reshape(-1, 3).astype(np.float64)


def write_key(key: bpy.types.ShapeKey, points: np.ndarray) -> None:
    """Sets the points of a shape key."""
    key.data.foreach_set("co", np.ascontiguousarray(points, np.float32).ravel())


def triangles(mesh: bpy.types.Mesh) -> np.ndarray:
    """Triangles (f, 3) of the faces, as Blender draws them."""
    mesh.calc_loop_triangles()
    found = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", found)
    return found.reshape(-1, 3)


def handle_vertices(owner: bpy.types.Object) -> dict[str, np.ndarray]:
    """Vertices of each vertex group, which have at least the weight `WEIGHT` in it.

    A vertex in several groups belongs to the one with the largest weight. Groups without vertices,
    and groups whose names begin with "_", are not handles.
    """
    groups = {group.index: group.name for group in owner.vertex_groups}
    members: dict[str, list[int]] = {name: [] for name in groups.values() if name[0] != "_"}
    for vertex in owner.data.vertices:
        known = [(g.weight, -g.group) for g in vertex.groups if groups[g.group] in members]
        if known and max(known)[0] >= WEIGHT:
            members[groups[-max(known)[1]]].append(vertex.index)
    return {name: np.array(found) for name, found in members.items() if found}


def pose_keys(owner: bpy.types.Object) -> list[bpy.types.ShapeKey]:
    """The shape keys that are poses: all but the basis, the solved shape, and baked ones."""
    keys = owner.data.shape_keys
    ours = {RESULT, *(key.name for key in baked_keys(owner))}
    return [] if keys is None else [key for key in keys.key_blocks[1:] if key.name not in ours]


def baked_keys(owner: bpy.types.Object) -> list[bpy.types.ShapeKey]:
    """The shape keys that were baked."""
    keys = owner.data.shape_keys
    return [] if keys is None else [key for key in keys.key_blocks if key.name.startswith(BAKED)]


def result_key(owner: bpy.types.Object) -> bpy.types.ShapeKey:
    """The shape key of the solved shape, made at rest if there is none.

    Baked keys show the same film. They are muted so that both do not add up.
    """
    if owner.data.shape_keys is None:
        owner.shape_key_add(name="Basis", from_mix=False)
    key = owner.data.shape_keys.key_blocks.get(RESULT)
    if key is None:
        key = owner.shape_key_add(name=RESULT, from_mix=False)
    key.value, key.mute = 1.0, False
    for baked in baked_keys(owner):
        baked.mute = True
    return key
