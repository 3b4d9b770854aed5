"""The page says what is wrong with a surface, and shows what was invented to fill it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from snapspace.mesh import write_surface

from .choosing_page import (
    BAR,
    compute,
    ends_as_handles,
    press,
    wait_for_last_model,
    wait_for_text,
)
from .pages import OpenPage
from .serving import served

#: Corners of the faces on the stage that close holes.
INVENTED = """(() => {
  const mesh = snapspace.stage.root.getObjectByName('invented');
  return mesh ? mesh.geometry.attributes.position.data : [];
})()"""


def test_holes_are_listed_and_what_closes_them_is_drawn(
    tmp_path: Path, opened: OpenPage, chromium: object
) -> None:
    missing = BAR.vertices[BAR.surface[:1]]
    write_surface(tmp_path / "scan.obj", BAR.vertices, BAR.surface[1:])
    with served(tmp_path / "scan.obj", "--edge-length", "0.1", cwd=tmp_path) as address:
        page = opened(address)
        page.wait("snapspace.kind === 'choosing'")
        assert "closed 1 hole with 1 face" in page.text(".notes"), "before anybody asks"
        assert page.numbers(INVENTED).size == 0
        press(page, "Check surface")
        wait_for_text(page, ".findings", "What to do:")
        text = page.text(".findings")
        assert "holes it is not closed: 1 hole" in text
        assert "closed 1 hole with 1 face" in text and "Your file is as it was" in text
        corners = page.numbers(INVENTED).reshape(-1, 3)
        for corner in missing.reshape(-1, 3):
            assert np.abs(corners - corner).max(axis=1).min() < 1e-6
        ends_as_handles(page)
        compute(page)
        page.wait("snapspace.kind === 'posing'")
        wait_for_last_model(page)
        assert page.numbers(INVENTED).size == 0, "a posed shape is not that surface"
        press(page, "Choose handles")
        page.wait("snapspace.kind === 'choosing'")
        assert len(page.numbers(INVENTED)) == 9
        page.close()  # before its server, which it would miss


def test_tets_have_nothing_to_check(bar_server: str, opened: OpenPage) -> None:
    page = opened(bar_server)
    page.wait("snapspace.kind === 'choosing'")
    assert page.page.get_by_role("button", name="Check surface").count() == 0
    assert page.page.locator(".notes").count() == 0
