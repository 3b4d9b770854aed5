"""Fitted poses match their targets, are valid, and are in the frame of the rest shape."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from snapspace import TetMesh
from snapspace import _core as core
from snapspace.fitting import PoseFits, fit_poses
from snapspace.fitting.stretches import stretches
from snapspace.mesh.embedded_surface import EmbeddedSurface

from .bodies import bent, body, fitting_system, inverted_tets, rms

MESH, SURFACE = body()
REST = SURFACE.vertices(MESH.vertices)


def distance_up_to_motion(a: np.ndarray, b: np.ndarray) -> float:
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    R, _ = Rotation.align_vectors(b, a)
    return rms(MESH, R.apply(a) - b)


@settings(max_examples=8)
@given(angle=st.floats(-3.0, 3.0).filter(lambda angle: abs(angle) > 0.1))
def test_a_bent_bar_is_found_from_its_surface(angle: float) -> None:
    fits = fit_poses(MESH, SURFACE, [bent(REST, angle)], deviation=5e-4)
    (report,) = fits.reports
    assert report.converged and report.rms <= 5e-4 and report.rms <= report.max
    assert report.inverted_tets == inverted_tets(MESH, fits.shapes[0]) == 0
    assert 0.0 < report.smallest_stretch < 1.0 < report.largest_stretch < 4.0
    # the inside follows the map, too, up to the warping of cross sections
    assert distance_up_to_motion(fits.shapes[0], bent(MESH.vertices, angle)) < 5e-3


def test_a_closer_goal_is_met_by_a_closer_surface() -> None:
    reports = [
        fit_poses(MESH, SURFACE, [bent(REST, 2.0)], deviation=d).reports[0]
        for d in (4e-3, 1e-3, 1e-4)
    ]
    assert all(report.converged for report in reports)
    assert reports[0].rms > reports[1].rms > reports[2].rms
    assert reports[0].smallest_stretch > reports[2].smallest_stretch


def test_the_rest_shape_is_its_own_fit() -> None:
    fits = fit_poses(MESH, SURFACE, [REST])
    np.testing.assert_allclose(fits.shapes[0], MESH.vertices, atol=1e-12)
    assert fits.reports[0].iterations == 0


def test_the_frame_of_a_target_does_not_matter() -> None:
    R = Rotation.from_rotvec([1.0, -2.0, 0.5])
    target = bent(REST, 1.5)
    fits = fit_poses(MESH, SURFACE, [REST, R.apply(REST) + 7.0, target, R.apply(target) - 3.0])
    np.testing.assert_allclose(fits.shapes[1], fits.shapes[0], atol=1e-10)
    np.testing.assert_allclose(fits.shapes[3], fits.shapes[2], atol=1e-6)


def test_a_small_motion_is_not_rounded_away() -> None:
    """The surface may be off by `deviation`, but only by a part of its own motion."""
    target = bent(REST, 0.01)
    moved = rms(MESH, target - REST)
    assert moved < 5e-3
    fits = fit_poses(MESH, SURFACE, [target], deviation=5e-2)
    assert fits.reports[0].converged
    assert distance_up_to_motion(SURFACE.vertices(fits.shapes[0]), target) < 0.1 * moved


def test_points_inside_tets_are_matched_like_vertices() -> None:
    """The points of the surface are the centres of the tets."""
    middle = np.full((len(MESH.tets), 4), 0.25)
    surface = EmbeddedSurface(
        np.arange(3 * (len(MESH.tets) // 3), dtype=np.int32).reshape(-1, 3), MESH.tets, middle
    )
    target = surface.vertices(bent(MESH.vertices, 1.0))
    fits = fit_poses(MESH, surface, [target], deviation=5e-4)
    assert fits.reports[0].converged and fits.reports[0].inverted_tets == 0
    assert distance_up_to_motion(fits.shapes[0], bent(MESH.vertices, 1.0)) < 5e-3


def test_a_target_that_intersects_itself_still_gives_a_valid_pose() -> None:
    """The bar bent once around and through itself, and a bar with its end turned inside out."""
    around = bent(REST, 6.5)
    inside_out = REST.copy()
    inside_out[REST[:, 0] > 3.0, 1] *= -1.0
    fits = fit_poses(MESH, SURFACE, [around, inside_out], max_iterations=60)
    assert fits.reports[0].converged
    assert not fits.reports[1].converged, "no pose without inverted tets is near it"
    for shape, report in zip(fits.shapes, fits.reports, strict=True):
        assert inverted_tets(MESH, shape) == report.inverted_tets == 0
        assert np.isfinite(shape).all()


def without_seconds(fits: PoseFits) -> list[object]:
    return [replace(report, seconds=0.0) for report in fits.reports]


def test_poses_depend_neither_on_threads_nor_on_each_other() -> None:
    targets = [bent(REST, angle) for angle in (0.5, 1.0, 2.0, -1.0)]
    one = fit_poses(MESH, SURFACE, targets, threads=1)
    many = fit_poses(MESH, SURFACE, targets, threads=3)
    np.testing.assert_array_equal(one.shapes, many.shapes)
    assert without_seconds(one) == without_seconds(many)
    alone = fit_poses(MESH, SURFACE, targets[2:3], names=["2"])
    np.testing.assert_array_equal(alone.shapes[0], one.shapes[2])


def test_the_unit_of_length_does_not_matter() -> None:
    scaled = TetMesh(1024.0 * MESH.vertices, MESH.tets)
    target = bent(REST, 2.0)
    here = fit_poses(MESH, SURFACE, [target])
    there = fit_poses(scaled, SURFACE, [1024.0 * target])
    np.testing.assert_allclose(there.shapes / 1024.0, here.shapes, atol=1e-9)


@pytest.mark.parametrize("count", [1, 3])
def test_reports_are_readable(count: int) -> None:
    targets = [bent(REST, 0.5)] * count
    fits = fit_poses(MESH, SURFACE, targets, names=[f"pose{i}" for i in range(count)])
    assert len(fits) == count
    assert fits.reports[-1].summary().startswith(f"pose{count - 1}: surface within ")
    assert "converged" not in fits.reports[0].summary()
    stuck = replace(fits.reports[0], status="max_iterations")
    assert stuck.summary().endswith(", max_iterations")


def pulled(distance: float) -> np.ndarray:
    """The bar with one point of its side pulled out."""
    target = REST.copy()
    point = int(np.argmin(np.linalg.norm(REST - [2.0, 0.33, 1.0], axis=1)))
    target[point, 2] += distance
    return target


def test_a_spike_that_would_stretch_tets_too_much_is_not_quite_reached() -> None:
    system = fitting_system(MESH, SURFACE)

    def fit(stretch: float) -> float:
        """The largest stretch."""
        u, report = system.fit(
            pulled(4.0) - REST,
            np.zeros(MESH.vertices.size),
            deviation=0.12,
            first_stiffness=1.0,
            stretch=stretch,
            max_iterations=300,
            control=core.SolveControl(),
        )
        assert report.status == core.FitStatus.converged and report.deviation <= 0.12
        values, inverted = stretches(MESH, MESH.vertices + u.reshape(-1, 3))
        assert not inverted.any() and values.min() > 1.0 / stretch
        return float(values.max())

    assert fit(1e6) > 10.0 > fit(10.0) > 5.0


def test_a_surface_that_needs_more_stretch_gets_it() -> None:
    stretch = np.array([15.0, 1.0, 1.0])
    fits = fit_poses(MESH, SURFACE, [REST * stretch])
    (report,) = fits.reports
    assert report.converged and report.inverted_tets == 0
    assert report.largest_stretch == pytest.approx(15.0, rel=0.1)
    assert distance_up_to_motion(fits.shapes[0], MESH.vertices * stretch) < 5e-3
