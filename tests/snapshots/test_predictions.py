"""Predictions: a model's solutions as starts, and its Hessians in the seed of later solves."""

from __future__ import annotations

from concurrent.futures import Executor
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    InterpolationModel,
    InterpolationProblem,
    Predictions,
    Snapshots,
    SolverOptions,
    predicted_solutions,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.mesh import mass_norm
from snapspace.reduction import reduced_solutions
from snapspace.session.predictions import STIFFER, TOLERANCE
from snapspace.snapshots import positive_inverse

from ..shells.strips import rolled_strips
from .bars import assert_same_bits

FloatArray = NDArray[np.float64]
TIGHT = SolverOptions(tolerance=1e-12, max_iterations=5000)


@pytest.fixture(scope="module")
def problem() -> InterpolationProblem:
    return rolled_strips()


@pytest.fixture(scope="module")
def solved(problem: InterpolationProblem) -> Snapshots:
    return solve_snapshots(problem, sample(problem.domain, 24, method="blends"), options=TIGHT)


@pytest.fixture(scope="module")
def wanted(problem: InterpolationProblem) -> FloatArray:
    return sample(problem.domain, 11, seed=5)


@pytest.fixture(scope="module")
def model(problem: InterpolationProblem, solved: Snapshots) -> InterpolationModel:
    return reduce(problem, snapshot_pca(solved, dimension=14), snapshots=solved)


@pytest.fixture(scope="module")
def predictions(model: InterpolationModel, wanted: FloatArray) -> Predictions:
    """Blends have no Hessians by default; here they stand in for slow motions, which have them."""
    return predicted_solutions(model, wanted, hessians=True)


def mean_evaluations(snapshots: Snapshots) -> float:
    return float(np.mean([report.evaluations for report in snapshots.reports]))


def test_predictions_are_the_models_solutions_and_stiffer_hessians(
    model: InterpolationModel, wanted: FloatArray, predictions: Predictions
) -> None:
    session, inverses = model.session(tolerance=TOLERANCE), predictions.inverses
    assert inverses is not None
    for w, displacement, inverse in zip(wanted, predictions.displacements, inverses, strict=True):
        session.reset()
        session.blend(w)
        shape = session.vertices.reshape(-1)
        np.testing.assert_allclose(displacement + model.problem.base, shape, atol=1e-9)
        hessian = model.blends.at(w).hessian(session.q)
        np.testing.assert_allclose(session.hessian(), hessian, atol=1e-9 * np.abs(hessian).max())
        identity = STIFFER * inverse @ hessian
        np.testing.assert_allclose(identity, np.eye(len(hessian)), atol=1e-6)


def test_solves_end_at_the_same_minima_in_fewer_evaluations(
    problem: InterpolationProblem, wanted: FloatArray, predictions: Predictions
) -> None:
    inverses = predictions.inverses
    assert inverses is not None
    # Hessians so stiff that the scalar factor is left, from the mean shape and from predictions
    alone = replace(predictions, inverses=1e-30 * inverses)
    means = np.repeat((problem.tau - problem.base)[None], len(wanted), axis=0)
    plain, started, seeded = (
        solve_snapshots(problem, wanted, options=TIGHT, predictions=given)
        for given in (replace(alone, displacements=means), alone, predictions)
    )
    assert seeded.converged.all()
    mass, tau = problem.mass(), problem.tau
    for shape, expected in zip(seeded.shapes, plain.shapes, strict=True):
        assert mass_norm(mass, shape - expected) < 1e-3 * mass_norm(mass, expected - tau)
    assert mean_evaluations(seeded) < 0.8 * mean_evaluations(started) < mean_evaluations(plain)


def test_neither_threads_nor_blocks_change_a_bit(
    problem: InterpolationProblem, wanted: FloatArray, predictions: Predictions
) -> None:
    one, two = (
        solve_snapshots(
            problem,
            wanted,
            options=SolverOptions(block=block),
            threads=threads,
            predictions=predictions,
        )
        for block, threads in ((16, 1), (11, 2))
    )
    assert_same_bits(two, one)


def test_an_executor_gives_the_same_bits(
    processes: Executor,
    problem: InterpolationProblem,
    wanted: FloatArray,
    predictions: Predictions,
) -> None:
    here = solve_snapshots(problem, wanted, predictions=predictions)
    there = solve_snapshots(problem, wanted, predictions=predictions, executor=processes)
    assert_same_bits(there, here)


