from __future__ import annotations

import math

import numpy as np
import pytest

from snapspace.generators import cylinder, helix

from .conforming import assert_solid


@pytest.mark.parametrize("options", [{}, {"twist": 2.0 * math.pi}, {"turns": -2.0}, {"turns": 0.5}])
def test_is_a_pose_of_the_cylinder(options: dict[str, float]) -> None:
    rest, pose = cylinder(2, 40), helix(2, 40, **options)
    assert np.array_equal(pose.tets, rest.tets)
    assert_solid(pose, euler=2)
    # Pappus: bending a tube about its centroid line keeps its volume; chords lose a little.
    assert pose.volume == pytest.approx(rest.volume, rel=0.03)


def test_centre_line_keeps_its_arc_length_and_lies_on_the_helix() -> None:
    along, turns, coil_radius = 400, 2.0, 0.55
    centre = helix(1, along, turns=turns, coil_radius=coil_radius).vertices.reshape(
        along + 1, -1, 3
    )
    line = centre[:, 0]
    assert np.linalg.norm(np.diff(line, axis=0), axis=1).sum() == pytest.approx(8.0, rel=1e-4)
    np.testing.assert_allclose(np.hypot(line[:, 0], line[:, 1]), coil_radius, rtol=1e-12)
    angle = np.unwrap(np.arctan2(line[:, 1], line[:, 0]))
    assert angle[-1] - angle[0] == pytest.approx(2.0 * math.pi * turns)


def test_cross_sections_are_rigid_and_normal_to_the_line() -> None:
    rest = cylinder(2, 200).vertices.reshape(201, -1, 3)
    pose = helix(2, 200).vertices.reshape(201, -1, 3)
    flat = pose - pose[:, :1]
    np.testing.assert_allclose(
        np.linalg.norm(flat, axis=2), np.linalg.norm(rest - rest[:, :1], axis=2), atol=1e-12
    )
    tangent = pose[2:, 0] - pose[:-2, 0]
    assert np.abs(np.einsum("lvk,lk->lv", flat[1:-1], tangent)).max() < 1e-3


def test_frame_does_not_turn_about_the_line_unless_twisted() -> None:
    def turning(twist: float) -> float:
        pose = helix(1, 1000, twist=twist).vertices.reshape(1001, -1, 3)
        spoke = pose[:, 1] - pose[:, 0]
        spoke /= np.linalg.norm(spoke, axis=1, keepdims=True)
        tangent = pose[1:, 0] - pose[:-1, 0]
        tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
        return float(np.einsum("lk,lk->l", np.cross(spoke[:-1], spoke[1:]), tangent).sum())

    assert turning(0.0) == pytest.approx(0.0, abs=1e-3)
    assert turning(1.5) == pytest.approx(1.5, abs=1e-3)


def test_the_same_call_gives_the_same_bits() -> None:
    assert helix().fingerprint == helix().fingerprint


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"turns": 0.0}, "helix: turns is 0, but must not be; call cylinder"),
        ({"coil_radius": 0.7}, "helix: coil_radius is 0.7, but .* need it below 0.6366"),
        ({"radius": 0.8}, "helix: radius is 0.8, but the centre line bends with radius 0.7368"),
        ({"coil_radius": 0.63}, "helix: radius is 0.35, but the windings are only"),
        ({"twist": math.nan}, "helix: twist is nan, but must be finite"),
        ({"along": 0}, "helix: along is 0, but must be at least 1"),
    ],
)
def test_refuses(options: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        helix(**options)  # type: ignore[arg-type]
