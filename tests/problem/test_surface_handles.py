"""handles_in_tets: handles chosen on a surface hold the tets inside it."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import Handles, TetMesh, embed_surface, handles_in_tets
from snapspace.mesh import EmbeddedSurface, boundary_surface

from ..surface_handles import FINE, MESH, box, ends


@pytest.mark.parametrize("surface", [FINE, box(), boundary_surface(MESH)])
def test_the_tets_of_an_end_are_held_and_others_are_not(surface: EmbeddedSurface) -> None:
    found = handles_in_tets(ends(surface), MESH, surface)
    assert found.names == ("foot", "head")
    share = (MESH.vertices[:, 0] - MESH.vertices[:, 0].min()) / np.ptp(MESH.vertices[:, 0])
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
    found = handles_in_tets(chosen, MESH, surface)
    for one, other in zip(found, chosen, strict=True):
        assert np.array_equal(one.vertices, MESH.surface_vertices[other.vertices])


def test_one_vertex_of_a_fine_surface_holds_the_tet_around_it() -> None:
    handles = Handles([[0], [len(FINE.corners) - 1]], names=["a", "b"])
    for handle in handles_in_tets(handles, MESH, FINE):
        assert len(handle.vertices) >= 3


def test_handles_without_enough_vertices_are_refused() -> None:
    surface = boundary_surface(MESH)
    few = Handles([[0, 1, 2], [7]], names=["a", "b"])
    with pytest.raises(ValueError, match=r"'b' has 1 of the surface's vertices, but only 1 of"):
        handles_in_tets(few, MESH, surface)
    with pytest.raises(ValueError, match="'b' has vertex index 99999, but the surface has"):
        handles_in_tets(Handles([[0, 1, 2], [99999]], names=["a", "b"]), MESH, surface)


def test_a_mask_over_other_vertices_than_those_of_the_surface_is_refused() -> None:
    surface, n = boundary_surface(MESH), len(MESH.vertices)
    of_tets = Handles([np.arange(n) < 3, np.arange(n) > n - 9], names=["a", "b"])
    message = f"handle 'a': the mask has {n} entries, but the surface has {len(surface.corners)} v"
    with pytest.raises(ValueError, match=message):
        handles_in_tets(of_tets, MESH, surface)


def test_disjoint_handles_stay_disjoint_on_coarse_tets() -> None:
    """Neighbours on a fine surface may follow the same tet vertex."""
    coarse = TetMesh(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], [[0, 1, 2, 3], [1, 2, 3, 4]]
    )
    rng = np.random.default_rng(0)
    points = rng.dirichlet(np.ones(4), size=60) @ coarse.vertices[[1, 2, 3, 4]]
    faces = np.arange(60).reshape(20, 3)
    surface = embed_surface(points, faces, coarse)
    order = np.argsort(points[:, 0])
    halves = Handles([order[:30], order[30:]], names=["a", "b"])
    with pytest.raises(ValueError, match="choose a larger part, or fill the surface with smaller"):
        handles_in_tets(halves, coarse, surface)
