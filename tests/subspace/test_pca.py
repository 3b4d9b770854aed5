"""Mass-weighted PCA: orthonormal, optimal, nested, and exact about its error."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.sparse import csr_array, identity

from snapspace import AffineSubspace, pca
from snapspace.mesh import mass_gram, mass_matrix, mass_norm, mass_norms

from ..shapes import CORNER_TET, irregular_bar

FloatArray = NDArray[np.float64]
MESH = irregular_bar(4, 2, 2)
TAU = MESH.vertices.reshape(-1)
MASSES = {"consistent": mass_matrix(MESH), "lumped": mass_matrix(MESH, lumped=True)}


def planted(amplitudes: FloatArray, count: int, *, seed: int = 0) -> FloatArray:
    """Snapshots (count, 3n) around TAU in a random space with one amplitude per direction."""
    rng = np.random.default_rng(seed)
    directions = rng.normal(size=(TAU.size, len(amplitudes)))
    weights = rng.normal(size=(len(amplitudes), count))
    return TAU + (directions @ (amplitudes[:, None] * weights)).T


def squared_error(shapes: FloatArray, basis: FloatArray, mass: csr_array) -> float:
    """Sum of the squared M-distances of the snapshots from tau + span of an M-orthonormal basis."""
    displacements = shapes - TAU
    left = displacements - mass_gram(mass, displacements, basis.T) @ basis.T
    return float((mass_norms(mass, left) ** 2).sum())


def angles(a: FloatArray, b: FloatArray, mass: csr_array) -> FloatArray:
    """Sines of the principal angles between two M-orthonormal bases."""
    left = b.T - mass_gram(mass, b.T, a.T) @ a.T
    return np.asarray(np.sqrt(np.maximum(np.linalg.eigvalsh(mass_gram(mass, left, left)), 0.0)))


def test_by_hand() -> None:
    """Four unit masses: snapshots 3 e1, -4 e1, 2 e2 have eigenvalues 25 and 4 along e1 and e2."""
    tau = CORNER_TET.reshape(-1)
    e1, e2 = np.eye(12)[[0, 7]]
    shapes = tau + np.stack([3 * e1, -4 * e1, 2 * e2])
    subspace = pca(shapes, tau, csr_array(identity(4)), dimension=2)
    np.testing.assert_allclose(subspace.snapshot_energies, [25.0, 4.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(subspace.basis, np.column_stack([e1, e2]), atol=1e-12)
    coordinates = subspace.coordinates(shapes)
    np.testing.assert_allclose(coordinates, [[3, 0], [-4, 0], [0, 2]], atol=1e-12)
    np.testing.assert_allclose(subspace.shape([3.0, 0.0]), shapes[0], atol=1e-12)
    assert subspace.leading(1).energy_fraction == pytest.approx(25 / 29)


@pytest.mark.parametrize("mass", MASSES.values(), ids=MASSES)
def test_orthonormal_over_six_decades(mass: csr_array) -> None:
    """The Gram matrix alone would leave an error of 1e-4 in the last direction."""
    shapes = planted(10.0 ** -np.arange(7.0), 20)
    subspace = pca(shapes, TAU, mass, dimension=7)
    gram = mass_gram(mass, subspace.basis.T, subspace.basis.T)
    np.testing.assert_allclose(gram, np.eye(7), rtol=0, atol=1e-12)
    # the space contains every planted direction, even the weakest
    assert squared_error(shapes, subspace.basis, mass) < 1e-20 * subspace.snapshot_energies[0]


@pytest.mark.parametrize("mass", MASSES.values(), ids=MASSES)
@pytest.mark.parametrize("dimension", [1, 3, 6])
def test_error_is_the_sum_of_the_discarded_eigenvalues(mass: csr_array, dimension: int) -> None:
    shapes = planted(10.0 ** -np.arange(7.0), 20)
    subspace = pca(shapes, TAU, mass, dimension=dimension)
    np.testing.assert_allclose(
        squared_error(shapes, subspace.basis, mass),
        subspace.snapshot_energies[dimension:].sum(),
        rtol=1e-6,
        atol=1e-13 * subspace.snapshot_energies[0],
    )
    total = (mass_norms(mass, shapes - TAU) ** 2).sum()
    assert subspace.snapshot_energies.sum() == pytest.approx(total, rel=1e-12)
    kept = 1.0 - squared_error(shapes, subspace.basis, mass) / total
    assert subspace.energy_fraction == pytest.approx(kept, abs=1e-12)


def test_the_planted_space_is_found_and_nothing_more() -> None:
    mass = MASSES["consistent"]
    shapes = planted(np.array([3.0, 1.0, 0.2]), 15, seed=4)
    subspace = pca(shapes, TAU, mass, energy_fraction=1.0)
    assert subspace.dimension == 3
    assert squared_error(shapes, subspace.basis, mass) < 1e-24 * subspace.snapshot_energies[0]
    unseen = planted(np.array([3.0, 1.0, 0.2]), 40, seed=4)  # the same space, other weights
    assert squared_error(unseen, subspace.basis, mass) < 1e-22 * subspace.snapshot_energies[0]
    with pytest.raises(
        ValueError, match=r"pca: dimension 4 exceeds the 3 independent directions of 15 usable"
    ):
        pca(shapes, TAU, mass, dimension=4)


def test_beats_random_subspaces() -> None:
    """It beats combinations of the snapshots, which are much better than arbitrary directions."""
    mass = MASSES["consistent"]
    shapes = planted(np.array([3.0, 2.0, 1.0, 0.7, 0.5, 0.3, 0.2, 0.1]), 12)
    best = squared_error(shapes, pca(shapes, TAU, mass, dimension=4).basis, mass)
    for seed in range(20):
        rng = np.random.default_rng(seed)
        mixed = rng.normal(size=(12, 4)).T @ (shapes - TAU)
        for directions in (mixed, rng.normal(size=(TAU.size, 4)).T):
            other = pca(TAU + directions, TAU, mass, dimension=4)
            assert squared_error(shapes, other.basis, mass) > 1.001 * best


@settings(max_examples=25)
@given(seed=st.integers(0, 10_000), count=st.integers(6, 12), dimension=st.integers(1, 5))
def test_for_any_snapshots(seed: int, count: int, dimension: int) -> None:
    """Orthonormal, with the eigenvalues' error; neither order nor a common shift matters."""
    mass = MASSES["consistent"]
    rng = np.random.default_rng(seed)
    shapes = planted(rng.uniform(0.1, 1.0, 5), count, seed=seed)
    subspace = pca(shapes, TAU, mass, dimension=dimension)
    scale = subspace.snapshot_energies[0]
    gram = mass_gram(mass, subspace.basis.T, subspace.basis.T)
    np.testing.assert_allclose(gram, np.eye(dimension), rtol=0, atol=1e-12)
    assert squared_error(shapes, subspace.basis, mass) == pytest.approx(
        subspace.snapshot_energies[dimension:].sum(), rel=1e-9, abs=1e-12 * scale
    )

    shuffled = pca(shapes[rng.permutation(count)], TAU, mass, dimension=dimension)
    np.testing.assert_allclose(
        shuffled.snapshot_energies, subspace.snapshot_energies, atol=1e-13 * scale
    )
    gap = subspace.snapshot_energies[dimension - 1] - subspace.snapshot_energies[dimension]
    assert angles(subspace.basis, shuffled.basis, mass).max() < 1e-7 + 1e-12 * scale / gap

    shifted = shapes + 5.0
    there = pca(shifted, TAU + 5.0, mass, dimension=dimension)
    assert angles(subspace.basis, there.basis, mass).max() < 1e-7 + 1e-12 * scale / gap


