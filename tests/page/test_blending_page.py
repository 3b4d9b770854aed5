"""The exported page of an interpolation model, in a browser."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from snapspace import InterpolationModel, StableNeoHookean, export_html

from ..shells.strips import blended_strips
from .pages import OpenPage, Page


def assert_shown(model: InterpolationModel, page: Page) -> None:
    """Both shapes are those of the weights that the page has."""
    shown, straight = page.shown(), page.shown("straight")
    weights = page.numbers("snapspace.session.weights")
    weights = weights / weights.sum()
    session = model.session()
    session.blend(weights)
    close = 1e-4 * model.problem.mesh.diagonal
    assert np.abs(shown - model.surface.vertices(session.vertices)).max() < close
    linear = model.surface.vertices(model.problem.linear_blend(weights))
    assert np.abs(straight - linear).max() < close


def test_sliders_and_polygon_blend(
    blending_model: InterpolationModel, blending_page: Path, opened: OpenPage
) -> None:
    page = opened(blending_page.as_uri())
    assert_shown(blending_model, page)
    names = blending_model.problem.poses.names
    page.page.get_by_role("slider", name=names[1]).fill("0.6")
    page.settle()
    weights = page.run("snapspace.session.weights")
    assert np.allclose(weights, [0.2, 0.6, 0.2])
    assert_shown(blending_model, page)

    box = page.page.locator(".polygon").bounding_box()
    start = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.drag(start, 0, -40)
    weights = page.run("snapspace.session.weights")
    assert np.isclose(sum(weights), 1) and weights[0] == max(weights)
    outline = "getComputedStyle(document.activeElement).outlineStyle"
    assert page.run("document.activeElement.classList.contains('polygon')")
    assert page.run(outline) == "none", "a press draws no frame"
    page.page.keyboard.press("Tab")
    page.page.keyboard.press("Shift+Tab")
    assert page.run(outline) == "solid", "the keyboard shows where it is"
    assert_shown(blending_model, page)
    mouse = page.page.mouse
    mouse.move(*start)
    mouse.down()
    mouse.move(start[0] + 20, start[1] + 20, steps=2)
    page.settle()
    assert not np.allclose(page.run("snapspace.session.weights"), weights)
    page.page.keyboard.press("Escape")
    page.settle()
    assert np.allclose(page.run("snapspace.session.weights"), weights), "the drag is cancelled"
    mouse.move(start[0] - 20, start[1], steps=2)
    mouse.up()
    page.settle()
    assert np.allclose(page.run("snapspace.session.weights"), weights), "it stays cancelled"
    page.page.locator(".corner").nth(2).click()
    page.settle()
    assert page.run("snapspace.session.weights") == [0, 0, 1]
    assert_shown(blending_model, page)


def test_surfaces_blend_also_from_files_that_are_dropped(tmp_path: Path, opened: OpenPage) -> None:
    rigid, hinged = blended_strips(), blended_strips(StableNeoHookean())
    page = opened(export_html(rigid, tmp_path / "strips.html").as_uri())
    addresses: set[str] = set()
    for name, model in (("page", rigid), ("rigid", rigid), ("hinged", hinged)):
        if name != "page":
            file = model.save(tmp_path / f"{name}.snapspace")
            page.page.locator("footer input[type=file]").set_input_files(file)
            page.wait(f"document.title.includes({name!r})")
        page.rest()
        assert_shown(model, page)
        for slider, weight in ((0, "0.1"), (1, "0.6" if name == "page" else "0.7")):
            page.page.get_by_role("slider", name=model.problem.poses.names[slider]).fill(weight)
            page.rest()
            assert_shown(model, page)
        if name == "page":
            page.wait_for(lambda: "0.6" in page.page.url, "the blend is in the address")
        page.page.wait_for_timeout(300)  # an address is written after a pause
        addresses.add(page.page.url)
    assert len(addresses) == 1, "the address is of the page's own model"


def test_a_path_plays_beside_the_straight_blend(
    blending_model: InterpolationModel, blending_page: Path, opened: OpenPage
) -> None:
    page = opened(blending_page.as_uri())
    page.page.get_by_role("button", name="Compare").click()
    page.settle()
    assert page.text(".tag >> nth=0") == "elastic" and page.text(".tag >> nth=1") == "straight"
    play = page.page.get_by_role("button", name="Play", exact=True)
    play.click()
    seen = []
    for _ in range(6):
        page.settle()
        seen.append(page.run("snapspace.session.weights"))
    play.click()
    assert len({tuple(weights) for weights in seen}) > 3, "it moves"
    assert_shown(blending_model, page)
    page.wait(
        "[...document.querySelectorAll('.corner image')].every((i) => i.getAttribute('href'))"
    )
