"""Posing models with the user's surface have it in their file; the tets' boundary is not stored."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors.numpy import load_file

from snapspace import InterpolationModel, PosingModel, load, reduce
from snapspace.mesh import EmbeddedSurface

from .test_bad_files import Change, refused, rewrite

NAMES = {"surface_faces", "surface_corners", "surface_weights"}


def test_the_surface_comes_back_to_the_last_bit(
    own_surface_model: PosingModel, tmp_path: Path
) -> None:
    model = load(own_surface_model.save(tmp_path / "own.snapspace"))
    for name in ("faces", "corners", "weights"):
        found, saved = getattr(model.surface, name), getattr(own_surface_model.surface, name)
        assert found.dtype == saved.dtype and np.array_equal(found, saved)
    leading = own_surface_model.leading(3)
    assert leading.surface is own_surface_model.surface


def test_the_boundary_of_the_tets_is_not_stored(posing_model: PosingModel, tmp_path: Path) -> None:
    path = posing_model.save(tmp_path / "bar.snapspace")
    assert not NAMES & set(load_file(path))
    assert load(path).surface.is_boundary(posing_model.problem.mesh)


def without_weights(arrays: dict[str, Any], _: object) -> None:
    del arrays["surface_weights"]


def with_three_corners(arrays: dict[str, Any], _: object) -> None:
    arrays["surface_corners"] = np.ascontiguousarray(arrays["surface_corners"][:, :3])


def with_a_face_too_far(arrays: dict[str, Any], _: object) -> None:
    arrays["surface_faces"] = np.array([[0, 1, 10**6]], np.int32)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (without_weights, "the array 'surface_weights' is missing"),
        (with_three_corners, "'surface_corners' has shape"),
        (with_a_face_too_far, "'surface_faces' has an index that is not between"),
    ],
)
def test_a_surface_that_does_not_fit_is_refused(
    own_surface_model: PosingModel, tmp_path: Path, change: Change, message: str
) -> None:
    path = own_surface_model.save(tmp_path / "own.snapspace")
    rewrite(path, change)
    assert message in refused(path)


def test_a_surface_of_another_mesh_is_refused(
    posing_model: PosingModel, blending_model: InterpolationModel
) -> None:
    corners = np.full((3, 4), 10**6)
    weights = np.tile([1.0, 0.0, 0.0, 0.0], (3, 1))
    foreign = EmbeddedSurface([[0, 1, 2]], corners, weights)
    for model in (posing_model, blending_model):
        with pytest.raises(ValueError, match="reduce: the surface follows vertex 1000000, but"):
            reduce(model.problem, model.subspace, surface=foreign)
