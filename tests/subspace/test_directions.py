"""affine_subspace: bases that are not from snapshots."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import affine_subspace, reduce
from snapspace.mesh import apply_mass

from ..shapes import interpolation_problem
from ..snapshots.bars import posing_bar

FloatArray = NDArray[np.float64]
PROBLEM = posing_bar()
SIZE = PROBLEM.tau.size


def directions(count: int, *, seed: int = 0) -> FloatArray:
    return np.random.default_rng(seed).normal(size=(SIZE, count))


def products(basis: FloatArray) -> FloatArray:
    return basis.T @ apply_mass(PROBLEM.mass(), basis.T).T


def left(directions: FloatArray, basis: FloatArray) -> float:
    """The largest part of directions outside the span of a basis, relative to the directions."""
    fit = np.linalg.lstsq(basis, directions, rcond=None)[0]
    return float(np.abs(basis @ fit - directions).max() / np.abs(directions).max())


def test_the_basis_is_orthonormal_and_spans_the_directions() -> None:
    given = directions(7) * 10.0 ** np.arange(-9, 12, 3)
    subspace = affine_subspace(given, PROBLEM)
    assert products(subspace.basis) == pytest.approx(np.eye(7), abs=1e-13)
    for k in range(7):
        assert left(given[:, [k]], subspace.basis) < 1e-12
    np.testing.assert_array_equal(subspace.tau, PROBLEM.tau)
    assert subspace.snapshot_energies is None
    assert subspace.energy_fraction is None
    assert subspace.leading(3).dimension == 3


def test_leading_columns_span_leading_directions_and_keep_their_signs() -> None:
    given = directions(5)
    basis = affine_subspace(given, PROBLEM).basis
    for k in range(1, 6):
        assert left(given[:, :k], basis[:, :k]) < 1e-12
    assert (np.diag(basis.T @ apply_mass(PROBLEM.mass(), given.T).T) > 0).all()


def test_nearly_dependent_directions_give_an_orthonormal_basis() -> None:
    """Their Gram matrix is singular to rounding."""
    given = directions(4)
    given[:, 1:] = given[:, :1] + 1e-9 * given[:, 1:]
    basis = affine_subspace(given, PROBLEM).basis
    assert products(basis) == pytest.approx(np.eye(4), abs=1e-12)


def test_directions_that_nearly_depend_on_other_blocks_give_an_orthonormal_basis() -> None:
    """Directions are made orthogonal in blocks: these differ by 1e-9 from others in their own block
    and in an earlier one, and one lies in the span of both blocks."""
    given = directions(75)
    given[:, 40] = given[:, 3] + 1e-9 * given[:, 40]
    given[:, 41] = given[:, 40] + 1e-9 * given[:, 41]
    given[:, 70] = given[:, :69] @ np.ones(69) + 1e-8 * given[:, 70]
    basis = affine_subspace(given, PROBLEM).basis
    assert products(basis) == pytest.approx(np.eye(75), abs=1e-12)
    dependent = np.column_stack([given[:, :50], given[:, 7] + given[:, 45], given[:, 60]])
    assert affine_subspace(dependent, PROBLEM, nested=False).dimension == 51


def test_dependent_directions_are_refused_or_dropped() -> None:
    given = np.column_stack([directions(3), np.zeros(SIZE), directions(1, seed=5)])
    given = np.insert(given, 2, given[:, 0] - 2 * given[:, 1], axis=1)
    with pytest.raises(ValueError, match=r"direction 2 is zero or depends .* nested=False"):
        affine_subspace(given, PROBLEM)
    subspace = affine_subspace(given, PROBLEM, nested=False)
    assert subspace.dimension == 4
    assert left(given, subspace.basis) < 1e-12
    loose = affine_subspace(directions(4), PROBLEM, nested=False, rtol=0.999)
    assert 1 <= loose.dimension < 4


def test_a_model_can_be_reduced_to_any_basis() -> None:
    """Its energy is the exact energy at tau + U q for any U."""
    subspace = affine_subspace(directions(5), PROBLEM)
    model = reduce(PROBLEM, subspace, threads=1)
    q = 0.1 * np.random.default_rng(3).normal(size=5)
    assert model.elastic.value(q) == pytest.approx(PROBLEM.energy.value(subspace.shape(q)))


def test_the_subspace_of_poses_contains_the_mean_shape() -> None:
    problem = interpolation_problem()
    subspace = affine_subspace(np.random.default_rng(1).normal(size=(problem.tau.size, 3)), problem)
    np.testing.assert_array_equal(subspace.tau, problem.tau)
    mass = problem.mass()
    gram = subspace.basis.T @ apply_mass(mass, subspace.basis.T).T
    assert gram == pytest.approx(np.eye(3), abs=1e-13)


def test_bad_input_is_named() -> None:
    good = directions(2)
    for shape in ((SIZE,), (SIZE, 0), (SIZE - 3, 2), (2, SIZE)):
        with pytest.raises(ValueError, match=rf"have shape .* but must be \({SIZE}, k\)"):
            affine_subspace(np.ones(shape), PROBLEM)
    with pytest.raises(ValueError, match="directions must be numbers"):
        affine_subspace([["a"]], PROBLEM)
    bad = good.copy()
    bad[5, 1] = np.nan
    with pytest.raises(ValueError, match="direction 1 is not finite"):
        affine_subspace(bad, PROBLEM)
    for rtol in (0.0, 1.0, np.nan):
        with pytest.raises(ValueError, match=r"rtol is .* must be between 0 and 1"):
            affine_subspace(good, PROBLEM, rtol=rtol)
    with pytest.raises(ValueError, match="all directions are zero"):
        affine_subspace(np.zeros((SIZE, 2)), PROBLEM, nested=False)
