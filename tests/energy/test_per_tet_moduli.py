"""Moduli that differ from tet to tet, in the energy and in systems that renumber tets."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import ElasticEnergy, HandleBox, Handles, Material, PosingProblem, TetMesh
from snapspace import _core as core

from ..shapes import bar_poses, deformed, irregular_bar, one_tet
from .densities import every_kind, varied

FloatArray = NDArray[np.float64]


def shuffled_bar() -> TetMesh:
    """A bar with tets and vertices in random order, so that systems renumber them."""
    mesh, random = irregular_bar(4, 2, 2), np.random.default_rng(9)
    place = random.permutation(len(mesh.vertices))
    vertices = np.empty_like(mesh.vertices)
    vertices[place] = mesh.vertices
    return TetMesh(vertices, place[mesh.tets][random.permutation(len(mesh.tets))])


MESH = shuffled_bar()
X = deformed(MESH, 0.03)


def sum_of_tets(mesh: TetMesh, material: Material, x: FloatArray) -> tuple[float, FloatArray]:
    """Energy and gradient as sums over meshes of one tet, each of one material."""
    value, gradient = 0.0, np.zeros((len(mesh.vertices), 3))
    positions = x.reshape(-1, 3)
    for index, tet in enumerate(mesh.tets):
        own = material.of_tets(np.array([index]))
        part, force = ElasticEnergy(one_tet(mesh.vertices[tet]), own).value_and_gradient(
            positions[tet]
        )
        value += part
        gradient[tet] += force.reshape(-1, 3)
    return value, gradient.reshape(-1)


def posing(material: Material) -> PosingProblem:
    ends = MESH.vertices[:, 0] < 0.3, MESH.vertices[:, 0] > 1.7
    domain = HandleBox(translation=0.1, angle=0.1)
    return PosingProblem(MESH, Handles(ends), domain=domain, material=material, stiffness=1000.0)


def assert_close(found: tuple[float, FloatArray], expected: tuple[float, FloatArray]) -> None:
    assert found[0] == pytest.approx(expected[0], rel=1e-12)
    scale = np.abs(expected[1]).max()
    np.testing.assert_allclose(found[1], expected[1], rtol=0, atol=1e-12 * scale)


@every_kind
def test_the_energy_is_the_sum_of_those_of_its_tets(kind: type[Material]) -> None:
    material = varied(kind, len(MESH.tets))
    energy = ElasticEnergy(MESH, material)
    expected = sum_of_tets(MESH, material, X)
    assert_close(energy.value_and_gradient(X), expected)
    stresses, energies = energy.core.tet_stresses(X - MESH.vertices.reshape(-1))
    assert energies.sum() == pytest.approx(expected[0], rel=1e-12)
    assert (np.linalg.norm(stresses, axis=1) > 0).all()


@every_kind
def test_hessians_are_sums_over_tets_too(kind: type[Material]) -> None:
    material = varied(kind, len(MESH.tets))
    energy, v = ElasticEnergy(MESH, material), np.random.default_rng(3).normal(size=X.size)
    parts = np.zeros((len(MESH.vertices), 3))
    for index, tet in enumerate(MESH.tets):
        own = ElasticEnergy(one_tet(MESH.vertices[tet]), material.of_tets(np.array([index])))
        parts[tet] += own.hessian_product(X.reshape(-1, 3)[tet], v.reshape(-1, 3)[tet]).reshape(
            -1, 3
        )
    expected = parts.reshape(-1)
    scale = np.abs(expected).max()
    for product in (energy.hessian_product(X, v), energy.hessian(X) @ v):
        np.testing.assert_allclose(product, expected, rtol=0, atol=1e-12 * scale)


@every_kind
def test_equal_moduli_in_every_tet_act_as_one_number(kind: type[Material]) -> None:
    number = kind.from_lame(lam=1.5, mu=0.7)
    names = kind.names()
    arrays = kind(**{name: np.full(len(MESH.tets), getattr(number, name)) for name in names})
    assert not arrays.uniform
    one, many = (ElasticEnergy(MESH, material) for material in (number, arrays))
    assert one.value(X) == many.value(X)
    np.testing.assert_array_equal(one.value_and_gradient(X)[1], many.value_and_gradient(X)[1])
    assert abs(one.hessian(X) - many.hessian(X)).max() == 0


@every_kind
def test_moduli_stay_with_their_tets(kind: type[Material]) -> None:
    material = varied(kind, len(MESH.tets))
    order = np.random.default_rng(1).permutation(len(MESH.tets))
    expected = ElasticEnergy(MESH, material).value_and_gradient(X)
    permuted = TetMesh(MESH.vertices, MESH.tets[order])
    assert_close(ElasticEnergy(permuted, material.of_tets(order)).value_and_gradient(X), expected)
    wrong = ElasticEnergy(permuted, material).value(X)
    assert wrong != pytest.approx(expected[0], rel=1e-3)


@every_kind
def test_a_posing_system_renumbers_them(kind: type[Material]) -> None:
    problem = posing(varied(kind, len(MESH.tets)))
    u = X - MESH.vertices.reshape(-1)
    value, gradient = sum_of_tets(MESH, problem.material, X)
    missed = u.reshape(-1, 3)[problem.pinned] - 0.1
    value += problem.pin_weights @ (missed**2).sum(axis=1)
    np.add.at(gradient.reshape(-1, 3), problem.pinned, 2 * problem.pin_weights[:, None] * missed)
    inputs = np.full(3 * len(problem.pinned), 0.1)
    assert_close(problem.system.value_and_gradient(u, inputs), (value, gradient))


@every_kind
def test_its_scalar_matrix_is_the_laplacian_of_their_stiffness(kind: type[Material]) -> None:
    """The sum over tets of (2 mu + lam) volume (grad, grad), plus twice the handles' weights."""
    problem = posing(varied(kind, len(MESH.tets)))
    n = len(MESH.vertices)
    matrix = np.zeros((n, n))
    stiffness = np.broadcast_to(problem.material.stiffness, len(MESH.tets))
    for tet, volume, modulus in zip(MESH.tets, MESH.volumes, stiffness, strict=True):
        gradients = np.linalg.inv(np.column_stack([np.ones(4), MESH.vertices[tet]]))[1:]
        matrix[np.ix_(tet, tet)] += modulus * volume * gradients.T @ gradients
    matrix[problem.pinned, problem.pinned] += 2 * problem.pin_weights
    system = core.PosingSystem(
        MESH.vertices,
        MESH.tets,
        problem.material.core,
        problem.pinned,
        problem.pin_weights,
        inverse=core.InverseKind.factor,
    )
    v = np.random.default_rng(5).normal(size=(n, 3))
    found = system.precondition((matrix @ v).reshape(-1)).reshape(n, 3)
    np.testing.assert_allclose(found, v, rtol=0, atol=1e-10)


