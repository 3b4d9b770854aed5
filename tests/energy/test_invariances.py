from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from snapspace import ElasticEnergy, StVK
from snapspace.generators import bar

from ..shapes import deformed, flat_cylinder, irregular_bar, moved, random_rotation

MESH = irregular_bar()
ENERGY = ElasticEnergy(MESH, StVK(lam=1.5, mu=0.7))
REST = MESH.vertices.reshape(-1)


def test_the_rest_shape_has_no_energy_and_no_force() -> None:
    value, gradient = ENERGY.value_and_gradient(REST)
    assert value == 0.0
    assert not gradient.any()


@pytest.mark.parametrize("size", [1e-3, 0.1, 2.0])
@given(
    angles=st.tuples(*[st.floats(-4, 4)] * 3),
    shift=st.tuples(*[st.floats(-10, 10)] * 3),
)
@settings(max_examples=20)
def test_a_rigid_motion_keeps_the_energy_and_turns_the_force(
    size: float, angles: tuple[float, ...], shift: tuple[float, ...]
) -> None:
    x = deformed(MESH, size)
    rotation = Rotation.from_euler("xyz", angles).as_matrix()
    value, gradient = ENERGY.value_and_gradient(x)
    moved_value, moved_gradient = ENERGY.value_and_gradient(moved(x, rotation, shift))
    assert moved_value == pytest.approx(value, rel=1e-9)
    scale = np.abs(gradient).max()
    assert moved_gradient == pytest.approx(moved(gradient, rotation), abs=1e-9 * scale)


def test_the_energy_of_a_rigidly_moved_rest_shape_is_rounding() -> None:
    x = moved(REST, random_rotation(), [5.0, -7.0, 3.0])
    strained = ENERGY.value(deformed(MESH, 0.1))
    assert abs(ENERGY.value(x)) < 1e-25 * strained


def test_forces_and_torques_of_a_free_body_vanish() -> None:
    """The infinitesimal rigid motions of the deformed shape do no work."""
    x = deformed(MESH, 0.3)
    force = ENERGY.value_and_gradient(x)[1].reshape(-1, 3)
    scale = np.abs(force).max()
    assert force.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-12 * scale)
    torque = np.cross(x.reshape(-1, 3), force).sum(axis=0)
    assert torque == pytest.approx(np.zeros(3), abs=1e-12 * scale)


@pytest.mark.parametrize("mesh", [bar(2, 2, 2), irregular_bar(), flat_cylinder()], ids=repr)
def test_the_hessian_at_rest_has_six_zero_modes_and_is_positive_else(mesh) -> None:  # type: ignore[no-untyped-def]
    hessian = ElasticEnergy(mesh, StVK(lam=2.0, mu=0.5)).hessian(mesh.vertices).toarray()
    eigenvalues = np.linalg.eigvalsh(hessian)
    noise = 1e-12 * eigenvalues[-1]
    assert np.abs(eigenvalues[:6]).max() < noise
    assert eigenvalues[6] > 1e3 * noise
    about = mesh.vertices - mesh.vertices.mean(axis=0)
    turns = [np.cross(axis, about).reshape(-1) for axis in np.eye(3)]
    shifts = [np.tile(axis, len(about)) for axis in np.eye(3)]
    for mode in turns + shifts:
        assert np.abs(hessian @ mode).max() < noise * np.abs(mode).max()


def test_an_inverted_element_costs_the_same_as_its_mirror_image() -> None:
    """The known weakness psi(F) = psi(-F) of St.Venant-Kirchhoff, which solvers must live with."""
    x = deformed(MESH, 0.2)
    value, gradient = ENERGY.value_and_gradient(x)
    mirrored_value, mirrored_gradient = ENERGY.value_and_gradient(-x)
    assert mirrored_value == pytest.approx(value, rel=1e-12)
    assert mirrored_gradient == pytest.approx(-gradient, rel=1e-9, abs=1e-12)
    assert ENERGY.inverted_tets(-REST) == len(MESH.tets)
    assert ENERGY.value(-REST) == pytest.approx(0.0, abs=1e-25)


def test_energy_is_linear_in_the_material_and_scales_with_the_volume() -> None:
    x = deformed(MESH, 0.2)
    by_lam = ElasticEnergy(MESH, StVK(lam=1.0, mu=1.0)).value(x)
    by_lam -= ElasticEnergy(MESH, StVK(lam=0.0, mu=1.0)).value(x)
    by_mu = ElasticEnergy(MESH, StVK(lam=0.0, mu=1.0)).value(x)
    assert ENERGY.value(x) == pytest.approx(1.5 * by_lam + 0.7 * by_mu, rel=1e-12)

    big = ElasticEnergy(type(MESH)(3.0 * MESH.vertices, MESH.tets), ENERGY.material)
    assert big.value(3.0 * x) == pytest.approx(27.0 * ENERGY.value(x), rel=1e-12)
