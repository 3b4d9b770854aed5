"""`snapspace blend --path`: weights from pose to pose, and a file for each frame."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from snapspace import load, read_surface, read_tets
from snapspace.cli.blend_path import path_weights
from snapspace.cli.files import SURFACE_OUTPUTS, TET_OUTPUTS

from .conftest import Run

COUNTS = {"poses": st.integers(2, 9), "frames": st.integers(2, 200)}


@given(**COUNTS)
def test_every_frame_is_between_two_poses_that_follow_each_other(poses: int, frames: int) -> None:
    weights = path_weights(poses, frames)
    assert weights.shape == (frames, poses)
    assert weights.min() >= 0
    np.testing.assert_allclose(weights.sum(axis=1), 1, rtol=0, atol=1e-15)
    for row in weights:
        used = np.flatnonzero(row)
        assert len(used) == 1 or (len(used) == 2 and used[1] == used[0] + 1)


@given(**COUNTS)
def test_frames_are_evenly_spaced_from_the_first_pose_to_the_last(poses: int, frames: int) -> None:
    """Pose k is at place k of the path; between two poses the place is linear in the weights."""
    places = path_weights(poses, frames) @ np.arange(poses)
    np.testing.assert_allclose(places, np.linspace(0, poses - 1, frames), rtol=0, atol=1e-12)


@given(poses=st.integers(2, 9), steps=st.integers(1, 30))
def test_poses_are_met_exactly_where_the_frames_allow_it(poses: int, steps: int) -> None:
    weights = path_weights(poses, (poses - 1) * steps + 1)
    np.testing.assert_array_equal(weights[::steps], np.eye(poses))


@given(**COUNTS)
def test_the_ends_are_poses_exactly(poses: int, frames: int) -> None:
    weights = path_weights(poses, frames)
    np.testing.assert_array_equal(weights[0], np.eye(poses)[0])
    np.testing.assert_array_equal(weights[-1], np.eye(poses)[-1])


def test_frames_at_poses_are_the_poses(run: Run, blend_model: Path, tmp_path: Path) -> None:
    words = ("--path", 7, "--format", "vtu", "-o", tmp_path / "frames", "--json")
    figures = run("blend", blend_model, *words).json
    problem = load(blend_model).problem
    weights = [frame["weights"] for frame in figures["frames"]]
    for pose, one_hot in enumerate(np.eye(3).tolist()):
        number = weights.index(one_hot)
        frame = read_tets(tmp_path / "frames" / f"frame-{number:04d}.vtu")
        wanted = problem.pose_shapes[pose].reshape(-1, 3)
        shape = problem.aligned(frame.vertices.reshape(-1), problem.pose_shapes[pose])
        away = np.linalg.norm(shape.reshape(-1, 3) - wanted, axis=1).max()
        assert away < 1e-3 * problem.mesh.diagonal  # what eight modes miss of the snapshots
    assert all(frame["status"] == "converged" for frame in figures["frames"])


def test_frames_are_those_of_single_blends(run: Run, blend_model: Path, tmp_path: Path) -> None:
    """A frame starts where the last one ended, so it is the same up to the tolerance."""
    figures = run("blend", blend_model, "--path", 9, "-o", tmp_path, "--json").json
    weights = ",".join(map(str, figures["frames"][5]["weights"]))
    run("blend", blend_model, "--weights", weights, "-o", tmp_path / "one.obj")
    one, _ = read_surface(tmp_path / "one.obj")
    frame, _ = read_surface(tmp_path / "frame-0005.obj")
    np.testing.assert_allclose(frame, one, rtol=0, atol=1e-3)


@pytest.mark.parametrize("suffix", [*SURFACE_OUTPUTS, *TET_OUTPUTS])
def test_names_and_formats(run: Run, blend_model: Path, tmp_path: Path, suffix: str) -> None:
    folder = tmp_path / "new" / "frames"  # neither exists yet
    words = ("--path", 3, "--format", suffix.removeprefix("."), "-o", folder, "--json")
    figures = run("blend", blend_model, *words).json
    names = [f"frame-000{number}{suffix}" for number in range(3)]
    assert sorted(path.name for path in folder.iterdir()) == names
    assert figures["written"] == [str(folder / name) for name in names]
    mesh = load(blend_model).problem.mesh
    if suffix in SURFACE_OUTPUTS:
        assert len(read_surface(folder / names[1])[1]) == len(mesh.surface)
    else:
        np.testing.assert_array_equal(read_tets(folder / names[1]).tets, mesh.tets)


def test_the_linear_blend_is_written_beside_it(run: Run, blend_model: Path, tmp_path: Path) -> None:
    words = ("--path", 4, "--even", "weights", "--linear")
    words += ("--format", "msh", "-o", tmp_path / "frames")
    figures = run("blend", blend_model, *words, "--json").json
    assert len(figures["written"]) == 8
    problem = load(blend_model).problem
    for number, weights in enumerate(path_weights(3, 4)):
        straight = read_tets(tmp_path / "frames" / f"frame-{number:04d}-linear.msh")
        np.testing.assert_array_equal(straight.vertices, problem.linear_blend(weights))


@pytest.mark.parametrize("linear", [[], ["--linear"]])
def test_frames_left_from_a_longer_path_are_reported(
    run: Run, blend_model: Path, tmp_path: Path, linear: list[str]
) -> None:
    """In a film they would follow the frames of the new path."""
    words = ("blend", blend_model, *linear, "-o", tmp_path / "frames", "--path")
    (tmp_path / "frames").mkdir()
    (tmp_path / "frames" / "frame-by-frame.txt").write_text("no frame")
    for frames in (3, 5, 5):
        assert "longer path" not in run(*words, frames).err
    result = run(*words, 3)
    assert result.code == 0
    old = 2 * (1 + len(linear))
    found = " ".join(result.err.split())
    assert f"also holds {old} files of a longer path; delete them" in found
    assert len(list((tmp_path / "frames").iterdir())) == 1 + 5 * (1 + len(linear)), "all are kept"


def test_frames_left_in_another_format_are_reported(
    run: Run, blend_model: Path, tmp_path: Path
) -> None:
    frames = tmp_path / "frames"
    words = ("-o", frames, "--path")
    run("blend", blend_model, *words, 3, "--format", "vtu")
    (frames / "frames.vtu.series").write_text("{}")
    found = " ".join(run("blend", blend_model, *words, 2, "--format", "obj").err.split())
    assert (
        f"{frames} also holds 4 files of an earlier path in another format, such as "
        "frame-0000.vtu; delete them" in found
    )
    assert "longer path" not in found
    (frames / "frame-0007.obj").touch()
    found = " ".join(run("blend", blend_model, *words, 2, "--format", "obj").err.split())
    assert "also holds 1 files of a longer path" in found and "holds 4 files of an earlier" in found


def test_a_picture_shows_seven_frames_with_the_straight_ones_below(
    run: Run, blend_model: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: dict[str, Any] = {}

    def grey(surfaces: Any, faces: Any, **options: Any) -> Any:
        seen.update(options, surfaces=surfaces)
        return np.full((2, 3, 3), 128, np.uint8)

    monkeypatch.setattr("snapspace.cli.blend_picture.render_row", grey)
    words = ("--path", 13, "--even", "weights", "--linear", "--up", "y")
    words += ("--png", tmp_path / "path.png", "--json")
    figures = run("blend", blend_model, *words).json
    assert figures["written"] == [str(tmp_path / "path.png")]
    assert (len(seen["surfaces"]), seen["columns"], seen["up"]) == (14, 7, "y")
    picked = [seen["labels"][number] for number in (0, 3, 6, 7)]
    assert picked == ["1 0 0", "0 1 0", "0 0 1", "linear 1 0 0"]
    straight = load(blend_model).problem.linear_blend([0, 0, 1])
    np.testing.assert_array_equal(
        seen["surfaces"][-1], load(blend_model).surface.vertices(straight)
    )
    with Image.open(tmp_path / "path.png") as image:
        assert image.size == (3, 2)
