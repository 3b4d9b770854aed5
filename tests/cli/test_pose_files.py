"""Names of poses, and `read_poses` with tets that enclose or fill a surface."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from snapspace import TetMesh, write_surface, write_tets
from snapspace.cli.fit_cache import FitCache
from snapspace.cli.pose_files import PoseOptions, pose_names, read_poses
from snapspace.filling import SurfaceFilling, surface_filling
from snapspace.mesh import mass_matrix
from snapspace.registration import registered

from .files import (
    POSES,
    bar_mesh,
    bar_shapes,
    bar_surfaces,
    enclosing_mesh,
    surface_first,
    write_raw,
    write_surface_poses,
    write_tet_poses,
)


def options(**changes: Any) -> PoseOptions:
    plain: dict[str, Any] = {
        "tets": None,
        "filling": SurfaceFilling(),
        "thickness": None,
        "deviation": None,
        "scale": "auto",
        "accept_inverted": False,
        "repair": False,
        "threads": 1,
    }
    return PoseOptions(**{**plain, **changes})


@pytest.fixture
def cache(tmp_path: Path) -> FitCache:
    return FitCache.beside(tmp_path / "m.snapspace")


@pytest.mark.parametrize(
    ("files", "names"),
    [
        (["a.obj", "b.off"], ["a", "b"]),
        (["x/v1.2.obj", "x/v1.3.obj"], ["v1.2", "v1.3"]),
        (["sit/cat.obj", "run/cat.obj"], ["sit/cat", "run/cat"]),
        (["a/x/cat.obj", "b/x/cat.obj"], ["0: cat", "1: cat"]),
        (["cat.obj", "cat.obj"], ["0: cat", "1: cat"]),
    ],
)
def test_names_say_no_more_than_needed(files: list[str], names: list[str]) -> None:
    assert pose_names([Path(file) for file in files]) == names


@given(st.lists(st.lists(st.sampled_from("ab"), min_size=1, max_size=3), min_size=2, max_size=6))
def test_names_are_unique(parts: list[list[str]]) -> None:
    names = pose_names([Path(*folders).with_suffix(".obj") for folders in parts])
    assert len(names) == len(set(names)) == len(parts)


def test_tets_are_their_own_poses(tmp_path: Path, cache: FitCache) -> None:
    pose_set = read_poses(write_tet_poses(tmp_path), options(), cache)
    np.testing.assert_array_equal(pose_set.poses.shapes, list(bar_shapes().values()))
    np.testing.assert_array_equal(
        pose_set.surface.vertices(bar_mesh().vertices),
        bar_mesh().vertices[bar_mesh().surface_vertices],
    )
    assert (pose_set.fits, pose_set.seconds) == ((), {})
    assert not cache.folder.exists()


def test_tets_that_are_ordered_the_other_way_are_turned_in_all_poses(
    tmp_path: Path, cache: FitCache, capsys: pytest.CaptureFixture[str]
) -> None:
    paths = [tmp_path / f"{name}.mesh" for name in POSES]
    for path, shape in zip(paths, bar_shapes().values(), strict=True):
        write_raw(path, shape, bar_mesh().tets[:, [0, 2, 1, 3]])
    poses = read_poses(paths, options(), cache).poses
    assert "rest: all 192 tets were inverted" in capsys.readouterr().err
    np.testing.assert_array_equal(poses.tets, bar_mesh().tets)
    np.testing.assert_array_equal(poses.shapes, list(bar_shapes().values()))


@pytest.mark.parametrize("tets", [surface_first(), enclosing_mesh()], ids=["exact", "enclosing"])
def test_fitted_tets_carry_the_surfaces(tmp_path: Path, cache: FitCache, tets: TetMesh) -> None:
    """The first pose is the given tets; the others deviate as reported."""
    write_tets(tmp_path / "tets.msh", tets)
    files = write_surface_poses(tmp_path)
    pose_set = read_poses(files, options(tets=tmp_path / "tets.msh"), cache)
    poses, surface = pose_set.poses, pose_set.surface
    assert poses.names == POSES
    np.testing.assert_array_equal(poses.reference.vertices, tets.vertices)
    np.testing.assert_array_equal(poses.tets, tets.tets)
    wanted, faces = bar_surfaces()["rest"]
    np.testing.assert_array_equal(surface.faces, faces)
    np.testing.assert_allclose(surface.vertices(tets.vertices), wanted, rtol=0, atol=1e-12)
    assert (poses.volumes > 0).all()
    assert [fit.name for fit in pose_set.fits] == list(POSES[1:])
    assert all(fit.converged and fit.rms <= 1e-3 < fit.max for fit in pose_set.fits)
    assert list(pose_set.seconds) == ["tets", "fitting"]


def test_the_inside_follows_known_tets(tmp_path: Path, cache: FitCache) -> None:
    """Tets fitted to the surfaces of known tet poses are near those poses inside, too."""
    mesh = surface_first()
    outer = bar_mesh().surface_vertices[::-1]
    order = np.concatenate([outer, np.setdiff1d(np.arange(len(mesh.vertices)), outer)])
    write_tets(tmp_path / "tets.msh", mesh)
    files = write_surface_poses(tmp_path)
    poses = read_poses(files, options(tets=tmp_path / "tets.msh"), cache).poses
    for shape, known in zip(poses.shapes, bar_shapes().values(), strict=True):
        onto = shape.reshape(-1)
        found = registered(known[order].reshape(-1), onto, mass_matrix(mesh))
        np.testing.assert_allclose(found, onto, rtol=0, atol=0.01 * mesh.diagonal)


def test_a_surface_is_filled_once(
    tmp_path: Path, cache: FitCache, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Filling is slow and differs each time, so its result is kept."""
    calls: list[SurfaceFilling] = []

    def fill(filling: SurfaceFilling, vertices: Any, faces: Any, **_: Any) -> TetMesh:
        calls.append(filling)
        np.testing.assert_array_equal(vertices, bar_surfaces()["rest"][0])
        np.testing.assert_array_equal(faces, bar_surfaces()["rest"][1])
        return enclosing_mesh()

    monkeypatch.setattr(SurfaceFilling, "fill", fill)
    files = write_surface_poses(tmp_path)
    first = read_poses(files, options(), cache)
    again = read_poses(files, options(), cache)
    assert calls == [SurfaceFilling()]
    np.testing.assert_array_equal(again.poses.shapes, first.poses.shapes)
    assert list(again.fits) == list(first.fits)  # the seconds too: nothing was fitted again
    finer, exact = SurfaceFilling(edge_length=0.1), SurfaceFilling(exact=True)
    read_poses(files, options(filling=finer), cache)
    read_poses(files, options(filling=exact), cache)
    assert calls == [SurfaceFilling(), finer, exact]


