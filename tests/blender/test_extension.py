"""Vertex groups to a model, empties that move it, blends of shape keys, and baked films."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import snapspace as ss

from .drawn import drawn, empties


def result(owner: Any) -> np.ndarray:
    """Points of the key that shows the solved shape."""
    key = owner.data.shape_keys.key_blocks["Snapspace"]
    points = np.empty(3 * len(key.data), np.float32)
    key.data.foreach_get("co", points)
    return points.reshape(-1, 3).astype(float)


def test_empties_stand_at_the_handles_and_the_shape_at_rest(bpy: Any, computed: Any) -> None:
    found = empties(computed)
    assert set(found) == {"foot", "head"}
    rest = np.array([v.co for v in computed.data.vertices])
    ends = {name: empty.location.x for name, empty in found.items()}
    assert ends["head"] - ends["foot"] == pytest.approx(4.0, abs=0.5)
    np.testing.assert_allclose(drawn(bpy, computed), rest, atol=1e-3)


def test_an_empty_drives_the_solve_as_python_does(bpy: Any, computed: Any) -> None:
    head = empties(computed)["head"]
    head.location.z += 0.3
    head.rotation_euler = (0.1, -0.2, 0.0)
    bpy.context.view_layer.update()
    model = ss.load_posing(bpy.path.abspath(computed.snapspace.model))
    session = model.session()
    session.move("head", euler=[0.1, -0.2, 0.0], translation=[0, 0, 0.3])
    wanted = model.surface.vertices(session.vertices)
    np.testing.assert_allclose(drawn(bpy, computed), wanted, atol=2e-3)
    moved = np.abs(wanted - model.surface.vertices(model.problem.mesh.vertices)).max()
    assert moved > 0.25


def test_the_object_may_stand_anywhere(bpy: Any, computed: Any) -> None:
    """Empties are its children: the same motion gives the same local shape."""
    head = empties(computed)["head"]
    head.location.z += 0.3
    before = drawn(bpy, computed)
    computed.location = (5.0, 1.0, -2.0)
    computed.rotation_euler = (0.0, 1.0, 0.5)
    computed.scale = (2.0, 2.0, 2.0)
    np.testing.assert_allclose(drawn(bpy, computed), before, atol=1e-4)


def test_animation_is_baked_to_keys_that_need_no_extension(bpy: Any, computed: Any) -> None:
    scene, head = bpy.context.scene, empties(computed)["head"]
    scene.frame_start, scene.frame_end = 1, 8
    for frame, z in ((1, 0.0), (8, 0.4)):
        head.location.z = empties(computed)["foot"].location.z + z
        head.keyframe_insert("location", frame=frame)
    film = []
    for frame in range(1, 9):
        scene.frame_set(frame)
        film.append(drawn(bpy, computed))
    assert np.abs(film[7] - film[0]).max() > 0.3
    assert bpy.ops.snapspace.bake() == {"FINISHED"}
    keys = [key for key in computed.data.shape_keys.key_blocks if key.name.startswith("Baked")]
    assert 1 <= len(keys) <= 7
    assert not computed.snapspace.live
    for frame in (1, 4, 8):
        scene.frame_set(frame)
        np.testing.assert_allclose(drawn(bpy, computed), film[frame - 1], atol=1e-3)
    assert bpy.ops.snapspace.bake() == {"FINISHED"}, "again"
    assert len(
        [k for k in computed.data.shape_keys.key_blocks if k.name.startswith("Baked")]
    ) == len(keys)


def test_a_saved_file_is_live_again(bpy: Any, computed: Any) -> None:
    path = bpy.data.filepath
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=path)
    owner = bpy.data.objects["bar"]
    assert Path(bpy.path.abspath(owner.snapspace.model)).parent == Path(path).parent
    before = drawn(bpy, owner)
    empties(owner)["head"].location.y += 0.3
    assert np.abs(drawn(bpy, owner) - before).max() > 0.2


def test_shape_keys_blend_along_elastic_paths(bpy: Any, owner: Any) -> None:
    rest = np.array([v.co for v in owner.data.vertices])
    owner.shape_key_add(name="Basis", from_mix=False)
    key = owner.shape_key_add(name="bent", from_mix=False)
    angle = 1.2 * (rest[:, 0] - rest[:, 0].min()) / 4.0
    radius = 4.0 / 1.2
    bent = rest.copy()
    bent[:, 0] = (radius - rest[:, 2]) * np.sin(angle)
    bent[:, 2] = radius - (radius - rest[:, 2]) * np.cos(angle)
    key.data.foreach_set("co", bent.astype(np.float32).ravel())
    assert bpy.ops.snapspace.compute_blend() == {"FINISHED"}
    key = owner.data.shape_keys.key_blocks["bent"]
    assert key.mute, "it must not be added to the solved shape"
    key.value = 0.5
    half = drawn(bpy, owner)
    model = ss.load_blending(bpy.path.abspath(owner.snapspace.model))
    session = model.session()
    session.blend([0.5, 0.5])
    np.testing.assert_allclose(half, model.surface.vertices(session.vertices), atol=2e-3)
    # the straight blend of the ends is shorter than the elastic one
    ends = [np.argmin(rest[:, 0]), np.argmax(rest[:, 0])]
    straight = 0.5 * (rest + bent)
    assert np.linalg.norm(np.diff(half[ends], axis=0)) > 1.005 * np.linalg.norm(
        np.diff(straight[ends], axis=0)
    )


def test_one_group_is_refused(bpy: Any, owner: Any) -> None:
    owner.vertex_groups.remove(owner.vertex_groups["head"])
    with pytest.raises(RuntimeError, match=r"1 vertex groups with vertices .* at least two"):
        bpy.ops.snapspace.compute()


def test_small_weights_are_refused_with_the_weight_that_is_needed(bpy: Any, owner: Any) -> None:
    """Automatic weights of an armature are like this; the panel counts them as handles."""
    for group in owner.vertex_groups:
        members = [
            v.index for v in owner.data.vertices if group.index in [g.group for g in v.groups]
        ]
        group.add(members, 0.4, "REPLACE")
    with pytest.raises(RuntimeError, match=r"0 vertex groups .* a weight of one half or more"):
        bpy.ops.snapspace.compute()


def test_an_uneven_scale_is_refused(bpy: Any, owner: Any) -> None:
    owner.scale = (1.0, 2.0, 1.0)
    bpy.context.view_layer.update()
    with pytest.raises(RuntimeError, match="scale is not uniform; apply it"):
        bpy.ops.snapspace.compute()


def test_without_shape_keys_there_is_nothing_to_blend(bpy: Any, owner: Any) -> None:
    with pytest.raises(RuntimeError, match="no shape keys besides its basis"):
        bpy.ops.snapspace.compute_blend()


def test_a_changed_mesh_is_reported(bpy: Any, computed: Any) -> None:
    mesh = computed.data
    computed.shape_key_clear()
    mesh.vertices.add(1)
    computed["changed"] = True
    empties(computed)["head"].location.z += 0.2
    bpy.context.view_layer.update()
    assert "compute it again" in computed.snapspace.status


def test_a_script_makes_shape_keys_without_the_extension(
    bpy: Any, posing_model: ss.PosingModel, tmp_path: Path
) -> None:
    """This runs in Blender itself; tests/gltf/test_blender_script.py has the figures."""
    bpy.ops.wm.read_homefile(use_empty=True)
    path = ss.write_blender(tmp_path / "bar.py", posing_model, ss.mode_targets(posing_model))
    exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), {})
    made = bpy.data.objects["bar"]
    keys = made.data.shape_keys.key_blocks
    assert len(keys) == 1 + posing_model.dimension
    q = posing_model.training_coordinates[0]
    for key, value in zip(
        keys[1:], q / np.abs(posing_model.training_coordinates).max(axis=0), strict=True
    ):
        key.value = value
    wanted = posing_model.surface.vertices(posing_model.subspace.shape(q))
    np.testing.assert_allclose(drawn(bpy, made), wanted, atol=1e-4)
