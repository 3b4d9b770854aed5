"""Several shapes of one mesh: frames of a film, or a row of pictures."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.pictures import scene
from snapspace.pictures.exposure import Exposure

from .conftest import Mesh


def exposures(shapes: list[np.ndarray], faces: np.ndarray) -> list[Exposure]:
    made = scene.Scene.of(shapes, faces, [None] * len(shapes), who="test")
    return list(
        made.exposures(
            size=(48, 36),
            azimuth=-60.0,
            elevation=15.0,
            up="z",
            field_of_view=24.0,
            margin=0.1,
            ground=True,
            samples=1,
        )
    )


def test_shapes_drawn_at_the_same_time_are_those_drawn_one_by_one(
    sphere: Mesh, monkeypatch: pytest.MonkeyPatch
) -> None:
    vertices, faces = sphere
    shapes = [vertices * [1.0, 1.0, stretch] for stretch in np.linspace(0.2, 1.0, 7)]
    several = exposures(shapes, faces)
    monkeypatch.setattr(scene, "AT_ONCE", 1)
    for one, other in zip(exposures(shapes, faces), several, strict=True):
        assert np.array_equal(one.light, other.light)
        assert np.array_equal(one.shadow(), other.shadow())
    covered = [float((1.0 - one.uncovered).sum()) for one in several]
    assert covered == sorted(covered), "the shapes come in order"
