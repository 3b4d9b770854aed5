"""Rows of local coordinates: the same energy as that of their products, derivatives, bad input."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import Cubature, InterpolationModel
from snapspace.cubature import BlendedCubature, LocalRows

from ..clustered import TETS, local_rows
from .test_cubature import assert_derivatives, cubature

FloatArray = NDArray[np.float64]


def clustered(dimension: int, tets: int, rank: int) -> Cubature:
    """Some tets in clusters of 24."""
    dense = cubature(dimension, tets)
    return dense.in_clusters(np.arange(tets), local_rows(dense.rows, rank))


def dense_of(local: Cubature) -> Cubature:
    """The energy of the products of a cubature's rows."""
    return Cubature(local.tets, local.weights, local.rows, local.material)


@pytest.mark.parametrize(("dimension", "tets", "rank"), [(12, 60, 7), (9, 24, 4), (17, 50, 2)])
def test_the_energy_is_that_of_the_products(dimension: int, tets: int, rank: int) -> None:
    local = clustered(dimension, tets, rank)
    dense = dense_of(local)
    assert isinstance(local.stored_rows, LocalRows)
    q = 0.3 * np.random.default_rng(1).normal(size=dimension)
    for found, expected in (
        *zip(local.value_and_gradient(q), dense.value_and_gradient(q), strict=True),
        (local.hessian(q), dense.hessian(q)),
        (local.rough_hessian(q), dense.rough_hessian(q)),
        (local.stresses(q), dense.stresses(q)),
        (local.curvatures(q), dense.curvatures(q)),
    ):
        assert found == pytest.approx(expected, rel=1e-5, abs=3e-6 * float(np.abs(expected).max()))


def test_blends_have_the_energy_of_the_products(
    blended_cubature_model: InterpolationModel,
) -> None:
    dense = blended_cubature_model.blends
    assert isinstance(dense, BlendedCubature)
    rows = local_rows(dense.rows, 6)
    local = dense.in_clusters(np.arange(len(dense.tets)), rows)
    products = BlendedCubature(
        dense.tets, dense.weights, rows.products, dense.material, dense.corners
    )
    weights = np.array([0.2, 0.5, 0.3])
    q = 0.1 * np.random.default_rng(2).normal(size=dense.dimension)
    for found, expected in (
        *zip(
            local.value_and_gradient(q, weights),
            products.value_and_gradient(q, weights),
            strict=True,
        ),
        (local.hessian(q, weights), products.hessian(q, weights)),
        (local.stresses(q, weights), products.stresses(q, weights)),
    ):
        assert found == pytest.approx(expected, rel=1e-5, abs=3e-6 * float(np.abs(expected).max()))


def test_all_local_coordinates_leave_nothing_out() -> None:
    dense = cubature(10, 60)
    local = dense.in_clusters(np.arange(60), local_rows(dense.rows, 11))
    scale = np.abs(dense.rows).max()
    np.testing.assert_allclose(local.rows, dense.rows, atol=1e-6 * scale)


@pytest.mark.parametrize(("dimension", "tets", "rank"), [(12, 60, 7), (11, 33, 3)])
def test_taylor(dimension: int, tets: int, rank: int) -> None:
    assert_derivatives(clustered(dimension, tets, rank), seed=3)


def test_rest_has_no_energy_and_no_force() -> None:
    value, gradient = clustered(12, 60, 5).value_and_gradient(np.zeros(12))
    assert value == 0
    np.testing.assert_array_equal(gradient, np.zeros(12))


@pytest.mark.parametrize("leading", [12, 9, 1])
def test_leading_coordinates_are_products_where_these_are_fewer(leading: int) -> None:
    elastic = clustered(13, 48, 4)
    fewer = elastic.leading(leading)
    np.testing.assert_allclose(fewer.rows, elastic.rows[:, :, :leading], atol=1e-6)
    assert isinstance(fewer.stored_rows, LocalRows) == (leading > 4)


def test_pickles_keep_the_clusters() -> None:
    elastic = clustered(12, 60, 5)
    other = pickle.loads(pickle.dumps(elastic))
    assert isinstance(other.stored_rows, LocalRows)
    q = np.random.default_rng(4).normal(size=12)
    assert other.value(q) == elastic.value(q)


def test_bad_input_is_named() -> None:
    good = local_rows(cubature(9, 30).rows, 4)
    sizes, rows, modes = good.sizes, good.rows, good.modes
    uneven = np.array([[TETS - 1, 3], [7, 4]], np.int32)
    for bad, message in (
        ((sizes, rows[1:], modes), "do not match the sizes"),
        ((sizes, rows, modes[1:]), "do not match the sizes"),
        ((uneven, rows, modes), "no multiple of 8"),
        ((sizes * np.array([1, 0], np.int32), rows, modes), "must have tets and local coord"),
        ((sizes[:, :1], rows, modes), r"\(clusters, 2\)"),
    ):
        with pytest.raises(ValueError, match=message):
            LocalRows(*bad).core  # noqa: B018
    elastic = cubature(9, 29)
    with pytest.raises(ValueError, match=r"29 tets need weights \(29,\) and rows \(29, 9, d\)"):
        Cubature(elastic.tets, elastic.weights, good, elastic.material)
