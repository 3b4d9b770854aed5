"""What the notice about a mended surface says."""

from __future__ import annotations

import pytest

from snapspace.filling.closed_input import closed_input
from snapspace.generators import bar
from snapspace.mesh import MeshNotice

from .surfaces import surface_of


def notice_without(faces: int) -> str:
    """The notice about a bar without its first faces."""
    vertices, triangles = surface_of(bar(4, 2, 2))
    with pytest.warns(MeshNotice) as caught:
        closed_input(vertices, triangles[faces:], who="fill", mend=True, leave_open=True)
    return str(caught[0].message)


def test_the_notice_says_what_was_mended_and_what_is_still_open() -> None:
    closed = notice_without(1)
    assert closed.startswith("the surface was mended for filling: closed 1 hole with 1 face")
    assert "not closed" not in closed
    both = notice_without(6)
    assert both.startswith("the surface was mended for filling: dropped 1 vertex without faces; ")
    assert "the surface is not closed" in both


def test_where_nothing_helped_no_mending_is_claimed() -> None:
    notice = notice_without(4)
    assert notice.startswith("the surface is not closed, it has 6 boundary edges")
    assert "mended" not in notice
