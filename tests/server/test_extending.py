"""Kept points become handles of models that the server computes from the newest one."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from snapspace import (
    HandleBox,
    Handles,
    PosingModel,
    PosingProblem,
    StableNeoHookean,
    growing_models,
    load,
    read_problem,
    with_handles,
)
from snapspace.generators import bar
from snapspace.mesh import TetMesh, boundary_surface
from snapspace.server import messages as m
from snapspace.server.body import Body
from snapspace.server.kept_points import RADIUS, with_points
from snapspace.server.message_parts import KeptPoint
from snapspace.server.settings import ServerSettings
from snapspace.server.shared_body import SharedBody
from snapspace.server.workspace import Workspace
from snapspace.validation import solved_reference, unseen_errors

from ..shapes import bar_problem
from .test_workspace import PATIENCE, Mailbox

ORDER = m.Compute(request=1, target_error=0.05, most_samples=60, seed=0, stiffness=1000.0)


def bar_with_ends() -> PosingProblem:
    """A bar with the handles foot and head, whose middle can be pulled."""
    mesh = bar(8, 2, 2, length=4.0)
    x = mesh.vertices[:, 0]
    return PosingProblem(
        mesh,
        Handles([x < 0.1, x > 3.9], names=["foot", "head"]),
        domain=HandleBox(translation=0.4, angle=0.5),
        material=StableNeoHookean(),
    )


def point_near(place: list[float], mesh: TetMesh, *, name: str = "point 1") -> KeptPoint:
    """The middle of the triangle that is nearest to a place, pulled down."""
    surface = boundary_surface(mesh)
    centers = surface.vertices(mesh.vertices)[surface.faces].mean(axis=1)
    face = surface.faces[np.argmin(np.linalg.norm(centers - place, axis=1))]
    third = 1 / 3
    return KeptPoint(
        name=name,
        corners=tuple(face.tolist()),
        shares=(third, third, 1 - 2 * third),
        reach=(0.0, 0.1, -0.9),
    )


def middle(problem: PosingProblem) -> KeptPoint:
    """A point on top of the bar's middle."""
    return point_near([2.0, 0.4, 1.0], problem.mesh)


def settings_of(folder: Path, problem: PosingProblem) -> ServerSettings:
    body = Body(name="bar", mesh=problem.mesh, file=None, folder=folder, problem=problem)
    return ServerSettings(
        title="bar",
        up="z",
        token="t",
        folder=folder,
        scratch=folder,
        body=SharedBody(lambda _: body),
    )


class Opened:
    """A workspace and its messages."""

    def __init__(self, settings: ServerSettings) -> None:
        self.mailbox = Mailbox()
        self.workspace = Workspace(settings, self.mailbox.put)
        self.workspace.open()

    def last(self, message: type) -> m.ServerMessage:
        found = [one for one in self.mailbox.messages if isinstance(one, message)]
        return found[-1]  # type: ignore[no-any-return]

    @property
    def model(self) -> PosingModel:
        newest = self.workspace._models.newest
        assert newest is not None and isinstance(newest.model, PosingModel)
        return newest.model

    def do(self, order: m.PageMessage, answer: type, **fields: object) -> None:
        self.workspace.receive(order)
        self.mailbox.wait_for(answer, request=order.request, **fields)


@pytest.fixture(scope="module")
def start() -> PosingModel:
    return next(growing_models(bar_with_ends())).model  # type: ignore[return-value]


@pytest.fixture
def opened(tmp_path: Path, start: PosingModel) -> Iterator[Opened]:
    """A page with the server's own model of the bar."""
    settings = settings_of(tmp_path, start.problem)
    opened = Opened(replace(settings, body=None, model=start))
    yield opened
    opened.workspace.close()


