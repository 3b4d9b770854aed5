"""Mirror images of handles, where they are chosen, and of poses, in a browser."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from snapspace import MirrorPlane, PosingModel, export_html, mirror_pose
from snapspace.problem import rotation_matrix

from .choosing_page import BAR, ENDS, TAKE_HANDLES, handles, press, wait_for_text
from .pages import OpenPage, Page
from .test_posing_page import assert_shown

LEFT, RIGHT = (set(np.flatnonzero(end).tolist()) for end in ENDS.values())
HINT = ".mirror .hint"
#: Across the middle of the bar of `posing_model`, between its foot and its head.
MIDDLE = MirrorPlane((1, 0, 0), (2, 0, 0))


def test_m_makes_the_mirror_image_of_a_handle_and_undo_takes_it_back(
    bar_server: str, opened: OpenPage
) -> None:
    page: Page = opened(bar_server)
    page.wait("snapspace.kind === 'choosing'")
    page.run(TAKE_HANDLES, [["left end", sorted(LEFT)], ["belly", [*middle()]]])
    page.page.get_by_role("button", name="Mirror left end").focus()
    page.page.keyboard.press("m")
    wait_for_text(page, HINT, "Right end is the mirror image of left end.")
    assert handles(page) == {"left end": LEFT, "belly": middle(), "right end": RIGHT}
    assert "The shape is symmetric." in page.text(HINT)
    plane = "snapspace.stage.root.getObjectByName('mirror plane')"
    assert page.run(f"{plane}.visible")
    assert page.run(f"{plane}.position.x") == pytest.approx(2, abs=1e-6)
    press(page, "Show plane")
    assert not page.run(f"{plane}.visible")
    page.page.keyboard.press("Control+z")
    assert set(handles(page)) == {"left end", "belly"}
    page.page.keyboard.press("Control+Shift+Z")
    assert handles(page)["right end"] == RIGHT
    # what lies across the plane has no counterpart; the other plane is taken for the same handle
    press(page, "Mirror belly")
    wait_for_text(page, HINT, "'belly' lies across the mirror plane and is its own mirror image")
    page.page.get_by_role("radio", name="Across z").click()
    wait_for_text(page, HINT, "Belly mirrored is the mirror image of belly.")
    x, _, z = BAR.vertices.T
    above = set(np.flatnonzero((np.abs(x - 2) < 0.5) & (z > 0.6)).tolist())
    assert handles(page)["belly mirrored"] == above
    page.page.keyboard.press("?")
    assert "mirror image of the focused or last handle" in page.text("dialog")
    page.page.keyboard.press("Escape")


def middle() -> set[int]:
    x, _, z = BAR.vertices.T
    return set(np.flatnonzero((np.abs(x - 2) < 0.5) & (z < 0.4)).tolist())


def test_mirror_pose_swaps_the_sides_and_is_undone(
    posing_model: PosingModel, tmp_path: Path, opened: OpenPage
) -> None:
    """This works in a page without a server."""
    model = replace(posing_model, provenance={"mirror": MIDDLE.content})
    page: Page = opened(export_html(model, tmp_path / "mirror.html").as_uri())
    for handle, (dx, dy) in {1: (50, -40), 2: (-20, 30)}.items():
        page.drag(page.run(f"snapspace.handle({handle})"), dx, dy)
    before = page.motions()
    session = model.session()
    session.move_all({name: before[k] for k, name in enumerate(model.problem.handles.names)})
    mirror_pose(session)
    page.page.keyboard.press("m")
    page.settle()
    for (turn, shift), (euler, own) in zip(
        session.motions.values(), page.motions().values(), strict=True
    ):
        assert own == pytest.approx(shift, abs=1e-9)
        assert rotation_matrix(euler) == pytest.approx(turn, abs=1e-9)
    assert np.linalg.norm(page.motions()[0][1]) > 0.02
    assert_shown(model, page)
    page.page.keyboard.press("m")
    page.settle()
    assert flat(page.motions()) == pytest.approx(flat(before), abs=1e-9)
    page.page.keyboard.press("Control+z")
    page.settle()
    assert page.motions()[0][1] == pytest.approx(session.motions["foot"][1], abs=1e-9)


def flat(motions: dict[int, tuple[list[float], list[float]]]) -> list[float]:
    return [x for motion in motions.values() for part in motion for x in part]


def test_where_a_pose_cannot_be_mirrored_the_button_says_why(
    posing_model: PosingModel, tmp_path: Path, opened: OpenPage
) -> None:
    far = MirrorPlane((1, 0, 0), (50, 0, 0))
    model = replace(posing_model, provenance={"mirror": far.content})
    page: Page = opened(export_html(model, tmp_path / "alone.html").as_uri())
    button = page.page.get_by_role("button", name="Mirror pose")
    reason = "“foot” and others have no counterpart on the other side."
    assert button.get_attribute("aria-disabled") == "true"
    assert button.get_attribute("title") == reason
    assert reason not in page.text("#panel")
    page.drag(page.run("snapspace.handle(1)"), 50, -40)
    before = page.motions()
    page.page.keyboard.press("m")
    assert reason in page.text("#panel")
    assert page.motions() == before
