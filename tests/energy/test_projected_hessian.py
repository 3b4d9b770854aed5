"""Hessians of tets made positive semi-definite, compared with dense eigenvalues."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import ElasticEnergy, Material

from ..shapes import deformed, irregular_bar, one_tet
from .densities import (
    every_kind,
    every_material,
    has_barrier,
    random_stretches,
    turned,
    varied,
)

FloatArray = NDArray[np.float64]
POSITIVE = {"clamp": lambda values: np.maximum(values, 0.0), "absolute": np.abs}
projections = pytest.mark.parametrize("projection", POSITIVE)
TET = one_tet()


def states(material: Material) -> FloatArray:
    """Deformation gradients (k, 3, 3): at rest, near it, far from it, and inverted if allowed."""
    near = 1.0 + 0.1 * np.random.default_rng(1).uniform(0.0, 1.0, (10, 3))
    s = [np.ones((1, 3)), near, random_stretches(20, inverted=False)]
    if not has_barrier(material):
        s.append(random_stretches(20, inverted=True))
    return turned(np.concatenate(s))[0]


def by_entries(hessian: FloatArray) -> FloatArray:
    """The second derivative (9, 9) of 1/6 psi with respect to F, column by column.

    Vertices 1 to 3 of the unit corner tet are these columns.
    """
    return hessian[3:, 3:]


@projections
@every_material
def test_eigenvalues_are_those_of_the_exact_hessian_made_positive(
    material: Material, projection: str
) -> None:
    """Eigenvectors stay the same; clamping gives the nearest positive semi-definite matrix."""
    energy = ElasticEnergy(TET, material)
    indefinite = 0
    for F in states(material):
        x = TET.vertices @ F.T
        eigenvalues, vectors = np.linalg.eigh(by_entries(energy.hessian(x).toarray()))
        scale = np.abs(eigenvalues).max()
        indefinite += int(eigenvalues[0] < -1e-6 * scale)
        expected = vectors * POSITIVE[projection](eigenvalues) @ vectors.T
        found = energy.projected_hessian(x, projection=projection).toarray()
        np.testing.assert_allclose(by_entries(found), expected, rtol=0, atol=1e-10 * scale)
    assert indefinite > 3, "some states must need a projection"


@projections
@every_material
def test_nothing_changes_where_the_hessian_is_semi_definite(
    material: Material, projection: str
) -> None:
    energy = ElasticEnergy(TET, material)
    semi_definite = 0
    for F in states(material):
        x = TET.vertices @ F.T
        exact = energy.hessian(x).toarray()
        eigenvalues = np.linalg.eigvalsh(by_entries(exact))
        if eigenvalues[0] < -1e-13 * eigenvalues[-1]:
            continue
        semi_definite += 1
        found = energy.projected_hessian(x, projection=projection).toarray()
        np.testing.assert_allclose(found, exact, rtol=0, atol=1e-13 * eigenvalues[-1])
    assert semi_definite > 0, "at least the rest shape"


@projections
@pytest.mark.parametrize("size", [0.05, 1.0])
@every_kind
def test_for_a_mesh_it_is_symmetric_and_semi_definite(
    kind: type[Material], size: float, projection: str
) -> None:
    """With moduli per tet. Every tet is projected, so the sum is not the nearest matrix."""
    mesh = irregular_bar()
    energy = ElasticEnergy(mesh, varied(kind, len(mesh.tets)))
    hessian = energy.projected_hessian(deformed(mesh, size), projection=projection).toarray()
    scale = np.abs(hessian).max()
    assert np.isfinite(scale)
    np.testing.assert_allclose(hessian, hessian.T, rtol=0, atol=1e-13 * scale)
    assert np.linalg.eigvalsh(hessian)[0] > -1e-12 * scale


@every_material
def test_absolute_is_stiffer_than_clamped_and_clamped_than_exact(
    material: Material,
) -> None:
    mesh = irregular_bar()
    energy, x = ElasticEnergy(mesh, material), deformed(mesh, 0.05)
    exact = energy.hessian(x)
    clamped = energy.projected_hessian(x, projection="clamp")
    absolute = energy.projected_hessian(x, projection="absolute")
    for more, less in ((clamped, exact), (absolute, clamped)):
        difference = np.linalg.eigvalsh((more - less).toarray())
        assert difference[0] > -1e-12 * abs(exact).max()
        assert difference[-1] > 1e-6 * abs(exact).max(), "the projection must change the matrix"


@every_material
def test_clamping_is_the_default(material: Material) -> None:
    mesh = irregular_bar()
    energy, x = ElasticEnergy(mesh, material), deformed(mesh, 0.05)
    clamped = energy.projected_hessian(x, projection="clamp")
    assert abs(energy.projected_hessian(x) - clamped).max() == 0
