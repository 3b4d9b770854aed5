"""The product of a sparse matrix with points, against SciPy's."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import identity, kron, random_array

from snapspace import _core as core


@pytest.mark.parametrize("seed", range(4))
def test_it_is_the_kronecker_product(seed: int) -> None:
    random = np.random.default_rng(seed)
    matrix = random_array((30, 30), density=0.2, format="csr", rng=random)
    points = random.standard_normal(90)
    product = core.point_product(
        matrix.indptr.astype(np.int32), matrix.indices.astype(np.int32), matrix.data, points
    )
    np.testing.assert_allclose(product, kron(matrix, identity(3)) @ points, atol=1e-14)


def test_rows_without_entries_give_zero() -> None:
    starts, columns = np.array([0, 0, 1, 1], np.int32), np.array([2], np.int32)
    product = core.point_product(starts, columns, np.array([2.0]), np.arange(9.0))
    np.testing.assert_array_equal(product, [0, 0, 0, 12, 14, 16, 0, 0, 0])


@pytest.mark.parametrize(
    ("starts", "columns", "points", "message"),
    [
        ([0, 1], [1], 3, "a column is out of range"),
        ([0, 1], [-1], 3, "a column is out of range"),
        ([0, 2], [0], 3, "starts reach beyond the entries"),
        ([0, -1], [0], 3, "starts reach beyond the entries"),
        ([1, 1], [0], 3, "from 0"),
        ([0, 1], [0], 4, r"needs a \(3n,\) vector"),
    ],
)
def test_nothing_is_read_beyond_an_array(
    starts: list[int], columns: list[int], points: int, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        core.point_product(
            np.array(starts, np.int32), np.array(columns, np.int32), np.ones(1), np.zeros(points)
        )
