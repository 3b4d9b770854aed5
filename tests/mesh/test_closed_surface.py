"""Checks that a surface is closed, and the volume that it encloses."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import ArrayLike

from snapspace.mesh.closed_surface import check_closed, enclosed_volume

from .boxes import box_mesh

TET = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]


def test_surfaces_of_solids_are_closed_either_way_round() -> None:
    faces = box_mesh((2, 3, 1)).surface
    check_closed(faces, who="test")
    check_closed(faces[:, ::-1], who="test")


def test_two_solids_at_a_common_edge_are_closed() -> None:
    """Four faces meet at the edge 0-1."""
    other = np.array([0, 1, 4, 5])[np.array(TET)]
    check_closed(np.concatenate([TET, other]).astype(np.int32), who="test")


@pytest.mark.parametrize(
    ("faces", "message"),
    [
        (np.zeros((0, 3), dtype=int), "the surface has no faces"),
        (TET[1:], r"not closed, it has 3 boundary edges \(the first between vertices 1 and 2\)"),
        ([[0, 1, 2]], "it has 3 boundary edges"),
        (
            [TET[0][::-1], *TET[1:]],
            r"opposite orientations at 3 edges \(the first between vertices 1 and 2\)",
        ),
    ],
)
def test_refuses_open_surfaces(faces: ArrayLike, message: str) -> None:
    with pytest.raises(ValueError, match=f"test: .*{message}"):
        check_closed(np.array(faces, dtype=np.int32), who="test")


def test_volume_has_the_sign_of_the_orientation_and_ignores_the_origin() -> None:
    mesh = box_mesh((2, 3, 1), (1.0, 2.0, 0.5))
    for shift in (0.0, 100.0):
        vertices = mesh.vertices + shift
        assert enclosed_volume(vertices, mesh.surface) == pytest.approx(1.0)
        assert enclosed_volume(vertices, mesh.surface[:, ::-1]) == pytest.approx(-1.0)
