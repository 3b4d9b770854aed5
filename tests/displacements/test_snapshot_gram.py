"""Inner products of snapshots: exact, independent of how they are gathered, enough for errors."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.sparse import csr_array
from threadpoolctl import threadpool_limits

from snapspace import SnapshotGram, pca
from snapspace.displacements import BLOCK
from snapspace.generators import bar
from snapspace.mesh import mass_gram, mass_matrix, mass_norms

from ..shapes import interpolation_problem, irregular_bar
from ..snapshots.samples import displacements

FloatArray = NDArray[np.float64]
MESH = irregular_bar(4, 2, 2)
SIZE = MESH.vertices.size
MASSES = {"consistent": mass_matrix(MESH), "lumped": mass_matrix(MESH, lumped=True)}
LARGE = bar(16, 8, 8)


def gram(mass: csr_array, rows: FloatArray, splits: list[int] | None = None) -> SnapshotGram:
    """The products of rows (k, 3n), added in pieces that end at the splits."""
    result = SnapshotGram(mass)
    for begin, end in pairwise([0, *(splits or []), len(rows)]):
        result.add(rows[begin:end])
    return result


def decaying(count: int, rank: int, *, seed: int = 0) -> FloatArray:
    """Rows (count, 3n) in a space of dimension `rank`, with sizes over three decades."""
    rng = np.random.default_rng(seed)
    weights = rng.normal(size=(count, rank)) * 10.0 ** -np.linspace(0, 3, rank)
    rows: FloatArray = weights @ np.random.default_rng(99).normal(size=(rank, SIZE))
    return rows


def direct_errors(mass: csr_array, known: FloatArray, new: FloatArray, d: int) -> FloatArray:
    """The same errors from shapes, with the basis and differences of vectors."""
    basis = pca(known, np.zeros(SIZE), mass, dimension=d).basis
    left = new - mass_gram(mass, new, basis.T) @ basis.T
    return mass_norms(mass, left) / mass_norms(mass, new)


@pytest.mark.parametrize("mass", MASSES.values(), ids=MASSES)
@pytest.mark.parametrize("count", [1, 15, 16, 17, 50])
def test_is_the_matrix_of_inner_products(mass: csr_array, count: int) -> None:
    rows = displacements(count, SIZE)
    matrix = gram(mass, rows).matrix
    expected = mass_gram(mass, rows, rows)
    np.testing.assert_allclose(matrix, expected, rtol=0, atol=1e-14 * expected.max())
    np.testing.assert_array_equal(matrix, matrix.T)


def test_it_sums_over_several_blocks_of_vertices() -> None:
    mass = mass_matrix(LARGE)
    rows = displacements(5, LARGE.vertices.size)
    assert rows.shape[1] > BLOCK
    expected = mass_gram(mass, rows, rows)
    np.testing.assert_allclose(gram(mass, rows).matrix, expected, rtol=0, atol=1e-13)


@settings(max_examples=40)
@given(data=st.data(), count=st.integers(2, 70))
def test_it_is_bitwise_the_same_however_the_rows_are_split(data: st.DataObject, count: int) -> None:
    """A resumed run finds its samples finished in other pieces."""
    mass, rows = MASSES["consistent"], displacements(count, SIZE)
    splits = sorted(data.draw(st.lists(st.integers(0, count), max_size=6)))
    np.testing.assert_array_equal(gram(mass, rows, splits).matrix, gram(mass, rows).matrix)


def test_it_is_bitwise_the_same_wherever_the_rows_are_and_for_any_threads() -> None:
    mass, rows = mass_matrix(LARGE), displacements(40, LARGE.vertices.size)
    together = gram(mass, rows).matrix
    apart = SnapshotGram(mass)
    with threadpool_limits(limits=2, user_api="blas"):
        apart.add([row.copy() for row in rows])
    np.testing.assert_array_equal(apart.matrix, together)


def test_displacements_count_from_tau() -> None:
    problem = interpolation_problem()
    rows = displacements(6, problem.base.size)
    products = SnapshotGram.of(problem)
    products.add(rows)
    from_tau = rows + problem.base - problem.tau
    np.testing.assert_allclose(products.matrix, mass_gram(problem.mass(), from_tau, from_tau))


def test_a_sample_that_is_not_finite_spoils_no_other() -> None:
    mass, rows = MASSES["consistent"], displacements(20, SIZE)
    clean = gram(mass, rows).matrix
    rows[3, 7], rows[18] = np.nan, 1e308
    matrix = gram(mass, rows).matrix
    good = np.delete(np.arange(20), [3, 18])
    np.testing.assert_array_equal(matrix[np.ix_(good, good)], clean[np.ix_(good, good)])
    assert not np.isfinite(matrix[3, 0])


def test_selected_rows_have_the_products_of_these_rows_and_grow_alone() -> None:
    mass, rows = MASSES["consistent"], displacements(9, SIZE)
    every, which = gram(mass, rows[:7]), np.array([True, False, True, True, False, True, True])
    some = every.select(which)
    some.add(rows[7:])
    again = gram(mass, np.vstack([rows[:7][which], rows[7:]]))
    np.testing.assert_array_equal(some.matrix, again.matrix)
    assert len(every) == 7
    np.testing.assert_array_equal(every.select([4, 1]).matrix, every.matrix[np.ix_([4, 1], [4, 1])])


def test_a_copy_grows_alone() -> None:
    mass, rows = MASSES["lumped"], displacements(8, SIZE)
    first = gram(mass, rows[:5])
    second = first.copy()
    second.add(rows[5:])
    assert (len(first), len(second)) == (5, 8)
    np.testing.assert_array_equal(second.matrix, gram(mass, rows).matrix)
    with pytest.raises(ValueError, match="read-only"):
        first.matrix[0, 0] = 1.0


@pytest.mark.parametrize("mass", MASSES.values(), ids=MASSES)
@pytest.mark.parametrize("dimension", [1, 4, 9])
def test_errors_are_those_of_the_projections(mass: csr_array, dimension: int) -> None:
    rows = decaying(30, 12)
    errors = gram(mass, rows).held_out_error(range(20), range(20, 30), dimension)
    direct = direct_errors(mass, rows[:20], rows[20:], dimension)
    np.testing.assert_allclose(errors, direct, rtol=1e-6, atol=1e-8)
    assert errors.min() > 1e-4


@settings(max_examples=25)
@given(seed=st.integers(0, 1000), count=st.integers(2, 25))
def test_errors_fall_with_every_dimension(seed: int, count: int) -> None:
    """Nested spaces; between 0 and 1; beyond the number of training rows nothing changes."""
    products = gram(MASSES["consistent"], decaying(count + 4, 40, seed=seed))
    errors = np.array(
        [
            products.held_out_error(range(count), range(count, count + 4), dimension)
            for dimension in range(1, count + 3)
        ]
    )
    assert (np.diff(errors**2, axis=0) <= 1e-14).all()
    assert (errors >= 0).all() and (errors <= 1).all()
    np.testing.assert_array_equal(errors[-1], errors[count - 1])


def test_errors_vanish_in_the_span_of_the_training_rows() -> None:
    """This holds for linearly dependent training rows, too: nothing is divided by noise."""
    rows = decaying(40, 6)
    errors = gram(MASSES["consistent"], rows).held_out_error(range(30), range(30, 40), 20)
    np.testing.assert_allclose(errors, 0.0, atol=3e-7)  # roots of what rounding leaves


def test_rows_are_chosen_by_numbers_or_masks_in_any_order() -> None:
    rows = decaying(20, 12)
    products = gram(MASSES["consistent"], rows)
    mask = np.arange(20) % 3 > 0
    errors = products.held_out_error(mask, ~mask, 5)
    numbers = np.flatnonzero(mask)[::-1]
    np.testing.assert_allclose(products.held_out_error(numbers, ~mask, 5), errors, rtol=1e-9)
    np.testing.assert_allclose(errors, direct_errors(products.mass, rows[mask], rows[~mask], 5))


def test_the_reference_shape_itself_has_no_error() -> None:
    rows = np.vstack([decaying(5, 4), np.zeros(SIZE)])
    products = gram(MASSES["consistent"], rows)
    assert products.held_out_error(range(5), [5], 2) == 0.0
    np.testing.assert_array_equal(products.held_out_error([5], [0, 5], 3), [1.0, 0.0])


def test_all_dimensions_at_once_agree_with_single_ones() -> None:
    products = gram(MASSES["consistent"], decaying(30, 6))
    every = products.held_out_errors(range(20), range(20, 30))
    np.testing.assert_array_equal(every[0], 1.0)  # without a direction nothing is represented
    for dimension, errors in enumerate(every[1:], start=1):
        one = products.held_out_error(range(20), range(20, 30), dimension)
        np.testing.assert_array_equal(one, errors)


@pytest.mark.parametrize(
    ("training", "dimension", "message"),
    [(range(3), 0, "dimension is 0"), ([], 2, "there are no training rows")],
)
def test_it_refuses_what_has_no_subspace(training: range, dimension: int, message: str) -> None:
    products = gram(MASSES["consistent"], displacements(5, SIZE))
    with pytest.raises(ValueError, match=f"SnapshotGram: {message}"):
        products.held_out_error(np.array(training, int), [4], dimension)


def test_it_refuses_rows_of_another_mesh() -> None:
    with pytest.raises(ValueError, match=r"row 0 is float64 of shape \(6,\), but must be"):
        SnapshotGram(MASSES["lumped"]).add([np.zeros(6)])
