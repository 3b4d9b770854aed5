"""Rotation clustering: the ARAP energy with the best rotation of each cluster."""

from __future__ import annotations

import numpy as np
import pytest

import snapspace as ss
from paper.evaluators import (
    clustered_energy,
    clustered_model,
    local_global,
    nearest_rotations,
    rotation_clusters,
    with_near_hessian,
)
from paper.rivals import skinning_subspace
from snapspace.cubature.displacement_gradients import displacement_gradients
from snapspace.mesh import tet_volumes

from ..shapes import bar_problem, random_rotation


def arap_problem() -> ss.PosingProblem:
    plain = bar_problem()
    mu = np.linspace(0.5, 1.5, len(plain.mesh.tets))
    return ss.PosingProblem(
        plain.mesh,
        plain.handles,
        domain=plain.domain,
        material=ss.ARAP(mu=mu),
        stiffness=plain.stiffness,
    )


PROBLEM = arap_problem()
MESH = PROBLEM.mesh
EACH = np.arange(len(MESH.tets))
#: Closed under affine maps, so that it holds all rigid motions of each of its shapes.
SUBSPACE = skinning_subspace(PROBLEM, 24).in_single_precision()
MODEL = ss.reduce(PROBLEM, SUBSPACE, energy="full")
STATES = np.random.default_rng(1).standard_normal((30, 24))
LABELS = rotation_clusters(PROBLEM, SUBSPACE, STATES, 12)
OFFSETS = PROBLEM.offsets(PROBLEM.domain.from_unit(np.full(PROBLEM.parameter_count, 0.65)))


def state(seed: int = 0) -> np.ndarray:
    return 0.1 * np.random.default_rng(seed).standard_normal(24)


def test_as_many_clusters_as_tets_are_the_full_energy() -> None:
    energy = clustered_energy(PROBLEM, SUBSPACE, EACH)
    value, gradient = energy.value_and_gradient(state())
    wanted, slope = MODEL.elastic.value_and_gradient(state())
    assert value == pytest.approx(wanted, rel=1e-5), "rows are in single precision"
    assert np.allclose(gradient, slope, rtol=0, atol=1e-5 * np.abs(slope).max())
    assert np.abs(energy.spread).max() < 1e-20


def test_one_rotation_for_each_cluster_is_the_best_one() -> None:
    """The energy is sum_e v mu |F_e - R_c|^2 with the polar rotation of the weighted sums."""
    q = state()
    rows = displacement_gradients(MESH, SUBSPACE.basis, EACH.astype(np.int32))
    gradients = np.eye(3) + (rows @ q).reshape(-1, 3, 3)
    weights = tet_volumes(MESH.vertices, MESH.tets) * PROBLEM.material.of_tets(EACH).mu
    total = 0.0
    for cluster in range(LABELS.max() + 1):
        here = LABELS == cluster
        mean = (weights[here, None, None] * gradients[here]).sum(axis=0)
        rotation = nearest_rotations(mean[None])[0]
        total += float(weights[here] @ ((gradients[here] - rotation) ** 2).sum(axis=(1, 2)))
    value, _ = clustered_energy(PROBLEM, SUBSPACE, LABELS).value_and_gradient(q)
    assert value == pytest.approx(total, rel=1e-5)
    assert value > MODEL.elastic.value(q), "each tet has a better rotation of its own"


def test_the_energy_does_not_change_with_rigid_motions() -> None:
    energy = clustered_energy(PROBLEM, SUBSPACE, LABELS)
    x = SUBSPACE.shape(state()).reshape(-1, 3)
    turned = SUBSPACE.coordinates((x @ random_rotation().T + np.array([1.0, -2.0, 0.5])).ravel())
    wanted = energy.value_and_gradient(state())[0]
    assert energy.value_and_gradient(turned)[0] == pytest.approx(wanted, rel=1e-4)
    rigid = SUBSPACE.coordinates((MESH.vertices @ random_rotation().T).ravel())
    assert energy.value_and_gradient(rigid)[0] < 1e-8 * wanted


