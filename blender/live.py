"""The live solve: when an empty or a weight changes, a shape key gets the solved shape."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
from bpy.app.handlers import persistent

from . import models
from .empties import motions_of
from .mesh_data import pose_keys, result_key, write_key
from .problems import weights_of

#: The empties or weights of the last solve, by the object's session id.
_solved: dict[int, bytes] = {}


def solved_points(owner: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> np.ndarray | None:
    """Points (s, 3) for the current empties or weights; None without a model or without changes.

    ValueError as for `models.session`.
    """
    session = models.session(owner)
    if session is None:
        return None
    posing = hasattr(session, "move_all")
    if posing:
        motions = motions_of(owner, depsgraph, session.model.problem.handles.names)
        asked = b"".join(
            name.encode() + r.tobytes() + t.tobytes() for name, (r, t) in motions.items()
        )
    else:
        weights = weights_of({key.name: key.value for key in pose_keys(owner)})
        asked = weights.tobytes()
    asked += id(session).to_bytes(8, "little")
    if _solved.get(owner.session_uid) == asked:
        return None
    models.check_rest(owner, session.model)
    _solved[owner.session_uid] = asked
    if posing:
        session.move_all(motions)
    else:
        session.blend(weights)
    return session.model.surface.vertices(session.positions)


def update(owner: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> None:
    """Shows the solved shape of one object, if something has changed. Errors go to its panel."""
    try:
        points = solved_points(owner, depsgraph)
    except ValueError as error:
        owner.snapspace.status = str(error)
        return
    if points is not None:
        write_key(result_key(owner), points)
        owner.data.update()


def update_all(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Shows the solved shapes of all objects of a scene with a live model."""
    for owner in scene.objects:
        if owner.type == "MESH" and owner.mode == "OBJECT" and owner.snapspace.live:
            update(owner, depsgraph)


def forget() -> None:
    """Makes the next update solve for every object."""
    _solved.clear()


@persistent
def _on_change(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    update_all(scene, depsgraph)


@persistent
def _on_save(file: str, *_: object) -> None:
    if file:
        models.follow(Path(file))


@persistent
def _on_load(*_: object) -> None:
    models.forget()
    forget()


_HANDLERS = (
    ("depsgraph_update_post", _on_change),
    ("frame_change_post", _on_change),
    ("load_post", _on_load),
    ("save_pre", _on_save),
)


def register() -> None:
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).remove(handler)
    _on_load()
