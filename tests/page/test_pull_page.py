"""Any point of the surface is pulled, let go or kept, with real pointer events."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np

from .pages import OpenPage, Page


def window(page: Page, vertex: int) -> tuple[float, float]:
    """Where a vertex of the surface is in the window."""
    x, y = page.run(
        """(vertex) => {
            const { stage } = snapspace;
            const place = stage.camera.position.clone().fromArray(snapspace.shown(), 3 * vertex);
            place.applyMatrix4(stage.root.matrixWorld).project(stage.camera);
            const box = stage.renderer.canvas.getBoundingClientRect();
            const [width, height] = [box.width / 2, box.height / 2];
            return [box.left + (1 + place.x) * width, box.top + (1 - place.y) * height];
        }""",
        vertex,
    )
    return x, y


def free_vertex(page: Page) -> int:
    """A vertex of no handle, in front, that a press finds nowhere near a handle's marker."""
    owners = np.asarray(page.run("Array.from(snapspace.session.model.handleOfVertex)"))
    markers = np.array(
        page.run("snapspace.session.model.handles.map((_, k) => snapspace.handle(k))")
    )
    shown = page.shown()
    camera = np.asarray(
        page.run(
            "snapspace.stage.root.worldToLocal(snapspace.stage.camera.position.clone()).toArray()"
        )
    )
    nearest = np.argsort(np.linalg.norm(shown - camera, axis=1))
    for vertex in nearest:
        away = np.linalg.norm(markers - np.array(window(page, int(vertex))), axis=1)
        if owners[vertex] < 0 and away.min() > 40:
            return int(vertex)
    raise AssertionError("the bar has no such vertex")


def press_pull(page: Page, start: tuple[float, float], by: tuple[float, float]) -> Any:
    mouse = page.page.mouse
    mouse.move(*start)
    mouse.down()
    page.page.wait_for_timeout(100)  # the pulled model is made
    mouse.move(start[0] + by[0], start[1] + by[1], steps=4)
    page.settle()
    return mouse


def test_a_point_follows_the_pointer_and_goes_back(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri())
    page.page.get_by_role("radio", name="Pull").click()
    rest, motions = page.shown(), page.motions()
    vertex = free_vertex(page)
    start = window(page, vertex)
    mouse = press_pull(page, start, (25, -35))
    pulled = page.shown()
    seen = np.array(window(page, vertex)) - start
    assert seen[0] > 8 and seen[1] < -12, f"the point follows, {seen}"
    moved = np.linalg.norm(pulled - rest, axis=1)
    assert moved[vertex] > 0.7 * moved.max(), "it moves most"
    assert page.motions() == motions, "handles stay"
    mouse.up()
    page.page.wait_for_timeout(400)
    page.settle()
    np.testing.assert_allclose(page.shown(), rest, atol=1e-4 * np.abs(pulled - rest).max() + 1e-5)


def test_kept_points_hold_while_handles_move(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri())
    page.page.get_by_role("radio", name="Pull").click()
    page.page.get_by_role("button", name="Keep points").click()
    rest = page.shown()
    vertex = free_vertex(page)
    press_pull(page, window(page, vertex), (20, -25)).up()
    page.settle()
    kept = page.shown()
    assert np.abs(kept - rest).max() > 0.01
    entry = re.search(r"point%201:([^;]*)", page.page.url)
    assert entry is not None, "a model that has the point as a handle finds it in the address"
    shift = np.array(entry[1].split(","), float)
    np.testing.assert_allclose(shift[:3], 0.0)
    np.testing.assert_allclose(shift[3:], (kept - rest)[vertex], atol=0.05)
    page.drag(page.run("snapspace.handle(1)"), 20, 15)
    moved = np.linalg.norm(page.shown() - kept, axis=1)
    assert moved[vertex] < 0.3 * moved.max(), "the point stays where it was pulled to"
    page.page.get_by_role("button", name="Let go").click()
    page.page.wait_for_timeout(400)
    page.settle()
    assert np.linalg.norm(page.shown() - kept, axis=1)[vertex] > 0.005
    assert page.page.get_by_role("button", name="Let go").is_disabled()
    assert "point" not in page.page.url