def test_the_gradient_passes_a_taylor_test() -> None:
    energy = clustered_energy(PROBLEM, SUBSPACE, LABELS)
    q, direction = state(), state(2)
    value, gradient = energy.value_and_gradient(q)
    rests = [
        abs(
            energy.value_and_gradient(q + h * direction)[0]
            - value
            - h * float(gradient @ direction)
        )
        for h in (1e-2, 1e-3)
    ]
    assert rests[1] < 0.02 * rests[0], "second order"


def test_local_and_global_steps_find_the_full_minimiser_with_a_cluster_for_each_tet() -> None:
    energy = clustered_energy(PROBLEM, SUBSPACE, EACH)
    found = local_global(energy, MODEL.handles, OFFSETS, np.zeros(24), tolerance=1e-9)
    _, slope = MODEL.elastic.value_and_gradient(found.q)
    pull = np.einsum("hik,hk->i", MODEL.handles.L, OFFSETS.reshape(len(OFFSETS), 12))
    residual = slope + 2.0 * (MODEL.handles.K @ found.q - pull)
    assert np.linalg.norm(residual) < 1e-5 * np.linalg.norm(slope)


def test_the_core_minimises_the_clustered_energy() -> None:
    """A session of the clustered model ends where local and global steps end, which fall."""
    energy = clustered_energy(PROBLEM, SUBSPACE, LABELS)
    session = clustered_model(MODEL, energy).session(tolerance=1e-12, minimizer="newton")
    session.put([(o[:, :3] + np.eye(3), o[:, 3]) for o in OFFSETS], np.zeros(24))
    session.solve()
    found = local_global(energy, MODEL.handles, OFFSETS, np.zeros(24), tolerance=1e-10)
    assert np.abs(session.q - found.q).max() < 1e-5 * np.linalg.norm(found.q)
    values = [
        energy.value_and_gradient(q)[0] + MODEL.handles.value(q, OFFSETS)
        for q in (
            local_global(energy, MODEL.handles, OFFSETS, np.zeros(24), most=steps).q
            for steps in range(1, 6)
        )
    ]
    assert (np.diff(values) < 0).all()


def test_clusters_hold_tets_that_move_alike() -> None:
    """The spread within clusters falls with their number, and all tets are in one."""
    spreads = []
    for count in (1, 12):
        labels = rotation_clusters(PROBLEM, SUBSPACE, STATES, count)
        assert labels.shape == EACH.shape and set(labels) == set(range(labels.max() + 1))
        energy = clustered_energy(PROBLEM, SUBSPACE, labels)
        spreads.append(np.einsum("ki,ij,kj->", STATES, energy.spread, STATES))
    assert spreads[0] > 2.0 * spreads[1] > 0
    every = rotation_clusters(PROBLEM, SUBSPACE, STATES, len(EACH))
    assert np.array_equal(every, EACH)


def test_other_materials_are_refused() -> None:
    with pytest.raises(ValueError, match=r"clustered_energy: the material is .*ARAP only"):
        clustered_energy(bar_problem(), SUBSPACE, LABELS)


def test_nearest_rotations_are_rotations_also_of_reflections() -> None:
    matrices = np.stack([np.diag([2.0, 1.0, -0.5]), random_rotation() @ np.diag([3.0, 2.0, 1.0])])
    found = nearest_rotations(matrices)
    assert np.allclose(found @ found.transpose(0, 2, 1), np.eye(3))
    assert np.allclose(np.linalg.det(found), 1.0)
    assert np.allclose(found[0], np.eye(3)) and np.allclose(found[1], random_rotation())


def test_an_approximate_hessian_leaves_the_minimiser_of_all_tets() -> None:
    near = clustered_energy(PROBLEM, SUBSPACE, EACH).clusters.leading(24)
    ends = []
    for model in (MODEL, with_near_hessian(MODEL, near)):
        session = model.session(tolerance=1e-12)
        session.put([(o[:, :3] + np.eye(3), o[:, 3]) for o in OFFSETS], np.zeros(24))
        session.solve()
        ends.append(session.q)
    assert np.abs(ends[0] - ends[1]).max() < 1e-5 * np.abs(ends[0]).max()
