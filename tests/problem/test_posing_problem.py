from __future__ import annotations

import pickle
import re

import numpy as np
import pytest

from snapspace import HandleBox, Handles, PosingProblem
from snapspace.generators import bar
from snapspace.problem import affine_offset, rotation_matrix

from ..shapes import bar_problem, deformed, irregular_bar, moved, random_rotation
from ..taylor import observed_order

PROBLEM = bar_problem(irregular_bar(5, 2, 2))
MESH = PROBLEM.mesh
BOX = HandleBox(translation=1.0, angle=1.0)


def random_parameters(seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-0.8, 0.8, PROBLEM.parameter_count)


def world_map(offset: np.ndarray, center: np.ndarray) -> np.ndarray:
    """(4, 4) homogeneous map of positions for an offset [A - I | t] about a center."""
    A = offset[:, :3] + np.eye(3)
    return np.vstack([np.column_stack([A, center + offset[:, 3] - A @ center]), [0, 0, 0, 1]])


def test_centroids_are_weighted_by_mass() -> None:
    """m_j is a quarter of the volume of the tets at j."""
    for handle, center in zip(PROBLEM.handles, PROBLEM.centroids, strict=True):
        masses = [MESH.volumes[(MESH.tets == j).any(axis=1)].sum() / 4 for j in handle.vertices]
        expected = np.array(masses) @ MESH.vertices[handle.vertices] / sum(masses)
        assert center == pytest.approx(expected)
        assert np.abs(center - MESH.vertices[handle.vertices].mean(axis=0)).max() > 1e-3


def test_the_handle_energy_is_equation_two_written_out() -> None:
    w, x = random_parameters(), deformed(MESH, 0.3)
    total = 0.0
    for h, (handle, c) in enumerate(zip(PROBLEM.handles, PROBLEM.centroids, strict=True)):
        motion = np.zeros(6) if h == 0 else w[6 * (h - 1) : 6 * h]
        R, t = rotation_matrix(motion[3:]), motion[:3]
        for j in handle.vertices:
            m = MESH.volumes[(MESH.tets == j).any(axis=1)].sum() / 4
            target = R @ (MESH.vertices[j] - c) + c + t
            total += PROBLEM.stiffness * m * ((x.reshape(-1, 3)[j] - target) ** 2).sum()
    assert PROBLEM.handle_energy(x, PROBLEM.offsets(w)) == pytest.approx(total, rel=1e-12)
    elastic = PROBLEM.energy.value(x)
    assert PROBLEM.value_and_gradient(x, w)[0] == pytest.approx(elastic + total, rel=1e-12)


def test_parameters_are_the_motions_of_the_moving_handles() -> None:
    w = random_parameters()
    offsets = PROBLEM.offsets(w)
    assert not offsets[0].any(), "the first handle stays at rest"
    for h in (1, 2):
        t, euler = w[6 * h - 6 : 6 * h - 3], w[6 * h - 3 : 6 * h]
        assert offsets[h, :, 3] == pytest.approx(t)
        assert offsets[h, :, :3] + np.eye(3) == pytest.approx(rotation_matrix(euler))


def test_a_shape_that_follows_its_handles_costs_nothing() -> None:
    offsets = PROBLEM.offsets(random_parameters())
    x = MESH.vertices.copy()
    x[PROBLEM.pinned] += PROBLEM.target_displacements(offsets)
    assert PROBLEM.handle_energy(x, offsets) < 1e-26
    assert PROBLEM.handle_energy(MESH.vertices, np.zeros((3, 3, 4))) == 0.0


def test_a_common_rigid_motion_of_all_handles_and_the_shape_keeps_the_objective() -> None:
    offsets, x = PROBLEM.offsets(random_parameters()), deformed(MESH, 0.3)
    R, t = random_rotation(), np.array([3.0, -1.0, 2.0])
    common = np.vstack([np.column_stack([R, t]), [0, 0, 0, 1]])
    moved_offsets = np.array(
        [
            affine_offset((common @ world_map(offset, c))[:3], c)
            for offset, c in zip(offsets, PROBLEM.centroids, strict=True)
        ]
    )
    moved_x = moved(x, R, t)
    before = PROBLEM.handle_energy(x, offsets)
    assert PROBLEM.handle_energy(moved_x, moved_offsets) == pytest.approx(before, rel=1e-11)
    assert PROBLEM.energy.value(moved_x) == pytest.approx(PROBLEM.energy.value(x), rel=1e-11)


