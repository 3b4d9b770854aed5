"""Stuffing with smaller cells near some points."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from snapspace.mesh import TetMesh
from snapspace.mesh.quality import tet_volumes
from snapspace.stuffing import GradedStuffing
from snapspace.stuffing.ranked_stencils import ranked_table

from ..generators.conforming import assert_solid
from .test_isosurface_stuffing import BOX, ball, torus
from .test_stuffing_stencils import SHAPE, fraction_below_zero, local_points

LOW, HIGH = (np.array(corner) for corner in BOX)


def test_stencils_fill_exactly_the_inside_of_a_linear_function() -> None:
    rng = np.random.default_rng(0)
    for number, stencil in enumerate(ranked_table()):
        signs = np.array([number // 3**i % 3 - 1 for i in range(4)])
        values = signs * rng.uniform(0.2, 1.0, 4)
        volumes = np.abs(tet_volumes(local_points(values), stencil))
        expected = tet_volumes(SHAPE, np.array([[0, 1, 2, 3]]))[0] * fraction_below_zero(values)
        assert volumes.sum() == pytest.approx(expected, abs=1e-7), "no overlaps, no gaps"


@settings(max_examples=10)
@given(
    centers=st.lists(st.tuples(*[st.floats(-1.4, 1.4)] * 3), min_size=0, max_size=6),
    seed=st.integers(0, 99),
)
def test_shapes_are_solids_wherever_cells_are_halved(
    centers: list[tuple[float, float, float]], seed: int
) -> None:
    places = np.array(centers).reshape(-1, 3)
    levels = np.random.default_rng(seed).integers(1, 3, len(places))
    for shape, euler, volume in ((ball, 2, 4 / 3 * np.pi), (torus, 0, 2 * np.pi**2 * 0.4**2)):
        stuffing = GradedStuffing(shape, LOW, HIGH, 0.35, levels=2)
        mesh = TetMesh(*stuffing.tets(places, levels))
        assert_solid(mesh, euler=euler)
        assert np.abs(shape(mesh.vertices[mesh.surface_vertices])).max() < 1e-12
        assert mesh.volume == pytest.approx(volume, rel=0.15)
        assert mesh.dihedral_angles.min() > 2.0


def test_a_second_call_evaluates_only_new_nodes_and_gives_the_same() -> None:
    counted = []

    def counting(points: np.ndarray) -> np.ndarray:
        counted.append(len(points))
        return ball(points)

    center, level = np.array([[0.9, 0.0, 0.0]]), np.array([1])
    twice = GradedStuffing(counting, LOW, HIGH, 0.25, levels=1)
    twice.tets(center[:0], level[:0])
    nodes = counted[0]
    counted.clear()
    again = twice.tets(center, level)
    assert counted[0] < 0.3 * nodes
    once = GradedStuffing(ball, LOW, HIGH, 0.25, levels=1).tets(center, level)
    assert all(np.array_equal(a, b) for a, b in zip(again, once, strict=True))
