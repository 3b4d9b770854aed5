"""A cubature does not depend on the unit of length, from nanometres on a mesh in metres upwards."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import (
    Cubature,
    HandleBox,
    PosingProblem,
    SolverOptions,
    StableNeoHookean,
    TetMesh,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)

from ..snapshots.bars import posing_bar


def cubature_of(scale: float) -> Cubature:
    """The cubature of a bar whose lengths are multiplied by a scale."""
    bar = posing_bar(material=StableNeoHookean())
    box = HandleBox(translation=scale * np.array(bar.domain.translation), angle=bar.domain.angle)
    mesh = TetMesh(scale * bar.mesh.vertices, bar.mesh.tets)
    problem = PosingProblem(mesh, bar.handles, domain=box)
    samples = sample(problem.domain, 16)
    solved = solve_snapshots(problem, samples, options=SolverOptions(precision="double"))
    model = reduce(problem, snapshot_pca(solved, dimension=6), snapshots=solved)
    assert isinstance(model.elastic, Cubature)
    return model.elastic


@pytest.fixture(scope="module")
def usual() -> Cubature:
    return cubature_of(1.0)


@pytest.mark.parametrize("power", [-30, -20, 36])
def test_a_cubature_is_the_same_in_every_unit_of_length(usual: Cubature, power: int) -> None:
    """Powers of two do not round. In floats, 1e-9 once gave no cubature, and 1e-6 a worse one."""
    found = cubature_of(2.0**power)
    np.testing.assert_array_equal(found.tets, usual.tets)
    np.testing.assert_allclose(found.weights / 2.0 ** (3 * power), usual.weights, rtol=1e-4)


def test_units_beyond_single_precision_are_refused_with_the_cure() -> None:
    with pytest.raises(ValueError, match=r"^reduce: .* leave single precision, .*; use units in"):
        cubature_of(2.0**44)
