"""Flat and inverted tets: they are counted, and every derivative is finite."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import ElasticEnergy, Material, StVK, TetMesh
from snapspace import _core as core
from snapspace.generators import bar

from ..shapes import CORNER_TET, deformed, irregular_bar
from .densities import densities, displacements, every_material, has_barrier, single_tets

#: Deformation gradients with det F <= 0: points, lines, planes, mirror images.
DEGENERATE = np.array(
    [
        np.zeros((3, 3)),
        np.diag([1.0, 0.0, 0.0]),
        np.diag([1.0, 1.0, 0.0]),
        np.diag([1.0, 1.0, -1e-9]),
        np.diag([1.0, 1.0, -1.0]),
        -np.eye(3),
        -1e-9 * np.eye(3),
        np.diag([1e-150, 1e-150, -1e-150]),
        np.diag([3.0, 1e-12, -2.0]),
        [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        [[1.0, 2.0, 3.0], [1.0, 2.0, 3.0], [0.0, 0.0, 0.0]],
        -1e3 * np.eye(3),
    ]
)


@every_material
def test_a_material_reports_whether_it_has_a_barrier(material: Material) -> None:
    """If it has one, solves start without inverted tets."""
    assert material.barrier == has_barrier(material)


@every_material
def test_the_stress_and_the_hessian_of_degenerate_tets_are_finite(material: Material) -> None:
    """The value is finite, too, or infinite with a zero gradient: a barrier that solvers avoid."""
    psi, P = densities(material, DEGENERATE)
    if has_barrier(material):
        assert (psi == np.inf).all()
        assert not P.any()
    else:
        assert np.isfinite(psi).all()
        assert np.isfinite(P).all()
    energy, u = single_tets(material, len(DEGENERATE)), displacements(DEGENERATE)
    direction = np.random.default_rng(2).normal(size=u.size)
    assert np.isfinite(energy.hessian_product(u, direction)).all()
    for projection in core.Projection:
        blocks = energy.hessian_blocks(u, projection=projection, threshold=0.65)[2]
        assert np.isfinite(blocks).all(), projection


@pytest.mark.parametrize("single", [False, True])
@every_material
def test_derivatives_in_lanes_are_finite_too(material: Material, single: bool) -> None:
    for F in DEGENERATE:
        energy, u = single_tets(material, 1), displacements(F[None])
        values, gradients = energy.lane_values_and_gradients(u[None], single=single)
        assert values[0] == np.inf if has_barrier(material) else np.isfinite(values[0])
        assert np.isfinite(gradients).all()


@every_material
def test_one_inverted_tet_of_a_mesh_is_enough_for_a_barrier(material: Material) -> None:
    mesh = irregular_bar()
    energy = ElasticEnergy(mesh, material)
    x = mesh.vertices.copy()
    x[0] = 2 * x[mesh.tets[(mesh.tets == 0).any(axis=1)][0]].mean(axis=0) - x[0]
    assert 0 < energy.inverted_tets(x) < len(mesh.tets)
    value, gradient = energy.value_and_gradient(x)
    assert np.isfinite(value) != has_barrier(material)
    assert np.isfinite(gradient).all()
    assert gradient.any(), "the tets that are not inverted have forces"


@every_material
def test_flattening_costs_energy_without_bound_for_a_barrier(material: Material) -> None:
    """Along diag(1, 1, h), psi rises as h falls from one to zero."""
    heights = np.linspace(1.0, 0.0, 21)
    F = np.tile(np.eye(3), (len(heights), 1, 1))
    F[:, 2, 2] = heights
    psi = densities(material, F)[0]
    assert (np.diff(psi[:-1]) > 0).all()
    assert np.isfinite(psi[:-1]).all()
    assert psi[-1] > psi[-2]


def test_counts_the_planted_inversions() -> None:
    """Pushing an apex through the opposite face inverts only its own tet."""
    vertices = np.vstack([CORNER_TET, [[1.0, 1.0, 1.0], [-1.0, 0.2, 0.2]]])
    mesh = TetMesh(vertices, [[0, 1, 2, 3], [1, 2, 3, 4], [0, 3, 2, 5]])
    energy = ElasticEnergy(mesh, StVK())
    x = vertices.copy()
    assert energy.inverted_tets(x) == 0
    x[4] = [0.1, 0.1, 0.1]
    assert energy.inverted_tets(x) == 1
    x[5] = [0.1, 0.2, 0.2]
    assert energy.inverted_tets(x) == 2


def test_a_flattened_tet_counts_as_inverted() -> None:
    mesh = bar(2, 2, 2, length=2.0, width=2.0, height=2.0)  # coordinates without rounding
    flattened = mesh.vertices * [1.0, 1.0, 0.0]
    assert ElasticEnergy(mesh, StVK()).inverted_tets(flattened) == len(mesh.tets)


def test_agrees_with_the_signed_volumes_of_the_deformed_mesh() -> None:
    mesh = irregular_bar()
    x = deformed(mesh, 0.6)
    corners = x.reshape(-1, 3)[mesh.tets]
    negative = int((np.linalg.det(corners[:, 1:] - corners[:, :1]) <= 0).sum())
    assert 0 < negative < len(mesh.tets)
    assert ElasticEnergy(mesh, StVK()).inverted_tets(x) == negative
