"""The reduced energy equals the full energy on the subspace."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import AffineSubspace, ElasticEnergy, StVK, TetMesh
from snapspace import _core as core
from snapspace.generators import bar
from snapspace.reduction import coefficient_count, reduced_quartic

from ..shapes import deformed, flat_cylinder, irregular_bar, one_tet, random_subspace
from ..taylor import observed_order

FloatArray = NDArray[np.float64]
CASES = [
    pytest.param(irregular_bar(), StVK(lam=1.5, mu=0.7), 7, id="bar"),
    pytest.param(irregular_bar(), StVK(lam=0.0, mu=1.0), 20, id="no volume term"),
    pytest.param(flat_cylinder(), StVK(lam=500.0, mu=1.0), 5, id="flat, nearly incompressible"),
    pytest.param(one_tet(), StVK(), 1, id="one tet"),
    pytest.param(bar(6, 5, 4), StVK(lam=1.0, mu=3e6), 17, id="two panels of tets"),
]


def full(
    energy: ElasticEnergy, subspace: AffineSubspace, q: FloatArray
) -> tuple[float, FloatArray]:
    """Energy and gradient by q at tau + U q, from displacements: positions would round tiny q."""
    offset = subspace.tau - energy.mesh.vertices.reshape(-1)
    value, gradient = energy.core.value_and_gradient(offset + subspace.basis @ q)
    return value, subspace.basis.T @ gradient


@pytest.mark.parametrize("size", [1e-6, 1e-2, 1.0, 1e3])
@pytest.mark.parametrize("deformed_tau", [False, True])
@pytest.mark.parametrize(("mesh", "material", "dimension"), CASES)
def test_energy_and_gradient_are_those_of_the_full_space(
    mesh: TetMesh, material: StVK, dimension: int, deformed_tau: bool, size: float
) -> None:
    energy = ElasticEnergy(mesh, material)
    tau = deformed(mesh, 0.1) if deformed_tau else None
    subspace = random_subspace(mesh, dimension, tau=tau)
    quartic = reduced_quartic(energy, subspace)
    q = size * np.random.default_rng(6).normal(size=dimension)
    value, gradient = quartic.value_and_gradient(q)
    expected, expected_gradient = full(energy, subspace, q)
    assert value == pytest.approx(expected, rel=1e-10)
    assert np.linalg.norm(gradient - expected_gradient) <= 1e-10 * np.linalg.norm(expected_gradient)


def test_the_energy_at_positions_agrees() -> None:
    energy = ElasticEnergy(irregular_bar(), StVK())
    subspace = random_subspace(energy.mesh, 6)
    q = np.random.default_rng(6).normal(size=6)
    expected = energy.value(subspace.shape(q))
    assert reduced_quartic(energy, subspace).value(q) == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("size", [0.0, 1e-2, 1.0])
@pytest.mark.parametrize("deformed_tau", [False, True])
def test_the_hessian_is_that_of_the_full_space(deformed_tau: bool, size: float) -> None:
    energy = ElasticEnergy(irregular_bar(), StVK(lam=1.5, mu=0.7))
    tau = deformed(energy.mesh, 0.1) if deformed_tau else None
    subspace = random_subspace(energy.mesh, 9, tau=tau)
    q = size * np.random.default_rng(6).normal(size=9)
    U = subspace.basis
    expected = U.T @ (energy.hessian(subspace.shape(q)) @ U)
    hessian = reduced_quartic(energy, subspace).hessian(q)
    assert hessian == pytest.approx(expected, abs=1e-11 * np.abs(expected).max())


def test_taylor_along_the_full_energy() -> None:
    """The reduced gradient and Hessian are derivatives of the full energy along the subspace."""
    energy = ElasticEnergy(irregular_bar(), StVK())
    subspace = random_subspace(energy.mesh, 8)
    quartic = reduced_quartic(energy, subspace)
    rng = np.random.default_rng(8)
    q, d = rng.normal(size=8), rng.normal(size=8)
    value, gradient = quartic.value_and_gradient(q)
    assert np.linalg.norm(gradient) > 0
    curvature = d @ quartic.hessian(q) @ d

    def remainder(h: float) -> float:
        return full(energy, subspace, q + h * d)[0] - value - h * gradient @ d

    assert observed_order(remainder) == pytest.approx(2, abs=0.1)
    steps = [0.1, 0.05, 0.025, 0.0125]
    third = observed_order(lambda h: remainder(h) - h**2 / 2 * curvature, steps)
    assert third == pytest.approx(3, abs=0.1)


def test_the_rest_shape_has_neither_energy_nor_force() -> None:
    energy = ElasticEnergy(irregular_bar(), StVK())
    value, gradient = reduced_quartic(energy, random_subspace(energy.mesh, 5)).value_and_gradient(
        np.zeros(5)
    )
    assert value == 0.0
    assert not gradient.any()


def test_truncated_coefficients_are_those_computed_for_fewer_modes() -> None:
    energy = ElasticEnergy(irregular_bar(), StVK(lam=1.5, mu=0.7))
    subspace = random_subspace(energy.mesh, 14)
    quartic = reduced_quartic(energy, subspace)
    for dimension in (1, 6, 13):
        direct = reduced_quartic(energy, subspace.leading(dimension)).coefficients
        truncated = quartic.leading(dimension).coefficients
        assert truncated == pytest.approx(direct, abs=1e-13 * np.abs(direct).max())


def test_coefficients_are_bitwise_the_same_for_any_number_of_threads() -> None:
    energy = ElasticEnergy(bar(8, 5, 4), StVK())  # 960 tets: two panels of fifteen slices
    subspace = random_subspace(energy.mesh, 18)  # 190 columns: three blocks of the Gram matrix
    one, two, four, every = (
        reduced_quartic(energy, subspace, threads=threads).coefficients
        for threads in (1, 2, 4, None)
    )
    assert len(one) == coefficient_count(18)
    assert np.array_equal(one, two) and np.array_equal(one, four) and np.array_equal(one, every)


@pytest.mark.parametrize("shape", [(1, 108), (3, 107), (3, 0)])
def test_the_core_refuses_modes_of_another_size(shape: tuple[int, int]) -> None:
    energy = ElasticEnergy(irregular_bar(), StVK())
    assert energy.mesh.vertices.size == 108
    with pytest.raises(ValueError, match=r"modes must be \(dimension \+ 1, 3n\)"):
        core.quartic_coefficients(energy.core, np.zeros(shape), threads=1)
