"""The multigrid cycle: symmetric, positive, and near the inverse for any number of elements."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from numpy.typing import NDArray
from scipy import sparse
from scipy.linalg import eigh

from snapspace import _core as core
from snapspace.generators import bar, creature

from ..cholesky.matrices import MATRICES, by_columns, mesh_matrix, random_matrices
from .laplacian import laplacian

FloatArray = NDArray[np.float64]
LANES = {"apply_lanes": core.lane_count, "apply_single_lanes": 2 * core.lane_count}
#: The cycle's matrices are in single precision.
ROUNDING = 1e-5


body = cache(creature)


def dense_cycle(A: Any) -> FloatArray:
    """The cycle's matrix, column by column, as it acts on y."""
    cycle, n = core.TwoGridCycle(*by_columns(A)), A.shape[0]
    columns = []
    for j in range(n):
        unit = np.zeros((1, 3 * n))
        unit[0, 3 * j + 1] = 1.0
        columns.append(cycle.apply(unit)[0, 1::3])
    return np.array(columns).T


def assert_is_a_preconditioner(A: Any) -> None:
    """The cycle is symmetric, and the eigenvalues of cycle * A are in (0, 1]. The error of a
    solution shrinks in the norm of A, as it must for symmetric cycles with exact coarse solves."""
    M = dense_cycle(A)
    assert np.abs(M - M.T).max() <= ROUNDING * np.abs(M).max()
    dense = sparse.csc_array(A).toarray()
    eigenvalues = eigh(0.5 * (M + M.T), np.linalg.inv(dense), eigvals_only=True)
    assert 0.0 < eigenvalues[0] and eigenvalues[-1] <= 1.0 + ROUNDING * np.linalg.cond(dense)


@pytest.mark.parametrize("name", sorted(set(MATRICES) - {"creature"}))
def test_cycles_are_preconditioners(name: str) -> None:
    assert_is_a_preconditioner(MATRICES[name])


@settings(max_examples=100)
@given(random_matrices())
def test_cycles_of_random_matrices_are_preconditioners(A: Any) -> None:
    assert_is_a_preconditioner(A)


@pytest.mark.parametrize("name", ["one vertex", "diagonal"])
def test_without_neighbours_a_cycle_is_the_inverse(name: str) -> None:
    A = MATRICES[name]
    expected = np.diag(1.0 / A.diagonal())
    np.testing.assert_allclose(dense_cycle(A), expected, rtol=ROUNDING, atol=0)


@pytest.mark.parametrize("tets", [6_000, 12_000, 36_000])
def test_nearness_does_not_depend_on_the_number_of_elements(tets: int) -> None:
    """The purpose of a cycle: the shape of the elements alone bounds the eigenvalues from below."""
    A = laplacian(body(tets))
    cycle = core.TwoGridCycle(*by_columns(A))
    assert 0.3 < cycle.lowest_eigenvalue(*by_columns(A)) < 0.6
    assert A.shape[0] / 25 < cycle.coarse_size < A.shape[0] / 10


def test_flat_elements_make_the_cycle_worse() -> None:
    """Neighbours in thin layers are not alike; the choice of the inverse depends on that."""
    lowest, mesh = [], body(12_000)
    for flat in (1.0, 0.1, 0.02):
        A = laplacian(mesh, scale=(1.0, 1.0, flat))
        lowest.append(core.TwoGridCycle(*by_columns(A)).lowest_eigenvalue(*by_columns(A)))
    assert lowest[0] > 2 * lowest[1] > 4 * lowest[2] > 0


def test_the_lowest_eigenvalue_is_nearly_that_of_the_dense_matrices() -> None:
    A = mesh_matrix(bar(8, 4, 4))
    M = dense_cycle(A)
    dense = sparse.csc_array(A).toarray()
    exact = eigh(0.5 * (M + M.T), np.linalg.inv(dense), eigvals_only=True)[0]
    found = core.TwoGridCycle(*by_columns(A)).lowest_eigenvalue(*by_columns(A))
    assert exact * (1 - 1e-4) <= found <= 1.1 * exact


@pytest.mark.parametrize(
    ("method", "tolerance"), [("apply_lanes", 1e-12), ("apply_single_lanes", 2e-5)]
)
@pytest.mark.parametrize("name", MATRICES)
def test_lanes_agree_with_one_number(name: str, method: str, tolerance: float) -> None:
    cycle = core.TwoGridCycle(*by_columns(MATRICES[name]))
    b = np.random.default_rng(5).normal(size=(LANES[method], 3 * MATRICES[name].shape[0]))
    x = getattr(cycle, method)(b)
    one = np.concatenate([cycle.apply(row[None]) for row in b])
    np.testing.assert_allclose(x, one, rtol=0, atol=tolerance * np.abs(one).max())


@pytest.mark.parametrize("method", LANES)
def test_a_lane_does_not_see_its_neighbours(method: str) -> None:
    A = MATRICES["creature"]
    cycle = core.TwoGridCycle(*by_columns(A))
    b = np.random.default_rng(5).normal(size=(LANES[method], 3 * A.shape[0]))
    x = getattr(cycle, method)(b)
    np.testing.assert_array_equal(
        getattr(cycle, method)(np.roll(b, 1, axis=0)), np.roll(x, 1, axis=0)
    )
    b[0] = np.nan
    np.testing.assert_array_equal(getattr(cycle, method)(b)[1:], x[1:])


def test_coordinates_are_treated_alike() -> None:
    A = MATRICES["creature"]
    cycle = core.TwoGridCycle(*by_columns(A))
    b = np.random.default_rng(5).normal(size=(core.lane_count, A.shape[0], 3))
    x = cycle.apply_lanes(b.reshape(len(b), -1)).reshape(b.shape)
    turned = b[:, :, [1, 2, 0]].reshape(len(b), -1)
    np.testing.assert_array_equal(cycle.apply_lanes(turned).reshape(b.shape), x[:, :, [1, 2, 0]])


def test_a_singular_matrix_is_refused() -> None:
    """One of two components is free to move, which the coarse grid detects."""
    free = sparse.csc_array([[1.0, -1.0], [-1.0, 1.0]])
    A = sparse.block_diag([MATRICES["bar"], free])
    with pytest.raises(ValueError, match="not positive definite"):
        core.TwoGridCycle(*by_columns(A))
