"""Orders of elimination: all vertices once, little fill, and the same each time."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from snapspace import _core as core
from snapspace.generators import bar

from .matrices import MATRICES, IndexArray, by_columns, mesh_matrix, random_matrices

ORDERINGS = [core.minimum_degree, core.nested_dissection]


def fill(A: Any, order: IndexArray) -> int:
    """Entries of the factor, zeros of supernodes included."""
    return core.ScalarFactor.in_order(*by_columns(A), order).nonzeros


def assert_every_vertex_once(order: IndexArray, A: Any) -> None:
    np.testing.assert_array_equal(np.sort(order), np.arange(A.shape[0]))


@pytest.mark.parametrize("ordering", ORDERINGS)
@pytest.mark.parametrize("name", MATRICES)
def test_every_vertex_comes_once(name: str, ordering: Any) -> None:
    starts, rows, _ = by_columns(MATRICES[name])
    order = ordering(starts, rows)
    assert_every_vertex_once(order, MATRICES[name])
    np.testing.assert_array_equal(ordering(starts, rows), order)


@settings(max_examples=50)
@given(random_matrices())
def test_random_graphs_are_ordered(A: Any) -> None:
    for ordering in ORDERINGS:
        assert_every_vertex_once(ordering(*by_columns(A)[:2]), A)


@pytest.mark.parametrize("n", [300, 500])
def test_graphs_without_separators_are_ordered(n: int) -> None:
    """Larger than the parts left to minimum degree: complete graphs, stars, no edges at all."""
    hub = np.eye(n)
    hub[0, :] = hub[:, 0] = 1.0
    for A in (np.ones((n, n)), hub, np.eye(n)):
        assert_every_vertex_once(core.nested_dissection(*by_columns(A)[:2]), A)


def test_dissection_fills_less_in_solid_bodies() -> None:
    """A cube of m^3 vertices has at least a constant times m^4 entries, in any order [George 1973];
    minimum degree needs half as many again as dissection.
    """
    A = mesh_matrix(bar(23, 23, 23))
    starts, rows, _ = by_columns(A)
    by_degree = fill(A, core.minimum_degree(starts, rows))
    by_dissection = fill(A, core.nested_dissection(starts, rows))
    assert by_dissection < 0.8 * by_degree
    assert core.ScalarFactor(*by_columns(A)).nonzeros == by_dissection


def test_minimum_degree_fills_less_in_thin_bodies() -> None:
    A = mesh_matrix(bar(120, 2, 2))
    starts, rows, _ = by_columns(A)
    by_degree = fill(A, core.minimum_degree(starts, rows))
    assert by_degree < fill(A, core.nested_dissection(starts, rows))
    assert core.ScalarFactor(*by_columns(A)).nonzeros == by_degree


def test_the_order_decides_the_fill() -> None:
    A = MATRICES["star"]
    n = A.shape[0]
    last = np.arange(n, dtype=np.int32)[::-1].copy()  # the centre is vertex 0
    assert fill(A, last) < n * (n + 1) / 4
    assert fill(A, np.arange(n, dtype=np.int32)) == n * (n + 1) / 2


@pytest.mark.parametrize("order", [[0, 1], [0, 0, 1], [1, 2, 3], [0, 1, 2, 3]])
def test_an_order_must_be_a_permutation(order: list[int]) -> None:
    columns = by_columns(np.eye(3))
    with pytest.raises(ValueError, match="every vertex once"):
        core.ScalarFactor.in_order(*columns, np.array(order, np.int32))