@every_kind
def test_a_blend_of_poses_uses_them_in_every_pose(kind: type[Material]) -> None:
    """sum_k w_k E_k, where E_k is the energy with pose k as its rest shape."""
    poses = bar_poses(irregular_bar(4, 2, 2))
    material = varied(kind, len(poses.tets))
    system = core.InterpolationSystem(poses.shapes, poses.tets, material.core)
    weights = np.array([0.5, 0.2, 0.3])
    u = 0.02 * np.random.default_rng(4).normal(size=poses.shapes[0].size)
    x = poses.shapes[0].reshape(-1) + u
    parts = [
        ElasticEnergy(TetMesh(pose, poses.tets), material).value_and_gradient(x)
        for pose in poses.shapes
    ]
    value = weights @ [part[0] for part in parts]
    gradient = weights @ np.array([part[1] for part in parts])
    found = system.value_and_gradient(u, weights)
    assert found[0] == pytest.approx(value, rel=1e-9)
    np.testing.assert_allclose(found[1], gradient, rtol=0, atol=1e-9 * np.abs(gradient).max())


@pytest.mark.parametrize("more", [-1, 1])
@every_kind
def test_systems_and_problems_refuse_moduli_of_another_number_of_tets(
    kind: type[Material], more: int
) -> None:
    material = varied(kind, len(MESH.tets) + more)
    pins = np.arange(4, dtype=np.int32), np.ones(4)
    with pytest.raises(ValueError, match="the material has moduli for a different number of tets"):
        core.PosingSystem(MESH.vertices, MESH.tets, material.core, *pins)
    with pytest.raises(ValueError, match="the material has moduli for a different number of tets"):
        core.InterpolationSystem(MESH.vertices[None], MESH.tets, material.core)
    with pytest.raises(ValueError, match="PosingProblem: the material has moduli for"):
        posing(material)
