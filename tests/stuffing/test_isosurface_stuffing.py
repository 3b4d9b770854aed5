from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace.stuffing import stuff

from ..generators.conforming import assert_solid

Floats = NDArray[np.float64]
BOX = ((-1.5, -1.5, -1.5), (1.5, 1.5, 1.5))


def ball(points: Floats) -> Floats:
    return np.asarray(np.sqrt((points**2).sum(axis=1)) - 1.0)


def torus(points: Floats) -> Floats:
    x, y, z = points.T
    return np.asarray(np.hypot(np.hypot(x, y) - 1.0, z) - 0.4)


@pytest.mark.parametrize("cell", [0.5, 0.27, 0.16])
def test_ball_is_a_sphere_and_torus_has_a_hole(cell: float) -> None:
    assert_solid(stuff(ball, *BOX, cell), euler=2)
    assert_solid(stuff(torus, *BOX, cell), euler=0)


def test_volume_converges_at_second_order() -> None:
    exact = 4.0 / 3.0 * math.pi
    errors = [exact - stuff(ball, *BOX, cell).volume for cell in (0.3, 0.15, 0.075)]
    for coarse, fine in pairwise(errors):
        assert coarse / fine == pytest.approx(4.0, rel=0.2)


def test_surface_vertices_lie_on_the_zero_set() -> None:
    mesh = stuff(torus, *BOX, 0.2)
    assert np.abs(torus(mesh.vertices[mesh.surface_vertices])).max() < 1e-12
    inner = np.setdiff1d(np.arange(len(mesh.vertices)), mesh.surface_vertices)
    assert torus(mesh.vertices[inner]).max() < 0.0


def test_interior_tets_are_those_of_the_lattice() -> None:
    mesh = stuff(ball, *BOX, 0.2)
    deep = np.linalg.norm(mesh.vertices[mesh.tets], axis=2).max(axis=1) < 0.6
    np.testing.assert_allclose(mesh.volumes[deep], 0.2**3 / 12.0, rtol=1e-9)
    angles = mesh.dihedral_angles[deep]
    assert np.abs(angles[..., None] - [60.0, 90.0]).min(axis=-1).max() < 1e-6


@settings(max_examples=25)
@given(
    centre=st.tuples(*[st.floats(-0.3, 0.3)] * 3),
    radii=st.tuples(*[st.floats(0.4, 1.0)] * 3),
    cell=st.floats(0.15, 0.3),
)
def test_dihedral_angles_are_bounded(
    centre: tuple[float, ...], radii: tuple[float, ...], cell: float
) -> None:
    def egg(points: Floats) -> Floats:
        return np.asarray((((points - np.array(centre)) / np.array(radii)) ** 2).sum(axis=1) - 1.0)

    mesh = stuff(egg, *BOX, cell)
    assert mesh.dihedral_angles.min() > 8.0
    assert mesh.dihedral_angles.max() < 165.0


def test_mirror_planes_are_kept_to_the_last_bit() -> None:
    vertices = stuff(torus, *BOX, 0.17).vertices
    for axis in range(3):
        mirrored = vertices.copy()
        mirrored[:, axis] *= -1.0
        assert {tuple(v) for v in mirrored + 0.0} == {tuple(v) for v in vertices + 0.0}


def test_the_same_call_gives_the_same_bits() -> None:
    assert stuff(ball, *BOX, 0.2).fingerprint == stuff(ball, *BOX, 0.2).fingerprint


def test_scale_of_the_function_does_not_matter() -> None:
    plain = stuff(ball, *BOX, 0.25)
    scaled = stuff(lambda points: 1e-3 * ball(points), *BOX, 0.25)
    np.testing.assert_allclose(scaled.vertices, plain.vertices, atol=1e-12)


def test_keeps_the_largest_of_several_parts() -> None:
    def two_balls(points: Floats) -> Floats:
        return np.minimum(ball(points / 0.8), ball((points - [1.2, 1.2, 1.2]) / 0.25))

    mesh = stuff(two_balls, *BOX, 0.15)
    assert mesh.volume == pytest.approx(4.0 / 3.0 * math.pi * 0.8**3, rel=0.03)


@pytest.mark.parametrize(
    ("implicit", "lower", "upper", "cell", "message"),
    [
        (ball, BOX[0], BOX[1], 0.0, r"stuff: cell is 0\.0, but must be positive"),
        (ball, BOX[0], BOX[1], 1e-4, "stuff: cell is 0.0001, .* use a larger cell"),
        (ball, (-1, -1), BOX[1], 0.3, r"stuff: lower is \(-1, -1\), but must be three finite"),
        (ball, BOX[1], BOX[0], 0.3, "stuff: lower .* is not below upper"),
        (ball, (-1.5, -1.5, -1.5), (1.5, 1.5, 0.1), 0.2, "stuff: the shape leaves the box"),
        (lambda p: ball(p) + 5.0, *BOX, 0.3, "stuff: implicit is negative nowhere"),
        (lambda p: ball(p)[:, None], *BOX, 0.3, r"stuff: implicit returned shape \(\d+, 1\)"),
        (lambda p: np.log(ball(p) + 0.5), *BOX, 0.3, "stuff: implicit is nan at"),
    ],
)
@pytest.mark.filterwarnings("ignore:invalid value encountered in log")
def test_refuses(implicit: object, lower: object, upper: object, cell: float, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        stuff(implicit, lower, upper, cell)  # type: ignore[arg-type]


def test_refuses_a_surface_that_touches_itself() -> None:
    def crossed_plates(points: Floats) -> Floats:
        # Two wedges that meet in a line are not a manifold at any resolution.
        x, y, z = points.T
        return np.maximum(x * y, np.maximum(ball(points), np.abs(z) - 0.5))

    with pytest.raises(ValueError, match="is not a manifold; use a smaller cell"):
        stuff(crossed_plates, *BOX, 0.25)
