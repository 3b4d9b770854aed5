"""Animations have weights between 0 and 1: Blender clamps others, and the film would be wrong."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel, write_animation
from snapspace.gltf import mode_targets, sliders, write_glb

from .glb_content import GlbContent


def test_shapes_stay_and_weights_lie_between_zero_and_one() -> None:
    weights = np.random.default_rng(0).normal(size=(7, 3)) * [1.0, 5.0, 0.1]
    mix, values = sliders(weights)
    assert mix.shape == (4, 3) and values.min() == 0.0 and values.max() == 1.0
    np.testing.assert_array_equal(values[:, 3], 1.0)
    np.testing.assert_allclose(values @ mix, weights, atol=1e-12)


def test_weights_that_are_not_negative_need_no_offset() -> None:
    weights = np.array([[0.0, 0.0, 0.0], [1.0, 4.0, 0.0], [-1e-17, 2.0, 0.0]])
    mix, values = sliders(weights)
    np.testing.assert_array_equal(mix, np.diag([1.0, 4.0, 1.0]))
    np.testing.assert_array_equal(values, [[0, 0, 0], [1, 1, 0], [0, 0.5, 0]])


@pytest.mark.parametrize("all_modes", [False, True])
def test_a_clamped_film_is_the_film(
    posing_model: PosingModel, all_modes: bool, tmp_path: Path
) -> None:
    """The film moves to and fro, so fitted weights have both signs."""
    session = posing_model.session()
    nod = session.animate([{"head": ((0, z, 0), (0, 0, z))} for z in (0.3, -0.3)], frames=8)
    shapes = np.array([session.vertices for _ in nod])
    path = tmp_path / "nod.glb"
    if all_modes:
        write_glb(path, posing_model, mode_targets(posing_model, shapes))
    else:
        write_animation(path, posing_model, shapes)
    file = GlbContent(path)
    assert all_modes or len(file.primitive["targets"]) <= 8
    diagonal = posing_model.problem.mesh.diagonal
    frames = np.clip(file.animated_weights(), 0.0, 1.0)
    for weights, shape in zip(frames, shapes, strict=True):
        wanted = posing_model.surface.vertices(shape)
        np.testing.assert_allclose(file.shape(weights), wanted, atol=1e-3 * diagonal)
    assert file.json["meshes"][0]["weights"] == pytest.approx(frames[0])
