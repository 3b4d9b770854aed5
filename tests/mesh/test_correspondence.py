"""Poses correspond if they have the same faces or tets in the same order."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from snapspace.mesh.correspondence import check_same_faces, check_same_tets

from .boxes import box_arrays, box_mesh

CURE = "export all poses from one mesh, without reordering or merging vertices"
NAMES = ("stand.obj", "run.obj", "jump.obj")
BOX = box_mesh()
SURFACE = (BOX.vertices, BOX.surface)


def test_other_positions_of_the_same_faces_correspond() -> None:
    moved = 2.0 * BOX.vertices + 1.0
    check_same_faces([SURFACE, (moved, BOX.surface), (-moved, BOX.surface.copy())], NAMES)
    check_same_tets([(BOX.vertices, BOX.tets), (moved, BOX.tets)], NAMES[:2])


def changed(row: int, corners: list[int]) -> np.ndarray:
    faces = BOX.surface.copy()
    faces[row] = corners
    return faces


FIRST = ", ".join(map(str, BOX.surface[5].tolist()))
TURNED = np.roll(BOX.surface[5], 1).tolist()


@pytest.mark.parametrize(
    ("third", "message"),
    [
        ((BOX.vertices[:-1], BOX.surface), "has 26 vertices, but stand.obj has 27"),
        ((BOX.vertices, BOX.surface[:-2]), "has 46 faces, but stand.obj has 48"),
        # the number of vertices comes first: faces of other vertices cannot be compared
        ((BOX.vertices[:-1], BOX.surface[:-2]), "has 26 vertices, but stand.obj has 27"),
        (
            (BOX.vertices, changed(5, [1, 2, 3])),
            f"face 5 has vertices 1, 2, 3, but in stand.obj {FIRST}; 1 of 48 faces differ",
        ),
        (
            (BOX.vertices, BOX.surface[::-1]),
            f"face 0 has vertices {', '.join(map(str, BOX.surface[-1].tolist()))}, but in "
            f"stand.obj {', '.join(map(str, BOX.surface[0].tolist()))}; 48 of 48 faces differ",
        ),
        # a face that starts at another corner suggests that the file was reordered
        (
            (BOX.vertices, changed(5, TURNED)),
            f"face 5 has vertices {', '.join(map(str, TURNED))}, but in stand.obj {FIRST}; 1 of 48",
        ),
    ],
)
def test_the_first_difference_is_named(third: Any, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(f"jump.obj: {message}")) as caught:
        check_same_faces([SURFACE, SURFACE, third], NAMES)
    assert str(caught.value).endswith(CURE)
    assert "\n" not in str(caught.value)


def test_the_first_surface_that_differs_is_named() -> None:
    with pytest.raises(ValueError, match=r"run\.obj: has 26 vertices, but stand\.obj has 27"):
        check_same_faces([SURFACE, (BOX.vertices[:-1], BOX.surface), box_arrays((1, 1, 1))], NAMES)


def test_tets_are_called_tets() -> None:
    vertices, tets = box_arrays()
    others = tets.copy()
    others[7] = others[7][[1, 2, 0, 3]]
    row, first = ", ".join(map(str, others[7])), ", ".join(map(str, tets[7]))
    message = f"b: tet 7 has vertices {row}, but in a {first}; 1 of 48 tets differ: {CURE}"
    with pytest.raises(ValueError, match=re.escape(message)):
        check_same_tets([(vertices, tets), (vertices, others)], ["a", "b"])
    with pytest.raises(ValueError, match="b: has 47 tets, but a has 48"):
        check_same_tets([(vertices, tets), (vertices, tets[1:])], ["a", "b"])
