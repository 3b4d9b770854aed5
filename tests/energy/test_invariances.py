"""Invariances of every isotropic density: rigid motions, rotated material, and scale."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from snapspace import ElasticEnergy, Material, StVK
from snapspace import _core as core

from ..shapes import deformed, irregular_bar, moved, random_rotation
from .densities import densities, every_kind, every_material, has_barrier, random_stretches, turned

MESH = irregular_bar()
REST = MESH.vertices.reshape(-1)


@every_material
def test_the_rest_shape_has_no_energy_and_no_force(material: Material) -> None:
    value, gradient = ElasticEnergy(MESH, material).value_and_gradient(REST)
    assert value == 0.0
    assert not gradient.any()


@pytest.mark.parametrize("size", [1e-3, 0.05, 2.0])
@every_material
@given(
    angles=st.tuples(*[st.floats(-4, 4)] * 3),
    shift=st.tuples(*[st.floats(-10, 10)] * 3),
)
@settings(max_examples=10)
def test_a_rigid_motion_keeps_the_energy_and_rotates_the_force(
    material: Material, size: float, angles: tuple[float, ...], shift: tuple[float, ...]
) -> None:
    energy, x = ElasticEnergy(MESH, material), deformed(MESH, size)
    rotation = Rotation.from_euler("xyz", angles).as_matrix()
    value, gradient = energy.value_and_gradient(x)
    assert np.isfinite(value) or (size > 1.0 and has_barrier(material))
    moved_value, moved_gradient = energy.value_and_gradient(moved(x, rotation, shift))
    assert moved_value == pytest.approx(value, rel=1e-9)
    scale = np.abs(gradient).max()
    assert moved_gradient == pytest.approx(moved(gradient, rotation), abs=1e-9 * scale)


@every_material
def test_the_energy_of_a_rigidly_moved_rest_shape_is_rounding(material: Material) -> None:
    energy = ElasticEnergy(MESH, material)
    value, gradient = energy.value_and_gradient(moved(REST, random_rotation(), [5.0, -7.0, 3.0]))
    strained, force = energy.value_and_gradient(deformed(MESH, 0.05))
    assert abs(value) < 1e-14 * strained
    assert np.linalg.norm(gradient) < 1e-12 * np.linalg.norm(force)


@pytest.mark.parametrize("inverted", [False, True])
@every_material
def test_rotating_the_material_or_the_world_keeps_the_density(
    material: Material, inverted: bool
) -> None:
    """psi(R F Q) = psi(F) and P(R F Q) = R P(F) Q: frame indifference and isotropy."""
    F, _, _ = turned(random_stretches(500, inverted=inverted))
    R, Q = (Rotation.random(len(F), random_state=seed).as_matrix() for seed in (7, 8))
    psi, P = densities(material, F)
    assert np.isfinite(psi).all() == (not inverted or not has_barrier(material))
    turned_psi, turned_P = densities(material, R @ F @ Q)
    np.testing.assert_allclose(turned_psi, psi, rtol=1e-10)
    np.testing.assert_allclose(turned_P, R @ P @ Q, rtol=0, atol=1e-9 * max(np.abs(P).max(), 1.0))
    # angular momentum: the Kirchhoff stress P F^T is symmetric
    tau = P @ F.swapaxes(1, 2)
    np.testing.assert_allclose(tau, tau.swapaxes(1, 2), rtol=0, atol=1e-10 * np.abs(P).max())


@every_material
def test_forces_and_torques_of_a_free_body_vanish(material: Material) -> None:
    """The infinitesimal rigid motions of the deformed shape do no work."""
    x = deformed(MESH, 0.05)
    force = ElasticEnergy(MESH, material).value_and_gradient(x)[1].reshape(-1, 3)
    scale = np.abs(force).max()
    assert force.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-12 * scale)
    torque = np.cross(x.reshape(-1, 3), force).sum(axis=0)
    assert torque == pytest.approx(np.zeros(3), abs=1e-12 * scale)


@every_kind
def test_densities_are_linear_in_their_moduli(kind: type[Material]) -> None:
    u = deformed(MESH, 0.05) - REST
    names = kind.names()
    weights = np.linspace(0.4, 1.9, len(names))

    def at(moduli: np.ndarray) -> tuple[float, np.ndarray]:
        compiled = core.Material(kind.kind, moduli[None])
        return core.ElasticEnergy(MESH.vertices, MESH.tets, compiled).value_and_gradient(u)

    value, gradient = at(weights)
    parts = [at(modulus) for modulus in np.eye(len(names))]
    assert value == pytest.approx(weights @ [part[0] for part in parts], rel=1e-12)
    expected = weights @ np.array([part[1] for part in parts])
    assert gradient == pytest.approx(expected, abs=1e-12 * np.abs(gradient).max())


@every_material
def test_the_energy_scales_with_the_volume(material: Material) -> None:
    x = deformed(MESH, 0.05)
    big = ElasticEnergy(type(MESH)(3.0 * MESH.vertices, MESH.tets), material)
    assert big.value(3.0 * x) == pytest.approx(
        27.0 * ElasticEnergy(MESH, material).value(x), rel=1e-11
    )


def test_st_venant_kirchhoff_does_not_distinguish_mirror_images() -> None:
    """The known weakness psi(F) = psi(-F), which solvers must cope with."""
    energy, x = ElasticEnergy(MESH, StVK(lam=1.5, mu=0.7)), deformed(MESH, 0.2)
    value, gradient = energy.value_and_gradient(x)
    mirrored_value, mirrored_gradient = energy.value_and_gradient(-x)
    assert mirrored_value == pytest.approx(value, rel=1e-12)
    assert mirrored_gradient == pytest.approx(-gradient, rel=1e-9, abs=1e-12)
    assert energy.inverted_tets(-REST) == len(MESH.tets)
    assert energy.value(-REST) == pytest.approx(0.0, abs=1e-25)
