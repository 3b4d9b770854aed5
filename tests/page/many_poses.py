"""A model of twelve poses, enough to need a search."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import (
    InterpolationModel,
    InterpolationProblem,
    StVK,
    reduce,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.generators import bar
from snapspace.problem import Poses

from ..shapes import bent


@pytest.fixture(scope="session")
def many_poses_model() -> InterpolationModel:
    """A thin bar: five arcs, five twists that are bent, and two other poses; d = 8."""
    mesh = bar(10, 2, 2)
    shapes = {"rest": mesh.vertices}
    shapes |= {f"arc-{k:02}": bent(mesh, 0.5 * k) for k in range(1, 6)}
    shapes |= {f"twist_{k}": bent(mesh, -0.2 * k, twist=0.45 * k) for k in range(1, 6)}
    shapes["look back"] = bent(mesh, -2.2)
    poses = Poses(np.stack(list(shapes.values())), mesh.tets, names=list(shapes))
    problem = InterpolationProblem(poses, material=StVK())
    # the poses themselves, and the middles of successive ones
    ends = np.eye(len(poses))
    weights = np.concatenate([ends, (ends + np.roll(ends, 1, axis=0)) / 2])
    snapshots = solve_snapshots(problem, weights, threads=1)
    subspace = snapshot_pca(snapshots, dimension=8)
    return reduce(problem, subspace, snapshots=snapshots, threads=1)
