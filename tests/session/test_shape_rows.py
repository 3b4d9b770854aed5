"""Vertices for the screen agree with those in double precision up to single precision."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from snapspace import PosingModel
from snapspace import _core as core

#: Number of modes in single precision, and of coordinates that share a unit in the other modes.
FINE, BLOCK = 16, 2048


def parts(size: int, dimension: int, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    scales = 10.0 ** rng.uniform(-3, 3, size=dimension)
    modes = rng.normal(size=(dimension, size)) * scales[:, None]
    return 1e3 * rng.normal(size=size), modes, rng.normal(size=dimension) / scales


@given(st.integers(1, 5000), st.integers(1, 90), st.integers(0, 2**32 - 1))
def test_each_coordinate_keeps_the_bound(size: int, dimension: int, seed: int) -> None:
    tau, modes, q = parts(size, dimension, seed)
    shape = core.ShapeRows(tau, modes).shape(q)
    most = (dimension + 4) * 2.0**-24 * (np.abs(q) @ np.abs(modes))
    for begin in range(0, size, BLOCK):
        units = np.abs(modes[FINE:, begin : begin + BLOCK]).max(axis=1) / 32767
        most[begin : begin + BLOCK] += 0.5001 * np.abs(q[FINE:]) @ units
    exact = tau + q @ modes
    rounding = 2.0**-23 * np.abs(exact)  # the rounding of the shape itself
    assert (np.abs(shape - exact) <= most + rounding + 1e-30).all()


def test_threads_change_nothing() -> None:
    tau, modes, q = parts(30_011, 41, 1)
    rows = core.ShapeRows(tau, modes)
    one = rows.shape(q, threads=1)
    for threads in (0, 2, 5):
        np.testing.assert_array_equal(rows.shape(q, threads=threads), one)


def test_modes_of_zero_and_almost_zero_add_nothing() -> None:
    tau, modes, q = parts(3000, 30, 4)
    modes[20], modes[21] = 0.0, 1e-60
    exact = core.ShapeRows(tau, np.delete(modes, [20, 21], axis=0)).shape(np.delete(q, [20, 21]))
    np.testing.assert_allclose(core.ShapeRows(tau, modes).shape(q), exact, rtol=1e-5)


@pytest.mark.parametrize("count", [0, 1, 3, 4, 6, 16, 17, 85])
def test_the_first_coordinates_are_a_shape_of_fewer_modes(count: int) -> None:
    tau, modes, q = parts(5000, 90, 2)
    few = core.ShapeRows(tau, modes[:count]) if count else None
    shape = core.ShapeRows(tau, modes).shape(q[:count])
    np.testing.assert_array_equal(shape, np.float32(tau) if few is None else few.shape(q[:count]))


def test_arrays_that_do_not_match_are_refused() -> None:
    tau, modes, q = parts(12, 3, 3)
    with pytest.raises(ValueError, match=r"tau \(3n,\) and modes \(d, 3n\) do not match"):
        core.ShapeRows(tau[:-1], modes)
    with pytest.raises(ValueError, match="q must have an entry for each mode"):
        core.ShapeRows(tau, modes).shape(np.append(q, 1.0))


def test_a_session_shows_the_shape_of_its_coordinates(posing_model: PosingModel) -> None:
    session = posing_model.session()
    session.pose(0.7 * posing_model.problem.domain.half_widths)
    exact = posing_model.subspace.shape(session.q).reshape(-1, 3)
    rest = posing_model.problem.mesh.vertices
    assert session.positions.dtype == np.float32 and session.positions.shape == rest.shape
    bound = 2e-5 * np.abs(exact - rest).max() + 2.0**-23 * np.abs(exact).max()
    assert np.abs(session.positions - exact).max() < bound
    session.dimension = 3
    session.solve()
    assert np.abs(session.positions - session.vertices).max() < bound
    session.reset()
    np.testing.assert_array_equal(session.positions, rest.astype(np.float32))
