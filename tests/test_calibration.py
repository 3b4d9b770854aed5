"""calibrate: new samples, ratios of true errors, and a model that is otherwise the same."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel, calibrate, load, sample, validate
from snapspace.calibration import _parameters


@pytest.fixture(scope="module")
def model(posing_model: PosingModel) -> PosingModel:
    return calibrate(posing_model, samples=12, threads=1)


def test_everything_else_is_shared(model: PosingModel, posing_model: PosingModel) -> None:
    assert posing_model.error_estimator is None
    assert model.subspace is posing_model.subspace and model.elastic is posing_model.elastic
    estimator = model.error_estimator
    assert estimator is not None and estimator.dimension == model.dimension
    assert estimator.mass == pytest.approx(model.problem.mesh.volume)
    assert len(estimator.residual_ratios) == len(estimator.movement_ratios) == 12


def test_it_does_not_depend_on_the_threads(model: PosingModel, posing_model: PosingModel) -> None:
    one, two = model.error_estimator, calibrate(posing_model, samples=12, threads=2)
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
    other = calibrate(posing_model, samples=12, seed=5, threads=1)
    assert model.error_estimator is not None and other.error_estimator is not None
    medians = [np.median(m.error_estimator.movement_ratios) for m in (model, other)]  # type: ignore[union-attr]
    assert medians[0] != medians[1]
    assert medians[0] == pytest.approx(medians[1], rel=0.5)


def test_it_takes_samples(posing_model: PosingModel) -> None:
    with pytest.raises(ValueError, match="samples is 1, but must be at least 2"):
        calibrate(posing_model, samples=1)


def test_known_solutions_calibrate_as_their_own_ones_do(posing_model: PosingModel) -> None:
    """The same full solutions, new or given, give the same ratios; quick ones measure no polish."""
    reference = validate(posing_model, samples=9, threads=1).reference
    thorough = calibrate(posing_model, reference=reference, threads=1).error_estimator
    quick_model = calibrate(posing_model, reference=reference, thorough=False, threads=1)
    quick = quick_model.error_estimator
    assert thorough is not None and quick is not None
    np.testing.assert_array_equal(quick.residual_ratios, thorough.residual_ratios)
    assert quick.movement_ratios is None and len(thorough.of_movement._logs) == 9
    session = quick_model.session()
    session.set_parameters(reference.parameters[0])
    assert session.certificate(confidence=0.8).distance > 0
    with pytest.raises(ValueError, match=r"quick certificates only; snapspace.calibrate\(model\)"):
        session.certificate(confidence=0.8, thorough=True)


def test_a_quick_one_is_in_the_file(posing_model: PosingModel, tmp_path: Path) -> None:
    reference = validate(posing_model, samples=4, threads=1).reference
    model = calibrate(posing_model, reference=reference, thorough=False)
    read = load(model.save(tmp_path / "model.snapspace")).error_estimator
    assert read is not None and model.error_estimator is not None
    assert read.movement_ratios is None
    np.testing.assert_array_equal(read.residual_ratios, model.error_estimator.residual_ratios)


def test_references_that_cannot_calibrate_are_refused(posing_model: PosingModel) -> None:
    reference = validate(posing_model, samples=2, threads=1).reference
    with pytest.raises(ValueError, match="samples and seed"):
        calibrate(posing_model, samples=3, reference=reference)
    with pytest.raises(ValueError, match="one full solution, but it takes two"):
        calibrate(posing_model, reference=reference.select(np.array([True, False])))
