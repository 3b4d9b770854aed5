"""fill_surface. fTetWild takes half a second for a small surface, so filled meshes are shared."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import ArrayLike

from snapspace.filling import fill_surface, ftetwild
from snapspace.filling.ftetwild_process import STOP_ENERGY
from snapspace.generators import bar, cylinder
from snapspace.mesh import MeshNotice, TetMesh, embed_surface
from snapspace.mesh.closed_surface import check_closed, enclosed_volume
from snapspace.mesh.tet_search import closest_boundary_faces

from .surfaces import Surface, surface_of

COARSE = {"edge_length": 0.3, "tolerance": 1e-2}


@pytest.fixture(scope="module")
def barrel() -> Surface:
    return surface_of(cylinder(3, 4, length=2.0, radius=1.0))


@pytest.fixture(scope="module")
def filled(barrel: Surface) -> TetMesh:
    return fill_surface(*barrel, **COARSE)


def test_the_solid_is_that_of_the_surface(barrel: Surface, filled: TetMesh) -> None:
    assert filled.volume == pytest.approx(enclosed_volume(*barrel), rel=0.02)
    assert filled.diagonal == pytest.approx(np.linalg.norm(np.ptp(barrel[0], axis=0)), rel=0.01)
    check_closed(filled.surface, who="test")


def test_passes_are_reported_while_it_works_and_at_its_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A program in place of fTetWild: two long passes, and two that end between two looks."""
    program = tmp_path / "passes.py"
    program.write_text(
        "import time\n"
        "for k in range(4):\n"
        "    print(f'////// pass {k} //////', flush=True)\n"
        "    time.sleep(0.3 if k < 2 else 0.0)\n"
    )
    monkeypatch.setattr(ftetwild, "_PROGRAM", program)
    passes: list[int] = []
    status, text = ftetwild._run(tmp_path, passes.append)
    assert status == 0 and text.count("pass") == 4
    assert passes == sorted(set(passes))
    assert passes[0] < 4 and passes[-1] == 4


def test_passes_of_ftetwild_are_recognised(barrel: Surface) -> None:
    """Few points need no pass if they come in a lucky order, so there are several tries."""
    passes: list[int] = []
    for _ in range(4):
        fill_surface(*barrel, edge_length=0.05, tolerance=1e-3, progress=passes.append)
        if passes:
            return
    pytest.fail("no pass in four runs")


def test_faces_reach_ftetwild_in_one_order_along_a_curve_in_space(
    barrel: Surface, monkeypatch: pytest.MonkeyPatch
) -> None:
    given: list[Surface] = []

    def read(folder: Path, progress: object) -> tuple[int, str]:
        with np.load(folder / "surface.npz") as surface:
            given.append((surface["vertices"], surface["faces"]))
        return 1, "stopped here"

    monkeypatch.setattr(ftetwild, "_run", read)
    vertices, faces = barrel
    rng = np.random.default_rng(0)
    for _ in range(2):
        order, cells = rng.permutation(len(vertices)), rng.permutation(len(faces))
        shuffled = np.argsort(order).astype(np.int32)[faces[cells]]
        with pytest.raises(ValueError, match="stopped here"):
            ftetwild.ftetwild(vertices[order], shuffled, edge_length=0.1, tolerance=1e-3)
    (one, first), (other, second) = given
    assert np.array_equal(one, other) and np.array_equal(first, second)


def test_the_tets_are_well_shaped(filled: TetMesh) -> None:
    """The conformal AMIPS energy |J|^2 / det(J)^(2/3), where J maps a regular tet to the tet."""
    corners = filled.vertices[filled.tets]
    regular = np.array([[1, 0, 0], [0.5, np.sqrt(3) / 2, 0], [0.5, np.sqrt(3) / 6, np.sqrt(2 / 3)]])
    J = np.linalg.inv(regular) @ (corners[:, 1:] - corners[:, :1])
    energies = (J**2).sum(axis=(1, 2)) / np.abs(np.linalg.det(J)) ** (2 / 3)
    assert energies.min() >= 3.0 - 1e-9, "that of a regular tet"
    assert energies.max() < STOP_ENERGY


def test_the_surface_is_near_the_boundary_and_follows_the_tets(
    barrel: Surface, filled: TetMesh
) -> None:
    vertices, faces = barrel
    _, distances = closest_boundary_faces(filled, vertices, limit=np.inf)
    assert distances.max() < 0.01 * filled.diagonal
    surface = embed_surface(vertices, faces, filled)
    assert surface.vertices(filled.vertices) == pytest.approx(vertices, abs=1e-13)
    assert np.abs(surface.weights).max() < 3.0


def test_unit_frame_orientation_and_unused_vertices_do_not_matter(barrel: Surface) -> None:
    """fTetWild's thresholds have no unit, and the orientation decides what it keeps."""
    vertices, faces = barrel
    far = np.vstack([1e-4 * vertices + 7.0, [[1e3, 1e3, 1e3]]])
    mesh = fill_surface(far, faces[:, ::-1], **COARSE)
    assert mesh.volume == pytest.approx(1e-12 * enclosed_volume(*barrel), rel=0.02)
    assert mesh.vertices.mean(axis=0) == pytest.approx(7.0 + 1e-4 * vertices.mean(axis=0), abs=3e-5)