def test_signs_are_fixed() -> None:
    """The largest entry is positive, so mirrored or shuffled snapshots give the same columns."""
    mass = MASSES["consistent"]
    shapes = planted(np.array([3.0, 1.0, 0.4, 0.1]), 9)
    subspace = pca(shapes, TAU, mass, dimension=4)
    assert (subspace.basis.max(axis=0) > -subspace.basis.min(axis=0)).all()
    mirrored = pca(2.0 * TAU - shapes, TAU, mass, dimension=4)
    shuffled = pca(shapes[::-1], TAU, mass, dimension=4)
    for other in (mirrored, shuffled):
        np.testing.assert_allclose(other.basis, subspace.basis, atol=1e-11)


@pytest.mark.parametrize("mass", MASSES.values(), ids=MASSES)
def test_leading_is_the_pca_of_that_dimension(mass: csr_array) -> None:
    shapes = planted(10.0 ** -np.linspace(0, 4, 8), 20)
    largest = pca(shapes, TAU, mass, dimension=8)
    for dimension in (1, 4, 7):
        alone = pca(shapes, TAU, mass, dimension=dimension)
        leading = largest.leading(dimension)
        assert leading.dimension == dimension
        np.testing.assert_allclose(leading.basis, alone.basis, rtol=0, atol=1e-10)
        assert leading.energy_fraction == alone.energy_fraction
        np.testing.assert_array_equal(leading.basis, largest.basis[:, :dimension])
    np.testing.assert_array_equal(largest.leading(8).basis, largest.basis)


