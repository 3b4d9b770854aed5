from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.sparse import csr_array, diags_array
from scipy.spatial.transform import Rotation
from threadpoolctl import threadpool_limits

from snapspace.generators import bar
from snapspace.mesh import mass_inner, mass_matrix, mass_norm
from snapspace.registration import RigidMotion, registered, rigid_registration

from ..shapes import deformed, irregular_bar, moved, random_rotation

FloatArray = NDArray[np.float64]
BAR = irregular_bar()
REST = BAR.vertices.reshape(-1)
BENT = deformed(BAR, 0.2)
MASS = mass_matrix(BAR)
SHIFT = np.array([3.0, -2.0, 7.0])
MIRROR = np.diag([1.0, 1.0, -1.0])


def rigid_directions(x: FloatArray) -> list[FloatArray]:
    """Three translations and three infinitesimal rotations of a shape, (3n,) each."""
    points = x.reshape(-1, 3)
    shifts = [np.tile(axis, len(points)) for axis in np.eye(3)]
    return shifts + [np.cross(axis, points).reshape(-1) for axis in np.eye(3)]


def distance(motion: RigidMotion, shape: FloatArray, onto: FloatArray, mass: csr_array) -> float:
    return mass_norm(mass, motion.apply(shape) - onto)


def assert_proper(rotation: FloatArray) -> None:
    assert rotation.T @ rotation == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(rotation) == pytest.approx(1.0)


@given(
    rotvec=st.tuples(*[st.floats(-3.5, 3.5)] * 3),
    shift=st.tuples(*[st.floats(-10, 10)] * 3),
    scale=st.floats(1e-3, 1e3),
)
@settings(max_examples=50)
def test_a_known_motion_is_found(
    rotvec: tuple[float, ...], shift: tuple[float, ...], scale: float
) -> None:
    rotation = Rotation.from_rotvec(rotvec).as_matrix()
    motion = rigid_registration(REST, moved(REST, rotation, np.array(shift)), MASS)
    assert motion.rotation == pytest.approx(rotation, abs=1e-12)
    assert motion.translation == pytest.approx(np.array(shift), abs=1e-11)
    assert motion.scale == 1.0
    larger = moved(REST, scale * rotation, np.array(shift))
    motion = rigid_registration(REST, larger, MASS, scale=True)
    assert motion.rotation == pytest.approx(rotation, abs=1e-11)
    assert motion.scale == pytest.approx(scale, rel=1e-11)


@pytest.mark.parametrize("axis", [*np.eye(3), [1.0, 1.0, 0.0], [0.3, -0.8, 0.52]])
def test_half_turns_are_found(axis: Any) -> None:
    half_turn = Rotation.from_rotvec(np.pi * np.divide(axis, np.linalg.norm(axis))).as_matrix()
    motion = rigid_registration(REST, moved(REST, half_turn, SHIFT), MASS)
    assert motion.rotation == pytest.approx(half_turn, abs=1e-13)


@pytest.mark.parametrize("lumped", [False, True])
@pytest.mark.parametrize("scale", [False, True])
def test_no_motion_nearby_brings_the_shapes_closer(lumped: bool, scale: bool) -> None:
    """The minimum is compared with that of a general minimiser, which uses no SVD."""
    mass = mass_matrix(BAR, lumped=lumped)
    onto = moved(BENT, random_rotation(), SHIFT)
    best = rigid_registration(REST, onto, mass, scale=scale)

    def squared(p: FloatArray) -> float:
        rotation = Rotation.from_rotvec(p[:3]).as_matrix() @ best.rotation
        factor = best.scale * np.exp(p[6]) if scale else 1.0
        tried = RigidMotion(rotation, best.translation + p[3:6], factor)
        return distance(tried, REST, onto, mass) ** 2

    start = np.random.default_rng(0).normal(0, 0.3, 7)
    found = minimize(squared, start, options={"gtol": 1e-9})
    assert squared(np.zeros(7)) <= found.fun * (1 + 1e-12)
    assert squared(np.zeros(7)) == pytest.approx(found.fun, rel=1e-8)


def test_the_result_depends_on_the_mass_matrix() -> None:
    """The optima for the consistent and the lumped mass differ; each is better in its own norm."""
    full, lumped = mass_matrix(BAR), mass_matrix(BAR, lumped=True)
    a, b = (rigid_registration(BENT, REST, mass) for mass in (full, lumped))
    assert distance(a, BENT, REST, full) < distance(b, BENT, REST, full) * (1 - 1e-9)
    assert distance(b, BENT, REST, lumped) < distance(a, BENT, REST, lumped) * (1 - 1e-9)


