"""Films as sums of few shapes: no more than needed, within the tolerance. Runs without Blender."""

from __future__ import annotations

import numpy as np
import pytest

from blender.principal_shapes import principal_shapes

RNG = np.random.default_rng(0)
SHAPES = RNG.normal(size=(3, 40, 3))
VALUES = RNG.normal(size=(20, 3)) * [1.0, 0.3, 0.01]
FILM = np.einsum("fk,ksc->fsc", VALUES, SHAPES)


def test_a_film_of_three_shapes_has_three() -> None:
    found = principal_shapes(FILM, tolerance=1e-9, most=10)
    assert len(found.shapes) == 3 and found.error < 1e-9
    np.testing.assert_allclose(
        np.einsum("fk,ksc->fsc", found.values, found.shapes), FILM, atol=1e-9
    )
    assert np.abs(found.values).max() == pytest.approx(1.0)


def test_a_tolerance_saves_shapes_and_is_kept() -> None:
    found = principal_shapes(FILM, tolerance=0.2, most=10)
    left = np.einsum("fk,ksc->fsc", found.values, found.shapes) - FILM
    assert len(found.shapes) == 2
    assert np.linalg.norm(left, axis=2).max() == pytest.approx(found.error) and found.error <= 0.2


def test_the_error_of_too_few_shapes_is_reported() -> None:
    found = principal_shapes(FILM, tolerance=1e-9, most=1)
    assert len(found.shapes) == 1 and found.error > 0.2


def test_a_film_at_rest_needs_no_shape() -> None:
    found = principal_shapes(np.zeros((5, 7, 3)), tolerance=1e-9, most=10)
    assert found.shapes.shape == (0, 7, 3) and found.values.shape == (5, 0) and found.error == 0
