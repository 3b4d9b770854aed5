"""Slender bodies that turn by more than half a turn between the rest shape and a target."""

from __future__ import annotations

import numpy as np

from snapspace.fitting import fit_poses
from snapspace.fitting.moved_with_surface import moved_with_surface
from snapspace.generators import bar
from snapspace.mesh import TetMesh
from snapspace.mesh.embedded_surface import boundary_surface

from .bodies import FloatArray, bent, inverted_tets


def slender(angle: float) -> TetMesh:
    """A bar of length 4 and a twelfth of that in width, bent to an arc."""
    mesh = bar(36, 3, 3)
    straight = mesh.vertices * [4.0 / np.ptp(mesh.vertices[:, 0]), 0.33, 0.33]
    return TetMesh(bent(straight, angle), mesh.tets)


def test_a_slender_body_is_bent_the_other_way() -> None:
    """From rest alone, this fit is caught in a fold, with a stretch of 100."""
    rest, target = slender(2.2), slender(-2.2)
    surface = boundary_surface(rest)
    fits = fit_poses(rest, surface, [surface.vertices(target.vertices)])
    (report,) = fits.reports
    assert report.converged and report.inverted_tets == inverted_tets(rest, fits.shapes[0]) == 0
    assert 0.5 < report.smallest_stretch and report.largest_stretch < 2.0


def rotated(points: FloatArray) -> FloatArray:
    return points[:, [1, 2, 0]] + [3.0, -7.0, 2.0]


def test_points_move_rigidly_with_a_rigid_surface() -> None:
    mesh = slender(1.0)
    surface = boundary_surface(mesh)
    rest = surface.vertices(mesh.vertices)
    moved = moved_with_surface(mesh.vertices, rest, rotated(rest), surface.faces)
    np.testing.assert_allclose(moved, rotated(mesh.vertices), atol=1e-9)


def test_faces_without_area_and_small_surfaces_have_a_motion() -> None:
    rest = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0]])
    faces = np.array([[0, 1, 2], [0, 1, 3]])
    points = np.array([[0.2, 0.3, 0.1], [1.0, 0.0, 0.0]])
    moved = moved_with_surface(points, rest, rotated(rest), faces)
    np.testing.assert_allclose(moved, rotated(points), atol=1e-9)
