"""Blends of surfaces: held-out samples are predicted too, and judge the model that predicts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    ARAP,
    InterpolationProblem,
    ShellPoses,
    Snapshots,
    accurate_model,
    reduce,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.accurate import model_search
from snapspace.accurate.dimension_search import MODES_PER_SOLUTION, DimensionSearch
from snapspace.accurate.growing_samples import GrowingSamples, Model
from snapspace.accurate.measured_ratio import measured_ratio
from snapspace.accurate.plan import BLENDS, Plan
from snapspace.accurate.predicting import Predicting
from snapspace.accurate.search_options import SearchOptions
from snapspace.accurate.solving import Solving
from snapspace.generators import lizard_poses
from snapspace.mesh import mass_norms
from snapspace.subspace import spanned_dimension
from snapspace.validation import unseen_errors

FloatArray = NDArray[np.float64]


class Predicted:
    """Samples of a problem, most of them predicted, and the last model that predicted them."""

    def __init__(self, problem: InterpolationProblem, *, judges_too: bool) -> None:
        self.problem = problem
        self.model: Model | None = None
        self._predicting = Predicting()
        self.samples = GrowingSamples(
            problem,
            28,
            method="blends",
            seed=0,
            first=20,
            held_out=8,
            pilot=12,
            judges_too=judges_too,
        )
        self.samples.solve_up_to(28, Solving(threads=2), predict=self._predict)

    def _predict(self) -> Model | None:
        self.model = self._predicting.model(self.samples.solved, self._make)
        return self.model

    def _make(self, solved: Snapshots, dimension: int, trained: Snapshots) -> Model:
        subspace = snapshot_pca(solved, dimension=dimension)
        return reduce(self.problem, subspace, snapshots=trained, threads=2)


def lizards(count: int) -> ShellPoses:
    """Poses as surfaces."""
    meshes = lizard_poses(count, 2000, seed=3)
    used, faces = np.unique(meshes[0].surface, return_inverse=True)
    shapes = [mesh.vertices[used] for mesh in meshes]
    return ShellPoses(shapes, faces.reshape(-1, 3), thickness=0.02)


@pytest.fixture(scope="module")
def problem() -> InterpolationProblem:
    return InterpolationProblem(lizards(3), material=ARAP())


@pytest.fixture(scope="module")
def predicted(problem: InterpolationProblem) -> Predicted:
    return Predicted(problem, judges_too=True)


def test_the_ratio_is_that_of_errors_and_projections(predicted: Predicted) -> None:
    samples = predicted.samples
    assert predicted.model is not None
    # the projection is a root of a difference, which with all dimensions is mostly rounding
    model = predicted.model.leading(6)
    error = unseen_errors(model, samples.unseen).mean()
    projection = samples.projection_errors_onto(model.subspace).mean()
    assert measured_ratio(model, samples.unseen, BLENDS) == pytest.approx(
        error / projection, rel=1e-3
    )


def test_predicted_judges_are_closer_to_the_minimum_for_less(
    problem: InterpolationProblem, predicted: Predicted
) -> None:
    alone = Predicted(problem, judges_too=False)
    options = Solving().judging(problem)
    tight = replace(options, tolerance=1e-3 * options.resolved(problem).tolerance)
    misses, evaluations = [], []
    for one in (predicted, alone):
        judges = one.samples.unseen
        minima = solve_snapshots(problem, judges.parameters, options=tight, known=judges, threads=2)
        apart = minima.displacements.array() - judges.displacements.array()
        misses.append(mass_norms(problem.mass(), apart).mean())
        evaluations.append(np.mean([report.evaluations for report in judges.reports]))
    assert misses[0] < 1.2 * misses[1]
    assert evaluations[0] < 0.8 * evaluations[1]


def test_the_first_dimension_follows_from_that_ratio(
    problem: InterpolationProblem, monkeypatch: pytest.MonkeyPatch
) -> None:
    ratios = []

    def recorded(model: Model, unseen: Snapshots, plan: Plan) -> float:
        ratios.append(measured_ratio(model, unseen, plan))
        return ratios[-1]

    monkeypatch.setattr(model_search, "measured_ratio", recorded)
    search = model_search.ModelSearch(problem, SearchOptions(), Solving(threads=2))
    first = next(search.trials())
    tries = DimensionSearch(search.samples, BLENDS, search.target, ratios[-1])
    assert first.step.dimension == next(tries.dimensions(last=False))
    assert ratios[-1] != BLENDS.first_ratio


def test_two_poses_get_a_model_although_their_blends_span_few_dimensions() -> None:
    """The samples lie near a curve: models that predict have fewer dimensions than usual."""
    accurate = accurate_model(InterpolationProblem(lizards(2)))
    solved = accurate.snapshots.select(~accurate.held_out)
    assert spanned_dimension(solved) < MODES_PER_SOLUTION * len(solved)
    assert accurate.step.error <= BLENDS.target
