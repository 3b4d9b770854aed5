"""Training: how far an estimate of the energy can be trusted to measure errors of forces."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import Cubature, PosingProblem, Snapshots, snapshot_pca
from snapspace.cubature import compliances as estimates
from snapspace.cubature.compliances import compliances, sampled_energy
from snapspace.cubature.elastic_states import PosingStates
from snapspace.cubature.elements import elements_of
from snapspace.cubature.tets_by_force import tets_by_force
from snapspace.cubature.training import Training
from snapspace.reduction.handle_quadric import handle_quadric
from snapspace.reduction.training_samples import training_samples


def bar_states(snapshots: Snapshots, dimension: int) -> PosingStates:
    problem = snapshots.problem
    assert isinstance(problem, PosingProblem)
    subspace = snapshot_pca(snapshots, dimension=dimension)
    coordinates = training_samples(problem, subspace, snapshots)[1]
    stiffness = 2.0 * handle_quadric(problem, subspace).K
    return PosingStates(problem, subspace, coordinates[1:31], stiffness)


def test_a_fit_knows_soft_directions_better_than_a_sample(
    snapshots: Snapshots, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Compliances of 64 fitted tets are nearer to those of all tets than of 64 sampled ones.

    Contributions of tets to the stiffness along a soft direction cancel, so that a sample of them
    may be far off, or even negative.
    """
    monkeypatch.setattr(estimates, "SAMPLED", 64)
    states = bar_states(snapshots, 16)
    measures = elements_of(states.problem).measures
    every = np.arange(len(measures), dtype=np.int32)
    sampled = sampled_energy(states, tets_by_force(states))
    rough = Training(states, every, seed=0).fitted(sampled, 64, rows=128)
    fitted = states.sum_over(rough.tets, rough.volumes)
    exact = compliances(states, states.sum_over(every, measures))

    def median_error(energy: Cubature) -> float:
        found = compliances(states, energy)
        sizes = np.linalg.norm(exact, 2, axis=(1, 2))
        return float(np.median(np.linalg.norm(found - exact, 2, axis=(1, 2)) / sizes))

    assert isinstance(sampled, Cubature)
    assert median_error(fitted) < 0.01
    assert median_error(fitted) < 0.4 * median_error(sampled)


def test_fits_are_the_same_for_any_number_of_threads(snapshots: Snapshots) -> None:
    states = bar_states(snapshots, 8)
    candidates = np.arange(0, 2000, 3, dtype=np.int32)
    sampled = sampled_energy(states, tets_by_force(states))
    one, two = (
        Training(states, candidates, seed=1, threads=threads).fitted(sampled, 40, rows=120)
        for threads in (1, 2)
    )
    np.testing.assert_array_equal(one.tets, two.tets)
    np.testing.assert_array_equal(one.volumes, two.volumes)
    assert set(one.tets.tolist()) <= set(candidates.tolist())
