"""stuff_surface: tets of a lattice that fill a closed surface."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from snapspace.filling import stuff_surface
from snapspace.filling.graded_tets import LOST
from snapspace.generators import bar, cylinder
from snapspace.mesh import MeshNotice, TetMesh, repair_tets
from snapspace.mesh.closed_surface import check_closed, enclosed_volume
from snapspace.mesh.tet_search import closest_boundary_faces
from snapspace.stuffing import stuff
from snapspace.stuffing.manifold import euler_characteristic, is_closed_manifold

from .surfaces import Surface, beside, box, inside_out, surface_of

EDGE = 0.07


@pytest.fixture(scope="module")
def barrel() -> Surface:
    return surface_of(cylinder(6, 8, length=2.0, radius=0.5))


@pytest.fixture(scope="module")
def stuffed(barrel: Surface) -> TetMesh:
    return stuff_surface(*barrel, edge_length=EDGE)


def test_the_solid_is_that_of_the_surface(barrel: Surface, stuffed: TetMesh) -> None:
    vertices, faces = barrel
    assert stuffed.volume == pytest.approx(enclosed_volume(vertices, faces), rel=0.03)
    check_closed(stuffed.surface, who="test")
    _, distances = closest_boundary_faces(stuffed, vertices, limit=np.inf)
    assert distances.max() < EDGE * stuffed.diagonal


def test_the_tets_are_well_shaped_and_of_the_wanted_size(stuffed: TetMesh) -> None:
    assert stuffed.dihedral_angles.min() > 8.0
    edges = stuffed.vertices[stuffed.tets[:, 0]] - stuffed.vertices[stuffed.tets[:, 1]]
    lengths = np.linalg.norm(edges, axis=1) / stuffed.diagonal
    assert 0.5 * EDGE < np.median(lengths) < 1.1 * EDGE


def test_it_is_reproducible_and_ignores_the_orientation(barrel: Surface, stuffed: TetMesh) -> None:
    vertices, faces = barrel
    again = stuff_surface(vertices, faces[:, ::-1], edge_length=EDGE)
    assert np.array_equal(again.vertices, stuffed.vertices)
    assert np.array_equal(again.tets, stuffed.tets)


@pytest.mark.parametrize("edge_length", [0.05, 0.07, 0.1])
def test_corners_are_cut_off_but_not_lost(edge_length: float) -> None:
    mesh = bar(6, 4, 4, length=1.5, width=1.0, height=1.0)
    stuffed = stuff_surface(*surface_of(mesh), edge_length=edge_length)
    assert stuffed.volume == pytest.approx(mesh.volume, rel=edge_length)


def lollipop(thickness: float) -> Surface:
    """A ball of diameter one on a stick of length 1.5."""

    def implicit(points: np.ndarray) -> np.ndarray:
        x, y, z = points.T
        stick = np.maximum(np.hypot(y, z) - thickness / 2, np.abs(x - 0.75) - 0.75)
        return np.minimum(np.linalg.norm(points, axis=1) - 0.5, stick)

    mesh = stuff(implicit, [-0.6, -0.6, -0.6], [1.6, 0.6, 0.6], thickness / 3)
    return surface_of(mesh)


def test_only_thin_parts_get_smaller_tets() -> None:
    surface = lollipop(0.08)
    mesh = stuff_surface(*surface, edge_length=0.1)
    assert mesh.volume == pytest.approx(enclosed_volume(*surface), rel=0.05)
    _, distances = closest_boundary_faces(mesh, surface[0], limit=np.inf)
    assert distances.max() < LOST * 0.1 * mesh.diagonal
    assert is_closed_manifold(mesh.surface) and euler_characteristic(mesh.surface) == 2
    edges = np.ptp(mesh.vertices[mesh.tets], axis=1).max(axis=1)
    x = mesh.vertices[mesh.tets].mean(axis=1)[:, 0]
    ball, stick = edges[x < 0.2], edges[x > 0.8]
    assert np.median(stick) < 0.6 * np.median(ball)
    assert np.median(ball) > 0.6 * 0.1 * mesh.diagonal, "the ball keeps its large tets"
    again = stuff_surface(*surface, edge_length=0.1)
    assert np.array_equal(again.tets, mesh.tets)


def test_smaller_tets_keep_open_what_larger_ones_would_join() -> None:
    """Two fingers with a gap of a third of an edge between them."""
    fork = bar(8, 5, 4, length=2.0, width=1.0, height=0.8)
    low = fork.vertices.min(axis=0)
    middle = fork.vertices[fork.tets].mean(axis=1) - low
    gap = (np.abs(middle[:, 1] - 0.5) < 0.1) & (middle[:, 0] > 0.5)
    vertices, faces = surface_of(repair_tets(fork.vertices, fork.tets[~gap])[0])
    steps = np.unique(vertices[:, 1])
    vertices[:, 1] = np.interp(vertices[:, 1], steps, [-0.4, -0.2, -0.03, 0.03, 0.2, 0.4])
    mesh = stuff_surface(vertices, faces, edge_length=0.06, most_closed=0)
    assert euler_characteristic(mesh.surface) == 2


def test_a_part_that_is_too_thin_is_an_error() -> None:
    mesh = bar(16, 1, 1, length=4.0, width=0.002, height=0.002)
    with pytest.raises(
        ValueError,
        match=r"edge_length is 0\.1 of the diagonal, too long .*with tets of an eighth of that",
    ):
        stuff_surface(*surface_of(mesh), edge_length=0.1)


def test_more_cells_than_memory_has_room_for_are_refused(barrel: Surface) -> None:
    with pytest.raises(ValueError, match="edge_length is 1e-05 of the diagonal"):
        stuff_surface(*barrel, edge_length=1e-5)


def test_overlapping_ends_are_joined_with_a_notice() -> None:
    """The ends of a ring cross each other."""
    with pytest.warns(MeshNotice, match="join parts of the surface that nearly touch, in 1 place;"):
        mesh = stuff_surface(*ring(-0.1), edge_length=0.05)
    assert is_closed_manifold(mesh.surface) and euler_characteristic(mesh.surface) == 0


def test_overlapping_parts_are_filled_as_their_union() -> None:
    body, arm = box(0.0, 0.0, 0.0), box(1.6, 0.3, 0.4, size=(1.25, 0.5, 0.5))
    with pytest.warns(MeshNotice, match="one solid of separate parts that overlap"):
        mesh = stuff_surface(*beside(body, arm), edge_length=0.03)
    assert mesh.volume == pytest.approx(2.0 + (1.25 - 0.4) * 0.5 * 0.5, rel=0.02)
    assert euler_characteristic(mesh.surface) == 2
    with (
        pytest.warns(MeshNotice, match="one solid of separate parts that overlap"),
        pytest.warns(MeshNotice, match="parts of the surface were inside out"),
    ):
        again = stuff_surface(*beside(body, inside_out(arm)), edge_length=0.03)
    assert np.array_equal(again.vertices, mesh.vertices), "a part inside out is turned"
    with pytest.raises(
        ValueError, match=r"separate parts of the surface overlap, .* most_closed is"
    ):
        stuff_surface(*beside(body, arm), most_closed=0)


def test_a_part_inside_another_one_changes_nothing() -> None:
    body = box(0.0, 0.0, 0.0)
    with pytest.warns(MeshNotice, match="one solid of separate parts that overlap"):
        mesh = stuff_surface(*beside(body, box(0.6, 0.3, 0.3, size=(0.5, 0.5, 0.5))))
    alone = stuff_surface(*body)
    assert np.array_equal(mesh.tets, alone.tets)
    assert mesh.volume == pytest.approx(alone.volume, rel=1e-5)


def ring(gap: float) -> Surface:
    """A bar bent to a ring that is open by `gap` of its mean diameter."""
    vertices, faces = surface_of(bar(48, 4, 4, length=1.0, width=0.3, height=0.3))
    x, y, z = (vertices - vertices.mean(axis=0)).T
    angle = x * (2.0 * np.pi - 2.0 * gap)
    return np.stack([(1.0 + y) * np.cos(angle), (1.0 + y) * np.sin(angle), z], axis=1), faces


def test_a_notice_says_if_a_gap_is_closed() -> None:
    """The ends of the ring are joined, and would move as one."""
    with pytest.warns(MeshNotice, match="join parts of the surface that nearly touch, in 1 place;"):
        stuff_surface(*ring(0.01), edge_length=0.06)
    stuff_surface(*ring(0.1), edge_length=0.06)  # a notice would be an error
    with pytest.raises(ValueError, match="too long for thin parts or gaps"):
        stuff_surface(*ring(0.01), edge_length=0.06, most_closed=0)


def test_a_notice_says_if_a_hole_is_closed() -> None:
    """A square plate with a hole of a thirtieth of an edge length through it."""
    side = np.concatenate([[-1.0, -0.5], [-0.002, 0.002], [0.5, 1.0]])
    plate = bar(5, 5, 2, length=2.0, width=2.0, height=0.2)
    cell = np.array([plate.vertices[tet].mean(axis=0) for tet in plate.tets])
    hole = (np.abs(cell[:, :2] - cell[:, :2].mean(axis=0)) < 0.2).all(axis=1)
    pierced, _ = repair_tets(plate.vertices, plate.tets[~hole])
    vertices, faces = surface_of(pierced)
    for axis in (0, 1):
        steps = np.unique(plate.vertices[:, axis])
        vertices[:, axis] = np.interp(vertices[:, axis], steps, side)
    assert euler_characteristic(faces) == 0
    with pytest.warns(MeshNotice, match="close narrow holes through the surface, in 1 place;"):
        stuff_surface(vertices, faces, edge_length=0.04)


def test_two_solids_are_refused(barrel: Surface) -> None:
    vertices, faces = surface_of(bar(4, 2, 2))
    two = np.vstack([vertices, vertices + np.array([20.0, 0.0, 0.0])])
    with pytest.raises(ValueError, match="stuff_surface: the surface has 2 separate parts"):
        stuff_surface(two, np.vstack([faces, faces + len(vertices)]), edge_length=0.02)


@pytest.mark.parametrize("edge_length", [0.0, -1.0, 0.6, np.nan])
def test_the_edge_length_is_checked(barrel: Surface, edge_length: float) -> None:
    with pytest.raises(ValueError, match="stuff_surface: edge_length is"):
        stuff_surface(*barrel, edge_length=edge_length)


@pytest.mark.parametrize("most", [-1, 0.5, None])
def test_the_number_of_closed_gaps_is_checked(barrel: Surface, most: Any) -> None:
    with pytest.raises(ValueError, match="stuff_surface: most_closed is"):
        stuff_surface(*barrel, most_closed=most)


def test_an_open_surface_is_refused(barrel: Surface) -> None:
    with pytest.raises(ValueError, match="stuff_surface: the surface is not closed"):
        stuff_surface(barrel[0], barrel[1][1:])
