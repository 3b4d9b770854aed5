"""Lattices with smaller cells near some points: conforming, and regular where they can be."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from snapspace.mesh.equal_faces import equal_faces
from snapspace.mesh.quality import tet_volumes
from snapspace.mesh.surface import FACES
from snapspace.stuffing.bcc_lattice import lattice_around
from snapspace.stuffing.graded_lattice import GradedLattice, GradedTets
from snapspace.stuffing.halved_tets import (
    can_fit,
    coordinates_of,
    divided_edges,
    eighths,
    fitted,
    middles,
    node_keys,
)

LEVELS = 3
#: A lattice tet: its long edges join 0 and 1, and 2 and 3.
TET = np.array([[0, 0, 0], [16, 0, 0], [8, 8, 8], [8, 8, -8]]) + 64


def lattice() -> GradedLattice:
    return GradedLattice(lattice_around(np.zeros(3), np.full(3, 4.0), 1.0), LEVELS)


def volumes(keys: np.ndarray) -> np.ndarray:
    corners = coordinates_of(keys).reshape(-1, 3).astype(float)
    return np.abs(tet_volumes(corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 4)))


def test_keys_name_whole_coordinates() -> None:
    nodes = np.random.default_rng(0).integers(0, 2**20, (100, 3))
    assert np.array_equal(coordinates_of(node_keys(nodes)), nodes)


def test_eighths_are_lattice_tets_of_half_the_size() -> None:
    tet = node_keys(TET)[None]
    parts = eighths(eighths(tet))
    assert volumes(parts) == pytest.approx(volumes(tet)[0] / 64)
    corners = coordinates_of(parts).astype(float)
    for one, other, length in ((0, 1, 4.0), (2, 3, 4.0), (0, 2, 4.0 * np.sqrt(0.75))):
        lengths = np.linalg.norm(corners[:, one] - corners[:, other], axis=1)
        assert lengths == pytest.approx(length), "long edges stay between the same nodes"


@pytest.mark.parametrize("number", range(1, 63))
def test_every_division_that_is_offered_fills_the_tet_and_uses_the_middles(number: int) -> None:
    tet = node_keys(TET)[None]
    divided = np.array([[bool(number >> k & 1) for k in range(6)]])
    if not can_fit(divided)[0]:
        assert divided.sum() > 2, "one or two edges always fit"
        return
    parts = fitted(tet, divided)
    assert volumes(parts).min() > 0.0
    assert volumes(parts).sum() == pytest.approx(volumes(tet)[0])
    assert set(middles(tet)[divided]) == set(parts.ravel()) - set(tet.ravel())
    assert not divided_edges(parts, np.unique(parts)).any(), "no node inside an edge"


def assert_conforming(grid: GradedTets) -> None:
    """Faces belong to two tets or lie on the border, and the tets fill what one size fills."""
    assert np.abs(tet_volumes(grid.points, grid.tets.astype(np.int32))).min() > 0.0
    faces = grid.tets[:, FACES].reshape(-1, 3).astype(np.int32)
    order, same = equal_faces(faces)
    twice = np.zeros(len(faces), bool)
    twice[order[:-1][same]] = twice[order[1:][same]] = True
    middle = grid.points[faces[~twice]].mean(axis=1)
    assert ((middle < 0.0) | (middle > 4.0)).any(axis=1).all(), "an open face inside the box"


@settings(max_examples=15)
@given(
    centers=st.lists(st.tuples(*[st.floats(0.5, 3.5)] * 3), min_size=1, max_size=5),
    seed=st.integers(0, 99),
)
def test_tets_conform_wherever_they_get_smaller(
    centers: list[tuple[float, float, float]], seed: int
) -> None:
    levels = np.random.default_rng(seed).integers(1, LEVELS + 1, len(centers))
    grid = lattice().tets(np.array(centers), levels)
    assert_conforming(grid)
    whole = lattice().tets(np.zeros((0, 3)), np.zeros(0, np.intp))
    assert np.isin(whole.keys, grid.keys).all(), "the same keys name the same nodes"
    filled, all_of_it = (
        np.abs(tet_volumes(g.points, g.tets.astype(np.int32))).sum() for g in (grid, whole)
    )
    assert filled == pytest.approx(all_of_it)


def test_more_cells_than_keys_can_name_are_refused() -> None:
    wire = lattice_around(np.zeros(3), np.array([100_000.0, 1.0, 1.0]), 1.0)
    with pytest.raises(ValueError, match=r"GradedLattice: cell is 1\.0, which makes .* half cells"):
        GradedLattice(wire, LEVELS)


def test_the_smallest_cells_are_around_the_center_and_regular() -> None:
    center = np.array([2.1, 1.9, 2.2])
    grid = lattice().tets(center[None], np.array([LEVELS]))
    distances = np.linalg.norm(grid.points[grid.tets].mean(axis=1) - center, axis=1)
    near = distances < 0.1
    sizes = np.abs(tet_volumes(grid.points, grid.tets.astype(np.int32)))
    assert near.any() and sizes[near] == pytest.approx((1 / 2**LEVELS) ** 3 / 12)
    assert not grid.irregular[grid.tets[near]].any()
    assert sizes[distances > 3.0].max() == pytest.approx(1 / 12)