def test_parts_that_overlap_become_one_solid() -> None:
    """Two bars that cross: their surfaces intersect each other."""
    along, faces = surface_of(bar(4, 1, 1, length=4.0, width=1.0, height=1.0))
    across = along[:, [1, 0, 2]] + [1.5, -1.5, 0.1]
    # exchanging two axes mirrors the bar, so its faces are reversed
    both = np.concatenate([faces, faces[:, ::-1] + len(along)])
    mesh = fill_surface(np.concatenate([along, across]), both, **COARSE)
    assert mesh.volume == pytest.approx(4.0 + 4.0 - 0.9, rel=0.03)


def test_separate_parts_are_refused_and_nothing_is_left_behind(
    capfd: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The C++ code prints, and writes a file into the current folder.

    The bars lean, side by side: their boxes overlap, so only their tets show that they are apart.
    """
    monkeypatch.chdir(tmp_path)
    vertices, faces = surface_of(bar(1, 1, 1, length=3.0, width=1.0, height=1.0))
    vertices[:, 1] += vertices[:, 0]
    both = (
        np.concatenate([vertices, vertices + np.array([0, 2, 0])]),
        np.concatenate([faces, faces + 8]),
    )
    other = "the second largest: .* % of the volume around"
    wanted = rf"the tets form 2 separate solids \({other} .*\), but one is needed"
    with pytest.raises(ValueError, match=wanted) as refused:
        fill_surface(*both, **COARSE)
    place = np.fromstring(str(refused.value).split("around (")[1].split(")")[0], sep=",")
    centers = np.add(np.mean(vertices, axis=0), [[0, 0, 0], [0, 2, 0]])
    assert np.linalg.norm(centers - place, axis=1).min() < 0.3, "the middle of one of the bars"
    assert capfd.readouterr() == ("", "")
    assert list(tmp_path.iterdir()) == []


def test_a_scan_with_a_bent_hole_is_filled_by_the_winding_number(barrel: Surface) -> None:
    """A third of the mantle is gone, too large and bent for a guess, and faces are flipped."""
    vertices, faces = barrel
    centers = vertices[faces].mean(axis=1)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    x, _, z = ((centers - low) / (high - low)).T
    kept = faces[~((x > 0.7) & (z > 0.2) & (z < 0.8))]
    kept[::9] = kept[::9, ::-1]
    with pytest.warns(MeshNotice, match=r"flipped \d+ faces.*winding number determines"):
        mesh = fill_surface(vertices, kept, mend=True, **COARSE)
    assert mesh.volume == pytest.approx(enclosed_volume(*barrel), rel=0.15)


def test_triangles_without_common_vertices_are_filled(barrel: Surface) -> None:
    vertices, faces = barrel
    soup = vertices[faces].reshape(-1, 3)
    with pytest.warns(MeshNotice, match=r"mended for filling: merged \d+ vertices"):
        mesh = fill_surface(soup, np.arange(len(soup)).reshape(-1, 3), mend=True, **COARSE)
    assert mesh.volume == pytest.approx(enclosed_volume(*barrel), rel=0.02)


TET = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
FACES = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]


@pytest.mark.parametrize(
    ("vertices", "faces", "options", "message"),
    [
        (TET, np.zeros((0, 3), dtype=int), {}, "the surface has no faces"),
        (TET, FACES[1:], {}, "the surface is not closed, it has 3 boundary edges"),
        (TET, [[2, 1, 3], *FACES[1:]], {}, "opposite orientations at 3 edges"),
        (TET, [[1, 2, 4]], {}, "face 0 has vertex index 4, but vertices has 4 rows"),
        ([[0, 0, np.nan], *TET[1:]], FACES, {}, "vertex 0 is not finite"),
        ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], FACES, {}, "encloses no volume"),
        (np.ones((4, 3)), FACES, {}, "encloses no volume"),
        (TET, FACES, {"edge_length": 0.0}, "edge_length is 0.0, but must be positive"),
        (TET, FACES, {"tolerance": 0.5}, "tolerance is 0.5, but must be positive and at most 0.1"),
        (TET, FACES, {"tolerance": float("nan")}, "tolerance is nan, but must be positive"),
    ],
)
def test_refuses_what_cannot_be_filled(
    vertices: ArrayLike, faces: ArrayLike, options: dict[str, float], message: str
) -> None:
    with pytest.raises(ValueError, match=f"fill_surface: .*{message}") as caught:
        fill_surface(vertices, faces, **options)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("program", "message"),
    [
        ("print('first'); raise SystemExit('no memory')", "exit status 1: no memory; check the"),
        # the C++ code does this when it meets an inverted tet
        ("raise SystemExit(0)", "exit status 0: it wrote nothing"),
        ("import os; os.abort()", "exit status -?[0-9]+: "),
    ],
)
def test_a_process_that_fails_is_an_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, program: str, message: str
) -> None:
    path = tmp_path / "program.py"
    path.write_text(program)
    monkeypatch.setattr(ftetwild, "_PROGRAM", path)
    with pytest.raises(ValueError, match=f"fill_surface: fTetWild failed with {message}") as caught:
        fill_surface(TET, FACES)
    assert "\n" not in str(caught.value)
