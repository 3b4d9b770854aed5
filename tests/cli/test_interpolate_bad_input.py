"""Poses and options that `interpolate` refuses: one line names them, and no file is touched."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from snapspace import write_surface, write_tets

from .conftest import Run, no_such_option
from .files import (
    FloatArray,
    bar_mesh,
    bar_shapes,
    bar_surfaces,
    contents,
    surface_first,
    write_raw,
    write_surface_poses,
    write_tet_poses,
)

Case = Callable[[Path], list[object]]
SMALL = ["--samples", 4, "--dimension", 3]


def tets(folder: Path, *words: object) -> list[object]:
    """Tet poses and more options."""
    return [*write_tet_poses(folder), *SMALL, *words]


def surfaces(folder: Path, *words: object) -> list[object]:
    """Surfaces, the tets of the first, and more options."""
    write_tets(folder / "tets.mesh", surface_first())
    return [*write_surface_poses(folder), *SMALL, "--tets", folder / "tets.mesh", *words]


def other_tets(folder: Path) -> list[object]:
    """One tet of the second pose starts at another vertex."""
    cells = bar_mesh().tets.copy()
    cells[7] = cells[7][[1, 2, 0, 3]]
    words = tets(folder)
    write_raw(folder / "bent.mesh", bar_shapes()["bent"], cells)
    return words


def other_faces(folder: Path) -> list[object]:
    """Two faces of the third pose have changed places."""
    vertices, faces = bar_surfaces()["twisted"]
    faces[[4, 9]] = faces[[9, 4]]
    words = surfaces(folder)
    write_surface(folder / "twisted.obj", vertices, faces)
    return words


def other_vertices(folder: Path) -> list[object]:
    """The second surface has one vertex more."""
    words = surfaces(folder)
    with (folder / "bent.obj").open("a") as file:
        file.write("v 0 0 0\n")
    return words


def fewer_tets(folder: Path) -> list[object]:
    words = tets(folder)
    write_tets(folder / "twisted.mesh", bar_mesh(4, 2, 2))
    return words


def pulled_through() -> FloatArray:
    """The bent bar with one vertex pulled through others."""
    shape = bar_shapes()["bent"].copy()
    shape[40] += [0, 0, 1.5]
    return shape


def inverted(folder: Path) -> list[object]:
    """The second pose has inverted tets."""
    words = tets(folder)
    write_raw(folder / "bent.mesh", pulled_through(), bar_mesh().tets)
    return words


def mirrored_tets(folder: Path) -> list[object]:
    words = tets(folder)
    write_raw(folder / "bent.mesh", bar_shapes()["bent"] * [-1, 1, 1], bar_mesh().tets)
    return words


def mirrored_surface(folder: Path) -> list[object]:
    words = surfaces(folder)
    vertices, faces = bar_surfaces()["bent"]
    write_surface(folder / "bent.obj", vertices * [-1, 1, 1], faces)
    return words


def mirrored_shell(folder: Path) -> list[object]:
    return [*mirrored_surface(folder)[:3], "--shell", 0.1]


def flat(folder: Path) -> list[object]:
    words = tets(folder)
    shape = bar_shapes()["bent"] * [1, 1, 0]
    write_raw(folder / "bent.mesh", shape, bar_mesh().tets)
    return words


def nan(folder: Path) -> list[object]:
    vertices, faces = bar_surfaces()["bent"]
    words = surfaces(folder)
    write_surface(folder / "bent.off", vertices, faces)
    text = (folder / "bent.off").read_text().splitlines()
    text[5] = "nan 0 0"
    (folder / "bent.off").write_text("\n".join(text))
    return [folder / "bent.off" if word == folder / "bent.obj" else word for word in words]


def far_tets(folder: Path) -> list[object]:
    """Tets in another unit of length than the surface."""
    words = surfaces(folder)
    write_tets(folder / "tets.mesh", bar_mesh(), vertices=0.01 * bar_mesh().vertices)
    return words


def without_extent(folder: Path) -> list[object]:
    vertices, faces = bar_surfaces()["bent"]
    words = surfaces(folder)
    write_surface(folder / "bent.obj", 0 * vertices, faces)
    return words


def mixture(folder: Path) -> list[object]:
    return [*tets(folder), *write_surface_poses(folder)[:1]]


def folder_as_pose(folder: Path) -> list[object]:
    (folder / "folder.mesh").mkdir()
    return tets(folder, folder / "folder.mesh")


def taken_folder(folder: Path) -> list[object]:
    (folder / "taken").write_text("a file")
    return tets(folder, "--save-poses", folder / "taken")


CASES: dict[str, tuple[Case, str]] = {
    "one file": (lambda f: tets(f)[:1] + SMALL, "interpolate needs two poses or more, got 1"),
    "no files": (lambda f: [], "Missing argument 'POSE POSE ...'"),
    "missing": (lambda f: [*tets(f), f / "none.mesh"], "none.mesh: there is no such file"),
    "missing surface": (lambda f: surfaces(f, f / "none.obj"), "none.obj: there is no such file"),
    "unknown extension": (
        lambda f: tets(f, f / "a.xyz"),
        "a.xyz: unknown extension '.xyz'; known are .obj, .off, .ply, .stl, .glb, .gltf, .mesh, ",
    ),
    "no extension": (lambda f: surfaces(f, f / "a"), "a: there is no such file"),
    "folder": (folder_as_pose, "folder.mesh: this is a folder; a file is needed"),
    "mixture": (mixture, "some poses are tets and others surfaces; give all of one kind"),
    "tets for tets": (
        lambda f: tets(f, "--tets", f / "rest.mesh"),
        "--tets is for poses that are surfaces, but these are tets",
    ),
    "no tets": (
        lambda f: [*surfaces(f)[:-1], f / "none.mesh"],
        "none.mesh: there is no such file",
    ),
    "surface as tets": (
        lambda f: [*surfaces(f)[:-1], f / "rest.obj"],
        "rest.obj: unknown extension '.obj'; known are .mesh",
    ),
    "far tets": (far_tets, "but the first surface has one of 4.24264; give tets of that surface"),
    "tet counts": (fewer_tets, "twisted: has 45 vertices, but rest has 81; export all poses from"),
    "other tets": (other_tets, "bent: tet 7 has vertices "),
    "vertex counts": (other_vertices, "bent: has 75 vertices, but rest has 74; export all poses"),
    "other faces": (other_faces, "twisted: face 4 has vertices "),
    "other faces counted": (other_faces, "; 2 of 144 faces differ: export all poses from one mesh"),
    "mirrored tets": (
        mirrored_tets,
        "bent: all 192 tets are inverted, so the pose is probably a",
    ),
    "mirrored surface": (mirrored_surface, "bent: is inside out, probably a mirror image: its fac"),
    "mirrored shell": (mirrored_shell, "ShellPoses: bent: is inside out, probably a mirror image"),
    "flat": (flat, "bent: 192 of 192 tets have no volume, the first is tet 0"),
    "nan": (nan, "bent.off: vertex 3 is not finite"),
    "no extent": (without_extent, "bent: all 74 vertices are at one point, so the pose has no"),
    "edge length": (
        lambda f: [*write_surface_poses(f), *SMALL, "--edge-length", 7],
        "'--edge-length': 7.0 is not in the range 0<x<=0.5",
    ),
    "deviation": (lambda f: surfaces(f, "--deviation", 0), "'--deviation': 0.0 is not in the ran"),
    "deviation nan": (lambda f: surfaces(f, "--deviation", "nan"), "deviation is nan"),
    "scale": (lambda f: tets(f, "--scale", "big"), "'--scale': 'big' is not one of 'auto', 'match"),
    "mu": (lambda f: tets(f, "--mu", -1), "mu is -1.0, but it must be positive"),
    "extrapolation": (lambda f: tets(f, "--extrapolation", -1), "'--extrapolation': -1"),
    "extrapolation nan": (lambda f: tets(f, "--extrapolation", "nan"), "extrapolation is nan"),
    "dimension": (
        lambda f: tets(f, "--dimension", 8),
        "dimension 8 needs at least as many samples, but there are 4 and 3 poses; raise --samples",
    ),
    "two sizes": (
        lambda f: tets(f, "--energy-fraction", 0.9),
        "give either --dimension or --energy-fraction",
    ),
    "tolerance": (lambda f: tets(f, "--tolerance", 0), "tolerance is 0"),
    "solver": (lambda f: tets(f, "--solver", "magic"), "'--solver': 'magic' is not one of"),
    "output extension": (
        lambda f: tets(f, "-o", f / "model.bin"),
        "model.bin: a model file ends in .snapspace",
    ),
    "output folder": (
        lambda f: tets(f, "-o", f / "none" / "m.snapspace"),
        "none does not exist",
    ),
    "saved poses": (taken_folder, "taken: cannot create the folder"),
    "usage": (lambda f: tets(f, "--handle", "head"), no_such_option("--handle")),
}


@pytest.mark.parametrize("name", CASES)
def test_refusals_are_one_line_and_touch_nothing(run: Run, tmp_path: Path, name: str) -> None:
    case, message = CASES[name]
    words = case(tmp_path)
    (tmp_path / "new.snapspace").write_text("what was there before")
    before = contents(tmp_path)
    output = [] if "-o" in words else ["-o", tmp_path / "new.snapspace"]
    assert message in run("interpolate", *words, *output, "--json").error
    assert contents(tmp_path) == before


def test_inverted_tets_are_counted(run: Run, tmp_path: Path) -> None:
    """The error names the pose, their number, and what to try."""
    words = inverted(tmp_path)
    corners = pulled_through()[bar_mesh().tets]
    bad = np.flatnonzero(np.linalg.det(corners[:, 1:] - corners[:, :1]) < 0)
    error = run("interpolate", *words, "-o", tmp_path / "m.snapspace").error
    count = f"bent: {len(bad)} of {len(corners)} tets are inverted, the first is tet {bad[0]} "
    assert count in error
    assert "fit the pose from its surface" in error


def test_the_first_pose_has_no_inverted_tets_even_if_they_are_accepted(
    run: Run, tmp_path: Path
) -> None:
    rest, bent, twisted, *size = inverted(tmp_path)
    words = (bent, rest, twisted, *size, "--accept-inverted", "-o", tmp_path / "m.snapspace")
    error = run("interpolate", *words).error
    assert "bent: tet " in error
    assert " is inverted" in error


def test_no_output(run: Run, tmp_path: Path) -> None:
    assert "Missing option '-o'" in run("interpolate", *tets(tmp_path)).error