@pytest.mark.parametrize("lumped", [False, True])
def test_the_residual_is_orthogonal_to_rigid_motions(lumped: bool) -> None:
    """This is why a subspace of such displacements has no rigid null directions."""
    mass = mass_matrix(BAR, lumped=lumped)
    onto = moved(REST, random_rotation(5), SHIFT)
    shapes = np.stack([deformed(BAR, 0.3, seed=seed) for seed in range(5)])
    for remaining in registered(shapes, onto, mass) - onto:
        length = mass_norm(mass, remaining)
        assert length > 0.1
        for direction in rigid_directions(onto):
            cosine = mass_inner(mass, remaining, direction)
            assert abs(cosine) < 1e-13 * length * mass_norm(mass, direction)
    motion = rigid_registration(shapes[0], onto, mass, scale=True)
    remaining = motion.apply(shapes[0]) - onto
    for direction in [*rigid_directions(onto), motion.apply(shapes[0])]:
        cosine = mass_inner(mass, remaining, direction)
        assert abs(cosine) < 1e-13 * mass_norm(mass, remaining) * mass_norm(mass, direction)


def test_registration_undoes_any_motion_of_the_shape() -> None:
    """Snapshots must not depend on the frame in which a solver ends."""
    expected = registered(BENT, REST, MASS)
    for seed in range(5):
        other = moved(BENT, random_rotation(seed), SHIFT)
        assert registered(other, REST, MASS) == pytest.approx(expected, abs=1e-13)
    assert registered(expected, REST, MASS) == pytest.approx(expected, abs=1e-13)


def test_rows_are_registered_one_by_one() -> None:
    shapes = np.stack([BENT, moved(BENT, random_rotation(), SHIFT), REST])
    together = registered(shapes, REST, MASS)
    assert together.shape == shapes.shape
    for row, shape in zip(together, shapes, strict=True):
        assert np.array_equal(row, registered(shape, REST, MASS))
    assert np.array_equal(together, registered(np.asfortranarray(shapes), REST, MASS))
    assert together[2] == pytest.approx(REST, abs=1e-14)
    assert registered(shapes[:0], REST, MASS).shape == (0, len(REST))


@pytest.mark.parametrize("scale", [False, True])
def test_reflections_are_never_returned(scale: bool) -> None:
    for shape in (REST, BENT):
        mirrored = moved(shape, random_rotation() @ MIRROR, SHIFT)
        motion = rigid_registration(mirrored, shape, MASS, scale=scale)
        assert_proper(motion.rotation)
        assert distance(motion, mirrored, shape, MASS) > 0.1


def test_a_mirrored_shape_gets_the_best_rotation() -> None:
    """The best rotation leaves the thin direction mirrored."""
    plate = bar(6, 4, 1, length=3.0, width=2.0, height=0.2)
    rest, mass = plate.vertices.reshape(-1), mass_matrix(plate)
    motion = rigid_registration(moved(rest, MIRROR), rest, mass)
    assert motion.rotation == pytest.approx(np.eye(3), abs=1e-12)


def line(direction: FloatArray) -> FloatArray:
    """All vertices on a line through a point off the origin."""
    along = (BAR.vertices @ [1.0, 0.3, 0.2])[:, None]
    return (along * direction + SHIFT).reshape(-1)


@pytest.mark.parametrize("scale", [False, True])
def test_a_line_takes_the_smallest_rotation(scale: bool) -> None:
    a, b = np.array([1.0, 0.0, 0.0]), np.array([0.6, 0.8, 0.0])
    motion = rigid_registration(line(a), line(b), MASS, scale=scale)
    smallest = Rotation.from_rotvec([0.0, 0.0, np.arccos(a @ b)]).as_matrix()
    assert motion.rotation == pytest.approx(smallest, abs=1e-12)
    assert motion.apply(line(a)) == pytest.approx(line(b), abs=1e-12)


def test_a_line_onto_a_body_and_onto_its_opposite() -> None:
    for onto in (REST, line(np.array([-1.0, 0.0, 0.0]))):
        motion = rigid_registration(line(np.array([1.0, 0.0, 0.0])), onto, MASS)
        assert_proper(motion.rotation)
        again = rigid_registration(line(np.array([1.0, 0.0, 0.0])), onto, MASS)
        assert np.array_equal(motion.rotation, again.rotation)


@pytest.mark.parametrize("position", [0.0, 1.0, 1e6])
def test_a_shape_without_extent_is_only_shifted(position: float) -> None:
    rounding = np.finfo(float).eps * np.random.default_rng(0).integers(-1, 2, len(REST))
    point = np.full(len(REST), position * 1.1) * (1 + rounding)
    for shape, onto in ((point, BENT), (BENT, point), (point, point + 1.0)):
        motion = rigid_registration(shape, onto, MASS)
        assert np.array_equal(motion.rotation, np.eye(3))
        mean_difference = distance(motion, shape, onto, MASS)
        shifted = RigidMotion(np.eye(3), motion.translation + 0.01)
        assert distance(shifted, shape, onto, MASS) > mean_difference


