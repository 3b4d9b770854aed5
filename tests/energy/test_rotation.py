"""The rotation nearest to F, which corotational densities use, found without an SVD.

The tests read it from P = 2 mu (F - R) of `ARAP`. R jumps where the signed singular values have
s_2 + s_3 = 0 (inverted tets only); the nearer F is to that, the fewer digits of R are correct.
"""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import ARAP, Corotational

from .densities import densities, displacements, formula, single_tets, turned

FloatArray = NDArray[np.float64]
COUNT = 4000
#: The least s_2 + s_3, and the bound on the relative error of psi and the error of R.
GAPS = [(0.5, 2e-12), (0.3, 2e-12), (0.1, 2e-12), (0.03, 1e-10), (0.01, 1e-9)]


def stretches(gap: float, *, seed: int = 1) -> FloatArray:
    """Inverted singular values of size one, with s_2 + s_3 from `gap` to twice `gap`."""
    random = np.random.default_rng(seed)
    middle = random.uniform(0.2, 1.5, COUNT)
    last = -middle + gap * random.uniform(1.0, 2.0, COUNT)
    return np.stack([middle + random.uniform(0.0, 1.0, COUNT), middle, last], axis=1)


def rotations(F: FloatArray) -> FloatArray:
    return F - densities(ARAP(), F)[1] / 2


def test_matrices_that_are_not_inverted() -> None:
    random = np.random.default_rng(2)
    for s in (random.uniform(0.0, 2.0, (COUNT, 3)), random.uniform(0.9, 1.1, (COUNT, 3))):
        F, U, V = turned(s)
        R = rotations(F)
        np.testing.assert_allclose(R, U @ V.swapaxes(1, 2), rtol=0, atol=1e-11)
        np.testing.assert_allclose(np.linalg.det(R), 1.0, rtol=1e-11)


@pytest.mark.parametrize(("gap", "error"), GAPS)
def test_inverted_matrices(gap: float, error: float) -> None:
    """U V^T of the signed decomposition is the nearest rotation."""
    s = stretches(gap)
    F, U, V = turned(s)
    np.testing.assert_allclose(rotations(F), U @ V.swapaxes(1, 2), rtol=0, atol=error)
    for material in (ARAP(mu=0.7), Corotational(lam=1.5, mu=0.7)):
        psi = densities(material, F)[0]
        np.testing.assert_allclose(psi, formula(material, s)[0], rtol=error)


@pytest.mark.parametrize("gap", [1e-2, 1e-4, 1e-8, 0.0])
def test_psi_is_continuous_where_the_rotation_jumps(gap: float) -> None:
    """R is not unique there, but |F - R| is; mirror images are an example."""
    s = stretches(gap)
    s[0] = 1.0, 1.0, -1.0
    psi = densities(ARAP(), turned(s)[0])[0]
    np.testing.assert_allclose(psi, formula(ARAP(), s)[0], rtol=0.05)


@pytest.mark.parametrize("single", [False, True])
@pytest.mark.parametrize("gap", [1e-2, 1e-4, 1e-8, 0.0])
def test_forces_are_finite_and_bounded_where_the_rotation_jumps(gap: float, single: bool) -> None:
    """|F - R| <= |F| + |R| = |F| + sqrt(3)."""
    F, _, _ = turned(stretches(gap))
    energy = single_tets(ARAP(), COUNT)
    values, gradients = energy.lane_values_and_gradients(displacements(F)[None], single=single)
    assert np.isfinite(values).all()
    stresses = 6 * gradients.reshape(-1, 4, 3)[:, 1:]  # P^T of unit corner tets
    bound = 2 * (np.linalg.norm(F, axis=(1, 2)) + np.sqrt(3.0))
    assert (np.linalg.norm(stresses, axis=(1, 2)) <= 1.01 * bound).all()


@pytest.mark.parametrize("width", [1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 0.0])
def test_needles(width: float) -> None:
    """Two singular values are nearly zero, of any sign: each adds mu to psi and pulls with 2 mu."""
    random = np.random.default_rng(5)
    s = np.stack(
        [random.uniform(0.5, 1.5, COUNT), *(width * random.uniform(0.5, 1.0, (2, COUNT)))], axis=1
    )
    s[::2, 2] *= -0.3
    psi, P = densities(ARAP(), turned(s)[0])
    assert np.isfinite(P).all()
    np.testing.assert_allclose(psi, formula(ARAP(), s)[0], rtol=0.05)


@pytest.mark.parametrize("size", [1e-3, 1e-8, 1e-20, 0.0])
def test_matrices_that_are_nearly_zero(size: float) -> None:
    """|F - R| is about |R| there, whatever R is; forces are finite even at zero."""
    for sign in (1.0, -1.0):
        s = size * np.random.default_rng(5).uniform(0.5, 1.0, (COUNT, 3))
        psi, P = densities(ARAP(), turned(sign * s)[0])
        assert np.isfinite(P).all()
        assert (psi > 0.0).all() and (psi < 3.3).all()
        if size > 1e-12 or size == 0.0:  # smaller values vanish in the sum I + G
            np.testing.assert_allclose(psi, 3.0, rtol=0, atol=0.2 + 10 * size)
