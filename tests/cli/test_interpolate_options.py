"""Impossible options of `interpolate` are refused before files are read or written."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace import write_surface, write_tets

from ..shapes import moved, random_rotation
from .conftest import Run
from .files import (
    bar_mesh,
    bar_surfaces,
    contents,
    surface_first,
    write_surface_poses,
    write_tet_poses,
)

SMALL = ["--samples", 4, "--dimension", 3]

OUT_OF_RANGE: dict[str, tuple[list[object], str]] = {
    "deviation": (["--deviation", -1], "'--deviation': -1.0 is not in the range 0<x<1"),
    "deviation of 3": (["--deviation", 3], "'--deviation': 3.0 is not in the range 0<x<1"),
    "deviation nan": (["--deviation", "nan"], "deviation is nan, but it must be positive"),
    "mu": (["--mu", -1], "mu is -1.0, but it must be positive"),
    "lam": (["--lam", "nan"], "lam is nan"),
    "energy fraction": (["--energy-fraction", 2], "energy fraction is 2.0, but must be in (0, 1]"),
    "extrapolation": (["--extrapolation", "nan"], "extrapolation is nan"),
    "samples": (["--samples", 4, "--dimension", 9], "dimension 9 needs at least as many samples"),
    "tolerance": (["--tolerance", "nan"], "tolerance is nan, but it must be positive"),
    "clamp": (["--solver", "newton", "--clamp", 2], "clamp is 2.0, but it must be in (0, 1]"),
    "clamp of the usual projection": (
        ["--solver", "newton", "--clamp", 0.5],
        "--clamp is for --projection stretches, not clamp, the default of this material",
    ),
    "edge length of tets": (
        ["--edge-length", 0.1],
        "--edge-length is for filling a surface with tets, but --tets has them",
    ),
    "fTetWild for tets": (
        ["--exact"],
        "--exact is for filling a surface with tets, but --tets has them",
    ),
}


@pytest.mark.parametrize("name", OUT_OF_RANGE)
def test_options_are_checked_before_the_poses_are_read(run: Run, tmp_path: Path, name: str) -> None:
    """The pose files do not exist, and that is not even mentioned."""
    words, message = OUT_OF_RANGE[name]
    poses = (tmp_path / "a.obj", tmp_path / "b.obj", "--tets", tmp_path / "tets.mesh")
    output = ("--save-poses", tmp_path / "saved", "-o", tmp_path / "m.snapspace")
    assert message in run("interpolate", *poses, *words, *output).error
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", OUT_OF_RANGE)
def test_options_are_checked_before_poses_are_fitted(
    run: Run, tmp_path: Path, surface_words: list[object], name: str
) -> None:
    words, message = OUT_OF_RANGE[name]
    before = contents(tmp_path)
    given = surface_words[:-4] if "--energy-fraction" in words else surface_words
    assert message in run(*given, *words, "-o", tmp_path / "m.snapspace").error
    assert contents(tmp_path) == before
    assert not (tmp_path / "m.snapspace.poses").exists()


@pytest.mark.parametrize("scale", [100.0, 0.01])
def test_tets_in_another_unit_of_length_are_refused(
    run: Run, tmp_path: Path, surface_words: list[object], scale: float
) -> None:
    write_tets(tmp_path / "tets.mesh", surface_first(), vertices=scale * surface_first().vertices)
    before = contents(tmp_path)
    error = run(*surface_words, "-o", tmp_path / "m.snapspace").error
    diagonal = 18**0.5
    assert f"tets.mesh: the tets have a diagonal of {scale * diagonal:g}, but the first" in error
    assert f"has one of {diagonal:g}; give tets of that surface in its unit of length" in error
    assert contents(tmp_path) == before


def test_tet_poses_are_not_repaired(run: Run, tmp_path: Path) -> None:
    """Each would be repaired in its own way. These are fine."""
    poses = write_tet_poses(tmp_path)
    before = contents(tmp_path)
    error = run("interpolate", *poses, *SMALL, "--repair", "-o", tmp_path / "m.snapspace").error
    assert error.startswith("--repair would repair each pose differently")
    assert error.endswith("repair the first one, and make the others from it")
    assert contents(tmp_path) == before


@pytest.mark.parametrize("word", [["--edge-length", 0.01], ["--exact"], ["--deviation", 0.01]])
def test_tet_poses_are_neither_filled_nor_fitted(
    run: Run, tmp_path: Path, word: list[object]
) -> None:
    poses = write_tet_poses(tmp_path)
    words = [*SMALL, *word, "-o", tmp_path / "m.snapspace"]
    error = run("interpolate", *poses, *words).error
    assert error == f"{word[0]} is for poses that are surfaces, but these are tets; leave it out"


def test_without_tets_of_its_own_there_is_nothing_to_repair(run: Run, tmp_path: Path) -> None:
    poses = write_surface_poses(tmp_path)
    error = run("interpolate", *poses, *SMALL, "--repair", "-o", tmp_path / "m.snapspace").error
    assert error == "--repair is for the mesh of --tets, and there is none; leave it out"


@pytest.mark.parametrize("turned", [False, True])
def test_equal_tet_poses_are_refused(run: Run, tmp_path: Path, turned: bool) -> None:
    """Between a shape and itself, or a rigid copy, there is nothing to blend but rounding."""
    mesh, poses = bar_mesh(), [tmp_path / "a.msh", tmp_path / "b.msh"]
    motion = (random_rotation(), np.array([3.0, -9.0, 2.0])) if turned else (np.eye(3), 0.0)
    write_tets(poses[0], mesh)
    write_tets(poses[1], mesh, vertices=moved(mesh.vertices.reshape(-1), *motion).reshape(-1, 3))
    words = ("--samples", 3, "--dimension", 2, "-o", tmp_path / "m.snapspace")
    result = run("interpolate", *poses, *words)
    assert result.code == 2
    assert "poses must differ by more than a rigid motion" in result.err
    assert "Traceback" not in result.err
    assert not (tmp_path / "m.snapspace").exists()


def test_equal_surfaces_are_refused(run: Run, tmp_path: Path) -> None:
    """The copy is rotated and moved, so that the fit sees rounding errors."""
    write_tets(tmp_path / "tets.mesh", surface_first())
    rest, copy, _ = write_surface_poses(tmp_path)
    vertices, faces = bar_surfaces()["rest"]
    turned = moved(vertices.reshape(-1), random_rotation(), np.array([3.0, -9.0, 2.0]))
    write_surface(copy, turned.reshape(-1, 3), faces)
    words = ("--tets", tmp_path / "tets.mesh", "--samples", 3, "--dimension", 2)
    result = run("interpolate", rest, copy, *words, "-o", tmp_path / "m.snapspace")
    assert result.code == 2
    assert "poses must differ by more than a rigid motion" in result.err
    assert not list(tmp_path.glob("m.snapspace*"))  # nor the folder of fitted poses


@pytest.mark.parametrize("words", [("--edge-length", 0.2), ("--shell", 0.1)])
def test_equal_surfaces_of_few_digits_are_refused_before_they_are_filled(
    run: Run, tmp_path: Path, words: tuple[object, ...]
) -> None:
    """The rounding errors of a file are no motion."""
    vertices, faces = bar_surfaces()["rest"]
    poses = [tmp_path / "a.obj", tmp_path / "b.obj"]
    write_surface(poses[0], vertices, faces)
    turned = moved(vertices.reshape(-1), random_rotation(), np.array([3.0, -9.0, 2.0]))
    write_surface(poses[1], turned.reshape(-1, 3).round(7), faces)
    result = run("interpolate", *poses, *words, *SMALL, "-o", tmp_path / "m.snapspace")
    assert result.code == 2
    assert "poses must differ by more than a rigid motion" in result.err
    assert "filling" not in result.err and not list(tmp_path.glob("m.snapspace*"))
