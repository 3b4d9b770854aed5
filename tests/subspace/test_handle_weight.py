"""Heavy handles: the PCA in their norm, and reduced solutions that improve with d."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from scipy.linalg import subspace_angles
from scipy.sparse import csr_array, diags_array

from snapspace import (
    HandleBox,
    Handles,
    InterpolationProblem,
    PosingProblem,
    Snapshots,
    StableNeoHookean,
    generators,
    pca,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.mesh import mass_gram
from snapspace.validation import unseen_errors

from ..shapes import bar_poses, irregular_bar
from ..snapshots.bars import parameters, posing_bar


@pytest.fixture(scope="module")
def snapshots() -> Snapshots:
    problem = posing_bar()
    return solve_snapshots(problem, parameters(problem, 10), threads=1)


def mass_with_handles(problem: PosingProblem, weight: float) -> csr_array:
    added = np.zeros(len(problem.mesh.vertices))
    added[problem.pinned] = weight * problem.mesh.vertex_masses[problem.pinned]
    return csr_array(problem.mass() + diags_array(added))


@pytest.mark.parametrize("weight", [1.0, 1000.0])
def test_handles_count_for_more_than_their_mass(snapshots: Snapshots, weight: float) -> None:
    """The PCA in a mass with heavier handles has the same nested spaces."""
    problem = snapshots.problem
    assert isinstance(problem, PosingProblem)
    subspace = snapshot_pca(snapshots, dimension=6, handle_weight=weight)
    heavy = mass_with_handles(problem, weight)
    expected = pca(snapshots.shapes, problem.tau, heavy, dimension=6).basis
    for d in range(1, 7):
        assert subspace_angles(subspace.basis[:, :d], expected[:, :d]).max() < 1e-6
    gram = mass_gram(problem.mass(), subspace.basis.T, subspace.basis.T)
    np.testing.assert_allclose(gram, np.eye(6), rtol=0, atol=1e-12)


def test_errors_of_reduced_solutions_fall_with_the_dimension() -> None:
    """In few dimensions the PCA in the mass alone misses the handles, which are stiff."""
    mesh = generators.bar(24, 4, 4, length=6.0)
    x = mesh.vertices[:, 0]
    problem = PosingProblem(
        mesh,
        Handles([x < 0.6, x > 5.4]),
        domain=HandleBox(translation=1.0, angle=(np.pi / 2, np.pi / 4, np.pi / 4)),
        material=StableNeoHookean(),
    )
    solved = solve_snapshots(problem, sample(problem.domain, 80, seed=0))
    training, unseen = solved.select(np.arange(80) < 64), solved.select(np.arange(80) >= 64)

    def medians(weight: float) -> list[float]:
        subspace = snapshot_pca(training, dimension=40, handle_weight=weight)
        model = reduce(problem, subspace, snapshots=training)
        return [
            float(np.median(unseen_errors(model.leading(d), unseen))) for d in (5, 10, 20, 30, 40)
        ]

    heavy, plain = medians(1000.0), medians(0.0)
    assert all(later < earlier for earlier, later in pairwise(heavy))
    assert heavy[1] < 0.75 * plain[1], "at d = 10"
    assert heavy[-1] < 1.15 * plain[-1], "at d = 40"


@pytest.mark.parametrize("weight", [0.0, 1000.0])
def test_energies_beyond_a_dimension_sum_to_its_squared_error(
    snapshots: Snapshots, weight: float
) -> None:
    subspace = snapshot_pca(snapshots, dimension=6, handle_weight=weight)
    displacements = snapshots.shapes - subspace.tau
    for d in range(1, 7):
        smaller = subspace.leading(d)
        left = displacements - smaller.coordinates(snapshots.shapes) @ smaller.basis.T
        expected = mass_gram(subspace.mass, left, left).trace()
        energies = smaller.snapshot_energies
        assert energies is not None
        assert energies[d:].sum() == pytest.approx(expected, rel=1e-6)


def test_blends_have_no_handles() -> None:
    poses = bar_poses(irregular_bar(4, 2, 2))
    problem = InterpolationProblem(poses, mean_shape=poses.shapes[0])
    snapshots = solve_snapshots(problem, sample(problem.domain, 6, seed=0), threads=1)
    heavy, plain = (snapshot_pca(snapshots, dimension=4, handle_weight=w) for w in (1000.0, 0.0))
    np.testing.assert_array_equal(heavy.basis, plain.basis)


@pytest.mark.parametrize("weight", [-1.0, np.nan, np.inf])
def test_a_bad_weight_is_refused(snapshots: Snapshots, weight: float) -> None:
    with pytest.raises(ValueError, match=r"handle_weight is .*, but must be finite and not neg"):
        snapshot_pca(snapshots, dimension=2, handle_weight=weight)
