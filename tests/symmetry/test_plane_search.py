"""mirror_plane: finds the plane of a symmetric surface, and refuses others."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from snapspace import TetMesh, mirror_plane
from snapspace.generators import bar
from snapspace.mesh import compact_surface

from .bodies import body


def surface(mesh: TetMesh) -> tuple[np.ndarray, np.ndarray]:
    return compact_surface(mesh.vertices, mesh.surface)


def test_the_plane_of_a_symmetric_body_is_exact() -> None:
    plane = mirror_plane(body().vertices, body().surface)
    assert plane.normal == (0, 1, 0)
    assert abs(plane.point[1]) < 1e-12 and plane.deviation is not None and plane.deviation < 1e-12


@pytest.mark.parametrize("seed", range(3))
def test_it_moves_with_the_body(seed: int) -> None:
    points, faces = surface(body())
    turn = Rotation.random(random_state=seed).as_matrix()
    size, shift = 10.0 ** (3 * seed - 3), np.array([3.0, 1.0, 2.0])
    plane = mirror_plane(size * (points @ turn.T + shift), faces)
    assert abs(plane.normal @ turn[:, 1]) == pytest.approx(1, abs=1e-12)
    assert (np.array(plane.point) / size - shift) @ plane.normal == pytest.approx(0, abs=1e-9)
    assert plane.deviation is not None and plane.deviation < 1e-9


def test_both_sides_may_have_different_triangles() -> None:
    """Each vertex of one side slides along its surface, which stays nearly the same."""
    points, faces = surface(body())
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    neighbour = np.zeros(len(points), int)
    neighbour[edges[:, 0]] = edges[:, 1]
    slid = points.copy()
    left = points[:, 1] > 1e-9
    slid[left] += 0.2 * (points[neighbour[left]] - points[left])
    plane = mirror_plane(slid, faces)
    assert plane.normal == (0, 1, 0)
    assert plane.deviation is not None and 1e-5 < plane.deviation < 5e-3
    assert abs(plane.point[1]) < 0.005


def test_among_several_planes_that_across_x_is_taken() -> None:
    points, faces = surface(bar(6, 2, 3, length=3, width=1, height=1.5))
    assert mirror_plane(points[:, [1, 2, 0]], faces).normal == (1, 0, 0)


def test_a_small_turn_is_found_where_the_surface_shows_it() -> None:
    points, faces = surface(body())
    turn = Rotation.from_euler("xyz", [0.02, 0, 0]).as_matrix()
    normal = np.array(mirror_plane(points @ turn.T, faces).normal)
    assert normal == pytest.approx(turn[:, 1], abs=1e-9)


def bent() -> tuple[np.ndarray, np.ndarray]:
    """The creature, with its head bent to one side, its tail to the other and its back raised."""
    points, faces = surface(body())
    x, y, z = points.T
    return np.stack([x, y + 0.3 * x * z, z + 0.4 * x * y], axis=1), faces


def test_a_surface_without_sides_is_refused_with_its_deviation_and_the_cure() -> None:
    points, faces = bent()
    cure = r"give the plane yourself, for example MirrorPlane\(\(1, 0, 0\)\) or normal="
    with pytest.raises(ValueError, match=rf"is not symmetric: .* is \d\.\d % of its .*; {cure}"):
        mirror_plane(points, faces)


def test_with_a_normal_only_the_place_is_sought_and_nothing_is_refused() -> None:
    points, faces = bent()
    plane = mirror_plane(points, faces, normal=(0, 0, -2))
    assert plane.normal == (0, 0, 1)
    assert plane.deviation is not None and plane.deviation > 0.015
    low, high = points[:, 2].min(), points[:, 2].max()
    assert low < plane.point[2] < high


@pytest.mark.parametrize(
    ("vertices", "faces", "options", "message"),
    [
        (np.eye(3), np.empty((0, 3), int), {}, "the surface has no faces"),
        (np.eye(2), [[0, 1, 2]], {}, r"vertices must have shape \(n, 3\)"),
        (np.eye(3) * np.nan, [[0, 1, 2]], {}, "vertex 0 is not finite"),
        (np.eye(3), [[0, 1, 3]], {}, "mirror_plane: face 0 has vertex index 3"),
        (np.ones((3, 3)), [[0, 1, 2]], {}, "the surface has no extent"),
        (np.eye(3), [[0, 1, 2]], {"normal": (0, 0, 0)}, "the normal is zero"),
    ],
)
def test_bad_input_is_refused(
    vertices: Any, faces: Any, options: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        mirror_plane(vertices, faces, **options)
