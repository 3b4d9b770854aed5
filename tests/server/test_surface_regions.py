"""Handles that are chosen on a surface hold the tets inside it."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.mesh import EmbeddedSurface, TetMesh, boundary_surface, embed_surface
from snapspace.problem import Handles
from snapspace.server.messages import HandleChoice
from snapspace.server.surface_regions import SurfaceRegions

from ..shapes import bar_problem, surface_around

PROBLEM = bar_problem()
MESH = PROBLEM.mesh
FINE = surface_around(MESH)
LENGTH = np.ptp(MESH.vertices[:, 0])


def box() -> EmbeddedSurface:
    """A surface of eight vertices, with far more tet vertices between them."""
    low, high = MESH.vertices.min(axis=0), MESH.vertices.max(axis=0)
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    faces = [t for a, b, c, d in quads for t in ([a, b, c], [a, c, d])]
    return embed_surface(low + (high - low) * corners, faces, MESH, farthest=0.1)


def along(surface: EmbeddedSurface) -> np.ndarray:
    """Positions of surface vertices between the ends, from 0 to 1."""
    x = surface.vertices(MESH.vertices)[:, 0]
    share: np.ndarray = (x - MESH.vertices[:, 0].min()) / LENGTH
    return share


def ends(surface: EmbeddedSurface, width: float = 0.2) -> Handles:
    share = along(surface)
    return Handles([share < width, share > 1 - width], names=["foot", "head"])


@pytest.mark.parametrize("surface", [FINE, box(), boundary_surface(MESH)])
def test_the_tets_of_an_end_are_held_and_others_are_not(surface: EmbeddedSurface) -> None:
    found = SurfaceRegions(MESH, surface).in_tets(ends(surface))
    assert found.names == ("foot", "head")
    share = (MESH.vertices[:, 0] - MESH.vertices[:, 0].min()) / LENGTH
    boundary = np.isin(np.arange(len(share)), MESH.surface_vertices)
    for handle, low, high in zip(found, (-0.1, 0.9), (0.1, 1.1), strict=True):
        inner = np.flatnonzero(boundary & (share > low) & (share < high))
        assert np.isin(inner, handle.vertices).all()
    assert found["foot"].vertices.max(initial=0) < len(share)
    assert share[found["foot"].vertices].max() < 0.6 < share[found["head"].vertices].max()
    assert share[found["head"].vertices].min() > 0.4


def test_on_the_boundary_itself_the_handles_are_the_chosen_vertices() -> None:
    surface = boundary_surface(MESH)
    chosen = ends(surface)
    found = SurfaceRegions(MESH, surface).in_tets(chosen)
    for one, other in zip(found, chosen, strict=True):
        assert np.array_equal(one.vertices, MESH.surface_vertices[other.vertices])


def test_a_handle_of_a_problem_is_the_same_after_it_was_shown() -> None:
    regions = SurfaceRegions(MESH, FINE)
    choices = [
        HandleChoice(name=handle.name, vertices=tuple(handle.vertices.tolist()), moving=False)
        for handle in PROBLEM.handles
    ]
    shown = regions.shown(choices)
    for choice, own in zip(choices, shown, strict=True):
        assert own.name == choice.name
        assert np.isin(FINE.nearest[list(own.vertices)], choice.vertices).all()
    chosen = Handles([own.vertices for own in shown], names=PROBLEM.handles.names)
    for again, handle in zip(regions.in_tets(chosen), PROBLEM.handles, strict=True):
        assert np.array_equal(again.vertices, handle.vertices)


def test_a_handle_that_no_surface_vertex_follows_is_shown_around_it() -> None:
    surface = box()
    middle = np.setdiff1d(MESH.surface_vertices, surface.nearest)[:3]
    choices = [
        HandleChoice(name="corner", vertices=(int(surface.nearest[0]),), moving=False),
        HandleChoice(name="middle", vertices=tuple(middle.tolist())),
    ]
    corner, around = SurfaceRegions(MESH, surface).shown(choices)
    assert around.vertices and not set(around.vertices) & set(corner.vertices)


def test_an_unchanged_handle_stays_when_another_comes_close() -> None:
    """Otherwise the samples that were solved for it would be useless."""
    regions = SurfaceRegions(MESH, FINE)
    first = ends(FINE)
    before = regions.in_tets(first)
    share = along(FINE)
    after = regions.in_tets(first.adding("waist", np.flatnonzero((share >= 0.2) & (share < 0.4))))
    for name in first.names:
        assert np.array_equal(after[name].vertices, before[name].vertices)


def test_one_vertex_of_a_fine_surface_holds_the_tet_around_it() -> None:
    handles = Handles([[0], [len(FINE.corners) - 1]], names=["a", "b"])
    for handle in SurfaceRegions(MESH, FINE).in_tets(handles):
        assert len(handle.vertices) >= 3


def test_handles_without_enough_vertices_are_refused() -> None:
    surface = boundary_surface(MESH)
    regions = SurfaceRegions(MESH, surface)
    few = Handles([[0, 1, 2], [7]], names=["a", "b"])
    with pytest.raises(ValueError, match=r"'b' has 1 of the surface's vertices, but only 1 of"):
        regions.in_tets(few)
    with pytest.raises(ValueError, match="'b' has vertex index 99999, but the surface has"):
        regions.in_tets(Handles([[0, 1, 2], [99999]], names=["a", "b"]))


def test_disjoint_handles_stay_disjoint_on_coarse_tets() -> None:
    """Neighbours on a fine surface may follow the same tet vertex."""
    coarse = TetMesh(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], [[0, 1, 2, 3], [1, 2, 3, 4]]
    )
    rng = np.random.default_rng(0)
    points = rng.dirichlet(np.ones(4), size=60) @ coarse.vertices[[1, 2, 3, 4]]
    faces = np.arange(60).reshape(20, 3)
    regions = SurfaceRegions(coarse, embed_surface(points, faces, coarse))
    order = np.argsort(points[:, 0])
    with pytest.raises(ValueError, match="choose a larger part, or fill the surface with smaller"):
        regions.in_tets(Handles([order[:30], order[30:]], names=["a", "b"]))
