from __future__ import annotations

import re
from functools import cache
from itertools import combinations

import numpy as np
import pytest

from snapspace.generators import (
    CREATURE_LOWER,
    CREATURE_REGIONS,
    CREATURE_UPPER,
    bar,
    creature,
    creature_handles,
    creature_paint,
    creature_shape,
)

from .conforming import assert_solid

# Made once for all tests that only read it; determinism has its own test.
made = cache(creature)


@pytest.mark.parametrize("tets", [5_000, 25_000])
def test_is_one_solid_without_holes_or_handles(tets: int) -> None:
    assert_solid(made(tets), euler=2)


@pytest.mark.parametrize("tets", [5_000, 5_480, 7_000, 12_000, 25_000, 130_000])
def test_size_and_shape_of_the_tets(tets: int) -> None:
    mesh = made(tets)
    assert abs(len(mesh.tets) - tets) < 0.15 * tets
    assert mesh.dihedral_angles.min() > 8.0


def test_volume_hardly_depends_on_the_resolution() -> None:
    assert made(12_000).volume == pytest.approx(made(25_000).volume, rel=0.03)


def test_stands_on_the_ground_inside_its_box() -> None:
    vertices = made(25_000).vertices
    lower, upper = vertices.min(axis=0), vertices.max(axis=0)
    assert lower[2] == pytest.approx(0.0, abs=0.03)
    assert (lower > CREATURE_LOWER).all() and (upper < CREATURE_UPPER).all()


def test_is_mirror_symmetric_to_the_last_bit() -> None:
    vertices = made(12_000).vertices
    assert {tuple(v) for v in vertices * [1, -1, 1] + 0.0} == {tuple(v) for v in vertices + 0.0}
    points = np.random.default_rng(0).uniform(CREATURE_LOWER, CREATURE_UPPER, (1000, 3))
    assert np.array_equal(creature_shape(points), creature_shape(points * [1, -1, 1]))


def test_the_same_call_gives_the_same_bits() -> None:
    assert creature(5_000).fingerprint == creature(5_000).fingerprint


@pytest.mark.parametrize("tets", [5_000, 25_000])
def test_handles_are_disjoint_and_where_their_names_say(tets: int) -> None:
    mesh = made(tets)
    handles = creature_handles(mesh)
    assert list(handles) == list(CREATURE_REGIONS) == ["feet", "head", "tail"]
    for first, second in combinations(handles.values(), 2):
        assert np.intersect1d(first, second).size == 0
    feet, head, tail = (mesh.vertices[handle] for handle in handles.values())
    assert min(len(feet), len(head), len(tail)) >= 12
    # Four feet: fore and hind, left and right, each with vertices.
    assert len(np.unique(np.sign(feet[:, :2]) @ [2, 1])) >= 4
    assert feet[:, 2].max() < 0.15 * mesh.vertices[:, 2].max()
    assert head[:, 0].min() > 0.0 > tail[:, 0].max()
    # A handle can hold its part only if it spans space.
    for part in (feet, head, tail):
        assert np.linalg.matrix_rank(part - part[0], tol=1e-3) == 3


def test_handles_of_another_mesh_are_refused() -> None:
    with pytest.raises(ValueError, match="creature_handles: no vertex lies in the region 'head'"):
        creature_handles(bar())


def test_paint_is_symmetric_and_in_range() -> None:
    mesh = made(25_000)
    colours = creature_paint(mesh)
    assert colours.shape == mesh.vertices.shape
    assert colours.min() >= 0.0 and colours.max() <= 1.0
    eyes = np.linalg.norm(np.abs(mesh.vertices) - [1.06, 0.3, 1.68], axis=1).argsort()[:6]
    assert colours[eyes].mean() < 0.4 < colours.mean()


@pytest.mark.parametrize(
    ("tets", "message"),
    [
        (4_999, "creature: tets is 4999, but must be at least 5000"),
        (10**8, "creature: tets is 100000000, but must be at most 1500000"),
        (2.5e4, "creature: tets is 25000.0, but must be a whole number"),
    ],
)
def test_refuses(tets: int, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        creature(tets)
