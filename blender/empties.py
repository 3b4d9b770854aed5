"""The empties that move handles: one at each handle's centroid, a child of the mesh object."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np
from mathutils import Matrix, Vector

#: Custom properties of an empty: the handle's name, and its rest position in the mesh's frame.
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


def check_alone(owner: bpy.types.Object) -> None:
    """ValueError if the empties of another object move the same mesh."""
    for other in bpy.data.objects:
        if other is not owner and other.data == owner.data and handle_empties(other):
            raise ValueError(
                f"{owner.name} and {other.name} share a mesh, which the empties of {other.name} "
                f"move; give {owner.name} its own mesh (Object > Relations > Make Single User)"
            )


def motions_of(
    owner: bpy.types.Object, depsgraph: bpy.types.Depsgraph, names: Sequence[str]
) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Rotation matrix and translation of each handle from rest, in the frame of the object.

    Animation, drivers and constraints of the empties count; their scales do not. A handle whose
    empty was removed stays at rest. ValueError if all were removed, as in a copy of the object
    without its empties.
    """
    to_owner = owner.evaluated_get(depsgraph).matrix_world.inverted_safe()
    empties = {name: one for name, one in handle_empties(owner).items() if name in names}
    if not empties:
        raise ValueError(f"{owner.name} has no empties for its handles; Compute makes them")
    found = {name: (np.eye(3), np.zeros(3)) for name in names}
    for name, empty in empties.items():
        local = to_owner @ empty.evaluated_get(depsgraph).matrix_world
        rotation = np.array(local.to_quaternion().to_matrix(), np.float64)
        found[name] = rotation, np.array(local.translation) - np.array(empty[REST])
    return found
