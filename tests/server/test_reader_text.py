"""The text of errors that readers of a page see."""

from __future__ import annotations

import pytest

from snapspace.server.reader_text import for_reader


@pytest.mark.parametrize(
    ("message", "shown"),
    [
        ("fill_surface: the surface is open", "the surface is open"),
        ("bunny.obj: fill_surface: 3 edges", "bunny.obj: 3 edges"),
        ("TetMesh: tet 17 has vertex 940", "tet 17 has vertex 940"),
        ("bad.mesh: line 3: no number", "bad.mesh: line 3: no number"),
        ("handle 'my_hand: x' is empty", "handle 'my_hand: x' is empty"),
        ("Poisson's ratio is 1", "Poisson's ratio is 1"),
    ],
)
def test_names_of_functions_are_left_out(message: str, shown: str) -> None:
    assert for_reader(message) == shown
