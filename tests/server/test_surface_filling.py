"""How a surface is filled, and the stages that the page is shown."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.generators import bar
from snapspace.mesh import MeshNotice, TetMesh, compact_surface
from snapspace.server import SurfaceFilling


def filled(mesh: TetMesh, how: SurfaceFilling) -> tuple[TetMesh, list[str]]:
    stages: list[str] = []
    tets = how.fill(*compact_surface(mesh.vertices, mesh.surface), stage=stages.append)
    return tets, stages


def test_a_solid_is_filled_by_stuffing() -> None:
    block = bar(2, 2, 2, length=1.0, width=1.0, height=1.0)
    mesh, stages = filled(block, SurfaceFilling(edge_length=0.1))
    assert stages == ["filling"]
    assert mesh.volume == pytest.approx(block.volume, rel=0.05)


def test_a_plate_too_thin_for_stuffing_is_filled_exactly() -> None:
    """Its thickness is a tenth of the edge length, so no tet of that size fits."""
    plate = bar(1, 1, 1, length=1.0, width=1.0, height=0.03)
    mesh, stages = filled(plate, SurfaceFilling(edge_length=0.3))
    assert stages == ["filling", "filling exactly"]
    assert mesh.volume == pytest.approx(plate.volume, rel=0.1)


def test_a_surface_is_filled_exactly_on_request() -> None:
    block = bar(1, 1, 1, length=1.0, width=1.0, height=1.0)
    mesh, stages = filled(block, SurfaceFilling(edge_length=0.3, exact=True))
    assert stages == ["filling exactly"]
    assert np.allclose(np.ptp(mesh.vertices, axis=0), 1.0, atol=0.01)


def test_an_open_surface_is_mended_with_a_notice() -> None:
    block = bar(2, 2, 2, length=1.0, width=1.0, height=1.0)
    vertices, faces = compact_surface(block.vertices, block.surface)
    stages: list[str] = []
    with pytest.warns(MeshNotice, match="closed 1 holes with 1 faces"):
        mesh = SurfaceFilling(edge_length=0.1).fill(vertices, faces[1:], stage=stages.append)
    assert stages == ["filling"]
    assert mesh.volume == pytest.approx(block.volume, rel=0.05)
