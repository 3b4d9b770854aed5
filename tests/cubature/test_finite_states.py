"""A material with a barrier trains its cubature on the states that have a finite energy."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    AffineSubspace,
    PosingProblem,
    SymmetricDirichlet,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.cubature import train_cubature
from snapspace.reduction.handle_quadric import handle_quadric

from ..snapshots.bars import parameters, posing_bar

FloatArray = NDArray[np.float64]
DIMENSION = 6


@pytest.fixture(scope="module")
def problem() -> PosingProblem:
    return posing_bar(material=SymmetricDirichlet())


@pytest.fixture(scope="module")
def subspace(problem: PosingProblem) -> AffineSubspace:
    snapshots = solve_snapshots(problem, parameters(problem, 20), threads=1)
    return snapshot_pca(snapshots, dimension=DIMENSION)


def states(problem: PosingProblem, subspace: AffineSubspace, inverted: list[int]) -> FloatArray:
    """Coordinates (20, d), some of them so far out that tets are inverted."""
    sizes = np.sqrt(subspace.snapshot_energies[:DIMENSION] / 20)
    q = np.random.default_rng(0).standard_normal((20, DIMENSION)) * sizes
    q[inverted] = 30.0 * q[2]
    energies = np.array([problem.energy.value(subspace.shape(one)) for one in q])
    assert np.flatnonzero(np.isinf(energies)).tolist() == inverted
    return q


def test_states_with_inverted_tets_are_left_out(
    problem: PosingProblem, subspace: AffineSubspace
) -> None:
    q, hessian = states(problem, subspace, [2, 11]), 2.0 * handle_quadric(problem, subspace).K
    found, record = train_cubature(problem, subspace, q, hessian, threads=1)
    expected, _ = train_cubature(problem, subspace, np.delete(q, [2, 11], 0), hessian, threads=1)
    np.testing.assert_array_equal(found.tets, expected.tets)
    np.testing.assert_array_equal(found.weights, expected.weights)
    assert record["held_out"]["force_median"] < 0.1


def test_too_few_finite_states_name_the_reason(
    problem: PosingProblem, subspace: AffineSubspace
) -> None:
    q, hessian = states(problem, subspace, [*range(11)]), 2.0 * handle_quadric(problem, subspace).K
    with pytest.raises(ValueError, match="11 of 20 snapshots have inverted tets once proj") as told:
        train_cubature(problem, subspace, q, hessian)
    assert "the energy of symmetric Dirichlet is infinite" in str(told.value)
    assert "needs 10 without; use a larger dimension" in str(told.value)
