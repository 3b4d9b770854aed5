"""mend_surface: afterwards the surface is closed, and what was invented is counted."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import check_surface, mend_surface
from snapspace.doctor.fill_holes import hole_triangles

from .test_check_surface import FAULTS, box, with_wall


@pytest.mark.parametrize("name", sorted(FAULTS.keys() - {"two parts", "thin"}))
def test_every_planted_fault_is_mended(name: str) -> None:
    vertices, faces = box()
    mended = mend_surface(*FAULTS[name][0](vertices, faces))
    assert check_surface(mended.vertices, mended.faces).findings == ()
    assert check_surface(mended.vertices, mended.faces).volume == pytest.approx(4.0)
    assert (mended.notes == ()) == (name == "nothing")
    assert mended.invented == (1 if name == "a hole" else 0)
    assert len(mended.vertices) == len(vertices) and len(mended.faces) == len(faces)
    if name != "soup":
        assert np.array_equal(mended.vertices, vertices)  # in their order


def test_a_removed_side_comes_back_flat() -> None:
    vertices, faces = box()
    end = (vertices[faces][:, :, 0] > 3.99).all(axis=1)
    mended = mend_surface(vertices, faces[~end])
    report = check_surface(mended.vertices, mended.faces)
    assert report.fine and report.volume == pytest.approx(4.0)
    assert mended.invented == 6 and mended.invented_area == pytest.approx(1.0)
    assert mended.notes[-1] == "closed 1 hole with 6 faces, area 1"


def test_a_large_hole_of_any_shape_is_left() -> None:
    """Half of the bar's sides are gone: no guess is made."""
    vertices, faces = box()
    centers = vertices[faces].mean(axis=1)
    kept = faces[(centers[:, 1] > 0.3) | (np.abs(centers[:, 0] - 2.0) > 1.2)]
    bent = vertices + np.outer(np.sin(2.0 * vertices[:, 0]), [0.0, 0.0, 0.8])
    mended = mend_surface(bent, kept)
    assert mended.invented == 0
    assert "holes" in {finding.name for finding in check_surface(bent, mended.faces).findings}


def test_one_triangle_is_not_covered_twice() -> None:
    mended = mend_surface(np.eye(3), [[0, 1, 2]])
    assert mended.faces.tolist() == [[0, 1, 2]] and mended.invented == 0


def test_a_wall_is_not_closed_into_a_second_sheet() -> None:
    mended = mend_surface(*with_wall(*box()))
    assert "non-manifold edges" in {
        finding.name for finding in check_surface(mended.vertices, mended.faces).findings
    }


def test_faces_that_all_vanish_are_refused() -> None:
    with pytest.raises(ValueError, match="no face would be left: all 1 name a vertex twice"):
        mend_surface(np.eye(3), [[0, 1, 1]])


def all_triangulations(loop: list[int]) -> list[list[tuple[int, int, int]]]:
    if len(loop) < 3:
        return [[]]
    return [
        [(loop[0], loop[k], loop[-1]), *left, *right]
        for k in range(1, len(loop) - 1)
        for left in all_triangulations(loop[: k + 1])
        for right in all_triangulations(loop[k:])
    ]


@pytest.mark.parametrize("seed", range(3))
def test_the_triangles_of_a_hole_have_the_least_area(seed: int) -> None:
    points = np.random.default_rng(seed).normal(size=(7, 3))
    loop = np.arange(7)

    def area(triangles: NDArray[np.int32]) -> float:
        a, b, c = np.moveaxis(points[np.asarray(triangles)], 1, 0)
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())

    best = min(area(np.array(one)) for one in all_triangulations(loop.tolist()))
    assert area(hole_triangles(points, loop)) == pytest.approx(best)
