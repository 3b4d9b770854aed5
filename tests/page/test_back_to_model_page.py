"""From choosing handles on a model's body, the page returns to the model as it was."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace import InterpolationModel, PosingModel

from ..server.in_process import started
from .choosing_page import cancel, compute, handles, press, wait_for_text
from .pages import OpenPage, Page

KEYS = "snapspace.timeline.timeline.keys.length"


def posed(page: Page) -> None:
    """Moves the first handle that moves, and makes a key."""
    page.drag(page.run("snapspace.handle(1)"), 30, -20)
    assert np.linalg.norm(page.motions()[1][1]) > 0.02
    press(page, "Add key")


def choose(page: Page) -> None:
    press(page, "Choose handles")
    page.wait("snapspace.kind === 'choosing'")


def back(page: Page) -> None:
    press(page, "Pose")
    page.wait("snapspace.kind === 'posing'")


def ranges(page: Page, *, travel: float, degrees: float) -> None:
    """Types the common ranges of the handles."""
    page.page.locator("summary").click()
    for label, value in (("Travel", travel), ("Turn", degrees)):
        page.page.get_by_label(f"{label}, plus or minus").last.fill(str(value))


def assert_as_left(page: Page, motions: dict[int, tuple[list[float], list[float]]]) -> None:
    for handle, motion in page.motions().items():
        np.testing.assert_allclose(np.concatenate(motion), np.concatenate(motions[handle]))
    assert page.run(KEYS) == 1


@pytest.fixture(scope="module")
def folder(posing_model: PosingModel, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("given")
    posing_model.save(folder / "given.snapspace")
    return folder


@pytest.fixture(scope="module")
def given(folder: Path, posing_model: PosingModel) -> str:
    """The address of a server that has the model."""
    return started(model=posing_model, title="given", folder=folder)


def test_the_servers_model_is_posed_again(
    given: str, posing_model: PosingModel, opened: OpenPage
) -> None:
    page = opened(given)
    posed(page)
    motions = page.motions()
    choose(page)
    back(page)
    assert_as_left(page, motions)
    assert page.run("snapspace.session.model.dimension") == posing_model.dimension
    press(page, "Save")
    wait_for_text(page, "#panel", "Saved given-2.json, given-2.snapspace")

    choose(page)
    page.page.reload()
    page.wait("snapspace.kind === 'choosing'")
    back(page)
    page.page.reload()
    page.wait("snapspace.kind === 'posing'")


def test_a_model_stays_if_there_is_none_of_other_handles(given: str, opened: OpenPage) -> None:
    page, other = opened(given), opened(given)
    choose(page)
    ranges(page, travel=0.0, degrees=0.0)
    press(page, "Compute")
    wait_for_text(page, ".fault", "All bounds are zero")
    back(page)

    choose(other)
    ranges(other, travel=0.5, degrees=120.0)
    compute(other, most_samples=20_000, percent=0.01)
    other.wait("snapspace.kind === 'posing'")  # the first model, which others follow
    choose(page)
    ranges(page, travel=0.5, degrees=90.0)
    press(page, "Compute")
    wait_for_text(page, "#panel", "Waiting for another computation")
    assert page.page.get_by_role("button", name="Pose", exact=True).is_hidden()
    cancel(page)
    cancel(other)
    back(page)


def test_a_model_that_was_dropped_is_posed_again(
    folder: Path, bar_server: str, opened: OpenPage
) -> None:
    page = opened(bar_server)
    page.wait("snapspace.kind === 'choosing'")
    page.page.locator("footer input[type=file]").set_input_files(folder / "given.snapspace")
    page.wait("snapspace.kind === 'posing'")
    posed(page)
    motions = page.motions()
    choose(page)
    assert len(handles(page)) == len(motions)
    back(page)
    assert_as_left(page, motions)


def test_a_model_of_poses_is_blended_again(
    blending_model: InterpolationModel, tmp_path: Path, opened: OpenPage
) -> None:
    names, weights = blending_model.problem.poses.names, (0.5, 0.3, 0.2)
    blend = ";".join(f"{name}:{weight}" for name, weight in zip(names, weights, strict=True))
    address = started(model=blending_model, title="poses", folder=tmp_path)
    page = opened(f"{address}#blend={blend}")
    press(page, "Add key")
    shape = page.shown()
    choose(page)
    assert page.page.get_by_role("button", name="Pose", exact=True).count() == 0
    assert page.page.get_by_role("button", name="Save handles").is_hidden()
    press(page, "Blend")
    page.wait("snapspace.kind === 'interpolation'")
    np.testing.assert_allclose(page.run("snapspace.session.weights"), weights)
    np.testing.assert_allclose(page.shown(), shape, atol=1e-4)
    assert page.run(KEYS) == 1
    choose(page)
