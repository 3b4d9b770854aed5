"""Exponents are those of the samples, and estimates follow errors that grow like a power."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from snapspace import ErrorEstimator, PosingModel
from snapspace.certificate import ResidualSample, grown, growth_exponent, rest_size

RNG = np.random.default_rng(0)
SIZES = RNG.uniform(0.5, 2.0, 400)
RESIDUALS = SIZES * np.exp(RNG.normal(size=400))
NOISE = np.exp(0.3 * RNG.normal(size=400))


def distances(exponent: float) -> np.ndarray:
    return NOISE * grown(RESIDUALS, SIZES, exponent)


@pytest.mark.parametrize("exponent", [1.2, 1.5, 2.0, 2.7])
def test_many_samples_give_their_own_exponent(exponent: float) -> None:
    found = growth_exponent(RESIDUALS, distances(exponent), SIZES)
    assert found == pytest.approx(exponent, abs=0.05)


def test_few_samples_stay_near_the_exponent_of_linear_problems() -> None:
    few = growth_exponent(RESIDUALS[:2], distances(2.7)[:2], SIZES[:2])
    more = growth_exponent(RESIDUALS[:16], distances(2.7)[:16], SIZES[:16])
    assert 1.0 <= few < more < 2.7
    assert growth_exponent(np.zeros(3), np.ones(3), np.ones(3)) == 1.0


@pytest.mark.parametrize(("exponent", "limit"), [(0.0, 1.0), (6.0, 3.0)])
def test_exponents_stay_within_their_limits(exponent: float, limit: float) -> None:
    assert growth_exponent(RESIDUALS, distances(exponent), SIZES) == limit


def test_units_do_not_matter() -> None:
    """Lengths in millimetres, and residuals in any unit."""
    one = growth_exponent(RESIDUALS[:20], distances(2.0)[:20], SIZES[:20])
    other = growth_exponent(70.0 * RESIDUALS[:20], 1e3 * distances(2.0)[:20], 1e3 * SIZES[:20])
    assert other == pytest.approx(one, rel=1e-12)
    frames = RNG.normal(size=(5, 3))
    assert rest_size(1e3 * frames, 1.0) == pytest.approx(1e3 * rest_size(frames, 1.0))


def test_an_exponent_of_one_is_the_residual() -> None:
    np.testing.assert_allclose(grown(RESIDUALS, SIZES, 1.0), RESIDUALS, rtol=1e-14)


@pytest.mark.parametrize("exponent", [0.9, np.nan, np.inf])
def test_other_exponents_are_refused(exponent: float) -> None:
    sample = ResidualSample(np.zeros(1, np.int32), np.ones(1))
    with pytest.raises(ValueError, match="an exponent of 1 or more; calibrate the model again"):
        ErrorEstimator(1.0, sample, np.zeros((2, 3)), np.ones(2), exponent=exponent)


def test_a_certificate_grows_like_the_power_of_the_residual(posing_model: PosingModel) -> None:
    """With equal ratios the relative distance is the ratio times (residual / size)^p."""
    d, n = posing_model.dimension, len(posing_model.problem.mesh.vertices)
    sample = ResidualSample(np.arange(n, dtype=np.int32), np.ones(n))
    volume = posing_model.problem.mesh.volume
    linear = ErrorEstimator(volume, sample, np.ones((9, d)), np.full(9, 3.0))
    relative = []
    for estimator in (linear, replace(linear, exponent=2.0)):
        session = replace(posing_model, error_estimator=estimator).session()
        session.pose(0.5 * posing_model.problem.domain.half_widths)
        relative.append(session.certificate().relative)
    assert relative[1] / 3.0 == pytest.approx((relative[0] / 3.0) ** 2, rel=1e-9)
