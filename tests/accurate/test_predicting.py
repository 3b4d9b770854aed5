"""Predicting: when models that only predict samples are made, and from which samples."""

from __future__ import annotations

from typing import cast

import numpy as np
import pytest

from snapspace import InterpolationModel, Snapshots, sample, solve_snapshots
from snapspace.accurate.predicting import ENOUGH, MOST_DIMENSIONS, TRAINED, Predicting

from ..shapes import interpolation_problem


@pytest.fixture(scope="module")
def solved() -> Snapshots:
    problem = interpolation_problem()
    few = solve_snapshots(problem, sample(problem.domain, 7, seed=0))
    many = few
    while len(many) < 100:  # only their number counts
        many = many.joined(few)
    return many


def first(snapshots: Snapshots, count: int) -> Snapshots:
    return snapshots.select(np.arange(len(snapshots)) < count)


class Makes:
    """Makes no model, and records the samples that it is asked to use."""

    def __init__(self) -> None:
        self.calls: list[tuple[int, int, int]] = []
        self.predicting = Predicting()

    def model(self, solved: Snapshots | None) -> InterpolationModel | None:
        model = self.predicting.model(solved, self.make)
        return cast("InterpolationModel | None", model)

    def make(self, every: Snapshots, dimension: int, trained: Snapshots) -> InterpolationModel:
        self.calls.append((len(every), dimension, len(trained)))
        return cast("InterpolationModel", object())


def test_before_any_sample_there_is_no_model() -> None:
    assert Makes().model(None) is None


def test_a_model_is_made_anew_once_there_are_enough_more_samples(solved: Snapshots) -> None:
    makes = Makes()
    model = makes.model(first(solved, 10))
    assert model is not None and makes.calls == [(10, 8, 10)]
    assert makes.model(first(solved, 13)) is model
    assert makes.model(first(solved, round(10 * ENOUGH))) is not model
    assert len(makes.calls) == 2


def test_dimension_and_training_are_bounded(solved: Snapshots) -> None:
    makes = Makes()
    makes.model(solved)
    assert makes.calls == [(len(solved), MOST_DIMENSIONS, TRAINED)]


class Modes:
    """A stand-in for a model; only its dimension counts."""

    def __init__(self, dimension: int) -> None:
        self.dimension = dimension

    def leading(self, dimension: int) -> InterpolationModel:
        return cast("InterpolationModel", Modes(dimension))


def test_a_model_made_for_another_purpose_serves_as_well(solved: Snapshots) -> None:
    makes, model = Makes(), cast("InterpolationModel", Modes(40))
    makes.predicting.take(model, first(solved, 50))
    assert makes.model(first(solved, 60)) is model
    assert not makes.calls


def test_its_leading_modes_predict_if_there_are_many(solved: Snapshots) -> None:
    makes = Makes()
    makes.predicting.take(cast("InterpolationModel", Modes(200)), first(solved, 50))
    model = makes.model(first(solved, 60))
    assert model is not None and model.dimension == MOST_DIMENSIONS
