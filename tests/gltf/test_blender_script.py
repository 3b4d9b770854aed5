"""Scripts for Blender: their keys are the model's modes, on whatever Blender made of the mesh."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from snapspace import InterpolationModel, PosingModel, fitted_targets, mode_targets, write_blender
from snapspace.mesh import embed_file, embed_surface, open_surface
from snapspace.reduction import ReducedModel

from .blender_scene import Object, Scene

UPRIGHT = Rotation.from_euler("x", 90, degrees=True)


@pytest.fixture
def scene(monkeypatch: pytest.MonkeyPatch) -> Scene:
    scene = Scene()
    for name, module in scene.modules.items():
        monkeypatch.setitem(sys.modules, name, module)
    return scene


def rest_of(model: ReducedModel) -> np.ndarray:
    return model.surface.vertices(model.problem.mesh.vertices)


def posed(made: Object, model: ReducedModel, sample: int) -> np.ndarray:
    """Sets the keys to a training sample; its shape, which the keys must give."""
    q = model.training_coordinates[sample]
    values = q / np.abs(model.training_coordinates).max(axis=0)
    assert np.abs(values).max() <= 1 + 1e-12
    modes = [key for key in made.keys if key.name.startswith("Mode")]
    for key, value in zip(modes, values, strict=True):
        key.value = value
    return model.surface.vertices(model.subspace.shape(q))


def test_sums_of_the_keys_are_the_shapes_of_the_model(
    posing_model: PosingModel, scene: Scene, tmp_path: Path
) -> None:
    made = scene.run(write_blender(tmp_path / "bar.py", posing_model, mode_targets(posing_model)))
    assert made.keys[0].name == "Basis" and len(made.keys) == 1 + posing_model.dimension
    for sample in range(3):
        wanted = posed(made, posing_model, sample)
        np.testing.assert_allclose(made.shape(), wanted, atol=1e-5)


def test_a_new_object_stands_upright_and_is_active(
    posing_model: PosingModel, scene: Scene, tmp_path: Path
) -> None:
    path = write_blender(tmp_path / "bar.py", posing_model, mode_targets(posing_model), up="y")
    made = scene.run(path)
    assert made.name == "bar" and made.rotation_euler == (np.pi / 2, 0, 0)
    assert scene.run(path) is made, "again"
    assert len(made.keys) == 1 + posing_model.dimension, "keys are replaced"


def test_a_blend_has_a_key_for_the_shape_that_modes_are_added_to(
    blending_model: InterpolationModel, scene: Scene, tmp_path: Path
) -> None:
    """Its base is the mean of the samples, and not the user's mesh, which is the first pose."""
    own = scene.add(rest_of(blending_model))
    scene.active.active = own
    morphs = mode_targets(blending_model)
    assert np.abs(morphs.base - own.data.vertices.places).max() > 0.01
    made = scene.run(write_blender(tmp_path / "blend.py", blending_model, morphs))
    assert made is own and made.keys[1].name == "Mean" and made.keys[1].value == 1.0
    wanted = posed(made, blending_model, 1)
    np.testing.assert_allclose(made.shape(), wanted, atol=1e-5)


@pytest.fixture(scope="module")
def lopsided(posing_model: PosingModel) -> PosingModel:
    """The bar with a surface that no turn maps onto itself."""
    surface = posing_model.surface
    rest = rest_of(posing_model)
    share = (rest - rest.min(axis=0)) / np.ptp(rest, axis=0)
    points = rest + 0.05 * share @ [[1, 0, 0], [0, 1, 0], [1, 0, 1]] * share[:, [1, 2, 0]]
    mesh = posing_model.problem.mesh
    return replace(posing_model, surface=embed_surface(points, surface.faces, mesh, farthest=0.5))


@pytest.mark.parametrize(
    ("turn", "size", "place", "order"),
    [
        pytest.param(Rotation.identity(), 1.0, 0.0, "own", id="as it was"),
        pytest.param(UPRIGHT, 1.0, 0.0, "own", id="turned to z up"),
        pytest.param(UPRIGHT.inv(), 100.0, 3.0, "mixed", id="turned, scaled, moved, reordered"),
        pytest.param(UPRIGHT, 1.0, 0.0, "seams", id="with seams"),
    ],
)
def test_vertices_are_found_by_their_places(
    lopsided: PosingModel,
    scene: Scene,
    tmp_path: Path,
    turn: Rotation,
    size: float,
    place: float,
    order: str,
) -> None:
    """Importers turn vertices to z up and split them at seams; a .glb has another order."""
    rest = rest_of(lopsided)
    numbers = np.arange(len(rest))
    if order == "mixed":
        numbers = np.random.default_rng(0).permutation(numbers)
    if order == "seams":
        numbers = np.concatenate([numbers[::3], numbers])
    own = scene.add(size * turn.apply(rest[numbers]) + place)
    scene.active.active = own
    made = scene.run(write_blender(tmp_path / "bar.py", lopsided, mode_targets(lopsided)))
    assert made is own
    wanted = size * turn.apply(posed(made, lopsided, 0)[numbers]) + place
    np.testing.assert_allclose(made.shape(), wanted, atol=1e-5 * size)


