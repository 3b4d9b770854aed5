"""What artists do with a posed mesh: edit it, copy it, save it elsewhere, bake it twice."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial import cKDTree

from .drawn import drawn, empties


@pytest.fixture
def animated(bpy: Any, computed: Any) -> Any:
    """The head goes down and up in eight frames."""
    scene, head = bpy.context.scene, empties(computed)["head"]
    scene.frame_start, scene.frame_end = 1, 8
    rest = head.location.z
    for frame, z in ((1, 0.0), (4, -0.3), (8, 0.4)):
        head.location.z = rest + z
        head.keyframe_insert("location", frame=frame)
    return computed


def baked(owner: Any) -> list[Any]:
    keys = owner.data.shape_keys.key_blocks
    return [key for key in keys if key.name.startswith("Baked")]


def test_a_baked_film_comes_back_from_gltf(bpy: Any, animated: Any, tmp_path: Path) -> None:
    """Blender clamps imported keys to values between 0 and 1."""
    assert bpy.ops.snapspace.bake() == {"FINISHED"}
    scene, film = bpy.context.scene, []
    for frame in range(1, 9):
        scene.frame_set(frame)
        film.append(drawn(bpy, animated))
        assert all(-1e-6 <= key.value <= 1 + 1e-6 for key in baked(animated))
    bpy.ops.export_scene.gltf(filepath=str(tmp_path / "film.glb"))
    rate = scene.render.fps
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.context.scene.render.fps = rate
    bpy.ops.import_scene.gltf(filepath=str(tmp_path / "film.glb"))
    (owner,) = (one for one in bpy.data.objects if one.type == "MESH")
    for frame, shape in enumerate(film, start=1):
        bpy.context.scene.frame_set(frame)
        assert cKDTree(shape).query(drawn(bpy, owner))[0].max() < 1e-4


def test_a_shorter_bake_leaves_no_keyframes_of_a_longer_one(bpy: Any, animated: Any) -> None:
    assert bpy.ops.snapspace.bake() == {"FINISHED"}
    bpy.context.scene.frame_end = 3
    assert bpy.ops.snapspace.bake() == {"FINISHED"}
    action = animated.data.shape_keys.animation_data.action
    assert tuple(action.frame_range) == (1.0, 3.0)


def test_a_new_model_after_a_bake_is_live_alone(bpy: Any, animated: Any) -> None:
    """Baked keys were once added to the live shape, and counted as poses to blend."""
    assert bpy.ops.snapspace.bake() == {"FINISHED"}
    assert bpy.ops.snapspace.compute() == {"FINISHED"}
    assert animated.snapspace.live and all(key.mute for key in baked(animated))
    bpy.context.scene.frame_set(8)
    rest = np.array([v.co for v in animated.data.vertices])
    assert np.abs(drawn(bpy, animated) - rest).max() == pytest.approx(0.4, abs=0.05)
    with pytest.raises(RuntimeError, match="no shape keys besides its basis"):
        bpy.ops.snapspace.compute_blend()


def test_nothing_is_baked_in_edit_mode(bpy: Any, computed: Any) -> None:
    bpy.ops.object.mode_set(mode="EDIT")
    assert not bpy.ops.snapspace.bake.poll()
    bpy.ops.object.mode_set(mode="OBJECT")


def test_an_edited_mesh_is_reported_and_keeps_its_edits(bpy: Any, computed: Any) -> None:
    basis = computed.data.shape_keys.key_blocks[0]
    computed.active_shape_key_index = 0
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.transform.resize(value=(1.0, 2.0, 1.0))
    bpy.ops.object.mode_set(mode="OBJECT")
    empties(computed)["head"].location.z += 0.2
    assert np.ptp(drawn(bpy, computed)[:, 1]) == pytest.approx(2.0, abs=1e-3)
    assert "was edited after its model was made; compute it again" in computed.snapspace.status
    assert np.ptp([point.co.y for point in basis.data]) == pytest.approx(2.0)


def test_a_handle_whose_empty_is_gone_rests(bpy: Any, computed: Any) -> None:
    rest = drawn(bpy, computed)
    head = empties(computed)["head"]
    head.location.z += 0.3
    assert np.abs(drawn(bpy, computed) - rest).max() > 0.2
    bpy.data.objects.remove(head)
    np.testing.assert_allclose(drawn(bpy, computed), rest, atol=1e-3)


def test_a_linked_copy_follows_and_has_no_model_of_its_own(bpy: Any, computed: Any) -> None:
    """The copy has no empties, and does not put the shared mesh back to rest."""
    twin = computed.copy()
    bpy.context.scene.collection.objects.link(twin)
    rest = drawn(bpy, computed)
    empties(computed)["head"].location.z += 0.3
    assert np.abs(drawn(bpy, computed) - rest).max() > 0.2
    np.testing.assert_array_equal(drawn(bpy, twin), drawn(bpy, computed))
    bpy.context.view_layer.objects.active = twin
    with pytest.raises(RuntimeError, match="share a mesh, which the empties of bar move"):
        bpy.ops.snapspace.compute()


@pytest.mark.parametrize("first", ["unsaved", "owner"])
def test_the_model_goes_where_the_file_is_saved(
    bpy: Any, request: pytest.FixtureRequest, tmp_path: Path, first: str
) -> None:
    """A model of an unsaved file once stayed in the folder for temporary files."""
    request.getfixturevalue(first)
    assert bpy.ops.snapspace.compute() == {"FINISHED"}
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "later.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(folder / "later.blend"))
    owner = bpy.data.objects["bar"]
    assert Path(bpy.path.abspath(owner.snapspace.model)).parent == folder
    rest = drawn(bpy, owner)
    empties(owner)["head"].location.z += 0.3
    assert np.abs(drawn(bpy, owner) - rest).max() > 0.2