def test_a_kept_point_becomes_a_handle_and_its_frames_come_nearer(tmp_path: Path) -> None:
    opened = Opened(settings_of(tmp_path, bar_with_ends()))
    opened.mailbox.wait_for(m.Workspace, kind="mesh")
    opened.do(ORDER, m.Model, final=True)
    old = opened.model
    opened.do(m.Extend(request=2, points=(middle(old.problem),)), m.Model, number=3, final=False)
    sent = opened.last(m.Model)
    assert isinstance(sent, m.Model)
    (kept,) = sent.kept
    assert kept.name == "point 1" and kept.moving
    assert kept.translation == pytest.approx((0.4, 0.4, 0.9)), "as far as it was pulled"
    assert kept.angle == pytest.approx((0.5, 0.5, 0.5))
    opened.mailbox.wait_for(m.Model, request=2, final=True)
    new = opened.model
    assert new.problem.handles.names == ("foot", "head", "point 1")
    assert new.problem.handles["point 1"].vertices.tolist() == list(kept.vertices)
    reference = solved_reference(new.problem, samples=8)
    before, after = (
        float(np.median(unseen_errors(model, reference)))
        for model in (with_handles(old, new.problem), new)
    )
    assert after < 0.2 * before, (before, after)
    content = opened.workspace.model_content(3)
    assert content is not None and b'"from_before"' in content, "the shape continues smoothly"

    opened.do(m.Save(request=3), m.Saved)
    saved = opened.last(m.Saved)
    assert isinstance(saved, m.Saved) and saved.problem is not None and saved.model is not None
    assert read_problem(saved.problem).fingerprint == new.problem.fingerprint
    model = load(saved.model)
    assert model.dimension == new.dimension and model.problem.handles.names[-1] == "point 1"
    opened.workspace.close()


def test_points_that_cannot_be_handles_are_refused_and_work_continues(
    opened: Opened, start: PosingModel
) -> None:
    point = middle(start.problem)
    corner = int(start.surface.vertices(start.subspace.tau)[:, 0].argmin())
    for wrong, words in (
        (replace(point, name="head"), "already a handle named 'head'"),
        (replace(point, corners=(0, 1, 100_000)), "three vertices of the surface"),
        (replace(point, corners=(0, 1)), "three vertices of the surface"),
        (replace(point, shares=(1.0, 1.0, 1.0)), "sum to one"),
        (replace(point, corners=(corner,) * 3), "pull a point farther from other handles"),
    ):
        opened.do(m.Extend(request=7, points=(wrong,)), m.Failed)
        failed = opened.last(m.Failed)
        assert isinstance(failed, m.Failed) and words in failed.message
        opened.mailbox.messages.clear()
    opened.do(m.Extend(request=8, points=(point,)), m.Progress)
    opened.do(m.Extend(request=9, points=()), m.Failed)
    assert opened.workspace._jobs.working


def test_a_cancelled_point_leaves_the_handles_as_they_were(
    opened: Opened, start: PosingModel
) -> None:
    opened.do(m.Extend(request=2, points=(middle(start.problem),)), m.Progress)
    opened.do(m.Cancel(request=3), m.Cancelled)
    opened.do(m.Save(request=4), m.Saved)
    saved = opened.last(m.Saved)
    assert isinstance(saved, m.Saved) and saved.problem is not None and saved.model is not None
    assert read_problem(saved.problem).handles.names == start.problem.handles.names
    assert load(saved.model).dimension == start.dimension


def test_a_second_point_is_added_to_the_newest_model(opened: Opened, start: PosingModel) -> None:
    mesh = start.problem.mesh
    opened.do(m.Extend(request=1, points=(middle(start.problem),)), m.Model)
    assert opened.model.problem.handles.names == ("foot", "head", "point 1")
    second = point_near([1.2, 0.4, 0.0], mesh, name="point 2")
    opened.do(m.Extend(request=2, points=(second,)), m.Model)
    assert opened.model.problem.handles.names == ("foot", "head", "point 1", "point 2")
    opened.do(m.Save(request=3), m.Saved)
    saved = opened.last(m.Saved)
    assert isinstance(saved, m.Saved) and saved.model is not None
    assert load(saved.model).problem.handles.names[-1] == "point 2"
    resumed = Mailbox()
    opened.workspace.resume(resumed.put)
    workspace = resumed.messages[0]
    assert isinstance(workspace, m.Workspace) and (workspace.job, workspace.has_model) == (2, True)


