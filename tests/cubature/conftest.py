"""A bar with many tets, its snapshots and a model trained on them."""

from __future__ import annotations

import pytest

from snapspace import PosingModel, Snapshots, reduce, sample, snapshot_pca, solve_snapshots

from ..shapes import bar_problem, irregular_bar


@pytest.fixture(scope="session")
def snapshots() -> Snapshots:
    """Sixty poses of a bar of 2000 tets with three handles."""
    problem = bar_problem(irregular_bar(16, 5, 5))
    return solve_snapshots(problem, sample(problem.domain, 60, seed=1), threads=1)


@pytest.fixture(scope="session")
def cubature_model(snapshots: Snapshots) -> PosingModel:
    """Sixteen dimensions with 128 tets."""
    subspace = snapshot_pca(snapshots, dimension=16)
    return reduce(
        snapshots.problem,
        subspace,
        energy="cubature",
        snapshots=snapshots,
        provenance={"seed": 3},
    )
