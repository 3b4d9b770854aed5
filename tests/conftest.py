"""Fixtures that several rooms share: they cost a second and are made once."""

from __future__ import annotations

import pytest

from snapspace import ReducedModel, reduce, sample, snapshot_pca, solve_snapshots

from .shapes import bar_problem


@pytest.fixture(scope="session")
def posing_model() -> ReducedModel:
    """A bar with three handles in the best 20 dimensions for 60 random poses."""
    problem = bar_problem()
    snapshots = solve_snapshots(problem, sample(problem.domain, 60, seed=1), threads=1)
    subspace = snapshot_pca(snapshots, dimension=20)
    return reduce(problem, subspace, snapshots=snapshots, threads=1)