def test_without_a_model_there_is_nothing_to_improve(tmp_path: Path) -> None:
    opened = Opened(settings_of(tmp_path, bar_with_ends()))
    opened.mailbox.wait_for(m.Workspace, kind="mesh")
    opened.do(m.Extend(request=1, points=(middle(bar_with_ends()),)), m.Failed)
    failed = opened.last(m.Failed)
    assert isinstance(failed, m.Failed) and "compute one first" in failed.message
    opened.workspace.close()


def test_materials_without_unique_solutions_begin_anew(tmp_path: Path) -> None:
    """St.Venant-Kirchhoff cannot start from another model; its point becomes a handle even so."""
    problem = bar_problem()
    opened = Opened(settings_of(tmp_path, problem))
    opened.mailbox.wait_for(m.Workspace, kind="mesh")
    opened.do(replace(ORDER, most_samples=20), m.Model, final=True)
    point = replace(middle(problem), reach=(0.0, 0.0, 0.1))
    opened.do(m.Extend(request=2, points=(point,)), m.Model)
    assert opened.model.problem.handles.names[-1] == "point 1"
    opened.workspace.close()


def two_legs() -> TetMesh:
    """Two legs along x, nearer to each other than the radius of a handle, joined at one end."""
    whole = bar(40, 6, 1, length=10.0, width=0.6, height=0.1)
    x, y, _ = whole.vertices[whole.tets].mean(axis=1).T
    tets = whole.tets[(np.abs(y - 0.3) > 0.1) | (x > 9.5)]
    used, corners = np.unique(tets, return_inverse=True)
    return TetMesh(whole.vertices[used], corners.reshape(-1, 4))


def test_a_handle_around_a_point_stays_on_its_part() -> None:
    mesh = two_legs()
    x = mesh.vertices[:, 0]
    problem = PosingProblem(
        mesh,
        Handles([x < 0.1, x > 9.9], names=["foot", "head"]),
        domain=HandleBox(translation=((0.4, 0.1, 0.2),), angle=((0.5, 0.5, 0.5),)),
    )
    surface, other = boundary_surface(mesh), mesh.vertices[:, 1] > 0.3
    point = replace(point_near([5, 0.2, 0.05], mesh, name="knee"), reach=(0.0, 0.0, 0.0))
    extended = with_points(problem, surface, [point])
    knee = extended.handles["knee"].vertices
    assert not other[knee].any(), "the other leg is near, but not connected"
    place = surface.vertices(mesh.vertices)[list(point.corners)].mean(axis=0)
    away = np.linalg.norm(mesh.vertices[knee] - place, axis=1)
    assert len(knee) >= 3 and away.max() <= RADIUS * mesh.diagonal
    near = np.linalg.norm(mesh.vertices - place, axis=1) <= RADIUS * mesh.diagonal
    assert near[other].any(), "else the test would show nothing"
    np.testing.assert_allclose(extended.domain.bounds[1], extended.domain.bounds[0])


def test_the_lock_is_free_while_the_point_waits(opened: Opened, start: PosingModel) -> None:
    """Another page computes: the order waits for its turn, and the page is still answered."""
    entered, release = threading.Event(), threading.Event()

    def occupy() -> None:
        with opened.workspace._settings.queue.turn(lambda _: None):
            entered.set()
            assert release.wait(PATIENCE)

    thread = threading.Thread(target=occupy)
    thread.start()
    assert entered.wait(PATIENCE)
    order = m.Extend(request=2, points=(middle(start.problem),))
    opened.do(order, m.Progress, stage="waiting")
    opened.do(m.Save(request=3), m.Saved)
    release.set()
    thread.join()