@pytest.mark.parametrize("turned", ["vertices", "object"])
def test_a_body_that_fits_in_several_ways_is_taken_as_importers_put_it(
    posing_model: PosingModel, scene: Scene, tmp_path: Path, turned: str
) -> None:
    """The bar is its own image when it is turned about its axis."""
    order = np.random.default_rng(0).permutation(len(rest_of(posing_model)))
    of_vertices, of_object = (
        (UPRIGHT, Rotation.identity()) if turned == "vertices" else (Rotation.identity(), UPRIGHT)
    )
    own = scene.add(of_vertices.apply(rest_of(posing_model)[order]), of_object.as_matrix())
    path = write_blender(tmp_path / "bar.py", posing_model, mode_targets(posing_model), up="y")
    made = scene.run(path)
    assert made is own
    wanted = of_vertices.apply(posed(made, posing_model, 0)[order])
    np.testing.assert_allclose(made.shape(), wanted, atol=1e-5)


def test_an_object_below_turned_and_mirroring_nodes_is_found(
    lopsided: PosingModel, scene: Scene, tmp_path: Path
) -> None:
    """The file's transforms are in the model's vertices, and in Blender's objects."""
    mirror = np.diag([-2.0, 2.0, 3.0]) @ Rotation.from_euler("y", 0.7).as_matrix()
    own = scene.add(rest_of(lopsided)[::-1] @ np.linalg.inv(mirror).T, mirror)
    scene.active.active = own
    path = write_blender(tmp_path / "bar.py", lopsided, mode_targets(lopsided), up="z")
    assert scene.run(path) is own
    wanted = posed(own, lopsided, 0)[::-1]
    np.testing.assert_allclose(own.shape() @ mirror.T, wanted, atol=1e-5)


def test_another_mesh_of_as_many_vertices_is_left_alone(
    posing_model: PosingModel, scene: Scene, tmp_path: Path
) -> None:
    """It once got the model's shape."""
    own = scene.add(rest_of(posing_model) * [1.0, 1.0, 1.1])
    scene.active.active = own
    made = scene.run(write_blender(tmp_path / "bar.py", posing_model, mode_targets(posing_model)))
    assert made is not own and own.keys == []


@pytest.mark.parametrize("count", [1, 2])
def test_a_users_mesh_need_not_be_active_if_it_is_the_only_one(
    posing_model: PosingModel, scene: Scene, tmp_path: Path, count: int
) -> None:
    own = [scene.add(rest_of(posing_model)) for _ in range(count)]
    cube = scene.add(np.eye(3))
    scene.objects.append(SimpleNamespace(type="CAMERA"))
    scene.active.active = cube
    made = scene.run(write_blender(tmp_path / "bar.py", posing_model, mode_targets(posing_model)))
    assert (made in own) == (count == 1), "two of them: a new object"


def test_in_edit_mode_it_goes_to_object_mode(
    posing_model: PosingModel, scene: Scene, tmp_path: Path
) -> None:
    """Keys that are written in edit mode are lost when it ends."""
    scene.active.active = scene.add(rest_of(posing_model))
    scene.context.mode = "EDIT_MESH"
    scene.run(write_blender(tmp_path / "bar.py", posing_model, mode_targets(posing_model)))
    assert scene.context.mode == "OBJECT"


@pytest.mark.parametrize("name", ['a """ b', "C:\\new\\umlaut", "K\u00fch\n{0}"])
def test_any_name_will_do(
    posing_model: PosingModel, scene: Scene, tmp_path: Path, name: str
) -> None:
    morphs = mode_targets(posing_model)
    made = scene.run(write_blender(tmp_path / "bar.py", posing_model, morphs, name=name))
    assert made.name == name


def test_few_targets_have_values_up_to_one(
    posing_model: PosingModel, scene: Scene, tmp_path: Path
) -> None:
    shapes = [
        posing_model.subspace.shape(q).reshape(-1, 3) for q in posing_model.training_coordinates
    ]
    morphs = fitted_targets(posing_model, np.array(shapes), count=3)
    made = scene.run(write_blender(tmp_path / "bar.py", posing_model, morphs))
    assert len(made.keys) == 4
    first = made.keys[1].data.places - made.keys[0].data.places
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
    made = scene.run(write_blender(tmp_path / "box.py", model, mode_targets(model)))
    assert len(made.data.vertices) == 8 and [len(face) for face in made.data.faces] == [4] * 6


def test_another_extension_is_refused(posing_model: PosingModel, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"a\.blend: the name .* must end in \.py"):
        write_blender(tmp_path / "a.blend", posing_model, mode_targets(posing_model))
