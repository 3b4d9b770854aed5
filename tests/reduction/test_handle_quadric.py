"""The reduced handle energy against eq. (2) of the paper."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import AffineSubspace, PosingProblem
from snapspace.problem import rigid_offset
from snapspace.reduction import HandleQuadric, handle_quadric

from ..shapes import bar_problem, irregular_bar, random_subspace

FloatArray = NDArray[np.float64]
PROBLEM = bar_problem(irregular_bar(6, 2, 2))
SUBSPACE = random_subspace(PROBLEM.mesh, 9)
QUADRIC = handle_quadric(PROBLEM, SUBSPACE)


def rigid(rng: np.random.Generator) -> FloatArray:
    return rigid_offset(rng.uniform(-3, 3, (3, 3)), rng.normal(size=(3, 3)))


def affine(rng: np.random.Generator) -> FloatArray:
    return rng.normal(size=(3, 3, 4))


def by_displacements(
    problem: PosingProblem, subspace: AffineSubspace, q: FloatArray, offsets: FloatArray
) -> float:
    """Eq. (2) in displacements: small terms are not lost in large positions."""
    reached = (subspace.basis @ q).reshape(-1, 3)[problem.pinned]
    missing = reached - problem.target_displacements(offsets)
    return float(problem.pin_weights @ (missing**2).sum(axis=1))


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("motion", [rigid, affine])
def test_equals_equation_two(motion, seed: int) -> None:  # type: ignore[no-untyped-def]
    rng = np.random.default_rng(seed)
    q, offsets = rng.normal(size=9), motion(rng)
    expected = PROBLEM.handle_energy(SUBSPACE.shape(q), offsets)
    assert expected > 0
    assert QUADRIC.value(q, offsets) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("size", [1e-6, 1e-12, 1e6])
@pytest.mark.parametrize("motion", [rigid, affine])
def test_offsets_of_any_size_keep_their_precision(motion, size: float) -> None:  # type: ignore[no-untyped-def]
    """With maps for offsets, tiny motions would be differences of large positions."""
    rng = np.random.default_rng(5)
    q, offsets = size * rng.normal(size=9), size * motion(rng)
    expected = by_displacements(PROBLEM, SUBSPACE, q, offsets)
    assert QUADRIC.value(q, offsets) == pytest.approx(expected, rel=1e-12)


def test_handles_at_rest_cost_nothing_at_rest() -> None:
    assert QUADRIC.value(np.zeros(9), np.zeros((3, 3, 4))) == 0.0


def test_a_subspace_that_can_follow_the_handles_costs_nothing() -> None:
    """An affine motion of the whole body takes all handles to their targets."""
    mesh = PROBLEM.mesh
    map_ = np.random.default_rng(9).normal(size=(3, 4))
    field = mesh.vertices @ map_[:, :3].T + map_[:, 3]
    subspace = AffineSubspace(SUBSPACE.tau, field.reshape(-1, 1), SUBSPACE.mass, np.ones(1))
    centers = PROBLEM.centroids
    offsets = np.array([np.column_stack([map_[:, :3], map_ @ np.append(c, 1.0)]) for c in centers])
    quadric = handle_quadric(PROBLEM, subspace)
    scale = quadric.value(np.ones(1), np.zeros((3, 3, 4)))
    assert abs(quadric.value(np.ones(1), offsets)) < 1e-13 * scale


def test_is_linear_in_the_stiffness() -> None:
    stiffer = bar_problem(PROBLEM.mesh, stiffness=3 * PROBLEM.stiffness)
    quadric = handle_quadric(stiffer, SUBSPACE)
    for a, b in ((quadric.K, QUADRIC.K), (quadric.L, QUADRIC.L), (quadric.S, QUADRIC.S)):
        assert a == pytest.approx(3 * b, rel=1e-12)


def test_the_matrices_are_symmetric_and_positive() -> None:
    assert np.array_equal(QUADRIC.K, QUADRIC.K.T)
    assert np.linalg.eigvalsh(QUADRIC.K)[0] > 0
    for S in QUADRIC.S:
        assert S == pytest.approx(S.T, rel=1e-12)
        assert np.linalg.eigvalsh(S)[0] > 0
        # arms start at the mass centroid, so rotations and translations do not mix
        assert np.abs(S[3, :3]).max() < 1e-12 * S[3, 3]


@pytest.mark.parametrize("dimension", [1, 4, 9])
def test_leading_is_the_form_with_the_other_coordinates_at_zero(dimension: int) -> None:
    rng = np.random.default_rng(7)
    q, offsets = rng.normal(size=dimension), affine(rng)
    leading = QUADRIC.leading(dimension)
    padded = np.concatenate([q, np.zeros(9 - dimension)])
    assert leading.value(q, offsets) == pytest.approx(QUADRIC.value(padded, offsets), rel=1e-12)
    direct = handle_quadric(PROBLEM, SUBSPACE.leading(dimension))
    assert isinstance(leading, HandleQuadric)
    assert leading.K == pytest.approx(direct.K, rel=1e-12)
    assert leading.L == pytest.approx(direct.L, rel=1e-9, abs=1e-12)
