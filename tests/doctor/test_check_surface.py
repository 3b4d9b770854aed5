"""check_surface finds each planted fault and nothing else, in any unit and place."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import check_surface, mend_surface
from snapspace.generators import bar
from snapspace.mesh import compact_surface

from ..cli.odd_surfaces import ball

Vertices, Faces = NDArray[np.float64], NDArray[np.int32]
Surface = tuple[Vertices, Faces]


def box() -> Surface:
    """The surface of a bar of 4 x 1 x 1, 144 faces."""
    mesh = bar(8, 2, 2)
    return compact_surface(mesh.vertices, mesh.surface)


def without_face(v: Vertices, f: Faces) -> Surface:
    return v, f[1:]


def with_flipped_faces(v: Vertices, f: Faces) -> Surface:
    return v, np.concatenate([f[:10][:, ::-1], f[10:]])


def with_duplicate(v: Vertices, f: Faces) -> Surface:
    return v, np.concatenate([f, f[:3]])


def with_turned_duplicate(v: Vertices, f: Faces) -> Surface:
    """Without both copies there would be a hole, so they are no wall between solids."""
    return v, np.concatenate([f, f[:1, ::-1]])


def with_degenerate(v: Vertices, f: Faces) -> Surface:
    return v, np.concatenate([f, [[5, 5, 9], [1, 7, 1]]]).astype(np.int32)


def with_unused(v: Vertices, f: Faces) -> Surface:
    return np.concatenate([v, np.zeros((4, 3))]), f


def as_soup(v: Vertices, f: Faces) -> Surface:
    return v[f].reshape(-1, 3), np.arange(f.size, dtype=np.int32).reshape(-1, 3)


def inward(v: Vertices, f: Faces) -> Surface:
    return v, f[:, ::-1]


def two_apart(v: Vertices, f: Faces) -> Surface:
    return np.concatenate([v, v + np.array([0, 5, 0])]), np.concatenate([f, f + len(v)])


def two_crossing(v: Vertices, f: Faces) -> Surface:
    return np.concatenate([v, v + np.array([0.37, 0.33, 0.31])]), np.concatenate([f, f + len(v)])


def with_wall(v: Vertices, f: Faces) -> Surface:
    """A face between an edge of the surface and a vertex of its own: an edge of three faces."""
    wall = [[f[0, 0], f[0, 1], len(v)]]
    out = v[f[0]].mean(axis=0) * 2.0 - v.mean(axis=0)
    return np.concatenate([v, [out]]), np.concatenate([f, wall]).astype(np.int32)


def flat(v: Vertices, f: Faces) -> Surface:
    return v * [1, 1, 0], f


def thin(v: Vertices, f: Faces) -> Surface:
    return v * [1, 1, 0.08], f


FAULTS = {
    "nothing": (lambda v, f: (v, f), {}),
    "a hole": (without_face, {"holes": 1}),
    "flipped": (with_flipped_faces, {"flipped faces": 10}),
    "duplicate": (with_duplicate, {"duplicate faces": 3}),
    "turned duplicate": (with_turned_duplicate, {"duplicate faces": 1}),
    "degenerate": (with_degenerate, {"degenerate faces": 2}),
    "unused": (with_unused, {"unused vertices": 4}),
    "soup": (as_soup, {"seams": 432 - 74}),
    "inward": (inward, {"inward": 1}),
    "two parts": (two_apart, {"components": 2}),
    "thin": (thin, {"thin": 1}),
}


@pytest.mark.parametrize(("plant", "expected"), FAULTS.values(), ids=FAULTS)
@pytest.mark.parametrize(("scale", "shift"), [(1.0, 0.0), (1e6, 1e6), (1e-6, 0.0)])
def test_planted_faults(
    plant: Callable[[Vertices, Faces], Surface],
    expected: dict[str, int],
    scale: float,
    shift: float,
) -> None:
    vertices, faces = plant(*box())
    report = check_surface(scale * vertices + shift, faces)
    assert {finding.name: finding.count for finding in report.findings} == expected
    assert report.closed == (not {"holes", "flipped faces"} & expected.keys())
    faults = {"holes", "flipped faces", "duplicate faces", "degenerate faces", "components"}
    assert report.fine == (not faults & expected.keys())
    if report.closed and "thin" not in expected:
        bars = 2 if "components" in expected else 1
        volume = 4.0 * bars * (-1 if "inward" in expected else 1) * scale**3
        assert report.volume == pytest.approx(volume, rel=1e-6)


def test_a_hole_is_measured() -> None:
    vertices, faces = box()
    (holes,) = check_surface(vertices, faces[1:]).findings
    corners = vertices[faces[0]]
    (hole,) = holes.details["holes"]
    length = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1).sum()
    assert hole["edges"] == 3 and hole["closed_by_fix"]
    assert hole["length"] == pytest.approx(length)
    assert hole["center"] == pytest.approx(corners.mean(axis=0))
    assert f"length {length:.4g}" in holes.text


def test_crossings_are_those_of_a_direct_test() -> None:
    """All pairs by the definition: an edge of one face goes through the inside of the other."""
    vertices, faces = two_crossing(*box())
    names = {finding.name: finding for finding in check_surface(vertices, faces).findings}
    assert names.keys() == {"components", "self-intersections"}
    found = {tuple(pair) for pair in names["self-intersections"].details["pairs"]}
    first, second = np.split(vertices[faces], 2)
    crossing = _pierces(first, second) | _pierces(second, first).T
    direct = {(i, 144 + j) for i, j in np.argwhere(crossing).tolist()}
    assert names["self-intersections"].count == len(direct) > 20
    assert found <= direct


def _pierces(ones: Vertices, others: Vertices) -> np.ndarray:
    """Whether an edge of each triangle goes through the inside of each other one, (m, n)."""
    origins, first, second = others[:, 0], others[:, 1] - others[:, 0], others[:, 2] - others[:, 0]
    found = np.zeros((len(ones), len(others)), bool)
    for k in range(3):
        p, q = ones[:, None, k], ones[:, None, (k + 1) % 3]
        matrices = np.stack(np.broadcast_arrays(p - q, first, second), axis=3)
        flat = np.abs(np.linalg.det(matrices)) < 1e-12
        matrices[flat] = np.eye(3)
        solved = np.linalg.solve(matrices, (p - origins)[..., None])[..., 0]
        t, s, r = np.moveaxis(solved, 2, 0)
        found |= ~flat & (0 < t) & (t < 1) & (s > 0) & (r > 0) & (s + r < 1)
    return found


def test_an_edge_of_three_faces() -> None:
    found = {finding.name for finding in check_surface(*with_wall(*box())).findings}
    assert found >= {"non-manifold edges", "holes"}


def test_a_sheet_has_no_inside() -> None:
    found = {finding.name: finding for finding in check_surface(*flat(*box())).findings}
    assert found["flat"].fault


def test_a_moebius_strip_has_no_orientation() -> None:
    angle = np.linspace(0, 2 * np.pi, 9)[:-1]
    side = 0.3 * np.stack([np.cos(angle / 2) * np.cos(angle), np.cos(angle / 2) * np.sin(angle),
                           np.sin(angle / 2)], axis=1)  # fmt: skip
    middle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    vertices = np.concatenate([middle + side, middle - side])
    faces = []
    for k in range(8):
        a, b = k, k + 8
        c, d = (k + 1, k + 9) if k < 7 else (8, 0)
        faces += [[a, b, c], [c, b, d]]
    found = {finding.name: finding for finding in check_surface(vertices, faces).findings}
    assert "like a Moebius strip" in found["flipped faces"].text


@pytest.mark.parametrize(
    ("vertices", "faces", "message"),
    [
        (np.empty((0, 3)), np.empty((0, 3), int), r"it has no faces \(0 vertices\)"),
        (np.eye(3), np.empty((0, 3), int), r"^check_surface: it has no faces \(3 vertices\)"),
        (np.eye(3), [], r"^check_surface: it has no faces \(3 vertices\)"),
        (
            np.eye(3),
            [[0, 1, 2], [1]],
            "^check_surface: faces is not a rectangular array",
        ),
        (np.eye(3) * np.nan, [[0, 1, 2]], "check_surface: vertex 0 is not finite"),
        (np.eye(3), [[0, 1, 3]], "check_surface: face 0 has vertex index 3"),
    ],
)
def test_what_is_no_surface_is_refused(
    vertices: Vertices, faces: list[list[int]], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        check_surface(vertices, faces)


def test_the_report_about_holes_is_what_mending_does() -> None:
    """The removed end is closed; a long cut around a corner is not."""
    vertices, faces = box()
    centers = vertices[faces].mean(axis=1)
    end = centers[:, 0] > 3.99
    corner = (centers[:, 0] < 2.0) & (centers[:, 1:] > 0.3).any(axis=1)
    for removed, can in ((end, 1), (corner, 0), (end | corner, 1)):
        (holes,) = (one for one in check_surface(vertices, faces[~removed]).findings if one.fault)
        closed = [hole["closed_by_fix"] for hole in holes.details["holes"]]
        mended = mend_surface(vertices, faces[~removed])
        assert sum(closed) == can == (mended.invented > 0)
        assert holes.mended == (can > 0)
        assert ("closes none of them" in holes.meaning) == (can == 0)
        assert holes.details["sheet"]


def test_a_small_hole_is_no_sheet() -> None:
    vertices, faces = ball(40)
    (holes,) = check_surface(vertices, faces[1:]).findings
    assert not holes.details["sheet"] and "cloth" not in holes.cure
