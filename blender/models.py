"""The models of a Blender file: where they are stored, and their sessions."""

from __future__ import annotations

import hashlib
import shutil
import tempfile
from pathlib import Path
from typing import Any

import bpy
import numpy as np

import snapspace as ss

from .mesh_data import rest_points

#: Sessions by the model's file and its modification time.
_sessions: dict[tuple[str, float], Any] = {}
#: Vertices at rest that differ by more than this share of the diagonal were edited.
_EDITED = 1e-4
#: The session of the newest model during a computation, by the object's session id.
_growing: dict[int, Any] = {}


def model_path(owner: bpy.types.Object) -> Path:
    """Where the model of an object is stored: beside the .blend file if that was saved."""
    name = bpy.path.clean_name(owner.name)
    if bpy.data.filepath:
        file = Path(bpy.data.filepath)
        return file.with_name(f"{file.stem}-{name}.snapspace")
    key = hashlib.sha256(owner.name.encode()).hexdigest()[:6]
    return Path(tempfile.gettempdir()) / f"blender-{name}-{key}.snapspace"


def store(owner: bpy.types.Object, model: ss.ReducedModel) -> Path:
    """Saves a model as the model of an object."""
    path = model_path(owner)
    model.save(path)
    relative = bpy.path.relpath(str(path)) if bpy.data.filepath else str(path)
    owner.snapspace.model = relative
    _growing.pop(owner.session_uid, None)
    return path


def show(owner: bpy.types.Object, model: ss.ReducedModel) -> None:
    """Uses a model that is not stored yet, until `store` is called."""
    _growing[owner.session_uid] = model.session()


def session(owner: bpy.types.Object) -> Any:
    """The session of an object's model; None without a model.

    ValueError if the model's file is missing or is for another mesh.
    """
    if owner.session_uid in _growing:
        return _growing[owner.session_uid]
    if not owner.snapspace.model:
        return None
    path = Path(bpy.path.abspath(owner.snapspace.model))
    if not path.is_file():
        raise ValueError(f"{path} is missing; compute the model again")
    key = str(path), path.stat().st_mtime
    if key not in _sessions:
        _sessions[key] = ss.load(path).session()
    found = _sessions[key]
    count = len(found.model.surface.corners)
    if count != len(owner.data.vertices):
        raise ValueError(
            f"the model has {count} vertices, but {owner.name} has {len(owner.data.vertices)}; "
            "compute it again"
        )
    return found


def check_rest(owner: bpy.types.Object, model: ss.ReducedModel) -> None:
    """ValueError if the rest shape was edited: a solved shape would undo these edits."""
    mesh = model.problem.mesh
    change = rest_points(owner.data) - model.surface.vertices(mesh.vertices)
    if np.abs(change).max() > _EDITED * mesh.diagonal:
        raise ValueError(f"{owner.name} was edited after its model was made; compute it again")


def follow(file: Path) -> None:
    """Copies the models of all objects beside a .blend file that is about to be saved there."""
    for owner in bpy.data.objects:
        name = owner.snapspace.model
        here = Path(bpy.path.abspath(name))
        if not name or not here.is_file():
            continue
        if not name.startswith("//"):
            if here.parent != Path(tempfile.gettempdir()):
                continue  # the user's own choice
            owner.snapspace.model = f"//{file.stem}-{bpy.path.clean_name(owner.name)}.snapspace"
        there = file.parent / owner.snapspace.model[2:]
        if there.resolve() != here.resolve():
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(here, there)


def forget() -> None:
    """Forgets all sessions, for instance when another .blend file is opened."""
    _sessions.clear()
    _growing.clear()
