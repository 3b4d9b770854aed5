"""Handles that are chosen on a surface hold the tets inside it."""

from __future__ import annotations

import numpy as np

from snapspace.problem import Handles
from snapspace.server.messages import HandleChoice
from snapspace.server.surface_regions import SurfaceRegions

from ..surface_handles import FINE, MESH, PROBLEM, along, box, ends


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
