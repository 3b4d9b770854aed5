"""Products and combinations of rows of displacements, compared with SciPy and NumPy."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse import csr_array, identity, kron

from snapspace import _core as core
from snapspace.displacements import DisplacementRows

FloatArray = NDArray[np.float64]
POINTS = 150  # vertices: a block and a part of one
RANDOM = np.random.default_rng(0)
MASS = csr_array(RANDOM.random((POINTS, POINTS)) * (RANDOM.random((POINTS, POINTS)) < 0.1))
ROWS = RANDOM.standard_normal((45, 3 * POINTS))


def mass_products(matrix: csr_array) -> core.MassProducts:
    starts, columns = matrix.indptr.astype(np.int32), matrix.indices.astype(np.int32)
    return core.MassProducts(starts, columns, matrix.data)


def products(rows: FloatArray, others: FloatArray, *, threads: int = 1) -> FloatArray:
    return mass_products(MASS).multiply(list(rows), None, list(others), threads=threads)


@pytest.mark.parametrize(("count", "others"), [(1, 1), (4, 3), (5, 9), (45, 17), (0, 3), (3, 0)])
def test_products_have_the_matrix_in_between(count: int, others: int) -> None:
    rows, offset = ROWS[:count], ROWS[-1]
    left, right = DisplacementRows(rows, ROWS.shape[1]).shifted(offset), ROWS[10 : 10 + others]
    result = left.mass_products(mass_products(MASS), DisplacementRows(right, ROWS.shape[1]))
    expected = (rows + offset) @ kron(MASS, identity(3)) @ right.T
    np.testing.assert_allclose(result, expected.reshape(count, others), rtol=0, atol=1e-11)


def test_products_are_bitwise_the_same_with_any_others_and_threads() -> None:
    every = products(ROWS, ROWS)
    np.testing.assert_array_equal(products(ROWS, ROWS, threads=3), every)
    np.testing.assert_array_equal(products(ROWS[7:9], ROWS[40:41]), every[7:9, 40:41])
    mass = mass_products(MASS)  # its memory is reused, also for fewer others
    for count in (45, 20, 19, 45):
        again = mass.multiply(list(ROWS), None, list(ROWS[:count]), threads=2)
        np.testing.assert_array_equal(again, every[:, :count])


def test_rows_of_the_matrix_without_entries_give_zero() -> None:
    matrix = csr_array((np.array([2.0]), np.array([2]), np.array([0, 0, 1, 1])), shape=(3, 3))
    units, row = np.eye(9), np.arange(9.0)
    weighted = mass_products(matrix).multiply(list(units), None, [row], threads=1)
    np.testing.assert_array_equal(weighted[:, 0], [0, 0, 0, 12, 14, 16, 0, 0, 0])


@pytest.mark.parametrize("size", [1, 31, 128, 450])
@pytest.mark.parametrize("count", [0, 1, 7])
def test_combinations_are_products_with_the_weights(size: int, count: int) -> None:
    weights = RANDOM.standard_normal((5, count))
    weights[2] = 0.0
    rows = DisplacementRows(list(ROWS[:count, :size].copy()), size)
    np.testing.assert_allclose(rows.combined(weights), weights @ ROWS[:count, :size], atol=1e-13)
    shifted = rows.shifted(ROWS[44, :size].copy()).combined(weights)
    expected = weights @ (ROWS[:count, :size] + ROWS[44, :size])
    np.testing.assert_allclose(shifted, expected, atol=1e-13)


def test_a_combination_depends_on_no_other_and_on_no_row_without_weight() -> None:
    weights = RANDOM.standard_normal((6, 45)) * (RANDOM.random((6, 45)) < 0.5)
    rows = DisplacementRows(ROWS, ROWS.shape[1])
    every = rows.combined(weights)
    used = weights[3] != 0.0
    alone = rows.select(used).combined(weights[3:4, used])
    np.testing.assert_array_equal(alone[0], every[3])
    spoiled = ROWS.copy()
    spoiled[~used] = np.nan
    clean = DisplacementRows(spoiled, ROWS.shape[1]).combined(weights[3:4])
    np.testing.assert_array_equal(clean[0], every[3])


def test_combinations_are_bitwise_the_same_for_any_threads() -> None:
    """The rows are long enough for several parts."""
    rows = DisplacementRows(RANDOM.standard_normal((9, 5000)), 5000)
    weights = RANDOM.standard_normal((6, 9))
    alone = rows.combined(weights, threads=1)
    np.testing.assert_array_equal(rows.combined(weights, threads=3), alone)


@pytest.mark.parametrize(
    ("starts", "columns", "message"),
    [
        ([0, 1], [1], "a column is out of range"),
        ([0, 1], [-1], "a column is out of range"),
        ([0, 2], [0], "starts reach beyond the entries"),
        ([0, -1], [0], "starts must not decrease"),
        ([1, 1], [0], "from 0"),
        ([0, 1], [0, 0], "one value per column"),
    ],
)
def test_arrays_that_are_not_a_matrix_are_refused(
    starts: list[int], columns: list[int], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        core.MassProducts(np.array(starts, np.int32), np.array(columns, np.int32), np.ones(1))


def test_nothing_is_read_beyond_an_array() -> None:
    short, row = np.zeros(447), np.zeros(450)
    for rows, offset, others in (
        ([short], None, [row]),
        ([row], short, [row]),
        ([row], None, [short]),
    ):
        with pytest.raises(ValueError, match=r"same length|must be \(3n,\)"):
            mass_products(MASS).multiply(rows, offset, others, threads=1)
    with pytest.raises(ValueError, match="same length"):
        core.combine_rows([row, short], 450, np.ones((1, 2)), threads=1)
    with pytest.raises(ValueError, match="one column of weights per row"):
        core.combine_rows([row], 450, np.ones((1, 2)), threads=1)
