"""The empties that move handles: one at each handle's centroid, a child of the mesh object."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np
from mathutils import Matrix, Vector

#: Custom properties of an empty: the handle's name, and its place at rest in the mesh's frame.
HANDLE, REST = "snapspace_handle", "snapspace_rest"
#: Size of an empty as a share of the mesh's diagonal.
SIZE = 0.06


def handle_empties(owner: bpy.types.Object) -> dict[str, bpy.types.Object]:
    """The empties of an object by their handles' names."""
    return {child[HANDLE]: child for child in owner.children if HANDLE in child}


def make_empties(
    owner: bpy.types.Object, names: Sequence[str], centroids: np.ndarray, diagonal: float
) -> None:
    """Makes the empties that are missing, and removes those of handles that are gone.

    Empties that exist stay where they are: they may be animated.
    """
    present = handle_empties(owner)
    for name in present.keys() - set(names):
        bpy.data.objects.remove(present[name])
    for name, place in zip(names, centroids, strict=True):
        empty = present.get(name)
        if empty is None:
            empty = bpy.data.objects.new(f"{owner.name} {name}", None)
            for collection in owner.users_collection:
                collection.objects.link(empty)
            empty.parent = owner
            empty.matrix_parent_inverse = Matrix.Identity(4)
            empty.location = Vector(place)
            empty.empty_display_type = "SPHERE"
            empty.empty_display_size = SIZE * diagonal
            empty.show_in_front = True
            empty[HANDLE] = name
        empty[REST] = [float(x) for x in place]


def motions_of(
    owner: bpy.types.Object, depsgraph: bpy.types.Depsgraph
) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Rotation matrix and translation of each handle from rest, in the frame of the object.

    Animation, drivers and constraints of the empties count; their scales do not.
    """
    to_owner = owner.evaluated_get(depsgraph).matrix_world.inverted_safe()
    found = {}
    for name, empty in handle_empties(owner).items():
        local = to_owner @ empty.evaluated_get(depsgraph).matrix_world
        rotation = np.array(local.to_quaternion().to_matrix(), np.float64)
        found[name] = rotation, np.array(local.translation) - np.array(empty[REST])
    return found
