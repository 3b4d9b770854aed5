"""Scripts for Blender: their arrays are the model's modes, scaled to the training samples."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from snapspace import PosingModel, fitted_targets, mode_targets, write_blender
from snapspace.mesh import embed_file, open_surface


class Key(SimpleNamespace):
    """A shape key that remembers its points."""

    def __init__(self, **about: Any) -> None:
        super().__init__(**about, points=None)
        self.data = SimpleNamespace(foreach_set=self._take)

    def _take(self, what: str, values: np.ndarray) -> None:
        assert what == "co"
        self.points = np.array(values).reshape(-1, 3)


class Scene:
    """As much of bpy as the scripts use."""

    def __init__(self) -> None:
        self.keys: list[Key] = []
        self.faces: list[list[int]] = []
        self.made: Any = None
        self.data = SimpleNamespace(
            meshes=SimpleNamespace(new=self._new_mesh), objects=SimpleNamespace(new=self._new)
        )
        collection = SimpleNamespace(objects=SimpleNamespace(link=lambda made: None))
        self.context = SimpleNamespace(
            view_layer=SimpleNamespace(objects=SimpleNamespace(active=None)),
            scene=SimpleNamespace(collection=collection, objects=[]),
        )

    def _new_mesh(self, name: str) -> Any:
        def from_pydata(points: Any, edges: Any, faces: Any) -> None:
            self.points, self.faces = np.array(points), faces

        return SimpleNamespace(
            from_pydata=from_pydata, shade_smooth=lambda: None, update=lambda: None, shape_keys=None
        )

    def _new(self, name: str, mesh: Any) -> Any:
        def add(name: str, from_mix: bool) -> Key:
            self.keys.append(Key(name=name))
            return self.keys[-1]

        self.made = SimpleNamespace(name=name, data=mesh, shape_key_add=add, type="MESH")
        return self.made


@pytest.fixture
def scene(monkeypatch: pytest.MonkeyPatch) -> Scene:
    scene = Scene()
    monkeypatch.setitem(sys.modules, "bpy", scene)
    return scene


def run(path: Path) -> None:
    exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), {"__name__": "__main__"})


def test_sums_of_the_keys_are_the_shapes_of_the_model(
    posing_model: PosingModel, scene: Scene, tmp_path: Path
) -> None:
    run(write_blender(tmp_path / "bar.py", posing_model, mode_targets(posing_model), up="y"))
    basis, *modes = scene.keys
    assert basis.name == "Basis" and len(modes) == posing_model.dimension
    assert scene.made.name == "bar" and scene.made.rotation_euler == (np.pi / 2, 0, 0)
    samples = posing_model.training_coordinates
    largest = np.abs(samples).max(axis=0)
    for q in samples[:3]:
        values = q / largest
        assert np.abs(values).max() <= 1 + 1e-12
        shape = scene.points + sum(
            value * (key.points - scene.points) for value, key in zip(values, modes, strict=True)
        )
        wanted = posing_model.surface.vertices(posing_model.subspace.shape(q))
        np.testing.assert_allclose(shape, wanted, atol=1e-5)


def test_a_users_mesh_of_the_same_vertices_gets_the_keys(
    posing_model: PosingModel, scene: Scene, tmp_path: Path
) -> None:
    count = len(posing_model.surface.corners)
    own = scene._new("own", scene._new_mesh("own"))
    own.data.vertices = [None] * count
    scene.context.view_layer.objects.active = own
    run(write_blender(tmp_path / "bar.py", posing_model, mode_targets(posing_model)))
    assert scene.made is own and len(scene.keys) == 1 + posing_model.dimension
    assert scene.faces == []


@pytest.mark.parametrize("count", [1, 2])
def test_a_users_mesh_need_not_be_active_if_it_is_the_only_one(
    posing_model: PosingModel, scene: Scene, tmp_path: Path, count: int
) -> None:
    own = [scene._new("own", scene._new_mesh("own")) for _ in range(count)]
    other = scene._new("cube", scene._new_mesh("cube"))
    for one in own:
        one.data.vertices = [None] * len(posing_model.surface.corners)
    other.data.vertices = [None] * 8
    camera = SimpleNamespace(type="CAMERA")
    scene.context.scene.objects = [camera, other, *own]
    scene.context.view_layer.objects.active = other
    run(write_blender(tmp_path / "bar.py", posing_model, mode_targets(posing_model)))
    assert len(scene.keys) == 1 + posing_model.dimension
    assert (scene.faces == []) == (count == 1), "two of them: a new object"


def test_few_targets_have_values_up_to_one(
    posing_model: PosingModel, scene: Scene, tmp_path: Path
) -> None:
    shapes = [
        posing_model.subspace.shape(q).reshape(-1, 3) for q in posing_model.training_coordinates
    ]
    morphs = fitted_targets(posing_model, np.array(shapes), count=3)
    run(write_blender(tmp_path / "bar.py", posing_model, morphs))
    assert len(scene.keys) == 4
    first = scene.keys[1].points - scene.points
    largest = np.abs(morphs.weights[:, 0]).max()
    np.testing.assert_allclose(first, largest * morphs.targets[0], atol=1e-5)


def test_quads_stay_quads(posing_model: PosingModel, scene: Scene, tmp_path: Path) -> None:
    low, high = (getattr(posing_model.problem.mesh.vertices, f)(axis=0) for f in ("min", "max"))
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * (high - low)
    lines = [f"v {x} {y} {z}" for x, y, z in corners + low]
    lines += [f"f {q}" for q in ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4")]
    (tmp_path / "box.obj").write_text("\n".join(lines) + "\n", encoding="utf-8")
    surface = embed_file(
        open_surface(tmp_path / "box.obj"), posing_model.problem.mesh, farthest=0.3
    )
    model = replace(posing_model, surface=surface)
    run(write_blender(tmp_path / "box.py", model, mode_targets(model)))
    assert len(scene.points) == 8 and [len(face) for face in scene.faces] == [4] * 6


def test_another_extension_is_refused(posing_model: PosingModel, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"a\.blend: the name .* must end in \.py"):
        write_blender(tmp_path / "a.blend", posing_model, mode_targets(posing_model))
