"""How far weights may go below zero and above one, by closed forms and by the definition."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace import InterpolationProblem, Poses, StableNeoHookean, StVK
from snapspace.generators import bar, lizard_poses
from snapspace.material import MATERIALS
from snapspace.mesh import tet_volumes
from snapspace.problem import CertainRange, certain_range

from ..shapes import CORNER_TET, one_tet, random_rotation

FloatArray = NDArray[np.float64]
LIZARDS = Poses.of(lizard_poses(4, 500))
RANGE = CertainRange(LIZARDS.shapes[:, LIZARDS.tets])


def scaled(*scales: float) -> CertainRange:
    """A tet at several sizes, each in its own frame."""
    rest = CORNER_TET + np.array([0.3, 0.1, -0.2])
    return CertainRange([[s * rest @ random_rotation(k)] for k, s in enumerate(scales)])


def terms(poses: Poses) -> tuple[FloatArray, FloatArray]:
    """M and alpha of every tet and pose, from deformation gradients: a second implementation."""
    edges = (poses.shapes[:, poses.tets[:, 1:]] - poses.shapes[:, poses.tets[:, :1]]).swapaxes(2, 3)
    volumes = np.abs(poses.volumes)
    maps = edges[0] @ np.linalg.inv(edges)
    squares = volumes[..., None, None] * maps @ maps.swapaxes(2, 3)
    return squares, volumes * np.linalg.det(maps) ** 2


directions = st.lists(st.floats(-1, 1), min_size=4, max_size=4).map(
    lambda entries: np.array(entries) - np.mean(entries)
)


def test_for_two_sizes_stiffness_bounds_the_range_below_and_volume_above() -> None:
    """At size s against size 1: M is 1 + w (s - 1), alpha is 1 + w (1 / s^3 - 1)."""
    for s in (0.3, 2.0, 5.0):
        ends = -1 / (s - 1), 1 / (1 - s**-3)
        least, greatest = min(ends), max(ends)
        found = scaled(1.0, s)
        assert found.limits()[1] == pytest.approx([least, greatest], rel=1e-12)
        assert found.limits()[0] == pytest.approx([1 - greatest, 1 - least], rel=1e-12)


def test_the_range_of_three_sizes_is_the_polygon_of_two_inequalities() -> None:
    sizes = np.array([1.0, 1.5, 0.6])
    found = scaled(*sizes)
    for w in np.random.default_rng(4).uniform(-3, 3, (200, 3)):
        w[0] = 1 - w[1:].sum()
        relative = min(w @ sizes / sizes.mean(), w @ sizes**-3 / (sizes**-3).mean())
        assert found.margin(w) == pytest.approx(relative, abs=1e-12)
        assert found.holds(w) == (relative > 0)


def test_the_least_eigenvalue_of_a_stretched_tet_is_across_or_along() -> None:
    """Stretched by s along x: v A A^T is diag(1 / s, s, s), and v a^2 is 1 / s."""
    s = 1.6
    found = CertainRange([[CORNER_TET], [CORNER_TET * [s, 1, 1]]])
    assert found.limits()[1] == pytest.approx([-1 / (s - 1), 1 / (1 - 1 / s)])


def test_poses_that_differ_by_rigid_motions_have_no_bound() -> None:
    found = scaled(1.0, 1.0, 1.0)
    assert np.array_equal(found.limits(), [[-np.inf, np.inf]] * 3)
    assert found.holds([50.0, -70.0, 21.0])


@given(direction=directions)
def test_one_term_vanishes_on_the_bound_and_none_inside(direction: FloatArray) -> None:
    toward = 0.25 + direction
    reach = RANGE.reach(toward)
    if not reach < 1e3:
        return  # the direction is too short
    squares, alphas = terms(LIZARDS)
    for share in (0.5, 0.999, 1.0, 1.001):
        w = 0.25 + share * reach * direction
        least = np.linalg.eigvalsh(np.tensordot(w, squares, 1))[:, 0] / squares[0, :, 0, 0]
        alpha = np.tensordot(w, alphas, 1) / alphas[0]
        smallest = min(least.min(), alpha.min())
        if share == 1.0:
            assert abs(smallest) < 1e-10
        assert share == 1.0 or (smallest > 0) == (share < 1) == RANGE.holds(w)


@given(a=directions, b=directions, share=st.floats(0, 1))
def test_the_range_is_convex_and_contains_the_simplex(
    a: FloatArray, b: FloatArray, share: float
) -> None:
    first, second = 0.25 + 4 * a, 0.25 + 4 * b
    between = share * first + (1 - share) * second
    least = share * RANGE.margin(first) + (1 - share) * RANGE.margin(second)
    assert RANGE.margin(between) >= least - 1e-9, "the margin is concave"
    inside = np.abs(a) + 1e-3
    assert RANGE.holds(inside / inside.sum())


def test_paths_from_any_start_end_on_the_same_bound() -> None:
    toward = np.array([0.5, 2.0, -1.0, -0.5])
    end = 0.25 + RANGE.reach(toward) * (toward - 0.25)
    for start in np.eye(4):
        assert RANGE.reach(end, start=start) == pytest.approx(1.0, rel=1e-9)
    outside = 0.25 + 1.1 * (end - 0.25)
    assert RANGE.reach([1, 0, 0, 0], start=outside) == 0.0
    assert RANGE.reach(np.eye(4)[1], start=np.eye(4)[1]) == np.inf, "a path of no length"


def test_the_energy_of_one_tet_falls_without_bound_beyond_and_grows_within() -> None:
    """The compiled energy itself, along flat shapes, where J = 0 and its terms do not grow."""
    shapes = [CORNER_TET, CORNER_TET * [1.5, 0.8, 1.1] @ random_rotation()]
    problem = InterpolationProblem(
        Poses(np.stack(shapes), one_tet().tets),
        material=StableNeoHookean(lam=1.5, mu=0.7),
        mean_shape=CORNER_TET.reshape(-1),
    )
    found = problem.certain_range
    assert found is not None
    least = found.limits()[1, 0]
    along = np.linalg.eigh(np.tensordot([1 - least, least], terms(problem.poses)[0], 1)[0])[1][:, 0]
    line = np.outer(CORNER_TET @ along, [0.0, 0.0, 1.0]).reshape(-1)
    values = {
        share: [
            problem.value_and_gradient(size * line, [1 - share * least, share * least])[0]
            for size in (100.0, 200.0)
        ]
        for share in (0.99, 1.01)
    }
    assert values[0.99][1] > values[0.99][0] > 0
    assert values[1.01][1] < values[1.01][0] < 0


def test_the_range_does_not_depend_on_frames_sizes_or_moduli() -> None:
    poses = LIZARDS.shapes.copy()
    poses[2] = poses[2] @ random_rotation() + [3.0, 1.0, -2.0]
    moved = InterpolationProblem(
        Poses(1e-3 * poses, LIZARDS.tets), material=StableNeoHookean(lam=9.0, mu=0.1)
    )
    assert moved.certain_range is not None
    assert moved.certain_range.limits() == pytest.approx(RANGE.limits(), rel=1e-8)


def test_only_materials_that_collapse_have_a_range() -> None:
    corners = LIZARDS.shapes[:, LIZARDS.tets]
    for kind, material in MATERIALS.items():
        known = certain_range(material.from_lame(lam=1.0, mu=1.0), corners)
        assert (known is not None) == (kind == "stable-neo-hookean")
    assert InterpolationProblem(LIZARDS, material=StVK()).certain_range is None


def test_an_inverted_tet_counts_as_its_mirror_image() -> None:
    mesh = bar(1, 1, 1)
    mirrored = mesh.vertices * [-1.3, 1.0, 1.0]
    assert (tet_volumes(mirrored, mesh.tets) < 0).all()
    found, wanted = (
        CertainRange([mesh.vertices[mesh.tets], x[mesh.tets]])
        for x in (mirrored, mesh.vertices * [1.3, 1.0, 1.0])
    )
    assert found.limits() == pytest.approx(wanted.limits())


WRONG: list[tuple[Any, str]] = [
    ([CORNER_TET], "corners must be (poses, tets, 4, 3) with two poses or more"),
    ([[CORNER_TET]], "two poses or more and a tet, got (1, 1, 4, 3)"),
    (np.zeros((2, 0, 4, 3)), "two poses or more and a tet, got (2, 0, 4, 3)"),
    ([[CORNER_TET], [CORNER_TET * [1, 1, 0]]], "tet 0 of pose 1 has no volume"),
    ([[CORNER_TET], [CORNER_TET * np.nan]], "a corner is not finite"),
]


@pytest.mark.parametrize(("corners", "message"), WRONG)
def test_wrong_corners_are_refused(corners: Any, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)) as caught:
        CertainRange(corners)
    assert str(caught.value).startswith("CertainRange: ")


BAD_WEIGHTS: list[tuple[Any, str]] = [
    ([1.0, 0.0], "CertainRange: 4 poses need 4 weights, got 2"),
    ([1, 1, 1, 1], "CertainRange: the weights sum to 4, but they must sum to 1"),
    ([np.inf, 0, 0, 1], "CertainRange: weight 0 is inf, but it must be finite"),
    ("abcd", "CertainRange: weights must be 4 numbers, one per pose"),
]


@pytest.mark.parametrize(("weights", "message"), BAD_WEIGHTS)
def test_wrong_weights_are_refused(weights: Any, message: str) -> None:
    for ask in (RANGE.margin, RANGE.holds, RANGE.reach):
        with pytest.raises(ValueError, match=re.escape(message)):
            ask(weights)
    with pytest.raises(ValueError, match=re.escape(message)):
        RANGE.reach([1, 0, 0, 0], start=weights)


def test_huge_weights_are_far_outside() -> None:
    assert not RANGE.holds([1e308, -1e308, 1.0, 0.0])
    assert 0 < RANGE.reach([1e307, -1e307, 1.0, 0.0]) < 1e-300