@pytest.mark.parametrize("size", [0.2, 1.0])
def test_taylor_of_the_objective(size: float) -> None:
    w, x = random_parameters(), deformed(MESH, size)
    direction = np.random.default_rng(3).normal(size=x.size)
    value, gradient = PROBLEM.value_and_gradient(x, w)
    assert np.linalg.norm(gradient) > 0

    def remainder(h: float) -> float:
        return (
            PROBLEM.value_and_gradient(x + h * direction, w)[0] - value - h * gradient @ direction
        )

    assert observed_order(remainder) == pytest.approx(2, abs=0.1)


def test_the_domain_has_six_parameters_per_moving_handle() -> None:
    assert PROBLEM.parameter_count == 12
    assert PROBLEM.domain.moving == 2
    two = PosingProblem(MESH, Handles([[0, 1, 2], [9]]), domain=HandleBox(translation=1, angle=0))
    assert two.parameter_count == 6
    assert (two.material.lam, two.material.mu) == (1.0, 1.0)
    assert two.stiffness == pytest.approx(2e5 / MESH.diagonal**2)


@pytest.mark.parametrize("stiffness", [0.0, -1.0, np.nan, np.inf])
def test_stiffness_must_be_positive(stiffness: float) -> None:
    with pytest.raises(ValueError, match=r"PosingProblem: stiffness is .* must be positive"):
        bar_problem(MESH, stiffness=stiffness)


def test_a_handle_outside_of_the_mesh_is_refused_by_name() -> None:
    n = len(MESH.vertices)
    handles = Handles([[0, 1, 2], [3, n]], names=["foot", "head"])
    message = f"handle 'head' has vertex index {n}, but the mesh has {n} vertices"
    with pytest.raises(ValueError, match=message):
        PosingProblem(MESH, handles, domain=BOX)


def test_a_mask_over_other_vertices_than_those_of_the_mesh_is_refused_by_name() -> None:
    """An example is a mask over the vertices of the surface, which are fewer."""
    n = len(MESH.vertices)
    feet, head = np.arange(n) < 3, np.arange(n - 7) > n - 12
    message = f"PosingProblem: handle 'head': the mask has {n - 7} entries, but the mesh has {n} v"
    masks = Handles([feet, head], names=["feet", "head"])
    wrong = [
        masks,
        pickle.loads(pickle.dumps(masks)),
        Handles([feet, [n - 1]], names=["feet", "tail"]).adding("head", head).without("tail"),
        Handles([feet, [n - 1]], names=["feet", "head"]).replacing("head", head).fixing("head"),
    ]
    for handles in wrong:
        with pytest.raises(ValueError, match=message):
            PosingProblem(MESH, handles, domain=BOX)
    PosingProblem(MESH, masks.replacing("head", np.arange(n) > n - 5), domain=BOX)


def test_handles_on_one_line_are_refused() -> None:
    mesh = bar(4, 1, 1)
    edge = np.flatnonzero((mesh.vertices[:, 1] == 0) & (mesh.vertices[:, 2] == 0))
    with pytest.raises(ValueError, match="all handles lie on one line, so the shape could turn"):
        PosingProblem(mesh, Handles([edge[:2], edge[3:]]), domain=BOX)
    with pytest.raises(ValueError, match="all handles lie on one line"):
        PosingProblem(mesh, Handles([[0], [1]]), domain=BOX)
    PosingProblem(mesh, Handles([edge[:2], [edge[3] + 1]]), domain=BOX)  # a triangle holds it


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        (np.zeros(6), "parameters have shape (6,), but 2 moving handles need (12,)"),
        (np.zeros((1, 12)), "parameters have shape (1, 12)"),
        (np.r_[np.zeros(11), np.nan], "parameter 11, gamma of '"),
        (np.r_[np.inf, np.zeros(11)], "parameter 0, translation x of '"),
    ],
)
def test_wrong_parameters_are_refused(parameters: np.ndarray, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(f"PosingProblem: {message}")):
        PROBLEM.offsets(parameters)
    with pytest.raises(ValueError, match=re.escape(f"PosingProblem: {message}")):
        PROBLEM.value_and_gradient(MESH.vertices, parameters)
