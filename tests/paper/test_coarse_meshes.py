"""Mesh coarsening: collapses keep the body, and the energy is that of the coarse mesh."""

from __future__ import annotations

import numpy as np
import pytest

import snapspace as ss
from paper.evaluators import CoarseMesh, coarse_full_energy, coarse_meshes, coarse_model
from paper.evaluators.surface_quadrics import squared_distances, surface_quadrics
from paper.rivals import skinning_subspace
from snapspace.generators import bar
from snapspace.mesh import tet_volumes

from ..shapes import bar_problem, interpolation_problem, random_rotation

PROBLEM = bar_problem()
MESH = PROBLEM.mesh
#: Closed under affine maps, so that it holds all rigid motions of each of its shapes.
SUBSPACE = skinning_subspace(PROBLEM, 24)
MODEL = ss.reduce(PROBLEM, SUBSPACE, energy="full")
WHOLE = CoarseMesh(np.arange(len(MESH.vertices)), MESH)


@pytest.fixture(scope="module")
def coarse() -> CoarseMesh:
    mesh: CoarseMesh = next(coarse_meshes(MESH, [len(MESH.tets) // 2]))
    return mesh


def state(seed: int = 0) -> np.ndarray:
    return 0.1 * np.random.default_rng(seed).standard_normal(24)


def test_collapses_keep_vertices_orientation_and_topology() -> None:
    for small in coarse_meshes(MESH, [80, 60, 40]):
        mesh = small.mesh
        assert np.array_equal(mesh.vertices, MESH.vertices[small.kept])
        assert (tet_volumes(mesh.vertices, mesh.tets) > 0).all()
        euler = len(mesh.surface_vertices) - len(mesh.surface) // 2
        assert euler == 2, "a closed surface without handles"
        assert len(mesh.tets) <= 80


def test_collapses_inside_keep_the_volume() -> None:
    """The tets around an inner vertex fill the same place when it moves to a neighbour."""
    cube = bar(3, 3, 3, length=1.0, width=1.0, height=1.0)
    inner = (np.abs(cube.vertices - 0.5) < 0.4).all(axis=1, keepdims=True)
    near = np.where(inner, 0.5 + 0.4 * (cube.vertices - 0.5), cube.vertices)
    small = next(coarse_meshes(ss.TetMesh(near, cube.tets), [len(cube.tets) - 1]))
    assert set(np.flatnonzero(~inner)) <= set(small.kept.tolist()), "the shortest edges are inside"
    assert len(small.kept) == len(near) - 1
    assert small.mesh.volume == pytest.approx(1.0, rel=1e-12)


def test_poses_do_not_invert() -> None:
    problem = interpolation_problem()
    shapes = problem.poses.shapes
    count = len(problem.mesh.tets)
    small = next(coarse_meshes(problem.mesh, [count - count // 4], poses=shapes))
    for pose in shapes:
        assert (tet_volumes(pose[small.kept], small.mesh.tets) > 0).all()


def test_coarsening_is_the_same_for_the_same_mesh(coarse: CoarseMesh) -> None:
    again = next(coarse_meshes(MESH, [len(MESH.tets) // 2]))
    assert np.array_equal(again.mesh.tets, coarse.mesh.tets)


def test_a_mesh_that_cannot_be_coarser_is_refused() -> None:
    with pytest.raises(ValueError, match="coarse_meshes: no edge of 1 tets can be collapsed"):
        next(coarse_meshes(ss.TetMesh(np.vstack([np.zeros(3), np.eye(3)]), [[0, 1, 2, 3]]), [0]))


def test_full_resolution_is_the_full_energy() -> None:
    q = state()
    wanted, slope = MODEL.elastic.value_and_gradient(q)
    for energy in (coarse_model(MODEL, WHOLE).elastic, coarse_full_energy(MODEL, WHOLE)):
        value, gradient = energy.value_and_gradient(q)
        assert value == pytest.approx(wanted, rel=1e-5), "rows are in single precision"
        assert np.allclose(gradient, slope, rtol=0, atol=1e-5 * np.abs(slope).max())


def test_full_resolution_of_poses_is_their_full_energy() -> None:
    problem = interpolation_problem()
    shapes = ss.solve_snapshots(problem, ss.sample(problem.domain, 8), threads=1)
    model = ss.reduce(problem, ss.snapshot_pca(shapes, dimension=4), energy="full")
    whole = CoarseMesh(np.arange(len(problem.mesh.vertices)), problem.mesh)
    weights, q = np.array([0.2, 0.5, 0.3]), np.array([0.3, -0.2, 0.1, 0.05])
    wanted, slope = model.elastic(weights).value_and_gradient(q)
    for blends in (coarse_model(model, whole).blends, coarse_full_energy(model, whole)):
        value, gradient = blends.at(weights).value_and_gradient(q)
        assert value == pytest.approx(wanted, rel=1e-5)
        assert np.allclose(gradient, slope, rtol=0, atol=1e-5 * np.abs(slope).max())


def test_both_forms_of_a_coarse_energy_agree(coarse: CoarseMesh) -> None:
    q = state()
    rows = coarse_model(MODEL, coarse).elastic.value_and_gradient(q)
    shared = coarse_full_energy(MODEL, coarse).value_and_gradient(q)
    assert rows[0] == pytest.approx(shared[0], rel=1e-5)
    assert np.allclose(rows[1], shared[1], rtol=0, atol=1e-5 * np.abs(shared[1]).max())


def test_a_coarse_energy_does_not_change_with_rigid_motions(coarse: CoarseMesh) -> None:
    elastic = coarse_model(MODEL, coarse).elastic
    x = SUBSPACE.shape(state()).reshape(-1, 3)
    turned = SUBSPACE.coordinates((x @ random_rotation().T + np.array([1.0, -2.0, 0.5])).ravel())
    assert elastic.value(turned) == pytest.approx(elastic.value(state()), rel=1e-4)
    rigid = SUBSPACE.coordinates((MESH.vertices @ random_rotation().T).ravel())
    assert elastic.value(rigid) < 1e-9 * elastic.value(state())


def test_the_gradient_of_a_coarse_energy_passes_a_taylor_test(coarse: CoarseMesh) -> None:
    elastic = coarse_model(MODEL, coarse).elastic
    q, direction = state(), state(1)
    value, gradient = elastic.value_and_gradient(q)
    rests = [
        abs(elastic.value(q + h * direction) - value - h * float(gradient @ direction))
        for h in (1e-2, 1e-3)
    ]
    assert rests[1] < 0.02 * rests[0], "second order"


def test_a_material_that_differs_from_tet_to_tet_is_refused(coarse: CoarseMesh) -> None:
    moduli = np.linspace(1.0, 2.0, len(MESH.tets))
    problem = ss.PosingProblem(
        MESH,
        PROBLEM.handles,
        domain=PROBLEM.domain,
        material=ss.StVK(lam=moduli, mu=moduli),
    )
    model = ss.reduce(problem, SUBSPACE, energy="full")
    with pytest.raises(ValueError, match="coarse_model: the material differs from tet to tet"):
        coarse_model(model, coarse)


def test_distances_from_the_surface_around_a_vertex() -> None:
    """In a flat face they are distances from its plane; at an edge, both faces' are averaged."""
    mesh = bar(4, 2, 2, length=4.0, width=2.0, height=2.0)
    quadrics = surface_quadrics(mesh)
    middle, edge = (
        int(np.linalg.norm(mesh.vertices - (mesh.vertices.min(axis=0) + at), axis=1).argmin())
        for at in ((2.0, 1.0, 2.0), (2.0, 2.0, 2.0))
    )
    forms, shift = quadrics[[middle, middle, edge]], np.diag([5.0, 7.0, 0.3])
    found = squared_distances(forms[:2], mesh.vertices[middle] + shift[1:])
    assert found == pytest.approx([0.0, 0.09], abs=1e-12), "along the face, and across"
    along = squared_distances(forms[2:], mesh.vertices[edge] + shift[:1])
    assert along == pytest.approx([0.0], abs=1e-12), "along the edge"
    across = squared_distances(forms[2:], mesh.vertices[edge] - shift[2:])
    assert 0.0 < across[0] < 0.09, "in the plane of one face only"
