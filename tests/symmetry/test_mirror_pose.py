"""mirror_pose: a mirrored pose is the mirror image of the pose."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from snapspace import (
    MirrorPlane,
    PosingModel,
    PosingProblem,
    SolverOptions,
    TetMesh,
    mirror_handle,
    mirror_pose,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.problem import euler_of_rotation, rotation_matrix
from snapspace.session import PosingSession

from ..shapes import bar_problem
from .bodies import PLANE, body, one_ear, twins


@pytest.fixture(scope="module")
def problem() -> PosingProblem:
    return mirror_handle(one_ear(), "left ear", plane=PLANE)


#: Share of the displacement; 58 of the creature's 5019 tets are not mirror images of others.
CLOSE = 3e-3


def mirrored(parameters: np.ndarray, plane: MirrorPlane = PLANE) -> np.ndarray:
    """Parameters (k, p) with each motion mirrored."""
    motions = parameters.reshape(len(parameters), -1, 2, 3)
    turns = euler_of_rotation(plane.rotations(rotation_matrix(motions[:, :, 1])))
    return np.stack([plane.vectors(motions[:, :, 0]), turns], axis=2).reshape(parameters.shape)


def swapped(parameters: np.ndarray) -> np.ndarray:
    """Parameters (k, 12) of two handles, with the handles swapped."""
    return parameters.reshape(-1, 2, 6)[:, ::-1].reshape(parameters.shape)


@pytest.mark.parametrize("normal", [(0, 1, 0), (0.3, -0.5, 0.8)])
def test_full_solutions_of_the_mirrored_body_are_mirror_images(
    normal: tuple[float, float, float],
) -> None:
    """The mirror image of everything: mesh, handles and motions."""
    problem, plane = bar_problem(), MirrorPlane(normal, (0.1, 0.2, 0.3))
    mesh = TetMesh(plane.points(problem.mesh.vertices), problem.mesh.tets[:, [1, 0, 2, 3]])
    other = PosingProblem(
        mesh,
        problem.handles,
        domain=problem.domain,
        material=problem.material,
        stiffness=problem.stiffness,
    )
    some = sample(problem.domain, 3, seed=2)
    tight = SolverOptions(tolerance=1e-13)
    shapes, images = (
        np.asarray(solve_snapshots(each, parameters, options=tight, threads=1).displacements)
        for each, parameters in ((problem, some), (other, mirrored(some, plane)))
    )
    expected = plane.vectors(shapes.reshape(3, -1, 3))
    error = np.abs(images.reshape(expected.shape) - expected).max()
    assert error < 1e-5 * np.abs(expected).max()


def image(shape: np.ndarray) -> np.ndarray:
    """The mirror image of a shape of the creature, (n, 3)."""
    return np.asarray(PLANE.points(shape)[twins()])


@pytest.fixture(scope="module")
def model(problem: PosingProblem) -> PosingModel:
    """A subspace of pairs of mirror images, so that it is symmetric itself."""
    some = sample(problem.domain, 6, seed=3)
    pairs = np.concatenate([some, swapped(mirrored(some))])
    snapshots = solve_snapshots(problem, pairs, options=SolverOptions(tolerance=1e-10), threads=1)
    made = reduce(problem, snapshot_pca(snapshots, dimension=12), snapshots=snapshots)
    assert isinstance(made, PosingModel)
    shapes = np.asarray(snapshots.displacements) + body().vertices.reshape(-1)
    for one, other in zip(shapes[:6], shapes[6:], strict=True):  # full solutions
        error = np.abs(image(one.reshape(-1, 3)) - other.reshape(-1, 3)).max()
        assert error < CLOSE * np.abs(one - body().vertices.reshape(-1)).max()
    return replace(made, provenance={"mirror": PLANE.content})


def posed(model: PosingModel) -> PosingSession:
    session = model.session()
    for share in (0.5, 1.0):
        session.move("left ear", euler=(0.3 * share, 0.2, -0.4 * share), translation=(0.1, 0, 0.05))
    session.move("right ear", translation=(0, -0.1, 0.1))
    return session


def test_it_is_the_mirror_image_of_the_shape(model: PosingModel) -> None:
    """The plane is found."""
    session = posed(replace(model, provenance={}))
    before = session.vertices
    assert mirror_pose(session).status == "converged"
    size = np.abs(before - body().vertices).max()
    assert np.abs(session.vertices - image(before)).max() < CLOSE * size
    assert np.abs(before - image(before)).max() > 0.2 * size


def test_mirroring_twice_gives_the_pose_itself(model: PosingModel) -> None:
    session = posed(model)
    motions, shape = session.motions, session.vertices
    mirror_pose(session)
    assert session.motions["right ear"][1] == pytest.approx([0.1, 0, 0.05])
    mirror_pose(session)
    for name, (turn, shift) in session.motions.items():
        np.testing.assert_allclose(turn, motions[name][0], atol=1e-14)
        np.testing.assert_allclose(shift, motions[name][1], atol=1e-14)
    assert np.abs(session.vertices - shape).max() < 1e-4


def test_the_first_handle_carries_the_mirror_image(model: PosingModel) -> None:
    session = posed(model)
    session.move("feet", euler=(0.2, 0.1, 0.5), translation=(0.3, 0.2, 0.1))
    before = session.vertices
    mirror_pose(session)
    size = np.abs(before - body().vertices).max()
    assert np.abs(session.vertices - image(before)).max() < CLOSE * size


def test_the_plane_is_the_given_one_or_that_of_the_record(model: PosingModel) -> None:
    session = posed(replace(model, provenance={"mirror": {"normal": [1, 0, 0]}}))
    with pytest.raises(ValueError, match="'left ear' has no counterpart across the mirror plane"):
        mirror_pose(session)
    before = session.motions
    mirror_pose(session, plane=PLANE)
    assert session.motions["right ear"][1] == pytest.approx(before["left ear"][1])
    for damaged in ({"normal": [0, 0, 0]}, {"axis": 1}, "x", None):
        assert replace(model, provenance={"mirror": damaged}).mirror_plane is None
    assert replace(model, provenance={"mirror": PLANE.content}).mirror_plane == PLANE


def test_handles_at_affine_maps_are_refused(model: PosingModel) -> None:
    session = model.session()
    session.move_affine("left ear", 1.1 * np.eye(3, 4))
    with pytest.raises(ValueError, match="'right ear' is a matrix that is not a rotation"):
        mirror_pose(session)
    assert session.motions["right ear"][0].tolist() == np.eye(3).tolist()


def test_a_far_plane_is_refused(model: PosingModel) -> None:
    with pytest.raises(ValueError, match="'feet' has no counterpart"):
        mirror_pose(model.session(), plane=MirrorPlane((0, 1, 0), (0, 50, 0)))
