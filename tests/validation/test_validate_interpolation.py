"""Errors of reduced blends after rigid registration."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import BlendingSession, InterpolationModel, Validation, validate
from snapspace.mesh import mass_norm
from snapspace.registration import registered
from snapspace.validation import unseen_parameters

from ..shapes import moved, random_rotation

FloatArray = NDArray[np.float64]
COUNT = 10


@pytest.fixture(scope="module")
def checked(blending_model: InterpolationModel) -> Validation:
    return validate(blending_model, samples=COUNT, seed=4, threads=1)


@pytest.fixture(scope="module")
def coiled(helix_model: InterpolationModel) -> Validation:
    return validate(helix_model, samples=COUNT, seed=4, threads=1)


def test_figures_match_their_definitions(
    blending_model: InterpolationModel, checked: Validation
) -> None:
    """Recomputed from the reference: solve from the mean shape, register, measure in the M-norm."""
    model, subspace, problem = blending_model, blending_model.subspace, blending_model.problem
    session = model.session()
    for i, w in enumerate(unseen_parameters(model.problem.domain, COUNT, seed=4)):
        full = checked.reference.shapes[i]
        assert checked.reference.reports[i].converged
        size = mass_norm(subspace.mass, full - subspace.tau)
        session.reset()
        report = session.blend(w)
        reduced = registered(session.vertices.reshape(-1), full, subspace.mass)
        error = mass_norm(subspace.mass, reduced - full) / size
        assert checked.error[i] == pytest.approx(error, rel=1e-9)
        projected = subspace.shape(subspace.coordinates(full))
        least = mass_norm(subspace.mass, projected - full) / size
        assert checked.projection_error[i] == pytest.approx(least, rel=1e-6)
        value, _ = problem.value_and_gradient(reduced, w)
        at_full, _ = problem.value_and_gradient(full, w)
        assert checked.energy_ratio[i] == pytest.approx(value / at_full, rel=1e-9)
        assert checked.iterations[i] == report.iterations


def test_a_rigid_motion_of_the_reduced_shape_is_no_error(
    blending_model: InterpolationModel, checked: Validation, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Solutions of an interpolation are defined only up to a rigid motion."""
    vertices = BlendingSession.vertices
    assert vertices.fget is not None
    straight = vertices.fget

    def elsewhere(session: BlendingSession) -> FloatArray:
        shape = straight(session).reshape(-1)
        return moved(shape, random_rotation(), np.array([5.0, 0.0, -1.0])).reshape(-1, 3)

    monkeypatch.setattr(BlendingSession, "vertices", property(elsewhere))
    displaced = validate(blending_model, samples=COUNT, seed=4, threads=1)
    np.testing.assert_allclose(displaced.error, checked.error, rtol=1e-6)
    np.testing.assert_array_equal(displaced.energy_ratio, checked.energy_ratio)


@pytest.mark.parametrize("name", ["checked", "coiled"])
def test_nothing_in_the_subspace_beats_the_projection(
    name: str, request: pytest.FixtureRequest
) -> None:
    """The last registration changes it only in second order; both shapes are registered already."""
    result: Validation = request.getfixturevalue(name)
    assert len(result.error) == COUNT
    assert (result.error >= result.projection_error * (1.0 - 1e-6)).all()


@pytest.mark.parametrize("name", ["checked", "coiled"])
def test_no_reduced_solution_has_less_energy_than_the_full_one(
    name: str, request: pytest.FixtureRequest
) -> None:
    """The tolerance is that of the reference: soft modes leave it 1e-8 above its minimum.

    The coil's energy is a cubature, which may be lower by its own error. (Measured: 1e-6.)
    """
    result: Validation = request.getfixturevalue(name)
    assert (result.energy_ratio >= 1.0 - (1e-7 if name == "checked" else 1e-5)).all()
    assert result.energy_ratio.max() < 1.0 + 1e-4


def test_blends_of_a_bar_have_small_errors(checked: Validation) -> None:
    """The family is two-dimensional, the subspace has twelve dimensions. (Measured: 2e-4.)"""
    assert checked.error.max() < 1e-3
    assert checked.projection_error.max() < 2e-4


def test_blends_of_the_helix_have_small_errors(coiled: Validation) -> None:
    """With 30 samples and 20 dimensions the paper reports 0.002. (Measured: 7e-4 on average.)"""
    assert coiled.error.mean() < 2e-3
    assert coiled.error.max() < 5e-3
    assert coiled.projection_error.max() < 5e-4


def test_fewer_dimensions_are_worse(helix_model: InterpolationModel, coiled: Validation) -> None:
    smaller = validate(helix_model.leading(5), samples=COUNT, seed=4, threads=1)
    assert (smaller.projection_error > coiled.projection_error).all()
    assert np.median(smaller.error) > np.median(coiled.error)
    np.testing.assert_array_equal(smaller.reference.shapes, coiled.reference.shapes)


def test_the_figures_hardly_depend_on_the_training_starts(
    helix_model: InterpolationModel, coiled: Validation
) -> None:
    """Starts change the path, not the minimum."""
    bare = replace(
        helix_model,
        training_parameters=np.zeros((0, 2)),
        training_coordinates=np.zeros((0, 20)),
    )
    other = validate(bare, samples=COUNT, seed=4, threads=1)
    np.testing.assert_allclose(other.error, coiled.error, atol=5e-3)
    np.testing.assert_array_equal(other.projection_error, coiled.projection_error)


def test_the_same_seed_gives_the_same_figures(
    blending_model: InterpolationModel, checked: Validation
) -> None:
    again = validate(blending_model, samples=COUNT, seed=4, threads=2)
    for name in ("error", "projection_error", "energy_ratio", "iterations"):
        np.testing.assert_array_equal(getattr(again, name), getattr(checked, name))


def test_unseen_weights_are_in_the_simplex_and_unseen(blending_model: InterpolationModel) -> None:
    drawn = unseen_parameters(blending_model.problem.domain, 400, seed=1)
    assert drawn.shape == (400, 3)
    assert drawn.sum(axis=1) == pytest.approx(np.ones(400), abs=1e-12)
    assert drawn.min() >= 0
    assert drawn.mean(axis=0) == pytest.approx(np.full(3, 1 / 3), abs=0.05)
    assert not np.isin(drawn, blending_model.training_parameters).any()


def test_json_counts_the_samples(checked: Validation) -> None:
    content = checked.as_json(12)
    assert (content["samples"], content["dimension"]) == (COUNT, 12)
    assert content["error"]["max"] == checked.error.max()
