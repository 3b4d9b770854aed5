"""`snapspace interpolate --shell`: poses of a surface, blended as they are."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace import ARAP, InterpolationModel, ShellPoses, load, read_surface, write_surface

from ..shells.sheets import rolled, sheet
from .conftest import Run

SMALL = ("--samples", 8, "--dimension", 6)
SHEET = sheet(8, 5)


@pytest.fixture
def poses(tmp_path: Path) -> list[Path]:
    """An open sheet, flat and rolled up, as .obj and .ply."""
    files = [tmp_path / "flat.obj", tmp_path / "rolled.ply"]
    shapes = SHEET.vertices, rolled(SHEET.vertices, 1.2).reshape(-1, 3)
    for file, shape in zip(files, shapes, strict=True):
        write_surface(file, shape, SHEET.triangles)
    return files


def test_open_surfaces_are_blended_and_written(run: Run, tmp_path: Path, poses: list[Path]) -> None:
    path, blend = tmp_path / "sheet.snapspace", tmp_path / "half.obj"
    words = ("--shell", 0.1, "--radius", 0, *SMALL, "-o", path)
    figures = run("interpolate", *poses, *words, "--json").json
    assert figures["poses"] == 2 and figures["fits"] == []
    model = load(path)
    assert isinstance(model, InterpolationModel) and isinstance(model.problem.poses, ShellPoses)
    assert model.problem.mesh.thickness == 0.1
    assert model.problem.material == ARAP()
    assert "vertices with their triangles" in run("info", path).err
    told = run("blend", path, "--weights", "0,1", "-o", blend).err
    assert "inverted" not in told, "a surface has no inside"
    vertices, faces = read_surface(blend)
    np.testing.assert_array_equal(faces, SHEET.triangles)
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]]])
    lengths, wanted = (
        np.linalg.norm(x[edges[:, 0]] - x[edges[:, 1]], axis=1)
        for x in (vertices, read_surface(poses[1])[0])
    )
    np.testing.assert_allclose(lengths, wanted, rtol=5e-3)


def test_rigid_neighbourhoods_may_have_a_radius(
    run: Run, tmp_path: Path, poses: list[Path]
) -> None:
    path = tmp_path / "sheet.snapspace"
    words = ("--shell", 0.1, "--radius", 0.2, *SMALL, "-o", path)
    run("interpolate", *poses, *words)
    model = load(path)
    assert model.problem.material == ARAP(radius=0.2)
    told = run("info", path).err
    assert "as rigid as possible, mu 1, radius 0.2" in told and "rigid neighbourhoods" in told
    refused = run("interpolate", *poses, "--radius", 0.2, "-o", path)
    assert refused.code == 2 and "--radius is for surfaces that are" in refused.err


def test_seams_of_texture_coordinates_are_no_cuts(run: Run, tmp_path: Path) -> None:
    """Two triangles with four corners at their common edge, as .obj files have them at seams."""
    paths = []
    for name, height in (("flat", 0.0), ("bent", 0.4)):
        lines = [
            f"v {x} {y} {z}"
            for x, y, z in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, height), (0, 1, 0))
        ]
        paths.append(tmp_path / f"{name}.obj")
        paths[-1].write_text("\n".join([*lines, "f 1 2 3", "f 4 5 6", ""]))
    model_path = tmp_path / "m.snapspace"
    run("interpolate", *paths, "--shell", 0.1, "--samples", 4, "--dimension", 1, "-o", model_path)
    model = load(model_path)
    assert model.problem.material == ARAP(radius=0.05), "as rigid as possible by default"
    assert len(model.problem.mesh.vertices) == 4
    assert len(model.surface.corners) == 6


@pytest.mark.parametrize(
    "words, message",
    [
        (["--edge-length", 0.1], "--edge-length is for poses that are tets or filled with tets"),
        (["--accept-inverted"], "--accept-inverted is for poses that are tets"),
        (["--material", "corotational"], "--material corotational has no form for shells"),
        (["--material", "stvk", "--radius", 0.1], "--radius is for surfaces that are as rigid as"),
        (["--radius", 2], "radius is 2.0, but must be a number from 0 to 1"),
    ],
)
def test_options_of_tets_are_refused(
    run: Run, tmp_path: Path, poses: list[Path], words: list[object], message: str
) -> None:
    path = tmp_path / "m.snapspace"
    assert message in run("interpolate", *poses, "--shell", 0.1, *words, "-o", path).error


def test_tets_are_refused(run: Run, tmp_path: Path, poses: list[Path]) -> None:
    tets = tmp_path / "solid.mesh"
    tets.write_text("")
    path = tmp_path / "m.snapspace"
    refused = run("interpolate", poses[0], tets, "--shell", 0.1, "-o", path).error
    assert "poses of a shell are surfaces" in refused
