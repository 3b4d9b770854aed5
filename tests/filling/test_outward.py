"""facing_outward: which parts of a closed surface are inside out."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.filling.outward import facing_outward

from .surfaces import Surface, beside, box, inside_out

BODY = box(0.0, 0.0, 0.0)
ARM = box(1.5, 0.25, 0.25, size=(1.0, 0.5, 0.5))
CAVITY = inside_out(box(0.5, 0.25, 0.25, size=(0.5, 0.5, 0.5)))


@pytest.mark.parametrize(
    "given",
    [
        beside(BODY, ARM),
        beside(inside_out(BODY), ARM),
        beside(BODY, inside_out(ARM)),
        beside(inside_out(BODY), inside_out(ARM)),
    ],
    ids=["none", "the larger part", "the smaller part", "both"],
)
def test_parts_that_are_inside_out_are_turned(given: Surface) -> None:
    assert np.array_equal(facing_outward(*given), beside(BODY, ARM)[1])


def test_the_wall_of_a_cavity_stays_as_it_is() -> None:
    hollow = beside(BODY, CAVITY)
    assert np.array_equal(facing_outward(*hollow), hollow[1])
    assert np.array_equal(facing_outward(*inside_out(hollow)), hollow[1])


def test_a_part_inside_out_is_turned_beside_a_cavity() -> None:
    assert np.array_equal(
        facing_outward(*beside(BODY, CAVITY, inside_out(ARM))), beside(BODY, CAVITY, ARM)[1]
    )


def test_parts_with_holes_are_turned_together() -> None:
    """The volume of an open part depends on the origin."""
    vertices, faces = beside(BODY, inside_out(ARM))
    pierced = faces[:-1]
    assert np.array_equal(facing_outward(vertices, pierced, closed=False), pierced)
    turned = facing_outward(vertices, pierced[:, ::-1], closed=False)
    assert np.array_equal(turned, pierced)
