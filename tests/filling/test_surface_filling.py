"""How a surface is filled, and the stages that the page is shown."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from snapspace.filling import SurfaceFilling, surface_filling
from snapspace.generators import bar
from snapspace.mesh import MeshNotice, TetMesh, compact_surface
from snapspace.stuffing import root_finding

from ..shapes import one_tet
from .test_stuff_surface import ring

ORDER = ["filling", "filling inside", "filling boundary"]


def filled(mesh: TetMesh, how: SurfaceFilling) -> tuple[TetMesh, list[str]]:
    """The tets, and the stages in their order."""
    stages: list[str] = []

    def stage(name: str, done: int = 0, total: int = 0) -> None:
        assert 0 <= done <= total or (name == "filling exactly" and total == 0)
        if stages[-1:] != [name]:
            stages.append(name)

    tets = how.fill(*compact_surface(mesh.vertices, mesh.surface), stage=stage)
    return tets, stages


def test_work_is_counted_while_a_surface_is_filled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(root_finding, "_CHUNK", 1 << 10)
    block = bar(2, 2, 2, length=1.0, width=1.0, height=1.0)
    surface = compact_surface(block.vertices, block.surface)
    told: list[tuple[str, int, int]] = []
    how = SurfaceFilling(edge_length=0.06)
    how.fill(*surface, stage=lambda name, done=0, total=0: told.append((name, done, total)))
    assert told[0] == ("filling", 0, 0), "first the stage alone"
    for part in ("filling inside", "filling boundary"):
        counts = [(done, total) for name, done, total in told if name == part]
        done, totals = zip(*counts, strict=True)
        assert len(done) > 2 and len(set(totals)) == 1
        assert list(done) == sorted(done) and done[-1] == totals[0]
    assert [name for name, _, _ in told] == sorted((n for n, _, _ in told), key=ORDER.index)


def test_a_solid_is_filled_by_stuffing() -> None:
    block = bar(2, 2, 2, length=1.0, width=1.0, height=1.0)
    mesh, stages = filled(block, SurfaceFilling(edge_length=0.1))
    assert stages == ORDER
    assert mesh.volume == pytest.approx(block.volume, rel=0.05)


def test_a_plate_too_thin_for_stuffing_is_filled_exactly() -> None:
    """Its thickness is a tenth of the edge length, so no tet of that size fits."""
    plate = bar(1, 1, 1, length=1.0, width=1.0, height=0.03)
    mesh, stages = filled(plate, SurfaceFilling(edge_length=0.3))
    assert (stages[0], stages[-1]) == ("filling", "filling exactly")
    assert mesh.volume == pytest.approx(plate.volume, rel=0.1)


def test_a_surface_is_filled_exactly_on_request() -> None:
    mesh, stages = filled(one_tet(), SurfaceFilling(edge_length=0.2, exact=True))
    assert stages == ["filling exactly"]
    assert np.allclose(np.ptp(mesh.vertices, axis=0), 1.0, atol=0.01)


def test_an_open_surface_is_mended_with_a_notice() -> None:
    block = bar(2, 2, 2, length=1.0, width=1.0, height=1.0)
    vertices, faces = compact_surface(block.vertices, block.surface)
    with pytest.warns(MeshNotice, match="closed 1 hole with 1 face"):
        mesh = SurfaceFilling(edge_length=0.1).fill(vertices, faces[1:], stage=lambda *_: None)
    assert mesh.volume == pytest.approx(block.volume, rel=0.05)


def test_more_closed_gaps_than_allowed_leave_the_surface_to_ftetwild(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A ring whose ends are nearer than the tets: poses must not be blended when it is closed."""

    def exactly(*_: Any, **__: Any) -> TetMesh:
        return one_tet()

    monkeypatch.setattr(surface_filling, "fill_surface", exactly)
    quick = SurfaceFilling(edge_length=0.06)
    with pytest.warns(MeshNotice, match="in 1 place"):
        closed = quick.fill(*ring(0.01), stage=lambda *_: None)
    assert len(closed.tets) > 100
    open_ = replace(quick, most_closed=0).fill(*ring(0.01), stage=lambda *_: None)
    assert len(open_.tets) == 1
