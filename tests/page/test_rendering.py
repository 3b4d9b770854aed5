"""What the renderer draws, by its pixels."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .pages import OpenPage, Page
from .test_gizmo import WINDOW
from .test_interaction import AXES
from .test_occlusion import picture

#: Where arrows are thick, in the gizmo's lengths.
ON_HEAD = 0.85
#: The opacity of the darkest shadow, of 255, on light paper.
DARKEST = 0.26 * 255


def shadow(page: Page) -> NDArray[np.bool_]:
    """Where there is nothing but a shadow in the picture."""
    seen = picture(page)
    return (seen[..., :3].max(axis=2) == 0) & (seen[..., 3] > 0) & (seen[..., 3] < 128)


def test_flat_colours_are_exact(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri(), sharp=True)
    page.page.keyboard.press("2")
    page.settle()
    seen = picture(page)
    width = page.run("snapspace.stage.renderer.canvas.getBoundingClientRect().width")
    for axis, color in zip(np.eye(3), AXES.values(), strict=True):
        ((x, y),) = page.run(WINDOW, [(ON_HEAD * axis).tolist()])
        column, row = (int(place * seen.shape[1] / width) for place in (x, y))
        around = seen[row - 2 : row + 3, column - 2 : column + 3, :3].reshape(-1, 3)
        expected = [int(color[i : i + 2], 16) for i in (1, 3, 5)]
        assert np.abs(around - expected).max(axis=1).min() <= 1, color


def test_a_shadow_falls_on_the_ground_and_follows_the_key_light(
    posing_page: Path, opened: OpenPage
) -> None:
    page = opened(posing_page.as_uri(), sharp=True)
    first = shadow(page)
    assert first.mean() > 0.002
    assert abs(picture(page)[..., 3][first].max() - DARKEST) <= 1
    body = picture(page)[..., 3] == 255
    page.run("snapspace.stage.root.visible = false")
    assert not shadow(page).any(), "nothing casts one"
    page.run("snapspace.stage.root.visible = true")
    # the light turns with the camera: the shadow stays on its side of the body
    columns = np.arange(body.shape[1])
    side = np.sign(columns[first.any(axis=0)].mean() - columns[body.any(axis=0)].mean())
    page.page.keyboard.press("Numpad9")
    page.settle()
    now, body = shadow(page), picture(page)[..., 3] == 255
    assert now.mean() > 0.002
    assert np.sign(columns[now.any(axis=0)].mean() - columns[body.any(axis=0)].mean()) == side


def test_edges_of_faces_only_darken_the_surface(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri(), sharp=True)
    before = picture(page)
    page.page.keyboard.press("w")
    page.settle()
    after = picture(page)
    inside = (before[..., 3] == 255) & (after[..., 3] == 255)
    change = after[inside][:, :3].sum(axis=1) - before[inside][:, :3].sum(axis=1)
    assert change.max() <= 3
    assert 0.02 < np.mean(change < -20) < 0.9
    page.page.keyboard.press("w")
    page.settle()
    assert (picture(page) == before).all()


def test_backs_of_closed_bodies_are_not_drawn(posing_page: Path, opened: OpenPage) -> None:
    """They once showed as dark specks on silhouettes."""
    page = opened(posing_page.as_uri(), sharp=True)
    assert (picture(page)[..., 3] == 255).any()
    page.run(
        """(() => {
            const { stage } = snapspace, [marks] = stage.root.children.slice(1);
            marks.visible = false;
            stage.camera.position.set(0, 0.1, 0);
            stage.camera.lookAt(1, 0.1, 0);
            stage.draw();
        })()"""
    )
    assert not (picture(page)[..., 3] == 255).any(), "seen from inside"


def test_flat_faces_end_in_sharp_edges(bar_server: str, opened: OpenPage) -> None:
    """Seen from in front, a face of the bar has one shade from its upper edge to its lower one."""
    page = opened(bar_server, sharp=True)
    page.wait("snapspace.kind === 'choosing'")
    page.page.keyboard.press("Numpad8")
    page.settle()
    seen = picture(page)
    column = seen[:, seen.shape[1] // 2]
    face = column[column[:, 3] == 255, :3]
    assert len(face) > 20
    assert np.ptp(face[2:-2], axis=0).max() <= 6
