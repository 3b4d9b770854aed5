from __future__ import annotations

import numpy as np
import pytest

from snapspace.mesh.quality import dihedral_angles, tet_volumes
from snapspace.mesh.surface import boundary_faces
from snapspace.stuffing.bcc_lattice import lattice_around
from snapspace.stuffing.clip import clip_tets
from snapspace.stuffing.cut_points import TET_EDGES, CutPoints
from snapspace.stuffing.lattice_warp import ALPHA_LONG, ALPHA_SHORT, lattice_edges, warp_nodes
from snapspace.stuffing.stuffing_stencils import case_numbers, stencil_table

SHAPE = np.array([[-1.0, 0.0, -0.5], [1.0, 0.0, -0.5], [0.0, 1.0, 0.5], [0.0, -1.0, 0.5]])


def test_stencils_fill_exactly_the_inside_of_a_linear_function() -> None:
    # The volume of a simplex below a plane has a closed form, a divided difference of
    # max(-v, 0)^3 over the corner values (Curry & Schoenberg 1966).
    rng = np.random.default_rng(0)
    for number, stencil in enumerate(stencil_table()):
        signs = np.array([number // 3**i % 3 - 1 for i in range(4)])
        values = signs * rng.uniform(0.5, 2.0, 4)
        volumes = tet_volumes(local_points(values), stencil)
        assert (volumes > 0.0).all()
        expected = tet_volumes(SHAPE, np.array([[0, 1, 2, 3]]))[0] * fraction_below_zero(values)
        assert volumes.sum() == pytest.approx(expected, abs=1e-7)


def local_points(values: np.ndarray) -> np.ndarray:
    """The corners of a tet, and where a linear function with these values vanishes on edges."""
    points = np.full((10, 3), np.nan)
    points[:4] = SHAPE
    for k, (i, j) in enumerate(TET_EDGES):
        if values[i] * values[j] < 0:
            t = values[i] / (values[i] - values[j])
            points[4 + k] = (1.0 - t) * SHAPE[i] + t * SHAPE[j]
    return points


def fraction_below_zero(values: np.ndarray) -> float:
    """The share of a tet where the linear function with these corner values is negative."""
    if values.max() <= 0.0:
        return 1.0 if values.min() < 0.0 else 0.0
    if values.min() >= 0.0:
        return 0.0
    rng = np.random.default_rng(1)  # distinct values: the formula divides by differences
    v = values + 1e-9 * rng.standard_normal(4)
    total = 0.0
    for i in range(4):
        if v[i] < 0.0:
            total += (-v[i]) ** 3 / np.prod([v[j] - v[i] for j in range(4) if j != i])
    return float(total)


@pytest.mark.parametrize("seed", range(3))
def test_random_signs_and_worst_cuts_conform_and_are_well_shaped(seed: int) -> None:
    rng = np.random.default_rng(seed)
    lattice = lattice_around(np.zeros(3), np.full(3, 12.0), 1.0)
    points = lattice.points()
    values = rng.choice([-1.0, 1.0], size=len(points))
    values[lattice.on_border()] = 1.0
    tets = lattice.tets_touching(values < 0.0)
    cuts = _random_cuts(rng, points, values, tets)
    edges = lattice_edges(cuts, corner_count=lattice.corner_count, cell=1.0)
    moved, signs, kept = warp_nodes(_unused, points, values, cuts, edges)
    numbers = case_numbers(signs[tets], lattice.odd_nodes()[tets])
    clipped = clip_tets(tets, signs, numbers, stencil_table(), kept)
    vertices = np.concatenate([moved, kept.points])
    assert tet_volumes(vertices, clipped).min() > 0.0
    assert dihedral_angles(vertices, clipped).min() > 8.0
    # Conforming means that all unshared faces lie on the zero set and none inside.
    surface = boundary_faces(clipped.astype(np.int32))
    on_surface = np.concatenate([signs == 0, np.ones(len(kept.points), dtype=bool)])
    assert on_surface[surface].all()


def _random_cuts(
    rng: np.random.Generator, points: np.ndarray, values: np.ndarray, tets: np.ndarray
) -> CutPoints:
    pairs = np.concatenate([tets[:, list(edge)] for edge in TET_EDGES])
    pairs = pairs[values[pairs[:, 0]] * values[pairs[:, 1]] < 0.0]
    pairs = np.where(values[pairs[:, :1]] < 0.0, pairs, pairs[:, ::-1])
    inside, outside = np.unique(pairs, axis=0).T
    corners = np.array([ALPHA_LONG, ALPHA_SHORT, 1.0 - ALPHA_LONG, 1.0 - ALPHA_SHORT])
    near = rng.choice(corners, len(inside)) + rng.uniform(-1e-4, 1e-4, len(inside))
    t = np.where(rng.random(len(inside)) < 0.7, near, rng.uniform(0.001, 0.999, len(inside)))
    return CutPoints(
        inside, outside, t, points[inside] + t[:, None] * (points[outside] - points[inside])
    )


def _unused(points: np.ndarray) -> np.ndarray:
    raise AssertionError("no two cut points are equally near")
