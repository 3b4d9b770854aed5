"""Blends beyond the poses in the page: how far sliders go, and the notices there."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from snapspace import InterpolationModel, InterpolationProblem, Poses
from snapspace.page import export_html

from ..conftest import interpolation_model
from ..shapes import bent, irregular_bar
from .pages import OpenPage, Page, Tabs

NOTICE = ".notice"


@pytest.fixture(scope="module")
def model() -> InterpolationModel:
    """A bar, bent, and blown up: between bodies of other sizes the range ends early."""
    mesh = irregular_bar(6, 2, 2)
    shapes = np.stack([mesh.vertices, bent(mesh, 1.2), mesh.vertices * [1.0, 1.9, 1.9]])
    problem = InterpolationProblem(Poses(shapes, mesh.tets, names=["rest", "bent", "thick"]))
    return interpolation_model(problem, 20, 8)


@pytest.fixture(scope="module")
def kept_page(
    model: InterpolationModel, tabs: Tabs, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Page]:
    path = export_html(model, tmp_path_factory.mktemp("beyond") / "poses.html")
    page = tabs.open(path.as_uri(), size=(900, 800))
    yield page
    tabs.close(page)


@pytest.fixture
def page(kept_page: Page) -> Page:
    """Equal weights, and sliders that go beyond; tests share the page."""
    beyond = kept_page.page.get_by_role("button", name="Beyond")
    if beyond.get_attribute("aria-pressed") != "true":
        beyond.click()
    kept_page.page.get_by_role("button", name="Mean").click()
    kept_page.settle()
    return kept_page


def fill(page: Page, name: str, weight: float) -> None:
    page.page.get_by_role("slider", name=name).fill(f"{weight:g}")
    page.settle()


def ends(page: Page, name: str) -> list[float]:
    slider = page.page.get_by_role("slider", name=name)
    return [float(slider.get_attribute(end)) for end in ("min", "max")]


def weights(page: Page) -> list[float]:
    page.settle()
    found: list[float] = page.run("snapspace.session.weights")
    return found


def test_sliders_end_where_the_certain_range_ends(model: InterpolationModel, page: Page) -> None:
    assert model.certain_range is not None
    limits = np.clip(model.certain_range.limits(), -1, 2)
    assert (limits[2] > -1).all() and (limits[2] < 2).all(), "neither is as far as sliders go"
    for name, (least, greatest) in zip(("rest", "bent", "thick"), limits, strict=True):
        shown = ends(page, name)
        assert least - 1e-6 < shown[0] < least + 0.01
        assert greatest - 0.01 < shown[1] < greatest + 1e-6
    shown = page.page.locator(".ends >> nth=2 >> span").all_inner_texts()
    assert shown == [f"{round(100 * end)} %" for end in ends(page, "thick")]


def test_a_blend_beyond_a_pose_is_that_of_the_session(
    model: InterpolationModel, page: Page
) -> None:
    fill(page, "bent", 1.2)
    assert np.allclose(weights(page), [-0.1, 1.2, -0.1])
    session = model.session()
    assert session.blend([-0.1, 1.2, -0.1], extrapolate=True).converged
    wanted = model.surface.vertices(session.vertices)
    assert np.abs(page.shown() - wanted).max() < 1e-3 * model.problem.mesh.diagonal
    assert page.text(NOTICE) == "Beyond what was sampled: rest, thick"
    assert page.page.locator(".dot.beyond").count() == 1


def test_a_notice_says_where_no_minimum_is_certain(model: InterpolationModel, page: Page) -> None:
    """Sliders end where the others share the rest evenly; with all of it on one it is too far."""
    certain = model.certain_range
    assert certain is not None
    fill(page, "bent", 2.0)
    fill(page, "thick", ends(page, "thick")[0])
    found = weights(page)
    assert not certain.holds(found)
    assert page.text(NOTICE) == "Too far: the energy may have no minimum"
    fill(page, "thick", 0.2)
    assert certain.holds(weights(page))
    assert not page.text(NOTICE).startswith("Too far")


def test_turning_beyond_off_removes_negative_weights(page: Page) -> None:
    fill(page, "bent", -0.3)
    assert np.allclose(weights(page), [0.65, -0.3, 0.65])
    page.page.get_by_role("button", name="Beyond").click()
    found = weights(page)
    assert np.allclose(found, [0.5, 0.0, 0.5])
    assert page.page.locator(".ends:visible").count() == 0
    assert page.page.locator(NOTICE).is_hidden()
    assert ends(page, "bent") == [0, 1]


def test_a_model_without_a_certain_range_stays_within_its_samples(
    blending_page: Path, opened: OpenPage
) -> None:
    """St.Venant-Kirchhoff, without negative samples."""
    page = opened(blending_page.as_uri())
    assert page.page.get_by_role("button", name="Beyond").count() == 0
