"""Fixtures that several packages share. Each takes about a second and is made once."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import settings

from snapspace import (
    InterpolationModel,
    InterpolationProblem,
    MirrorPlane,
    PosingModel,
    Snapshots,
    StableNeoHookean,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.generators import cylinder, helix

from .browser import chromium
from .shapes import bar_poses, bar_problem, interpolation_problem, surface_around

__all__ = ["chromium"]  # a fixture

# Every run tries the same examples, so that a failure is due to a change;
# `--hypothesis-profile=searching` tries others. A busy machine is not an error, hence no deadlines.
settings.register_profile("steady", derandomize=True, deadline=None)
settings.register_profile("searching", deadline=None)
settings.load_profile("steady")


def pytest_collection_finish() -> None:
    """Exempts the objects of thousands of collected tests from full garbage collections."""
    gc.freeze()


#: Pages need the mirror plane of the bar. The record of its models names it: a search takes longer
#: than everything else in a page.
MIRROR = MirrorPlane((0, 1, 0), (2, 0.5, 0.5))


def naming_its_plane(model: PosingModel) -> PosingModel:
    return replace(model, provenance={**model.provenance, "mirror": MIRROR.content})


@pytest.fixture(scope="session")
def posing_snapshots() -> Snapshots:
    """60 random poses of a bar with three handles."""
    problem = bar_problem()
    return solve_snapshots(problem, sample(problem.domain, 60, seed=1), threads=1)


@pytest.fixture(scope="session")
def posing_model(posing_snapshots: Snapshots) -> PosingModel:
    """The bar with the first 20 principal components of its snapshots."""
    subspace = snapshot_pca(posing_snapshots, dimension=20)
    problem = posing_snapshots.problem
    return naming_its_plane(reduce(problem, subspace, snapshots=posing_snapshots, threads=1))


@pytest.fixture(scope="session")
def own_surface_model(posing_model: PosingModel) -> PosingModel:
    """The bar inside a surface that has its own vertices, some outside the bar's tets."""
    return replace(posing_model, surface=surface_around(posing_model.problem.mesh))


@pytest.fixture(scope="session")
def cubature_model(posing_snapshots: Snapshots) -> PosingModel:
    """The bar in 19 dimensions, its energy summed over few tets."""
    subspace = snapshot_pca(posing_snapshots, dimension=19)
    problem = posing_snapshots.problem
    return naming_its_plane(
        reduce(problem, subspace, energy="cubature", snapshots=posing_snapshots)
    )


def interpolation_model(
    problem: InterpolationProblem, samples: int, dimension: int
) -> InterpolationModel:
    """A model of `dimension` from `samples` random blends, all converged."""
    snapshots = solve_snapshots(problem, sample(problem.domain, samples, seed=1), threads=1)
    assert snapshots.converged.all()
    subspace = snapshot_pca(snapshots, dimension=dimension)
    return reduce(problem, subspace, snapshots=snapshots, threads=1)


@pytest.fixture(scope="session")
def blending_model() -> InterpolationModel:
    """Three poses of a bar in 12 dimensions, from 30 random blends."""
    return interpolation_model(interpolation_problem(), 30, 12)


@pytest.fixture(scope="session")
def blended_cubature_model() -> InterpolationModel:
    """Three poses of a bar in a material that lets tets collapse and differs from tet to tet."""
    poses = bar_poses()
    mu = np.linspace(0.5, 2.0, len(poses.tets))
    problem = InterpolationProblem(poses, material=StableNeoHookean(lam=1.5, mu=mu))
    return interpolation_model(problem, 30, 12)


@pytest.fixture(scope="session")
def helix_model() -> InterpolationModel:
    """A cylinder and a helix in 20 dimensions, from 30 random blends."""
    return interpolation_model(InterpolationProblem([cylinder(2, 26), helix(2, 26)]), 30, 20)


#: A cluster that watches itself takes a fifth of a processor while it waits for work.
UNWATCHED = {
    "distributed.worker.profile.enabled": False,
    "distributed.admin.system-monitor.interval": "60s",
    "distributed.admin.tick.interval": "1s",
}


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """A dask cluster of two worker processes with one thread each."""
    distributed = pytest.importorskip("distributed", reason="needs the extra snapspace[dask]")
    import dask

    with (
        dask.config.set(UNWATCHED),
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address="127.0.0.1:0"
        ) as cluster,
    ):
        yield cluster
