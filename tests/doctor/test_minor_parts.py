"""minor_parts: open parts beside a body, such as cloth."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.doctor.holes import has_wide_hole
from snapspace.doctor.minor_parts import minor_parts
from snapspace.mesh.edges import edges_of

from ..filling.surfaces import Surface, beside, box


def cloth(size: float) -> Surface:
    """A bent sheet above the box, whose edge is no flat hole."""
    u, v = np.meshgrid(np.linspace(-1.0, 1.0, 9), np.linspace(-1.0, 1.0, 9), indexing="ij")
    points = np.stack([size * u + 1.0, size * v + 0.5, 1.2 + size * u**2], axis=-1).reshape(-1, 3)
    corner = np.arange(81).reshape(9, 9)
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    halves = [np.stack(half, axis=-1).reshape(-1, 3) for half in ((a, b, c), (a, c, d))]
    return points, np.concatenate(halves).astype(np.int32)


@pytest.mark.parametrize(("size", "is_minor"), [(0.5, True), (3.0, False)])
def test_open_parts_are_minor_if_they_have_less_than_half_of_the_area(
    size: float, is_minor: bool
) -> None:
    body, sheet = box(0.0, 0.0, 0.0), cloth(size)
    vertices, faces = beside(body, sheet)
    edges = edges_of(faces)
    found = minor_parts(vertices, faces, edges.ends[edges.uses == 1])
    expected = np.arange(len(faces)) >= len(body[1])
    assert np.array_equal(found, expected & is_minor)
    assert has_wide_hole(vertices, faces) is not is_minor


def test_a_sheet_alone_is_no_minor_part() -> None:
    vertices, faces = cloth(0.5)
    assert not minor_parts(vertices, faces, faces[:1]).any()
    assert has_wide_hole(vertices, faces)
