"""Mass matrices and the inner products that they define."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import kron

from snapspace.mesh import (
    apply_mass,
    mass_gram,
    mass_inner,
    mass_matrix,
    mass_norm,
    mass_norms,
)

from .boxes import box_mesh, irregular_mesh

SIZE = (2.0, 3.0, 0.5)


@pytest.mark.parametrize("lumped", [False, True])
def test_entries_sum_to_the_volume(lumped: bool) -> None:
    mesh = irregular_mesh()
    mass = mass_matrix(mesh, lumped=lumped)
    assert mass.shape == (len(mesh.vertices),) * 2
    assert mass.sum() == pytest.approx(mesh.volume)
    assert np.asarray(mass.sum(axis=1)) == pytest.approx(mesh.vertex_masses)
    assert abs(mass - mass.T).max() == 0
    assert np.linalg.eigvalsh(mass.toarray()).min() > 0


def test_linear_field_has_its_analytic_integral() -> None:
    """Integral of (x + 2y)^2 over [0, a] x [0, b] x [0, c]."""
    mesh = box_mesh((3, 4, 2), SIZE)
    a, b, c = SIZE
    field = mesh.vertices @ [1.0, 2.0, 0.0]
    exact = c * (a**3 * b / 3 + 4 * (a**2 / 2) * (b**2 / 2) + 4 * a * b**3 / 3)
    assert field @ mass_matrix(mesh) @ field == pytest.approx(exact)


def test_rigid_translation_has_the_norm_of_its_length() -> None:
    mesh = irregular_mesh()
    shift = np.tile([3.0, 0.0, 4.0], len(mesh.vertices))
    for lumped in (False, True):
        norm = mass_norm(mass_matrix(mesh, lumped=lumped), shift)
        assert norm == pytest.approx(5.0 * np.sqrt(mesh.volume))


def test_agrees_with_the_kronecker_product() -> None:
    mesh = irregular_mesh()
    mass = mass_matrix(mesh)
    full = kron(mass, np.eye(3)).toarray()
    rng = np.random.default_rng(0)
    a = rng.normal(size=(4, 3 * len(mesh.vertices)))
    b = rng.normal(size=(2, 3 * len(mesh.vertices)))
    for shapes in (a, np.asfortranarray(a), a[:1], a[:0], a[0]):
        product = apply_mass(mass, shapes)
        assert product.shape == shapes.shape
        assert product == pytest.approx(shapes @ full)
    assert mass_gram(mass, a, b) == pytest.approx(a @ full @ b.T)
    assert mass_inner(mass, a[0], b[0]) == pytest.approx(a[0] @ full @ b[0])
    assert mass_norms(mass, a) ** 2 == pytest.approx(np.diag(a @ full @ a.T))
    assert mass_norm(mass, a[1]) == pytest.approx(mass_norms(mass, a)[1])


def test_wrong_shapes_are_named() -> None:
    mass = mass_matrix(box_mesh())
    block, vector = np.zeros((2, 81)), np.zeros(81)
    with pytest.raises(ValueError, match=r"mass_inner: .*mass_gram takes one shape per row"):
        mass_inner(mass, block, vector)
    with pytest.raises(ValueError, match=r"mass_norm: .*mass_norms takes one shape per row"):
        mass_norm(mass, block)
    with pytest.raises(ValueError, match=r"apply_mass: shapes has shape \(81, 2\), .*: shapes\.T"):
        apply_mass(mass, block.T)
    with pytest.raises(ValueError, match=r"mass_gram: b has shape \(81, 2\), .*transpose it: b\.T"):
        mass_gram(mass, block, block.T)
    with pytest.raises(ValueError, match=r"mass_gram: a has shape \(81,\), .*is a\[None\]"):
        mass_gram(mass, vector, vector)
    with pytest.raises(
        ValueError, match=r"mass_norms: a has shape \(81, 2\), .*transpose it: a\.T"
    ):
        mass_norms(mass, block.T)
