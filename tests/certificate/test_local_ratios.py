"""Ratios near known frames, and bounds that hold as often as they claim."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace.certificate import ErrorEstimator, LocalRatios, ResidualSample

FloatArray = NDArray[np.float64]
SAMPLE = ResidualSample(np.zeros(1, np.int32), np.ones(1))


def covered(confidence: float, known: int, smooth: float) -> tuple[float, float]:
    """How often a bound holds, over calibrations, and the median of bound over estimate.

    Heavy-tailed ratios at random places, and a part that depends on the place.
    """
    random = np.random.default_rng(4)
    held, widths = [], []
    for _ in range(800):
        places = random.uniform(-1, 1, (known + 1, 2))
        noise = random.standard_t(3, known + 1) * (1 - smooth)
        ratios = np.exp(noise + 3 * smooth * np.sin(3 * places[:, 0]))
        middle, bound = LocalRatios(places[1:], ratios[1:]).at(places[0], confidence)
        held.append(ratios[0] <= bound)
        widths.append(bound / middle)
    return float(np.mean(held)), float(np.median(widths))


@pytest.mark.parametrize("confidence", [0.5, 0.8, 0.9])
@pytest.mark.parametrize("smooth", [0.0, 0.9])
def test_a_new_ratio_is_below_the_bound_as_often_as_claimed(
    confidence: float, smooth: float
) -> None:
    """On average over calibrations, whether or not ratios depend on the place."""
    share, _ = covered(confidence, 39, smooth)
    assert share == pytest.approx(confidence, abs=0.06)


def test_neighbours_predict_a_ratio_that_depends_on_the_place() -> None:
    places = np.linspace(0, 1, 40)[:, None]
    ratios = LocalRatios(places, np.exp(5 * places[:, 0]))
    for place in (0.21, 0.5, 0.83):
        middle, bound = ratios.at(np.array([place]), 0.9)
        assert middle == pytest.approx(np.exp(5 * place), rel=0.15)
        assert middle <= bound < 1.3 * middle


def test_far_from_all_frames_the_ratio_is_their_mean() -> None:
    places = np.linspace(0, 1, 40)[:, None]
    logs = 5 * places[:, 0]
    middle, _ = LocalRatios(places, np.exp(logs)).at(np.array([1e6]), 0.9)
    assert np.log(middle) == pytest.approx(logs.mean(), abs=0.1)


def test_the_unit_of_length_does_not_matter() -> None:
    random = np.random.default_rng(0)
    places, ratios, q = random.normal(size=(20, 3)), random.uniform(1, 2, 20), random.normal(size=3)
    small = LocalRatios(places, ratios).at(q, 0.9)
    assert LocalRatios(1e3 * places, 1e-5 * ratios).at(1e3 * q, 0.9) == pytest.approx(
        [1e-5 * factor for factor in small]
    )


def test_frames_in_one_place_are_a_plain_sample() -> None:
    ratios = LocalRatios(np.zeros((5, 2)), np.full(5, 3.0))
    assert ratios.at(np.ones(2), 0.5) == pytest.approx((3.0, 3.0))


def test_confidence_needs_samples() -> None:
    nine, eight = (LocalRatios(np.zeros((k, 1)), np.ones(k)) for k in (9, 8))
    assert nine.at(np.zeros(1), 0.9) == pytest.approx((1.0, 1.0))
    with pytest.raises(ValueError, match=r"0\.9 needs 9 calibration samples, but the model has 8"):
        eight.at(np.zeros(1), 0.9)
    with pytest.raises(ValueError, match=r"0\.99 needs 99 calibration samples"):
        eight.at(np.zeros(1), 0.99)
    for confidence in (0.0, 1.0, np.nan):
        with pytest.raises(ValueError, match="must be between 0 and 1"):
            eight.at(np.zeros(1), confidence)


@pytest.mark.parametrize("ratios", [[], [1.0], [1.0, np.nan], [0.0, 1.0], [1.0, 1.0, 1.0]])
def test_ratios_that_no_calibration_gives_are_refused(ratios: list[float]) -> None:
    with pytest.raises(ValueError, match=r"positive ratios, .* calibrate the model again"):
        ErrorEstimator(1.0, SAMPLE, np.zeros((2, 3)), np.array(ratios), np.ones(2))
