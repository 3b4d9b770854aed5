"""calibrated: new samples, ratios of true errors, and a model that is otherwise the same."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import PosingModel, calibrated, sample, validate
from snapspace.calibration import _parameters


@pytest.fixture(scope="module")
def model(posing_model: PosingModel) -> PosingModel:
    return calibrated(posing_model, samples=12, threads=1)


def test_everything_else_is_shared(model: PosingModel, posing_model: PosingModel) -> None:
    assert posing_model.error_estimator is None
    assert model.subspace is posing_model.subspace and model.elastic is posing_model.elastic
    estimator = model.error_estimator
    assert estimator is not None and estimator.dimension == model.dimension
    assert estimator.mass == pytest.approx(model.problem.mesh.volume)
    assert len(estimator.residual_ratios) == len(estimator.movement_ratios) == 12


def test_it_does_not_depend_on_the_threads(model: PosingModel, posing_model: PosingModel) -> None:
    one, two = model.error_estimator, calibrated(posing_model, samples=12, threads=2)
    assert one is not None and two.error_estimator is not None
    np.testing.assert_array_equal(one.sample.vertices, two.error_estimator.sample.vertices)
    np.testing.assert_array_equal(one.residual_ratios, two.error_estimator.residual_ratios)
    np.testing.assert_array_equal(one.movement_ratios, two.error_estimator.movement_ratios)


def test_its_samples_are_nobody_elses(posing_model: PosingModel) -> None:
    domain = posing_model.problem.domain
    drawn = np.vstack([_parameters(domain, 20, seed=1, stream=stream) for stream in (2, 3)])
    others = np.vstack(
        [
            sample(domain, 20, method="random", seed=1),
            validate(posing_model, samples=20, seed=1, threads=1).reference.parameters,
        ]
    )
    everything = np.vstack([drawn, others])
    assert len(np.unique(everything, axis=0)) == len(everything)


def test_other_seeds_calibrate_alike(model: PosingModel, posing_model: PosingModel) -> None:
    other = calibrated(posing_model, samples=12, seed=5, threads=1)
    assert model.error_estimator is not None and other.error_estimator is not None
    medians = [np.median(m.error_estimator.movement_ratios) for m in (model, other)]  # type: ignore[union-attr]
    assert medians[0] != medians[1]
    assert medians[0] == pytest.approx(medians[1], rel=0.5)


def test_it_takes_samples(posing_model: PosingModel) -> None:
    with pytest.raises(ValueError, match="samples is 1, but must be at least 2"):
        calibrated(posing_model, samples=1)
