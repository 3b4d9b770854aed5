"""A small model and its file."""

from __future__ import annotations

from pathlib import Path

import pytest

from snapspace import ReducedModel, reduce, snapshot_pca, solve_snapshots

from ..snapshots.bars import parameters, posing_bar


@pytest.fixture(scope="session")
def model() -> ReducedModel:
    """A bar in five dimensions; its provenance has values that are easy to get wrong."""
    problem = posing_bar(stiffness=1234.5678901234567)
    snapshots = solve_snapshots(problem, parameters(problem, 8), threads=1)
    provenance = {"seed": 0, "seconds": 0.1 + 0.2, "mesh": "Schildkröte.mesh", "none": None}
    subspace = snapshot_pca(snapshots, dimension=5)
    return reduce(problem, subspace, snapshots=snapshots, provenance=provenance, threads=1)


@pytest.fixture
def saved(model: ReducedModel, tmp_path: Path) -> Path:
    return model.save(tmp_path / "bar.snapspace")