def test_surfaces_without_thin_parts_are_filled_in_seconds(
    tmp_path: Path, cache: FitCache, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As in `build`, fTetWild, which takes up to some minutes, is not needed."""

    def refused(*_: object, **__: object) -> None:
        raise AssertionError("fTetWild was used")

    monkeypatch.setattr(surface_filling, "fill_surface", refused)
    files = write_surface_poses(tmp_path)
    pose_set = read_poses(files, options(filling=SurfaceFilling(edge_length=0.04)), cache)
    assert {fit.status for fit in pose_set.fits} == {"converged"}
    volumes = pose_set.poses.volumes.sum(axis=1)
    np.testing.assert_allclose(volumes, bar_mesh().volume, rtol=0.06)


def test_the_first_pose_decides_the_unit_of_length(
    tmp_path: Path, cache: FitCache, capsys: pytest.CaptureFixture[str]
) -> None:
    paths = write_tet_poses(tmp_path)
    write_tets(paths[0], bar_mesh(), vertices=0.01 * bar_mesh().vertices)
    poses = read_poses(paths, options(), cache).poses
    notes = capsys.readouterr().err.splitlines()
    assert len(notes) == 2
    assert all(note.endswith(" to the size of rest") for note in notes)
    volumes = poses.volumes.sum(axis=1)
    np.testing.assert_allclose(volumes, 4e-6, rtol=0.05)


def test_a_target_given_twice_keeps_both_names(tmp_path: Path, cache: FitCache) -> None:
    write_tets(tmp_path / "tets.msh", surface_first())
    rest, bent, _ = write_surface_poses(tmp_path)
    write_surface(tmp_path / "same.obj", *bar_surfaces()["bent"])
    words = [rest, bent, tmp_path / "same.obj"]
    for _ in range(2):  # fitted, and from the cache
        pose_set = read_poses(words, options(tets=tmp_path / "tets.msh"), cache)
        assert [fit.name for fit in pose_set.fits] == ["bent", "same"]
        np.testing.assert_array_equal(pose_set.poses.shapes[1], pose_set.poses.shapes[2])
