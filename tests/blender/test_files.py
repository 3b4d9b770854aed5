"""Files of Snapspace in Blender: films play as solved, and scripts find meshes that it imported."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial import cKDTree

import snapspace as ss

from .drawn import drawn

Shapes = np.ndarray


@pytest.fixture
def imported(bpy: Any) -> Callable[[Path], Any]:
    """Imports a .glb into an empty file of 30 frames per second; its mesh object is active."""

    def one(path: Path) -> Any:
        bpy.ops.wm.read_homefile(use_empty=True)
        bpy.context.scene.render.fps = 30
        bpy.ops.import_scene.gltf(filepath=str(path))
        (found,) = (made for made in bpy.data.objects if made.type == "MESH")
        bpy.context.view_layer.objects.active = found
        return found

    return one


def in_world(bpy: Any, owner: Any) -> np.ndarray:
    matrix = np.array(owner.matrix_world)
    return drawn(bpy, owner) @ matrix[:3, :3].T + matrix[:3, 3]


def test_a_film_plays_as_it_was_solved(
    bpy: Any, posing_model: ss.PosingModel, imported: Callable[[Path], Any], tmp_path: Path
) -> None:
    """Blender clamps weights below zero, which a motion to and fro has."""
    session = posing_model.session()
    nod = session.animate([{"head": ((0, z, 0), (0, 0, z))} for z in (0.3, -0.3)], frames=8)
    shapes = [session.vertices for _ in nod]
    (path,) = ss.write_animation(tmp_path / "nod.glb", posing_model, shapes)
    owner = imported(path)
    assert owner.name == "nod"
    for frame, shape in enumerate(shapes):
        bpy.context.scene.frame_set(frame)
        wanted = cKDTree(posing_model.surface.vertices(shape))
        assert wanted.query(in_world(bpy, owner))[0].max() < 2e-3


def test_a_script_finds_a_mesh_that_was_imported(
    bpy: Any, posing_model: ss.PosingModel, imported: Callable[[Path], Any], tmp_path: Path
) -> None:
    """Blender's importer turns it, and the order of vertices is its own."""
    model = posing_model
    rest = model.surface.vertices(model.problem.mesh.vertices)
    (still,) = ss.write_animation(tmp_path / "bar.glb", model, [model.problem.mesh.vertices])
    owner = imported(still)
    if owner.data.shape_keys is not None:
        owner.shape_key_clear()
    assert cKDTree(rest).query(in_world(bpy, owner))[0].max() < 1e-5
    script = ss.write_blender(tmp_path / "bar.py", model, ss.mode_targets(model))
    exec(compile(script.read_text(encoding="utf-8"), str(script), "exec"), {})
    assert [made for made in bpy.data.objects if made.type == "MESH"] == [owner]
    q = model.training_coordinates[0]
    largest = np.abs(model.training_coordinates).max(axis=0)
    for key, value in zip(owner.data.shape_keys.key_blocks[1:], q / largest, strict=True):
        key.value = value
    wanted = cKDTree(model.surface.vertices(model.subspace.shape(q)))
    assert wanted.query(in_world(bpy, owner))[0].max() < 1e-4
