"""growing_models: the first model comes early, the last one is what the plain pipeline makes."""

from __future__ import annotations

import numpy as np
import pytest

import snapspace as ss
from snapspace.growing import FIRST_DIMENSION, FIRST_SAMPLES

from .snapshots.bars import parameters, posing_bar


def energies(snapshots: ss.Snapshots) -> np.ndarray:
    return np.array([report.value for report in snapshots.reports])


@pytest.fixture(scope="module", params=[ss.StVK, ss.StableNeoHookean], ids=lambda m: m.kind)
def problem(request: pytest.FixtureRequest) -> ss.PosingProblem:
    """For a material whose energy is exact, and for one that has a cubature."""
    return posing_bar(8, 2, 2, material=request.param())


def test_the_last_model_has_all_samples_solved_as_the_plain_pipeline_does(
    problem: ss.PosingProblem,
) -> None:
    samples = parameters(problem, 200)
    grown = list(ss.growing_models(problem, samples, dimension=20))
    assert [len(growth.snapshots) for growth in grown] == [FIRST_SAMPLES, 66, 200]
    assert [growth.final for growth in grown] == [False, False, True]
    last = grown[-1]
    np.testing.assert_array_equal(last.snapshots.parameters, samples)
    assert last.snapshots.converged.all() and last.model.dimension == 20
    plain = ss.solve_snapshots(problem, samples)
    np.testing.assert_allclose(energies(last.snapshots), energies(plain), rtol=1e-4)
    leading = ss.snapshot_pca(plain, dimension=10).basis + problem.tau[:, None]
    cosines = np.linalg.svd(last.model.subspace.coordinates(leading))[1]
    assert cosines.min() > 0.999


def test_each_model_is_better_than_the_one_before(problem: ss.PosingProblem) -> None:
    unseen = ss.solve_snapshots(
        problem, parameters(problem, 12, seed=77), options=ss.SolverOptions(tolerance=1e-11)
    )
    errors, seconds = [], []
    for growth in ss.growing_models(problem, parameters(problem, 200), dimension=30):
        subspace = growth.model.subspace
        misses = unseen.shapes - subspace.tau[:, None]
        misses -= subspace.basis @ subspace.coordinates(unseen.shapes)
        errors.append(np.median(ss.mesh.mass_norms(subspace.mass, misses)))
        seconds.append(growth.seconds)
    assert errors[0] > errors[1] > errors[2]
    assert 0 < seconds[0] < seconds[1] < seconds[2]


def test_the_first_model_is_loose_and_small(problem: ss.PosingProblem) -> None:
    first = next(ss.growing_models(problem, parameters(problem, 40)))
    assert first.model.dimension == FIRST_DIMENSION and not first.final
    tight = ss.solve_snapshots(
        problem, first.snapshots.parameters, options=ss.SolverOptions(tolerance=1e-9)
    )
    excess = energies(first.snapshots) / energies(tight) - 1.0
    # what the tolerance is compared with is twice what the solver expects, which is no bound
    expected = 0.5 * problem.solving.loose_tolerance
    assert 0 < np.median(excess) < expected
    assert excess.max() < 4.0 * expected


def test_few_samples_are_one_stage(problem: ss.PosingProblem) -> None:
    (only,) = ss.growing_models(problem, parameters(problem, 20), dimension=8)
    assert only.final and only.model.dimension == 8


def test_a_dimension_beyond_the_samples_is_refused(problem: ss.PosingProblem) -> None:
    with pytest.raises(ValueError, match="dimension 30 exceeds the 20 independent"):
        list(ss.growing_models(problem, parameters(problem, 20), dimension=30))


def test_what_trains_a_cubature_is_ten_samples_at_least() -> None:
    problem = posing_bar(material=ss.ARAP())
    with pytest.raises(ValueError, match="9 samples are too few, the energy of as rigid as poss"):
        next(ss.growing_models(problem, parameters(problem, 9), dimension=3))
    (only,) = ss.growing_models(problem, parameters(problem, 10), dimension=3)
    assert isinstance(only.model.elastic, ss.Cubature)


def test_samples_of_a_large_quartic_material_are_tight_enough_for_a_cubature() -> None:
    """The last model has one beyond 48 dimensions; smaller ones are exact."""
    problem = posing_bar()
    grown = list(ss.growing_models(problem, parameters(problem, 60), dimension=50))
    assert isinstance(grown[0].model.elastic, ss.Quartic)
    assert isinstance(grown[-1].model.elastic, ss.Cubature)
    assert all(report.decrement < 1e-5 * report.value for report in grown[-1].snapshots.reports)