def test_a_rotation_that_is_barely_determined_is_still_found() -> None:
    """In a needle's cross covariance, the rotation about its axis is in the tenth digit."""
    thin = (BAR.vertices * [1.0, 1e-5, 1e-5]).reshape(-1)
    rotation = random_rotation()
    motion = rigid_registration(thin, moved(thin, rotation), MASS)
    assert motion.rotation == pytest.approx(rotation, abs=1e-4)
    assert motion.apply(thin) == pytest.approx(moved(thin, rotation), abs=1e-12)


def test_far_from_the_origin_only_digits_of_the_coordinates_are_lost() -> None:
    rotation = random_rotation()
    motion = rigid_registration(REST + 1e6, moved(REST, rotation, 1e6), MASS)
    assert motion.rotation == pytest.approx(rotation, abs=1e-9)


def test_blas_threads_do_not_change_a_bit() -> None:
    rng = np.random.default_rng(0)
    n = 400_000  # large enough for BLAS to share its sums between threads
    onto, mass = rng.normal(size=3 * n), csr_array(diags_array(rng.random(n)))
    shape = onto + rng.normal(0, 0.1, 3 * n)
    results = []
    for threads in (1, 2):
        with threadpool_limits(limits=threads, user_api="blas"):
            motion = rigid_registration(shape, onto, mass)
            assert np.array_equal(registered(shape, onto, mass), motion.apply(shape))
            results.append(motion)
    assert np.array_equal(results[0].rotation, results[1].rotation)
    assert np.array_equal(results[0].translation, results[1].translation)


def test_the_inverse_undoes_a_motion() -> None:
    motion = RigidMotion(random_rotation(), SHIFT, 2.5)
    assert motion.inverse().apply(motion.apply(BENT)) == pytest.approx(BENT)
    assert motion.apply(motion.inverse().apply(BENT)) == pytest.approx(BENT)
    assert motion.inverse().scale == 1 / 2.5


def test_a_motion_takes_vectors_and_points() -> None:
    motion = RigidMotion(random_rotation(), SHIFT, 2.5)
    points = motion.apply(BAR.vertices)
    assert np.array_equal(motion.apply(REST), points.reshape(-1))
    vertex = BAR.vertices[4]
    assert points[4] == pytest.approx(2.5 * motion.rotation @ vertex + SHIFT)
    for wrong in (np.zeros(4), np.zeros((6, 2)), np.zeros((2, 2, 3)), 1.0):
        with pytest.raises(ValueError, match=r"RigidMotion: a shape must be \(3n,\) or \(n, 3\)"):
            motion.apply(wrong)


def not_finite(vertex: int) -> FloatArray:
    x = REST.copy()
    x[3 * vertex + 1] = np.inf
    return x


POINT = np.zeros(len(REST))
BAD: list[tuple[FloatArray, FloatArray, bool, str]] = [
    (REST[3:], REST, False, "shape has shape (105,), but the mass matrix has 36 vertices, so (108"),
    (REST, REST[3:], False, "onto has shape (105,), but the mass matrix has 36 vertices"),
    (BAR.vertices, REST, False, "shape has shape (36, 3), but"),
    (not_finite(7), REST, False, "shape is not finite at vertex 7"),
    (REST, not_finite(30), False, "onto is not finite at vertex 30"),
    (POINT + 1.1, REST, True, "the shapes have no extent in common, so no scale is best; check"),
    (REST, POINT + 1.1, True, "the shapes have no extent in common"),
]


@pytest.mark.parametrize(("shape", "onto", "scale", "message"), BAD)
def test_bad_input_is_refused(
    shape: FloatArray, onto: FloatArray, scale: bool, message: str
) -> None:
    with pytest.raises(ValueError, match=re.escape(f"rigid_registration: {message}")):
        rigid_registration(shape, onto, MASS, scale=scale)


def test_the_bad_row_is_named() -> None:
    with pytest.raises(ValueError, match="registered: row 1 of shapes is not finite at vertex 7"):
        registered(np.stack([REST, not_finite(7)]), REST, MASS)
    with pytest.raises(ValueError, match=r"registered: shapes has shape \(105,\), but"):
        registered(REST[3:], REST, MASS)
    with pytest.raises(ValueError, match=r"registered: shapes has shape \(108, 2\), .*shapes\.T"):
        registered(np.zeros((108, 2)), REST, MASS)
