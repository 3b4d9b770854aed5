"""Clusters of points: a partition into groups of neighbours."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from snapspace.cubature.clusters import MULTIPLE, clusters


@given(st.integers(1, 400), st.integers(1, 12), st.integers(0, 5))
def test_every_point_is_in_one_group_of_the_right_size(count: int, size: int, seed: int) -> None:
    points = np.random.default_rng(seed).normal(size=(count, 3))
    groups = clusters(points, MULTIPLE * size)
    np.testing.assert_array_equal(np.sort(np.concatenate(groups)), np.arange(count))
    for group in groups:
        assert 1 <= len(group) <= MULTIPLE * size
        np.testing.assert_array_equal(group, np.sort(group))
    assert all(len(group) % MULTIPLE == 0 for group in groups[:-1])


def test_equal_points_are_divided_too() -> None:
    groups = clusters(np.ones((100, 3)), 48)
    assert [len(group) for group in groups] == [32, 32, 36]


def test_groups_are_neighbours() -> None:
    """Points at both ends of a bar are in different groups, whichever way the bar points."""
    rng = np.random.default_rng(1)
    ends = rng.normal(size=(96, 3))
    ends[48:] += [100.0, 30.0, 9.0]
    order = rng.permutation(96)
    for group in clusters(ends[order], 48):
        assert len(set((order[group] >= 48).tolist())) == 1


def test_groups_do_not_depend_on_the_unit_or_place() -> None:
    points = np.random.default_rng(2).normal(size=(200, 3)) * [3.0, 1.0, 2.0]
    expected = clusters(points, 48)
    for moved in (1e-12 * points, 1e3 * points, points + np.array([5.0, -7.0, 1.0])):
        for group, other in zip(expected, clusters(moved, 48), strict=True):
            np.testing.assert_array_equal(group, other)


@pytest.mark.parametrize("count", [1, 7, 48])
def test_few_points_are_one_group(count: int) -> None:
    assert len(clusters(np.zeros((count, 3)), 48)) == 1
