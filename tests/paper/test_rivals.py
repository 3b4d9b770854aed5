"""Rival subspaces: each has its defining property."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import eigh, subspace_angles

import snapspace as ss
from paper.rivals import (
    Vibrations,
    biharmonic_coordinates,
    biharmonic_subspace,
    farthest_points,
    modal_derivatives,
    modal_subspace,
    radial_basis_subspace,
    response_subspace,
    skinning_subspace,
    vibration_subspace,
    vibrations,
)
from paper.rivals.laplacian import normal_derivative, tet_laplacian
from paper.rivals.radial_basis import gaussians
from paper.rivals.skinning_modes import skinning_weights
from snapspace.generators import bar

from ..shapes import bar_problem, interpolation_problem

PROBLEM = bar_problem()
MESH = PROBLEM.mesh
RIVALS = {
    "vibrations": (vibration_subspace, 15),
    "modal derivatives": (modal_subspace, 20),
    "biharmonic": (biharmonic_subspace, 48),
    "radial basis": (radial_basis_subspace, 30),
    "skinning": (skinning_subspace, 30),
    "responses": (response_subspace, 36),
}


@pytest.fixture(scope="module")
def found() -> Vibrations:
    return vibrations(PROBLEM.energy.core, PROBLEM.mass(), MESH.vertices, 8)


def holds(subspace: ss.AffineSubspace, displacement: np.ndarray) -> float:
    """Share of a displacement that the subspace misses, in the M-norm."""
    u = displacement.reshape(-1)
    miss = u - subspace.basis @ subspace.coordinates(subspace.tau + u)
    norms = [
        np.sqrt(np.vdot(v.reshape(-1, 3), subspace.mass @ v.reshape(-1, 3))) for v in (miss, u)
    ]
    return float(norms[0] / norms[1])


def force(found: Vibrations, u: np.ndarray) -> np.ndarray:
    """Gradient of the elastic energy at a displacement."""
    gradient: np.ndarray = found.energy.value_and_gradient(u)[1]
    return gradient


@pytest.mark.parametrize("name", RIVALS)
def test_all_are_subspaces_that_models_take(name: str) -> None:
    make, dimension = RIVALS[name]
    subspace = make(PROBLEM, dimension)
    assert subspace.dimension == dimension
    gram = subspace.basis.T @ np.kron(subspace.mass.toarray(), np.eye(3)) @ subspace.basis
    assert np.abs(gram - np.eye(dimension)).max() < 1e-10
    report = ss.reduce(PROBLEM, subspace, energy="full").session().solve()
    assert report.status == "converged", "at rest"


def test_vibrations_are_those_of_a_dense_solver(found: Vibrations) -> None:
    """Generalised eigenpairs by LAPACK, whose first six are rigid."""
    values, vectors = eigh(found.stiffness.toarray(), found.mass.toarray())
    assert np.allclose(found.eigenvalues, values[6:14], rtol=1e-6)
    angles = subspace_angles(found.modes, vectors[:, 6:14])
    assert angles.max() < 1e-4
    assert np.abs(found.rigid.T @ (found.mass @ found.modes)).max() < 1e-8
    assert np.abs(found.stiffness @ found.rigid).max() < 1e-9 * found.stiffness.max()


def test_modal_derivatives_are_second_derivatives_of_forces(found: Vibrations) -> None:
    """K psi_ij is the mixed second difference of the body's forces, up to rigid motions."""
    pairs = [(0, 0), (0, 1), (1, 2)]
    psi = modal_derivatives(found, pairs)
    for k, (i, j) in enumerate(pairs):
        a, b = found.modes[:, i], found.modes[:, j]
        step = 1e-2 / np.abs(a).max()
        signs = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
        corners = [s * t * force(found, step * (s * a + t * b)) for s, t in signs]
        third = np.sum(corners, axis=0) / (4.0 * step**2)
        wanted = -(third - found.mass @ (found.rigid @ (found.rigid.T @ third)))
        assert np.linalg.norm(found.stiffness @ psi[:, k] - wanted) < 1e-5 * np.linalg.norm(wanted)
        assert np.abs(found.rigid.T @ (found.mass @ psi[:, k])).max() < 1e-8


def test_modal_derivatives_are_symmetric(found: Vibrations) -> None:
    one, two = modal_derivatives(found, [(0, 2), (2, 0)]).T
    assert np.allclose(one, two, rtol=0, atol=1e-6 * np.abs(one).max())


