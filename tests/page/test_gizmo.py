"""Arrows, squares and rings of the gizmo: what is held stays below the pointer."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace.problem.motion import rotation_matrix

from .pages import OpenPage, Page
from .test_interaction import UNDO

ACTIVE = "#ffd23f"
#: The gizmo's own lengths, see web/ui/gizmo_parts.ts.
ON_ARROW, ON_SQUARE, ON_RING, ON_VIEW_RING = 0.6, 0.38, 0.85, 1.05

#: Where points are in the window that are given in the gizmo's axes and lengths.
WINDOW = """(points) => {
  const { stage } = snapspace, gizmo = stage.scene.getObjectByName("gizmo");
  const box = stage.renderer.canvas.getBoundingClientRect();
  return points.map((point) => {
    const seen = gizmo.localToWorld(stage.camera.position.clone().set(...point));
    seen.project(stage.camera);
    return [box.left + (1 + seen.x) / 2 * box.width, box.top + (1 - seen.y) / 2 * box.height];
  });
}"""
#: The direction from the gizmo to the camera, in its axes.
TO_CAMERA = """(() => {
  const { camera, scene } = snapspace.stage;
  return scene.getObjectByName("gizmo").worldToLocal(camera.position.clone()).normalize().toArray();
})()"""

#: Looks at the gizmo along an axis of the stage.
FROM_THE_FRONT = """(() => {
  const { stage } = snapspace, { camera, controls } = stage;
  controls.target.copy(stage.scene.getObjectByName("gizmo").position);
  camera.position.copy(controls.target).z += 2;
  controls.update();
  stage.draw();
})()"""


@pytest.fixture
def moving(posing: Page) -> Page:
    return selecting_the_head(posing)


def selecting_the_head(page: Page) -> Page:
    page.page.keyboard.press("2")
    page.settle()
    return page


@pytest.fixture
def turning(moving: Page) -> Page:
    moving.page.keyboard.press("t")
    moving.settle()
    return moving


def in_window(page: Page, *points: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.array(page.run(WINDOW, [point.tolist() for point in points]))


def handle_in_window(page: Page) -> NDArray[np.float64]:
    return np.array(page.run("snapspace.handle(1)"))


def motion(page: Page) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Rotation matrix and translation of the selected handle."""
    euler, shift = page.motions()[1]
    return rotation_matrix(euler), np.array(shift)


@pytest.mark.parametrize("axis", range(3))
def test_an_arrow_moves_along_its_axis(moving: Page, axis: int) -> None:
    page = moving
    unit = np.eye(3)[axis]
    middle, start, further = in_window(page, 0 * unit, ON_ARROW * unit, 0.9 * unit)
    way = 40 * (further - start) / np.linalg.norm(further - start)
    page.page.mouse.move(*start)
    page.settle()
    active = [arrow["color"] == ACTIVE for arrow in page.run("snapspace.arrows()")]
    assert active == [place == axis for place in range(3)]
    page.drag((start[0], start[1]), *way)
    rotation, shift = motion(page)
    assert np.allclose(rotation, np.eye(3))
    assert np.allclose(np.delete(shift, axis), 0, atol=1e-9) and abs(shift[axis]) > 0.01
    assert np.linalg.norm(handle_in_window(page) - middle - way) < 5, "it follows the pointer"


@pytest.mark.parametrize("axis", range(3))
def test_a_square_moves_across_its_axis(moving: Page, axis: int) -> None:
    page = moving
    place = np.full(3, ON_SQUARE)
    place[axis] = 0
    middle, start = in_window(page, 0 * place, place)
    page.drag((start[0], start[1]), 25, 12)
    rotation, shift = motion(page)
    assert np.allclose(rotation, np.eye(3))
    assert abs(shift[axis]) < 1e-9 and np.linalg.norm(shift) > 0.01
    assert np.linalg.norm(handle_in_window(page) - middle - [25, 12]) < 5