@pytest.mark.parametrize("fraction", [0.5, 0.9, 0.99, 0.9999, 0.999999, 1.0])
def test_energy_fraction_takes_the_fewest_sufficient_dimensions(fraction: float) -> None:
    mass = MASSES["consistent"]
    shapes = planted(10.0 ** -np.linspace(0, 3, 8), 20)
    chosen = pca(shapes, TAU, mass, energy_fraction=fraction)
    assert chosen.energy_fraction >= fraction * (1 - 1e-14)
    if chosen.dimension > 1:
        assert chosen.leading(chosen.dimension - 1).energy_fraction < fraction
    np.testing.assert_array_equal(
        chosen.basis, pca(shapes, TAU, mass, dimension=chosen.dimension).basis
    )


def test_a_fraction_met_exactly_needs_no_more() -> None:
    """With eigenvalues 9 and 1 one direction holds 90 %, so 90 % needs no second one."""
    e1, e2 = np.eye(12)[:2]
    tau = np.arange(12.0)
    shapes = tau + np.stack([3 * e1, e2])
    mass = csr_array(identity(4))
    assert pca(shapes, tau, mass, energy_fraction=0.9).dimension == 1
    assert pca(shapes, tau, mass, energy_fraction=0.9 + 1e-9).dimension == 2


def test_projection_is_idempotent_and_nearest() -> None:
    mass = MASSES["consistent"]
    subspace = pca(planted(np.array([2.0, 1.0, 0.5]), 9), TAU, mass, dimension=3)
    x = planted(np.array([1.0]), 1, seed=9)[0]
    q = subspace.coordinates(x)
    np.testing.assert_allclose(subspace.coordinates(subspace.shape(q)), q, rtol=1e-12, atol=1e-13)
    distance = mass_norm(mass, subspace.shape(q) - x)
    for step in np.random.default_rng(1).normal(size=(10, 3)):
        assert mass_norm(mass, subspace.shape(q + 0.1 * step) - x) > distance
    block = np.stack([x, subspace.tau])
    np.testing.assert_allclose(
        subspace.coordinates(block), np.stack([q, np.zeros(3)]), rtol=1e-12, atol=1e-15
    )


def test_the_same_call_gives_the_same_bits() -> None:
    mass = MASSES["consistent"]
    shapes = planted(np.array([2.0, 1.0, 0.5]), 9)
    one, two = (pca(shapes, TAU, mass, dimension=3) for _ in range(2))
    np.testing.assert_array_equal(one.basis, two.basis)
    np.testing.assert_array_equal(one.snapshot_energies, two.snapshot_energies)


SHAPES = planted(np.array([2.0, 1.0, 0.5]), 5)


@pytest.mark.parametrize(
    ("shapes", "options", "message"),
    [
        (SHAPES, {}, "pca: give either dimension or energy_fraction"),
        (
            SHAPES,
            {"dimension": 2, "energy_fraction": 0.5},
            "pca: give either dimension or energy_fraction",
        ),
        (SHAPES, {"dimension": 0}, "dimension is 0, but must be at least 1"),
        (SHAPES, {"dimension": -1}, "dimension is -1, but must be at least 1"),
        (
            SHAPES,
            {"dimension": 9},
            "pca: dimension 9 exceeds the 3 independent directions of 5 usable snapshots; use "
            "more samples or a smaller dimension",
        ),
        (SHAPES, {"energy_fraction": 0.0}, "energy_fraction is 0.0, but must be in (0, 1]"),
        (SHAPES, {"energy_fraction": 1.1}, "energy_fraction is 1.1, but must be in (0, 1]"),
        (
            np.tile(TAU, (4, 1)),
            {"dimension": 1},
            "pca: all 4 snapshots equal the reference shape, so there is no direction to span",
        ),
        (
            SHAPES.T,
            {"dimension": 1},
            f"pca: shapes has shape ({TAU.size}, 5), but a mesh of {TAU.size // 3} vertices needs "
            f"(k, {TAU.size}), one shape per row; transpose it: shapes.T",
        ),
    ],
)
def test_refuses(shapes: FloatArray, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        pca(shapes, TAU, MASSES["consistent"], **options)


def test_coordinates_refuse_columns_with_the_cure() -> None:
    subspace: AffineSubspace = pca(SHAPES, TAU, MASSES["consistent"], dimension=3)
    message = f"AffineSubspace.coordinates: shapes has shape ({TAU.size}, 5), but"
    with pytest.raises(ValueError, match=re.escape(message) + r".*; transpose it: shapes\.T"):
        subspace.coordinates(SHAPES.T)


@pytest.mark.parametrize("dimension", [0, 4, -2])
def test_leading_refuses_what_it_does_not_have(dimension: int) -> None:
    subspace: AffineSubspace = pca(SHAPES, TAU, MASSES["consistent"], dimension=3)
    with pytest.raises(ValueError, match=f"dimension {dimension} is not between 1 and 3"):
        subspace.leading(dimension)
