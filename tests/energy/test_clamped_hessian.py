"""clamped_hessian: the Hessian at states whose singular values are clamped."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import ElasticEnergy, Material, StVK, TetMesh

from ..shapes import deformed, irregular_bar, one_tet, random_rotation
from .densities import every_material

FloatArray = NDArray[np.float64]
MATERIAL = StVK(lam=1.5, mu=0.7)
MESH = irregular_bar()
ENERGY = ElasticEnergy(MESH, MATERIAL)


def deformation_gradients(mesh: TetMesh, x: FloatArray) -> FloatArray:
    rest = mesh.vertices[mesh.tets]
    now = x.reshape(-1, 3)[mesh.tets]
    edges, rest_edges = now[:, 1:] - now[:, :1], rest[:, 1:] - rest[:, :1]
    return np.linalg.solve(rest_edges, edges).transpose(0, 2, 1)


def clamped_state(F: FloatArray, threshold: float) -> FloatArray:
    """U max(s, threshold) V^T with rotations U and V; the smallest s has the sign of det F."""
    U, s, Vt = np.linalg.svd(F)
    flip = np.diag([1.0, 1.0, np.linalg.det(U)])
    flop = np.diag([1.0, 1.0, np.linalg.det(Vt)])
    s[2] *= np.linalg.det(U) * np.linalg.det(Vt)
    return U @ flip @ np.diag(np.maximum(s, threshold)) @ flop @ Vt


def hessian_of_clamped_states(
    mesh: TetMesh, x: FloatArray, threshold: float, material: Material = MATERIAL
) -> FloatArray:
    """Sum of the Hessians of single tets, each deformed homogeneously to its clamped state."""
    total = np.zeros((x.size, x.size))
    for tet, F in zip(mesh.tets, deformation_gradients(mesh, x), strict=True):
        alone = one_tet(mesh.vertices[tet])
        state = alone.vertices @ clamped_state(F, threshold).T
        entries = (3 * tet[:, None] + np.arange(3)).reshape(-1)
        hessian = ElasticEnergy(alone, material).hessian(state).toarray()
        total[np.ix_(entries, entries)] += hessian
    return total


@pytest.mark.parametrize("threshold", [0.1, 0.6, 1.0])
@pytest.mark.parametrize("size", [0.15, 0.6])
def test_equals_the_hessian_at_the_states_that_an_svd_clamps(size: float, threshold: float) -> None:
    x = deformed(MESH, size)
    assert (ENERGY.inverted_tets(x) > 0) == (size > 0.5)
    expected = hessian_of_clamped_states(MESH, x, threshold)
    clamped = ENERGY.clamped_hessian(x, threshold=threshold).toarray()
    scale = np.abs(expected).max()
    np.testing.assert_allclose(clamped, expected, rtol=0, atol=1e-11 * scale)
    np.testing.assert_allclose(clamped, clamped.T, rtol=0, atol=1e-14 * scale)


@every_material
def test_it_is_the_same_for_every_material(material: Material) -> None:
    """It is the Hessian of a state that is not inverted, not a projection for every material."""
    x = deformed(MESH, 0.6)
    expected = hessian_of_clamped_states(MESH, x, 0.65, material)
    clamped = ElasticEnergy(MESH, material).clamped_hessian(x, threshold=0.65).toarray()
    np.testing.assert_allclose(clamped, expected, rtol=0, atol=1e-11 * np.abs(expected).max())


def test_one_inverted_tet() -> None:
    mesh = one_tet()
    x = mesh.vertices.copy()
    x[3] = [0.1, 0.2, -0.8]  # through the opposite face
    energy = ElasticEnergy(mesh, MATERIAL)
    assert energy.inverted_tets(x) == 1
    F = deformation_gradients(mesh, x)[0]
    expected = energy.hessian(mesh.vertices @ clamped_state(F, 0.6).T).toarray()
    clamped = energy.clamped_hessian(x, threshold=0.6).toarray()
    assert clamped == pytest.approx(expected, abs=1e-13)
    assert np.abs(clamped - energy.hessian(x).toarray()).max() > 0.1


def test_equals_the_hessian_where_nothing_needs_clamping() -> None:
    x = deformed(MESH, 0.05)
    smallest = np.linalg.svd(deformation_gradients(MESH, x), compute_uv=False).min()
    assert 0.5 < smallest < 1
    clamped = ENERGY.clamped_hessian(x, threshold=0.99 * smallest)
    assert abs(clamped - ENERGY.hessian(x)).max() == 0
    barely = ENERGY.clamped_hessian(x, threshold=1.01 * smallest)
    assert abs(barely - ENERGY.hessian(x)).max() > 0


@pytest.mark.parametrize("scale", [-0.8, 0.3, 0.7])
@pytest.mark.parametrize("size", [0.01, 0.3])
def test_is_positive_semidefinite_at_threshold_one(size: float, scale: float) -> None:
    x = scale * deformed(MESH, size)
    plain = np.linalg.eigvalsh(ENERGY.hessian(x).toarray())
    loosely = np.linalg.eigvalsh(ENERGY.clamped_hessian(x, threshold=0.3).toarray())
    clamped = np.linalg.eigvalsh(ENERGY.clamped_hessian(x, threshold=1.0).toarray())
    assert plain[0] < -1e-3 * plain[-1], "the case must need clamping"
    assert loosely[0] < -1e-3 * loosely[-1], "a threshold far below one guarantees nothing"
    assert clamped[0] > -1e-12 * clamped[-1]


def test_a_collapsed_tet_gets_the_spectrum_of_its_rest_shape() -> None:
    """F = 0 is clamped to some rotation, which rotates the Hessian at rest."""
    mesh = one_tet()
    energy = ElasticEnergy(mesh, MATERIAL)
    clamped = energy.clamped_hessian(np.zeros(12), threshold=1.0).toarray()
    rest = np.linalg.eigvalsh(energy.hessian(mesh.vertices).toarray())
    assert np.linalg.eigvalsh(clamped) == pytest.approx(rest, abs=1e-12 * rest[-1])


def test_rotates_with_the_shape() -> None:
    x, rotation = deformed(MESH, 0.5), random_rotation()
    turn = np.kron(np.eye(len(MESH.vertices)), rotation)
    clamped = ENERGY.clamped_hessian(x, threshold=0.6).toarray()
    turned = ENERGY.clamped_hessian(turn @ x, threshold=0.6).toarray()
    expected = turn @ clamped @ turn.T
    np.testing.assert_allclose(turned, expected, rtol=0, atol=1e-11 * np.abs(clamped).max())


@pytest.mark.parametrize("threshold", [0.0, -0.5, 1.5, np.nan])
def test_a_threshold_outside_of_its_range_is_refused(threshold: float) -> None:
    with pytest.raises(ValueError, match=r"clamped_hessian: threshold is .*must be in \(0, 1\]"):
        ENERGY.clamped_hessian(MESH.vertices, threshold=threshold)