@pytest.mark.parametrize("axis", range(3))
def test_a_ring_turns_about_its_axis(turning: Page, axis: int) -> None:
    page = turning
    unit = np.eye(3)[axis]
    to_camera = page.numbers(TO_CAMERA)
    front = to_camera - (to_camera @ unit) * unit
    held = ON_RING * front / np.linalg.norm(front)
    along = np.cross(unit, held)
    start, further = in_window(page, held, held + 0.3 * along)
    page.drag((start[0], start[1]), *(further - start))
    rotation, shift = motion(page)
    assert np.allclose(shift, 0) and np.allclose(rotation @ unit, unit)
    now = rotation @ held
    assert np.isclose(np.arctan2(now @ along, now @ held), 0.3, atol=0.02), "0.3 of the radius"


def test_the_outer_ring_turns_about_the_view(turning: Page) -> None:
    page = turning
    to_camera = page.numbers(TO_CAMERA)
    right = np.cross(to_camera, to_camera[[1, 2, 0]])
    right *= ON_VIEW_RING / np.linalg.norm(right)
    start, end = in_window(page, right, np.cross(to_camera, right))
    page.drag((start[0], start[1]), *(end - start))
    rotation, shift = motion(page)
    assert np.allclose(shift, 0) and np.allclose(rotation @ to_camera, to_camera, atol=1e-6)
    assert rotation @ right @ np.cross(to_camera, right) > 0.95 * (right @ right), "a right angle"


def test_the_dot_in_the_middle_is_dragged_freely(moving: Page) -> None:
    page = moving
    middle = handle_in_window(page)
    page.drag((middle[0], middle[1]), 30, -20)
    _, shift = motion(page)
    assert np.abs(shift).min() > 1e-3, "along no axis"
    assert np.linalg.norm(handle_in_window(page) - middle - [30, -20]) < 5


def test_after_a_cancelled_drag_the_gizmo_works_as_before(moving: Page) -> None:
    page, mouse = moving, moving.page.mouse
    unit = np.eye(3)[0]
    start, further = in_window(page, ON_ARROW * unit, unit)
    mouse.move(*start)
    mouse.down()
    mouse.move(*(start + 2 * (further - start)), steps=3)
    page.settle()
    assert np.linalg.norm(motion(page)[1]) > 0.01
    page.page.keyboard.press("Escape")
    mouse.up()
    page.settle()
    assert np.allclose(motion(page)[1], 0)
    page.drag((start[0], start[1]), *(further - start))
    shift = motion(page)[1]
    assert abs(shift[0]) > 0.01 and np.allclose(shift[1:], 0, atol=1e-9), "along the axis again"
    page.page.keyboard.press("t")
    page.settle()
    assert page.run("snapspace.stage.scene.getObjectByName('gizmo').visible")


def test_a_press_without_a_drag_is_no_step(posing_page: Path, opened: OpenPage) -> None:
    page = selecting_the_head(opened(posing_page.as_uri()))
    ((x, y),) = in_window(page, ON_ARROW * np.eye(3)[0])
    page.drag((x, y), 0, 0)
    assert page.run(f"{UNDO}.disabled")


@pytest.mark.parametrize("view", ["Numpad7", "Numpad8", "Numpad9"])
def test_its_size_stays_after_a_jump_of_the_view(moving: Page, view: str) -> None:
    """The size counts relative to the distance from the camera."""
    size = """(() => {
      const { camera, scene } = snapspace.stage, gizmo = scene.getObjectByName("gizmo");
      const depth = -gizmo.position.clone().applyMatrix4(camera.matrixWorldInverse).z;
      return gizmo.scale.x / depth;
    })()"""
    before = moving.run(size)
    moving.page.keyboard.press(view)
    moving.settle()
    assert np.isclose(moving.run(size), before, rtol=1e-6)


def test_an_arrow_that_points_at_the_camera_is_gone(moving: Page) -> None:
    assert len(moving.run("snapspace.arrows()")) == 3
    moving.run(FROM_THE_FRONT)
    moving.settle()
    assert len(moving.run("snapspace.arrows()")) == 2


def test_rings_are_there_only_to_turn(turning: Page) -> None:
    rings = (
        "snapspace.stage.scene.getObjectByName('gizmo').children"
        ".filter((part) => part.visible && part.material.uniforms.isRing.value).length"
    )
    assert turning.run(rings) == 3
    turning.page.get_by_role("radio", name="Pull").click()
    turning.settle()
    assert turning.run(rings) == 0, "a coloured part is moved"
    assert turning.run("snapspace.arrows().length") > 0
