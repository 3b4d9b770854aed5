"""The polynomial of degree four, compared with a direct evaluation of its monomials."""

from __future__ import annotations

import math
from itertools import permutations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import Quartic
from snapspace import _core as core
from snapspace.reduction import coefficient_count

from ..taylor import observed_order

FloatArray = NDArray[np.float64]


def random_quartic(dimension: int, seed: int = 0) -> Quartic:
    return Quartic(dimension, np.random.default_rng(seed).normal(size=coefficient_count(dimension)))


def dense(dimension: int, coefficients: FloatArray) -> FloatArray:
    """The symmetric tensor of degree four in x = (1, q): l slowest, i fastest, i <= j <= k <= l."""
    tensor = np.zeros((dimension + 1,) * 4)
    position = 0
    for last in range(dimension + 1):
        for k in range(last + 1):
            for j in range(k + 1):
                for i in range(j + 1):
                    tensor[i, j, k, last] = coefficients[position]
                    position += 1
    assert position == len(coefficients)
    orders = [np.transpose(tensor, order) for order in permutations(range(4))]
    return sum(orders) / 24


@pytest.mark.parametrize("dimension", [1, 2, 3, 4])
@pytest.mark.parametrize("size", [1e-3, 1.0, 50.0])
def test_value_gradient_and_hessian_are_those_of_the_monomials(dimension: int, size: float) -> None:
    quartic = random_quartic(dimension)
    tensor = dense(dimension, quartic.coefficients)
    q = size * np.random.default_rng(1).normal(size=dimension)
    x = np.append(1.0, q)
    value, gradient = quartic.value_and_gradient(q)
    cubic = tensor @ x
    assert value == pytest.approx(cubic @ x @ x @ x, rel=1e-12)
    assert gradient == pytest.approx(4 * (cubic @ x @ x)[1:], rel=1e-11)
    assert quartic.hessian(q) == pytest.approx(12 * (cubic @ x)[1:, 1:], rel=1e-11)
    assert quartic.value(q) == value


@pytest.mark.parametrize("dimension", [*range(1, 14), 20, 23, 40, 41, 42, 43])
def test_one_pass_gives_the_same_as_two(dimension: int) -> None:
    """The Hessian agrees with central differences of the gradient along q."""
    quartic = random_quartic(dimension)
    q = np.random.default_rng(4).normal(size=dimension)
    value, gradient = quartic.value_and_gradient(q)
    same_value, same_gradient, hessian = quartic.derivatives(q)
    size = np.linalg.norm(gradient)
    assert same_value == pytest.approx(value, rel=1e-11, abs=1e-13 * size)
    assert same_gradient == pytest.approx(gradient, abs=1e-13 * size)
    h = 1e-5
    moved = [quartic.value_and_gradient(q + h * side * q)[1] for side in (1, -1)]
    along = (moved[0] - moved[1]) / (2 * h)
    assert hessian @ q == pytest.approx(along, abs=1e-7 * np.abs(along).max())
    assert np.array_equal(hessian, hessian.T)


@pytest.mark.parametrize("dimension", [3, 12, 30])
def test_single_precision_is_the_quartic_of_rounded_coefficients(dimension: int) -> None:
    """The arithmetic adds no error, because sums are in double precision."""
    coefficients = random_quartic(dimension).coefficients
    q = np.random.default_rng(4).normal(size=dimension)
    single = core.Quartic(dimension, coefficients, single=True)
    rounded = core.Quartic(dimension, coefficients.astype(np.float32).astype(np.float64))
    assert single.value_and_gradient(q)[0] == rounded.value_and_gradient(q)[0]
    for a, b in zip(single.derivatives(q), rounded.derivatives(q), strict=True):
        assert np.array_equal(a, b)
    assert single.derivatives(q)[0] != core.Quartic(dimension, coefficients).derivatives(q)[0]


@pytest.mark.parametrize("dimension", [1, 4, 7, 19])
def test_taylor(dimension: int) -> None:
    quartic = random_quartic(dimension)
    rng = np.random.default_rng(2)
    q, direction = rng.normal(size=dimension), rng.normal(size=dimension)
    value, gradient = quartic.value_and_gradient(q)
    hessian = quartic.hessian(q)
    assert np.linalg.norm(gradient) > 0
    first = observed_order(
        lambda h: quartic.value(q + h * direction) - value - h * gradient @ direction
    )
    second = observed_order(
        lambda h: (
            quartic.value_and_gradient(q + h * direction)[1] - gradient - h * hessian @ direction
        )
    )
    third = observed_order(
        lambda h: (
            quartic.value(q + h * direction)
            - value
            - h * gradient @ direction
            - h**2 / 2 * direction @ hessian @ direction
        ),
        [0.02, 0.01, 0.005, 0.0025],
    )
    assert [first, second, third] == pytest.approx([2, 2, 3], abs=0.1)
    assert np.array_equal(hessian, hessian.T)


@pytest.mark.parametrize("dimension", [1, 2, 5, 11])
def test_the_leading_polynomial_has_the_other_coordinates_at_zero(dimension: int) -> None:
    full = random_quartic(11)
    q = np.random.default_rng(3).normal(size=dimension)
    padded = np.concatenate([q, np.zeros(11 - dimension)])
    leading = full.leading(dimension)
    value, gradient = leading.value_and_gradient(q)
    full_value, full_gradient = full.value_and_gradient(padded)
    assert value == pytest.approx(full_value, rel=1e-12)
    assert gradient == pytest.approx(full_gradient[:dimension], rel=1e-11)
    assert leading.coefficients.shape == (math.comb(dimension + 4, 4),)


def test_a_constant_a_line_and_a_fourth_power() -> None:
    """In one variable the coefficients are those of 1, q, q^2, q^3, q^4."""
    for degree in range(5):
        quartic = Quartic(1, np.eye(5)[degree])
        assert quartic.value([3.0]) == 3.0**degree
        assert quartic.value_and_gradient([3.0])[1][0] == degree * 3.0 ** max(degree - 1, 0)


def test_the_wrong_number_of_coefficients_is_refused() -> None:
    with pytest.raises(
        ValueError, match=r"Quartic: dimension 2 needs 15 coefficients, got .*\(14,\)"
    ):
        Quartic(2, np.zeros(14))


@pytest.mark.parametrize("size", [2, 4])
def test_the_wrong_number_of_coordinates_is_refused(size: int) -> None:
    quartic = random_quartic(3)
    for call in (quartic.value, quartic.value_and_gradient, quartic.hessian):
        with pytest.raises(ValueError, match="q must have one entry per dimension"):
            call(np.zeros(size))


def test_leading_with_more_coordinates_than_there_are_is_refused() -> None:
    with pytest.raises(ValueError, match="Quartic: dimension 4 needs 70 coefficients"):
        random_quartic(3).leading(4)


def test_coefficients_of_any_layout_and_type() -> None:
    coefficients = np.arange(30.0)[::2]
    q = np.array([0.3, -0.2])
    expected = Quartic(2, coefficients.copy()).value(q)
    assert Quartic(2, coefficients).value(q) == expected
    assert Quartic(2, coefficients.astype(np.float32)).value(q.tolist()) == expected
