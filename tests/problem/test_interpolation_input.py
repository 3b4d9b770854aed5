"""Input of an interpolation problem: refused, distinguished, or accepted on request."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    InterpolationProblem,
    Poses,
    SolverOptions,
    StableNeoHookean,
    StVK,
    TetMesh,
    solve_snapshots,
)
from snapspace.mesh import tet_volumes
from snapspace.registration import rigid_registration

from ..shapes import bar_poses, bar_problem, bent, deformed, interpolation_problem, irregular_bar

FloatArray = NDArray[np.float64]
PROBLEM = interpolation_problem()
POSES = PROBLEM.poses
MESH = PROBLEM.mesh
SHAPE = PROBLEM.base


def not_finite() -> FloatArray:
    shape = SHAPE.copy()
    shape[5] = np.nan
    return shape


BAD: list[tuple[Callable[[], Any], str]] = [
    (lambda: InterpolationProblem([MESH]), "Poses: got 1 pose, but at least two are needed"),
    (
        lambda: InterpolationProblem([MESH, irregular_bar(7, 2, 2)]),
        "Poses: pose 1: has 72 vertices, but pose 0 has 81",
    ),
    (
        lambda: InterpolationProblem([MESH, MESH.vertices]),  # type: ignore[list-item]
        "InterpolationProblem: pose 1 is a ndarray, but each must be a TetMesh or ShellMesh",
    ),
    (
        lambda: InterpolationProblem(POSES, extrapolation=-0.1),
        "Simplex: extrapolation is -0.1, but it must be zero or positive",
    ),
    (
        lambda: InterpolationProblem(POSES, mean_shape=SHAPE[3:]),
        "InterpolationProblem: the mean shape has 240 coordinates, but the mesh has 81 vertices",
    ),
    (
        lambda: InterpolationProblem(POSES, mean_shape=not_finite()),
        "InterpolationProblem: the mean shape has a coordinate that is not finite",
    ),
    (
        lambda: PROBLEM.value_and_gradient(SHAPE[3:], np.ones(3)),
        "InterpolationProblem: the shape has 240 coordinates, but the mesh has 81 vertices",
    ),
    (
        lambda: InterpolationProblem(POSES, mean_shape=SHAPE.reshape(-1, 3).T),
        "InterpolationProblem: the mean shape has shape (3, 81), but must be (81, 3), one row per",
    ),
    (
        lambda: InterpolationProblem(POSES, material=""),  # type: ignore[arg-type]
        "InterpolationProblem: material is '' of type str, but it must be one of ",
    ),
    (
        lambda: PROBLEM.value_and_gradient(SHAPE.reshape(-1, 3).T, np.ones(3)),
        "InterpolationProblem: the shape has shape (3, 81), but must be (81, 3), one row per",
    ),
    (
        lambda: PROBLEM.value_and_gradient(SHAPE, np.ones(2)),
        "InterpolationProblem: weights have shape (2,), but must be (3,), one per pose",
    ),
    (
        lambda: PROBLEM.weights([0.5, 0.5]),
        "InterpolationProblem: 3 poses need 3 weights, got 2",
    ),
    (
        lambda: PROBLEM.weights([0.5, 0.6, 0.0]),
        "InterpolationProblem: the weights sum to 1.1, but they must sum to 1",
    ),
    (
        lambda: PROBLEM.weights([1.1, -0.1, 0.0]),
        "InterpolationProblem: weight 1 is -0.1, but none may be below 0",
    ),
    (
        lambda: PROBLEM.weights([np.nan, 0.5, 0.5], extrapolate=True),
        "InterpolationProblem: weight 0 is nan, but it must be finite",
    ),
]


@pytest.mark.parametrize(("call", "message"), BAD)
def test_bad_input_is_refused(call: Callable[[], Any], message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)) as caught:
        call()
    assert "\n" not in str(caught.value)


def test_shapes_that_a_problem_keeps_cannot_be_changed_in_place() -> None:
    posing = bar_problem()
    given = InterpolationProblem(POSES, mean_shape=SHAPE)
    kept = (PROBLEM.tau, PROBLEM.pose_shapes, given.tau, posing.tau)
    for array in (*kept, posing.centroids, posing.pinned, posing.pin_weights):
        with pytest.raises(ValueError, match="read-only"):
            array += 1


def test_weights_beyond_the_simplex_are_taken_on_request_or_in_a_larger_domain() -> None:
    beyond = np.array([1.1, -0.05, -0.05])
    assert np.array_equal(PROBLEM.weights(beyond, extrapolate=True), beyond)
    larger = InterpolationProblem(POSES, extrapolation=0.2)
    assert np.array_equal(larger.weights(beyond), beyond)
    assert np.array_equal(larger.inputs(beyond[None]), beyond[None])
    with pytest.raises(ValueError, match=r"weight 2 is -0\.1, but none may be below -0\.0666667"):
        larger.weights([1.1, 0.0, -0.1])


def nudged(pose: int) -> Poses:
    """The poses, with one coordinate of one pose moved to the next floating-point number."""
    shapes = POSES.shapes.copy()
    shapes[pose, 7, 1] = np.nextafter(shapes[pose, 7, 1], np.inf)
    return Poses(shapes, POSES.tets)


def fewer_tets() -> Poses:
    used = np.unique(POSES.tets[:-1])
    assert len(used) == len(MESH.vertices)
    return Poses(POSES.shapes, POSES.tets[:-1])


def fingerprint(poses: Poses = POSES, **options: Any) -> str:
    return InterpolationProblem(poses, **options).fingerprint


def test_the_fingerprint_depends_on_all_that_solutions_depend_on() -> None:
    reordered = Poses(POSES.shapes[[0, 2, 1]], POSES.tets)
    prints = [
        fingerprint(),
        *(fingerprint(nudged(pose)) for pose in range(3)),
        fingerprint(reordered),
        fingerprint(Poses(POSES.shapes[:2], POSES.tets)),
        fingerprint(fewer_tets()),
        fingerprint(material=StVK(lam=1.0, mu=0.999)),
        fingerprint(material=StVK(lam=1.001, mu=1.0)),
        fingerprint(extrapolation=0.1),
    ]
    assert len(set(prints)) == len(prints)
    assert all(re.fullmatch("[0-9a-f]{64}", one) for one in prints)


def test_the_fingerprint_depends_on_nothing_else() -> None:
    renamed = Poses(POSES.shapes, POSES.tets, names=["a", "b", "c"], accept_inverted=True)
    assert (
        fingerprint(renamed) == fingerprint(bar_poses()) == fingerprint(material=StableNeoHookean())
    )


@pytest.fixture(scope="module")
def inverted() -> InterpolationProblem:
    """A bent bar with one corner pushed through its tets."""
    mesh = irregular_bar(6, 2, 2)
    pose = bent(mesh, 0.8)
    corner = int(np.argmax(mesh.vertices.sum(axis=1)))
    touching = (mesh.tets == corner).any(axis=1)
    inside = pose[np.unique(mesh.tets[touching])].mean(axis=0)
    pose[corner] += 3.0 * (inside - pose[corner])
    shapes = np.stack([mesh.vertices, pose])
    with pytest.raises(ValueError, match=r"Poses: pose 1: \d+ of 144 tets are inverted"):
        Poses(shapes, mesh.tets)
    poses = Poses(shapes, mesh.tets, accept_inverted=True)
    assert 0 < poses.inverted_tets[1] <= touching.sum()
    return InterpolationProblem(poses, material=StVK())


def test_inverted_rest_tets_have_energies_above_zero(inverted: InterpolationProblem) -> None:
    """The energy of a tet that is inverted at rest is that of its mirror image."""
    turned = inverted.poses.volumes[1] < 0
    rest = inverted.poses.shapes[1]
    for seed in range(5):
        x = deformed(TetMesh(inverted.poses.shapes[0], inverted.poses.tets), 0.5, seed=seed)
        assert inverted.value_and_gradient(x, [0.0, 1.0])[0] > 0.0
        expected = 0.0
        for tet, swap in zip(inverted.poses.tets, turned, strict=True):
            corners = tet[[1, 0, 2, 3]] if swap else tet
            E = _strain(rest[corners], x.reshape(-1, 3)[corners])
            volume = abs(float(tet_volumes(rest, tet[None])[0]))
            expected += volume * float((E**2).sum() + 0.5 * np.trace(E) ** 2)
        value, _ = inverted.value_and_gradient(x, [0.0, 1.0])
        assert value == pytest.approx(expected, rel=1e-10)


def _strain(rest: FloatArray, now: FloatArray) -> FloatArray:
    F = (now[1:] - now[0]).T @ np.linalg.inv((rest[1:] - rest[0]).T)
    E: FloatArray = (F.T @ F - np.eye(3)) / 2
    return E


def test_one_hot_gives_back_an_inverted_pose(inverted: InterpolationProblem) -> None:
    options = SolverOptions(tolerance=1e-12, max_iterations=5000)
    solved = solve_snapshots(inverted, [[0.0, 1.0]], options=options, threads=1)
    assert solved.converged.all()
    others, _ = inverted.value_and_gradient(inverted.pose_shapes[1], [1.0, 0.0])
    assert abs(solved.reports[0].value) < 1e-12 * others
    assert solved.reports[0].inverted_tets == inverted.poses.inverted_tets[1]
    assert solved.shapes[0] == pytest.approx(inverted.pose_shapes[1], abs=1e-9)
    assert (inverted.mass().data > 0).all(), "an inverted tet has mass as well"


def test_a_pose_that_is_a_mirror_image_is_never_turned_back() -> None:
    """All its tets are inverted, and stay so because registration is rigid."""
    mesh = irregular_bar(6, 2, 2)
    mirror = bent(mesh, 0.8) * [1.0, 1.0, -1.0]
    poses = Poses(np.stack([mesh.vertices, mirror]), mesh.tets, accept_inverted=True)
    assert poses.inverted_tets[1] == len(mesh.tets)
    problem = InterpolationProblem(poses)
    volumes = tet_volumes(problem.pose_shapes[1].reshape(-1, 3), mesh.tets)
    assert volumes == pytest.approx(poses.volumes[1], rel=1e-9)
    motion = rigid_registration(mirror.reshape(-1), problem.pose_shapes[1], problem.mass())
    assert motion.apply(mirror.reshape(-1)) == pytest.approx(problem.pose_shapes[1], abs=1e-12)