def test_blends_get_modes_of_all_their_poses() -> None:
    problem = interpolation_problem()
    subspace = modal_subspace(problem, 21)
    assert subspace.dimension == 21
    for pose in range(3):
        rest = problem.pose_shapes[pose].reshape(-1, 3)
        mass = ss.mass_matrix(ss.TetMesh(rest, problem.poses.tets))
        first = vibrations(problem.pose_energy(pose), mass, rest, 1).modes[:, 0]
        assert holds(subspace, first) < 1e-8


def test_biharmonic_coordinates_reproduce_linear_functions() -> None:
    handles = [np.asarray(handle.vertices) for handle in PROBLEM.handles]
    points = farthest_points(MESH.vertices, 6, given=np.concatenate(handles))
    weights = biharmonic_coordinates(MESH, points, handles)
    constants = [*range(6), *(6 + 4 * h + 3 for h in range(len(handles)))]
    assert np.allclose(weights[:, constants].sum(axis=1), 1.0, atol=1e-8), "partition of unity"
    for axis in range(3):
        given = np.zeros(weights.shape[1])
        given[:6] = MESH.vertices[points, axis]
        given[[6 + 4 * h + axis for h in range(len(handles))]] = 1.0
        assert np.allclose(weights @ given, MESH.vertices[:, axis], atol=1e-7), "linear precision"
    assert np.array_equal(weights[points, :6], np.eye(6)), "interpolation"


def test_the_normal_derivative_makes_linear_functions_harmonic_up_to_the_boundary() -> None:
    mesh = bar(3, 2, 2, length=3.0)
    linear = mesh.vertices @ np.array([1.0, -2.0, 0.5]) + 3.0
    laplacian = tet_laplacian(mesh)
    assert np.abs(laplacian @ linear).max() > 0.1
    assert np.abs((laplacian - normal_derivative(mesh)) @ linear).max() < 1e-12
    assert np.abs(laplacian.sum(axis=1)).max() < 1e-12


def test_the_laplacian_integrates_squared_gradients() -> None:
    mesh = bar(3, 2, 2, length=3.0)
    slope = np.array([1.0, -2.0, 0.5])
    u = mesh.vertices @ slope
    assert u @ (tet_laplacian(mesh) @ u) == pytest.approx(mesh.volume * float(slope @ slope))


def test_gaussians_add_up_to_one_and_move_their_own_point_most() -> None:
    points = farthest_points(MESH.vertices, 9)
    weights = gaussians(MESH.vertices, points)
    assert np.allclose(weights.sum(axis=1), 1.0)
    assert np.array_equal(weights[points].argmax(axis=1), np.arange(9))
    translation = np.tile([1.0, 2.0, 3.0], len(MESH.vertices))
    assert holds(radial_basis_subspace(PROBLEM, 27), translation) < 1e-8


def test_farthest_points_cover_the_mesh_evenly() -> None:
    """Greedy covering: no vertex is farther from the points than they are from each other."""
    points = farthest_points(MESH.vertices, 12)
    assert len(set(points.tolist())) == 12
    chosen = MESH.vertices[points]
    between = np.linalg.norm(chosen[:, None] - chosen[None], axis=2) + 1e9 * np.eye(12)
    cover = np.linalg.norm(MESH.vertices[:, None] - chosen[None], axis=2).min(axis=1).max()
    assert cover <= between.min() + 1e-12
    given = farthest_points(MESH.vertices, 3, given=points)
    assert not set(given.tolist()) & set(points.tolist())


def test_skinning_subspaces_hold_affine_motions_and_smooth_weights() -> None:
    weights = skinning_weights(PROBLEM, 3)
    laplacian, mass = tet_laplacian(MESH), PROBLEM.mass()
    values = np.einsum("ni,ni->i", weights, laplacian @ weights)
    known = eigh(laplacian.toarray(), mass.toarray(), eigvals_only=True)
    assert np.allclose(values, known[:3], atol=1e-8 * known[-1])
    subspace = skinning_subspace(PROBLEM, 24)
    affine = MESH.vertices @ np.random.default_rng(0).standard_normal((3, 3)) + 1.0
    assert holds(subspace, affine) < 1e-8


def test_responses_are_solutions_of_small_motions() -> None:
    """The error of the response to a motion falls with its square."""
    subspace = response_subspace(PROBLEM)
    misses = []
    for size in (1e-2, 5e-3):
        parameters = size * np.linspace(-1.0, 1.0, PROBLEM.parameter_count)
        options = ss.SolverOptions(tolerance=1e-14, settling=0.0, max_iterations=5000)
        solved = ss.solve_snapshots(PROBLEM, parameters[None], options=options, threads=1)
        misses.append(holds(subspace, solved.shapes[0] - PROBLEM.base))
    assert misses[0] < 0.02 and misses[1] < 0.6 * misses[0]
