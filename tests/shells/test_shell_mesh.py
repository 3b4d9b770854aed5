"""ShellMesh: what it holds, and what it refuses."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

from snapspace import ShellMesh, mass_matrix, mend_surface

from .sheets import equilateral, hinge, irregular, sheet, sphere

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])


def shell(vertices: Any = SQUARE, triangles: Any = FACES, thickness: Any = 0.1) -> ShellMesh:
    return ShellMesh(vertices, triangles, thickness=thickness)


def test_the_mass_of_a_sheet_is_its_area_times_the_thickness() -> None:
    mesh = sheet(5, 3, size=(2.0, 1.5), thickness=0.2)
    assert mesh.areas.sum() == pytest.approx(3.0)
    assert mesh.volume == pytest.approx(0.6)
    assert mesh.vertex_masses.sum() == pytest.approx(0.6)
    for lumped in (False, True):
        assert mass_matrix(mesh, lumped=lumped).sum() == pytest.approx(0.6)
    np.testing.assert_allclose(mass_matrix(mesh, lumped=True).diagonal(), mesh.vertex_masses)


def test_the_consistent_mass_integrates_products_of_linear_functions() -> None:
    """Over the unit square the integral of x y is 1/4, and that of x^2 is 1/3."""
    mesh = irregular(40, thickness=2.0)
    x, y = mesh.vertices[:, 0], mesh.vertices[:, 1]
    mass = mass_matrix(mesh)
    assert x @ mass @ y == pytest.approx(2.0 / 4.0)
    assert x @ mass @ x == pytest.approx(2.0 / 3.0)


def test_thickness_may_differ_from_triangle_to_triangle() -> None:
    mesh = shell(thickness=[0.1, 0.3])
    np.testing.assert_allclose(mesh.volumes, [0.05, 0.15])
    assert mesh.fingerprint != shell(thickness=[0.3, 0.1]).fingerprint
    assert not np.asarray(mesh.thickness).flags.writeable


def test_a_hinge_is_an_edge_between_two_triangles() -> None:
    mesh = hinge()
    np.testing.assert_array_equal(mesh.hinges, [[0, 1, 2, 3]])
    np.testing.assert_array_equal(mesh.hinge_triangles, [[0, 1]])
    np.testing.assert_array_equal(mesh.elements, [[0, 1, 2, 2], [1, 0, 3, 3], [0, 1, 2, 3]])


@pytest.mark.parametrize("mesh", [sheet(), sphere(1), irregular(30)], ids=["sheet", "ball", "odd"])
def test_hinges_are_the_inner_edges(mesh: ShellMesh) -> None:
    euler = 2 if len(mesh.hinges) * 2 == len(mesh.triangles) * 3 else 1
    edges = len(mesh.vertices) + len(mesh.triangles) - euler
    boundary = 2 * edges - 3 * len(mesh.triangles)
    assert len(mesh.hinges) == edges - boundary
    for (v0, v1, v2, v3), (one, other) in zip(mesh.hinges, mesh.hinge_triangles, strict=True):
        assert {v0, v1, v2} == set(mesh.triangles[one])
        assert {v0, v1, v3} == set(mesh.triangles[other])
        row = mesh.triangles[one].tolist()
        assert row[(row.index(v0) + 1) % 3] == v1


def test_hinges_of_equilateral_triangles_have_the_usual_measure() -> None:
    """|edge|^2 / (sum of both areas), in Grinspun, Hirani, Desbrun, Schroeder 2003."""
    mesh = equilateral(4, 3)
    np.testing.assert_allclose(mesh.measures[len(mesh.triangles) :], 2.0 / np.sqrt(3.0))


def test_components_share_edges() -> None:
    """Two triangles that meet in a vertex only are two components."""
    apart = shell(np.vstack([SQUARE, SQUARE + 3.0]), np.vstack([FACES, FACES + 4]))
    np.testing.assert_array_equal(apart.components, [0, 0, 1, 1])
    bow = shell(np.vstack([SQUARE, [[2.0, 2, 1]]]), [[0, 1, 2], [2, 4, 3]])
    np.testing.assert_array_equal(bow.components, [0, 1])


def test_a_shell_is_pickled_as_it_is() -> None:
    mesh = shell(thickness=[0.1, 0.2])
    again = pickle.loads(pickle.dumps(mesh))
    assert again.fingerprint == mesh.fingerprint
    assert (
        repr(again)
        == repr(mesh)
        == ("ShellMesh(4 vertices, 2 triangles, thickness 0.1 to 0.2, diagonal 1.41421)")
    )


BAD: dict[str, tuple[dict[str, Any], str]] = {
    "no triangles": ({"triangles": np.zeros((0, 3), int)}, "there are no triangles"),
    "not finite": ({"vertices": SQUARE * np.nan}, "vertex 0 is not finite"),
    "index": ({"triangles": [[0, 1, 4]]}, "vertex index 4, but vertices has 4 rows"),
    "corners": ({"triangles": [[0, 1, 2, 3]]}, r"must have shape \(m, 3\)"),
    "repeats": ({"triangles": [[0, 1, 2], [0, 3, 3]]}, "triangle 1 .* repeats a vertex: drop with"),
    "duplicate": (
        {"triangles": [[0, 1, 2], [0, 2, 3], [2, 0, 1]]},
        "triangle 2 .* same three vertices as an earlier one: drop with snapspace.mend_surface",
    ),
    "flat": (
        {"vertices": [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]]},
        "triangle 0 .* has no area: collapse",
    ),
    "fan": (
        {
            "vertices": [*SQUARE.tolist(), [0.5, 0.5, 1.0]],
            "triangles": [[0, 1, 2], [0, 2, 3], [2, 0, 4]],
        },
        "the edge between vertices 0 and 2 has 3 triangles; 1 such edges: .* delete the inner",
    ),
    "orientation": (
        {"triangles": [[0, 1, 2], [0, 3, 2]]},
        "triangle 1 runs from vertex 2 to 0 as an earlier one does: .* flip triangles with .*"
        "snapspace check FILE --fix OUT",
    ),
    "unused": (
        {"vertices": [*SQUARE.tolist(), [5.0, 5, 5]]},
        "vertex 4 belongs to no triangle; 1 of 5 do not: drop with",
    ),
    "huge": ({"vertices": SQUARE * 1e200}, "too large for the areas"),
    "zero": ({"thickness": 0.0}, "thickness is 0.0, but it must be positive"),
    "one zero": ({"thickness": [0.1, 0.0]}, "thickness of triangle 1 is 0.0"),
    "sizes": ({"thickness": [0.1, 0.2, 0.3]}, r"thickness has shape \(3,\).*\(2,\)"),
    "words": ({"thickness": "thin"}, "thickness must be a number, or one per triangle"),
}


@pytest.mark.parametrize(("given", "message"), BAD.values(), ids=BAD.keys())
def test_what_is_no_shell_is_refused(given: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=f"^ShellMesh: .*{message}"):
        shell(**given)


@pytest.mark.parametrize("fault", ["repeats", "duplicate", "orientation", "unused"])
def test_the_cure_that_a_message_names_works(fault: str) -> None:
    given = {"vertices": SQUARE, "triangles": FACES} | BAD[fault][0]
    mended = mend_surface(given["vertices"], given["triangles"], close_holes=False)
    mesh = shell(mended.vertices, mended.faces)
    assert mesh.areas.sum() == pytest.approx(0.5 * len(mesh.triangles))
