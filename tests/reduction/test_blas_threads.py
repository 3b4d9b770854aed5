"""A model does not depend on the number of BLAS threads."""

from __future__ import annotations

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

import snapspace as ss
from snapspace.generators import creature, creature_handles


@pytest.fixture(scope="module")
def snapshots() -> ss.Snapshots:
    # large enough for BLAS to share its sums between threads
    mesh = creature(20_000)
    parts = creature_handles(mesh)
    handles = ss.Handles([parts["feet"], parts["head"]], names=["feet", "head"])
    domain = ss.HandleBox(translation=0.2, angle=0.5)
    problem = ss.PosingProblem(mesh, handles, domain=domain, material=ss.StVK())
    options = ss.SolverOptions(tolerance=1e-2)
    return ss.solve_snapshots(problem, ss.sample(problem.domain, 24), options=options)


def reduced(snapshots: ss.Snapshots, threads: int) -> ss.ReducedModel:
    with threadpool_limits(limits=threads, user_api="blas"):
        subspace = ss.snapshot_pca(snapshots, dimension=16)
        return ss.reduce(snapshots.problem, subspace, snapshots=snapshots, threads=threads)


def test_blas_threads_do_not_change_a_bit(snapshots: ss.Snapshots) -> None:
    one, two = reduced(snapshots, 1), reduced(snapshots, 2)
    for name, a, b in (
        ("basis", one.subspace.basis, two.subspace.basis),
        ("energies", one.subspace.snapshot_energies, two.subspace.snapshot_energies),
        ("quartic", one.elastic.coefficients, two.elastic.coefficients),
        ("K", one.handles.K, two.handles.K),
        ("L", one.handles.L, two.handles.L),
        ("coordinates", one.training_coordinates, two.training_coordinates),
    ):
        np.testing.assert_array_equal(a, b, err_msg=name)
