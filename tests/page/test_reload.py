"""A page that is loaded again goes on where it was: handles, names, pose, and what is computed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from snapspace import PosingModel, load, read_problem
from snapspace.generators import bar
from snapspace.mesh import write_tets

from .choosing_page import bar_with_ends, handles, press, set_number, tool, wait_for_text
from .pages import OpenPage, Page
from .serving import served
from .test_materials_page import make_part, parts
from .test_posing_page import assert_shown

BAR = bar(12, 4, 4, length=4.0, width=1.0, height=1.0)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("reload")
    write_tets(folder / "bar.mesh", BAR)
    return folder


@pytest.fixture(scope="module")
def address(folder: Path, chromium: object) -> Iterator[str]:
    with served(folder / "bar.mesh", cwd=folder) as address:
        yield address


def reload(page: Page, kind: str) -> None:
    page.page.reload()
    page.wait(f"snapspace.kind === '{kind}'")


def test_handles_computation_and_pose_are_there_again(
    address: str, folder: Path, opened: OpenPage
) -> None:
    page = bar_with_ends(opened, address)
    make_part(page, "Stiff", 0.3, 0.6)
    tool(page, "x up")
    page.page.get_by_label("Poisson's ratio").fill("0.4")
    set_number(page, "Samples, at most", 320)
    set_number(page, "Error of unseen motions, %", 0.01)
    chosen, made = handles(page), parts(page)
    reload(page, "choosing")
    assert re.search(r"[?&]workspace=[\w-]+", page.page.url)
    assert (handles(page), parts(page)) == (chosen, made)
    assert page.run("snapspace.stage.up") == "x"
    assert page.page.get_by_label("Poisson's ratio").input_value() == "0.4"
    assert page.page.locator("summary .told").inner_text().endswith("error 0.01 %")

    press(page, "Compute")
    page.wait("snapspace.kind === 'posing'")
    page.drag(page.run("snapspace.handle(1)"), 30, -30)
    pose = page.motions()[1]
    assert np.linalg.norm(pose[1]) > 0.02
    reload(page, "posing")
    for again, before in zip(page.motions()[1], pose, strict=True):
        assert again == pytest.approx(before, abs=1e-4)
    wait_for_text(page, "#panel", "improving")
    press(page, "Cancel")
    wait_for_text(page, "#panel", "Ready to pose:")
    assert "improving" not in page.text("#panel"), "nothing improves it any more"

    press(page, "Save")
    wait_for_text(page, "#panel", f"in {folder}")
    model = load(folder / "bar.snapspace")
    assert model.up == "x" and read_problem(folder / "bar.json").handles.names == ("foot", "head")
    press(page, "Choose handles")
    reload(page, "choosing")
    press(page, "Pose")  # there is no such button before the model has come
    page.wait("snapspace.kind === 'posing'")


def test_handles_are_chosen_on_the_body_of_a_model(
    posing_model: PosingModel, tmp_path: Path, opened: OpenPage, chromium: object
) -> None:
    model = posing_model.save(tmp_path / "given.snapspace")
    with served(model, cwd=tmp_path) as address:
        page = opened(address)
        press(page, "Choose handles")
        page.wait("snapspace.kind === 'choosing'")
        found = handles(page)
        for handle in posing_model.problem.handles:
            assert found[handle.name] == set(handle.vertices.tolist())
        assert page.text(".hud h1") == "given"
        page.page.close()


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
    page = opened(many_poses_page.as_uri() + "#blend=twist_1:0.25;arc-03:0.75")
    weights = page.run("snapspace.session.weights.filter((w) => w !== 0)")
    assert sorted(weights) == [0.25, 0.75]
