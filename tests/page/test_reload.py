"""A page that is reloaded has the same state: handles, names, pose, and the running computation."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from snapspace import InterpolationModel, PosingModel, load, read_problem

from ..server.in_process import started
from .choosing_page import (
    bar_with_ends,
    cancel,
    handles,
    press,
    saved_file,
    set_number,
    tool,
    wait_for_text,
    widen,
)
from .pages import OpenPage, Page
from .test_materials_page import make_part, parts
from .test_posing_page import assert_shown


def reload(page: Page, kind: str) -> None:
    page.page.reload()
    page.wait(f"snapspace.kind === '{kind}'")


def test_handles_computation_and_pose_are_there_again(
    bar_server: str, bar_folder: Path, opened: OpenPage
) -> None:
    page = bar_with_ends(opened, bar_server)
    make_part(page, "Stiff", 0.3, 0.6)
    tool(page, "x up")
    page.page.get_by_label("Poisson's ratio").fill("0.4")
    set_number(page, "Samples, at most", 640)
    set_number(page, "Error of unseen motions, %", 0.01)
    widen(page)
    chosen, made = handles(page), parts(page)
    page.page.wait_for_timeout(300)  # the page sends choices soon, not at once
    reload(page, "choosing")
    assert re.search(r"[?&]workspace=[\w-]+", page.page.url)
    assert (handles(page), parts(page)) == (chosen, made)
    assert page.run("snapspace.stage.up") == "x"
    assert page.page.get_by_label("Poisson's ratio").input_value() == "0.4"
    assert page.page.locator("summary .detail").inner_text().endswith("error 0.01 %")

    press(page, "Compute")
    page.wait("snapspace.kind === 'posing'")
    reload(page, "posing")
    wait_for_text(page, "#panel", "improving")
    cancel(page)
    wait_for_text(page, "#panel", "Ready to pose:")
    assert "improving" not in page.text("#panel"), "no computation improves it"
    page.drag(page.run("snapspace.handle(1)"), 30, -30)
    pose = page.motions()[1]
    assert np.linalg.norm(pose[1]) > 0.02
    reload(page, "posing")
    for again, before in zip(page.motions()[1], pose, strict=True):
        assert again == pytest.approx(before, abs=1e-4)

    press(page, "Save")
    wait_for_text(page, "#panel", f"in {bar_folder}")
    problem = bar_folder / saved_file(page)
    model = load(problem.with_suffix(".snapspace"))
    assert model.up == "x" and read_problem(problem).handles.names == ("foot", "head")
    press(page, "Choose handles")
    reload(page, "choosing")
    press(page, "Pose")  # the button appears once the model has come
    page.wait("snapspace.kind === 'posing'")


def test_handles_are_chosen_on_the_body_of_a_model(
    posing_model: PosingModel, tmp_path: Path, opened: OpenPage
) -> None:
    page = opened(started(model=posing_model, title="given", folder=tmp_path))
    press(page, "Choose handles")
    page.wait("snapspace.kind === 'choosing'")
    found = handles(page)
    for handle in posing_model.problem.handles:
        assert found[handle.name] == set(handle.vertices.tolist())
    assert page.text(".hud h1") == "given"


def test_handles_are_chosen_on_the_first_pose_of_a_blending_model(
    blending_model: InterpolationModel, bar_server: str, tmp_path: Path, opened: OpenPage
) -> None:
    model, page = blending_model.save(tmp_path / "poses.snapspace"), opened(bar_server)
    page.wait("snapspace.kind === 'choosing'")
    page.page.locator("footer input[type=file]").set_input_files(model)
    page.wait("snapspace.kind === 'interpolation'")
    press(page, "Choose handles")
    page.wait("snapspace.kind === 'choosing'")
    shape = page.numbers("snapspace.choosing.mesh.shape").reshape(-1, 3)
    first = blending_model.problem.poses.reference.vertices
    np.testing.assert_allclose(shape, first, atol=1e-6)
    assert handles(page) == {} and page.text(".hud h1") == "poses"
    reload(page, "choosing")
    assert page.text(".hud h1") == "poses", "the workspace keeps it"


def test_poses_of_exported_pages_are_in_the_address(
    posing_model: PosingModel,
    posing_page: Path,
    many_poses_page: Path,
    opened: OpenPage,
) -> None:
    page = opened(posing_page.as_uri())
    page.drag(page.run("snapspace.handle(1)"), 40, -30)
    pose = page.motions()[1][1]
    reload(page, "posing")
    assert page.motions()[1][1] == pytest.approx(pose, abs=1e-4)
    assert_shown(posing_model, page)
    press(page, "Reset")
    assert "#pose" not in page.page.url
    page.run("(location.hash = '#pose=head:0,0,0.2,0.1,0,0', null)")
    reload(page, "posing")
    head = posing_model.problem.handles.index("head")
    for handle, (euler, shift) in page.motions().items():
        wanted = [0, 0, 0.2, 0.1, 0, 0] if handle == head else np.zeros(6)
        assert [*euler, *shift] == pytest.approx(wanted, abs=1e-6), "others are at rest"
    page = opened(many_poses_page.as_uri() + "#blend=twist_1:0.25;arc-03:0.75")
    weights = page.run("snapspace.session.weights.filter((w) => w !== 0)")
    assert sorted(weights) == [0.25, 0.75]
