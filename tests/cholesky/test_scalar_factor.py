"""The Cholesky factor of scalar matrices: compared with SciPy, in any order, in all lanes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import spsolve

from snapspace import _core as core
from snapspace.generators import bar
from snapspace.problem import HandleBox, Handles, PosingProblem

from ..snapshots.creatures import creature
from .matrices import MATRICES, by_columns, mesh_matrix, random_matrices

FloatArray = NDArray[np.float64]
LANES = {"solve_lanes": core.lane_count, "solve_single_lanes": 2 * core.lane_count}


def right_hand_sides(A: Any, count: int = 1) -> FloatArray:
    return np.random.default_rng(5).normal(size=(count, 3 * A.shape[0]))


def assert_solves(A: Any, b: FloatArray, x: FloatArray) -> None:
    """The residual is rounding, and the solution is SciPy's."""
    A = sparse.csc_matrix(A)
    residual = A @ x.reshape(-1, 3) - b.reshape(-1, 3)
    scale = np.abs(A).sum(axis=0).max() * np.abs(x).max() + np.abs(b).max()
    assert np.abs(residual).max() <= 1e-14 * np.sqrt(A.shape[0]) * scale
    oracle = spsolve(A, b.reshape(-1, 3)).reshape(-1)
    np.testing.assert_allclose(x.reshape(-1), oracle, rtol=0, atol=1e-11 * np.abs(oracle).max())


@pytest.mark.parametrize("name", MATRICES)
def test_solutions_are_those_of_scipy(name: str) -> None:
    A, b = MATRICES[name], right_hand_sides(MATRICES[name])
    assert_solves(A, b, core.ScalarFactor(*by_columns(A)).solve(b))


@settings(max_examples=100)
@given(random_matrices(), st.randoms(use_true_random=False))
def test_random_matrices_are_solved_in_any_order(A: Any, random: Any) -> None:
    """A bad order fills the factor but does not change the solution."""
    b = right_hand_sides(A)
    order = list(range(A.shape[0]))
    random.shuffle(order)
    columns = by_columns(A)
    assert_solves(A, b, core.ScalarFactor(*columns).solve(b))
    given_order = core.ScalarFactor.in_order(*columns, np.array(order, np.int32))
    assert_solves(A, b, given_order.solve(b))


def test_wide_supernodes_are_solved() -> None:
    """A solid block by dissection: supernodes of hundreds of columns."""
    A = mesh_matrix(bar(16, 16, 16))
    columns = by_columns(A)
    order = core.nested_dissection(*columns[:2])
    b = right_hand_sides(A)
    assert_solves(A, b, core.ScalarFactor.in_order(*columns, order).solve(b))


@pytest.mark.parametrize(
    ("method", "tolerance"), [("solve_lanes", 1e-12), ("solve_single_lanes", 2e-5)]
)
@pytest.mark.parametrize("name", MATRICES)
def test_lanes_agree_with_one_number(name: str, method: str, tolerance: float) -> None:
    factor = core.ScalarFactor(*by_columns(MATRICES[name]))
    b = right_hand_sides(MATRICES[name], LANES[method])
    x = getattr(factor, method)(b)
    one = np.concatenate([factor.solve(row[None]) for row in b])
    np.testing.assert_allclose(x, one, rtol=0, atol=tolerance * np.abs(one).max())


@pytest.mark.parametrize("method", LANES)
def test_a_lane_does_not_see_its_neighbours(method: str) -> None:
    """This holds even for a neighbour that contains NaN."""
    factor = core.ScalarFactor(*by_columns(MATRICES["creature"]))
    b = right_hand_sides(MATRICES["creature"], LANES[method])
    x = getattr(factor, method)(b)
    turned = np.roll(b, 1, axis=0)
    np.testing.assert_array_equal(getattr(factor, method)(turned), np.roll(x, 1, axis=0))
    b[0] = np.nan
    np.testing.assert_array_equal(getattr(factor, method)(b)[1:], x[1:])


def test_coordinates_are_solved_alike() -> None:
    A = MATRICES["creature"]
    factor, b = core.ScalarFactor(*by_columns(A)), right_hand_sides(A, core.lane_count)
    turned = b.reshape(len(b), -1, 3)[:, :, [1, 2, 0]]
    for method in ("solve_lanes", "solve_single_lanes"):
        x = getattr(factor, method)(b).reshape(turned.shape)[:, :, [1, 2, 0]]
        y = getattr(factor, method)(turned.reshape(b.shape))
        np.testing.assert_array_equal(y.reshape(x.shape), x)


def test_factors_are_reproducible() -> None:
    columns, b = by_columns(MATRICES["creature"]), right_hand_sides(MATRICES["creature"])
    first, second = core.ScalarFactor(*columns), core.ScalarFactor(*columns)
    np.testing.assert_array_equal(first.solve(b), second.solve(b))


@pytest.mark.parametrize("stiffness", [1e-3, 1.0, 1e6])
def test_stiff_handles_are_solved(stiffness: float) -> None:
    """All handles ask for the same translation, and at rest only they pull.

    A step with the problem's scalar matrix is then this translation of all vertices.
    """
    mesh = creature(5000)
    z = mesh.vertices[:, 2]
    handles = Handles([z < np.quantile(z, 0.1), z > np.quantile(z, 0.9)])
    domain = HandleBox(translation=1.0, angle=1.0)
    system = PosingProblem(mesh, handles, domain=domain, stiffness=stiffness).system
    n, translation = len(mesh.vertices), np.array([0.3, -0.2, 0.1])
    targets = np.tile(translation, system.input_size // 3)
    _, gradient = system.value_and_gradient(np.zeros(3 * n), targets)
    step = -system.precondition(gradient)
    np.testing.assert_allclose(step, np.tile(translation, n), rtol=0, atol=1e-8)


NOT_DEFINITE = {
    "zero": sparse.csc_array(np.zeros((1, 1))),
    "indefinite": sparse.csc_array([[1.0, 2.0], [2.0, 1.0]]),
    "negative": -MATRICES["bar"],
    "one component without a handle": sparse.block_diag(
        [MATRICES["bar"], sparse.csc_array([[1.0, -1.0], [-1.0, 1.0]])]
    ),
    "no diagonal": sparse.csc_array([[0.0, 1.0], [1.0, 0.0]]),
    "not a number": sparse.csc_array([[np.nan]]),
    "a wide supernode": sparse.csc_array(np.ones((30, 30)) - 0.5 * np.eye(30)),
}


@pytest.mark.parametrize("name", NOT_DEFINITE)
def test_matrices_that_are_not_positive_definite_are_refused(name: str) -> None:
    A = NOT_DEFINITE[name]
    with pytest.raises(ValueError, match=f"size {A.shape[0]} is not positive definite"):
        core.ScalarFactor(*by_columns(A))