def test_newtons_method_starts_from_predictions(
    problem: InterpolationProblem, wanted: FloatArray, predictions: Predictions
) -> None:
    newton = SolverOptions(solver="newton", tolerance=1e-10)
    plain = solve_snapshots(problem, wanted[:3], options=newton)
    few = Predictions(predictions.displacements[:3])
    started = solve_snapshots(problem, wanted[:3], options=newton, predictions=few)
    assert started.converged.all()
    assert mean_evaluations(started) < mean_evaluations(plain)


def test_the_seed_is_the_scalar_inverse_and_that_of_the_subspace(
    problem: InterpolationProblem, predictions: Predictions
) -> None:
    """The first step goes along -(A^-1 + U B U^T) g: compared with that from the parts."""
    basis, inverses = predictions.basis, predictions.inverses
    assert basis is not None and inverses is not None
    system, w = problem.system, np.array([0.3, 0.4, 0.3])
    start = np.zeros(problem.base.size)
    gradient = system.value_and_gradient(start, w)[1]
    coarse = core.CoarseSpace(system, np.ascontiguousarray(basis.T))
    small = 1e-3  # so that the first step is accepted as it is

    def moved(*, scale: float) -> FloatArray:
        inputs = np.concatenate([w, scale * inverses[0].ravel()])[None]
        batch = system.solve_fast(
            inputs,
            start[None],
            tolerance=1e-300,
            max_iterations=1,
            threads=1,
            control=core.SolveControl(),
            coarse=coarse,
        )
        shape: FloatArray = batch.shapes[0]
        return shape

    expected = -small * basis @ (inverses[0] @ (basis.T @ gradient))
    difference = moved(scale=small) - moved(scale=0.0)
    assert np.linalg.norm(difference - expected) < 1e-3 * np.linalg.norm(expected)


def test_blends_have_only_starts_by_default(
    model: InterpolationModel, wanted: FloatArray, predictions: Predictions
) -> None:
    starts = predicted_solutions(model, wanted)
    assert starts.basis is None and starts.inverses is None
    assert np.array_equal(starts.displacements, reduced_solutions(model, wanted))
    # those with Hessians are solved to a looser tolerance, as near as samples need
    distances = starts.displacements - predictions.displacements
    assert np.linalg.norm(distances) < 1e-3 * np.linalg.norm(starts.displacements)


def test_inverses_are_positive_definite_whatever_the_hessian_is() -> None:
    rng = np.random.default_rng(0)
    symmetric = rng.normal(size=(7, 7))
    symmetric += symmetric.T
    assert np.linalg.eigvalsh(positive_inverse(symmetric))[0] > 0
    positive = symmetric @ symmetric + np.eye(7)
    np.testing.assert_allclose(positive_inverse(positive), np.linalg.inv(positive), atol=1e-12)


@pytest.mark.parametrize("part", ["basis", "inverses"])
def test_a_basis_needs_inverses(predictions: Predictions, part: str) -> None:
    with pytest.raises(ValueError, match="a basis needs inverses"):
        replace(predictions, **{part: None})


def test_shapes_must_match(
    problem: InterpolationProblem, wanted: FloatArray, predictions: Predictions
) -> None:
    inverses = predictions.inverses
    assert inverses is not None
    with pytest.raises(ValueError, match=r"need a basis \(675, d\) and inverses \(11, d, d\)"):
        replace(predictions, inverses=inverses[:, :3])
    with pytest.raises(ValueError, match=r"predictions are for \(11, 675\) .* \(4, 675\)"):
        solve_snapshots(problem, wanted[:4], predictions=predictions)


def test_the_core_refuses_inputs_without_inverses(
    problem: InterpolationProblem, predictions: Predictions
) -> None:
    basis = predictions.basis
    assert basis is not None
    coarse = core.CoarseSpace(problem.system, np.ascontiguousarray(basis.T))
    start, w = np.zeros(problem.base.size), np.full(3, 1 / 3)
    with pytest.raises(ValueError, match=r"with a coarse space \(input_size \+ d"):
        problem.system.put(core.SampleQueue(), 0, w, start, coarse=coarse)
