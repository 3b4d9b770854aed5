"""Densities and stresses compared with independent formulas in principal stretches."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import MATERIALS, ElasticEnergy, Material, StVK, TetMesh

from ..shapes import deformed, flat_cylinder, irregular_bar, random_rotation
from .densities import (
    FORMULAS,
    LAM,
    MU,
    densities,
    formula,
    has_barrier,
    random_stretches,
    turned,
    with_formula,
)

FloatArray = NDArray[np.float64]
MATERIAL = StVK(lam=LAM, mu=MU)


@pytest.fixture(params=[irregular_bar(), flat_cylinder()], ids=["bar", "flat"])
def mesh(request: pytest.FixtureRequest) -> TetMesh:
    mesh: TetMesh = request.param
    return mesh


def homogeneous(mesh: TetMesh, F: FloatArray, material: Material = MATERIAL) -> float:
    """Energy density of a homogeneous deformation with gradient F."""
    return ElasticEnergy(mesh, material).value(mesh.vertices @ F.T) / mesh.volume


def test_formulas_belong_to_existing_materials() -> None:
    assert set(FORMULAS) <= set(MATERIALS)


@pytest.mark.parametrize("inverted", [False, True])
@with_formula
def test_densities_and_stresses_are_those_of_the_formula(
    material: Material, inverted: bool
) -> None:
    """P = U diag(d psi / d s) V^T at F = U diag(s) V^T; with a barrier psi is infinite and P 0."""
    s = random_stretches(2000, inverted=inverted)
    F, U, V = turned(s)
    psi, P = densities(material, F)
    if inverted and has_barrier(material):
        assert (psi == np.inf).all()
        assert not P.any()
        return
    expected, by_stretch = formula(material, s)
    np.testing.assert_allclose(psi, expected, rtol=1e-12, atol=1e-13)
    stress = U * by_stretch[:, None, :] @ V.swapaxes(1, 2)
    scale = np.abs(stress).max(axis=(1, 2))[:, None, None]
    np.testing.assert_allclose(P / scale, stress / scale, rtol=0, atol=1e-11)


@pytest.mark.parametrize("stretch", [0.0, 0.5, 0.99, 1.3, 3.0, -0.6])
@with_formula
def test_uniaxial_stretch(material: Material, mesh: TetMesh, stretch: float) -> None:
    if stretch > 0 or not has_barrier(material):
        expected = FORMULAS[material.kind](np.array([1.0, 1.0, stretch]), material.lam, material.mu)
    else:
        expected = np.inf
    density = homogeneous(mesh, np.diag([stretch, 1.0, 1.0]), material)
    assert density == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("scale", [0.3, 0.98, 1.7])
@with_formula
def test_uniform_scaling_after_a_rotation(material: Material, mesh: TetMesh, scale: float) -> None:
    expected = FORMULAS[material.kind](np.full(3, scale), material.lam, material.mu)
    density = homogeneous(mesh, scale * random_rotation(), material)
    assert density == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("shear", [1e-3, 0.4, 2.0])
def test_simple_shear_of_st_venant_kirchhoff(mesh: TetMesh, shear: float) -> None:
    """F = I + g e1 e2^T: E_12 = g/2, E_22 = g^2/2, so psi = mu (g^2/2 + g^4/4) + lam g^4/8."""
    F = np.eye(3)
    F[0, 1] = shear
    density = MU * (shear**2 / 2 + shear**4 / 4) + LAM / 8 * shear**4
    assert homogeneous(mesh, F) == pytest.approx(density, rel=1e-8)


@pytest.mark.parametrize(
    "material",
    [kind.from_lame(lam=LAM, mu=MU) for kind in MATERIALS.values() if kind.exact_degree],
    ids=lambda material: material.kind,
)
def test_along_a_line_the_energy_is_a_polynomial_of_its_exact_degree(
    material: Material, mesh: TetMesh
) -> None:
    degree = material.exact_degree
    assert degree is not None
    energy = ElasticEnergy(mesh, material)
    start = deformed(mesh, 0.3)
    direction = np.random.default_rng(7).normal(size=start.size)
    half = degree / 2
    values = np.array([energy.value(start + t * direction) for t in np.arange(-half, half + 2)])
    assert np.abs(np.diff(values, degree + 1)).max() < 1e-12 * np.abs(values).max()
    assert np.abs(np.diff(values, degree)).min() > 1e-3 * np.abs(values).max()
