"""write_animation: numbered files, GIFs and MP4s show the shapes."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import imageio_ffmpeg
import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from snapspace import PosingModel, read_surface, read_tets, write_animation
from snapspace.pictures import render

SIZE = (96, 64)


@pytest.fixture(scope="module")
def shapes(posing_model: PosingModel) -> list[NDArray[np.float64]]:
    session = posing_model.session()
    nod = session.animate([{"head": ((0, 0, 0.4), (0, 0, 0.4))}], frames=4)
    return [session.vertices for _ in nod]


def test_folders_hold_the_surface_of_every_frame(
    posing_model: PosingModel, shapes: list[NDArray[np.float64]], tmp_path: Path
) -> None:
    files = write_animation(tmp_path / "nod", posing_model, iter(shapes), kind="ply")
    assert [file.name for file in files] == [f"frame-{k:04d}.ply" for k in range(4)]
    for file, shape in zip(files, shapes, strict=True):
        vertices, faces = read_surface(file)
        np.testing.assert_array_equal(faces, posing_model.surface.faces)
        np.testing.assert_array_equal(vertices, posing_model.surface.vertices(shape))


def test_folders_hold_all_tets(
    posing_model: PosingModel, shapes: list[NDArray[np.float64]], tmp_path: Path
) -> None:
    last = write_animation(tmp_path, posing_model, shapes, kind="vtu")[-1]
    np.testing.assert_array_equal(read_tets(last).vertices, shapes[-1])


def test_a_gif_shows_each_shape_for_the_time_of_a_frame(
    posing_model: PosingModel, shapes: list[NDArray[np.float64]], tmp_path: Path
) -> None:
    options: dict[str, Any] = {"size": SIZE, "ground": False}
    write_animation(
        tmp_path / "nod.gif", posing_model, shapes, frames_per_second=20, samples=1, **options
    )
    with Image.open(tmp_path / "nod.gif") as film:
        assert film.n_frames == 4  # type: ignore[attr-defined]
        assert film.info["duration"] == 50 and film.info["loop"] == 0
        seen = []
        for frame in range(4):
            film.seek(frame)
            seen.append(np.asarray(film.convert("RGB"), float))
    assert seen[0].shape == (64, 96, 3)
    moved = [np.abs(one - seen[0]).mean() for one in seen]
    assert 0 == moved[0] < moved[1] < moved[3], "the shape keeps moving"
    surface = posing_model.surface
    still = render(surface.vertices(shapes[0]), surface.faces, samples=1, **options)
    assert np.abs(still.mean() - seen[0].mean()) < 20, "in the same light as a picture"


def test_an_mp4_is_read_by_another_program(
    posing_model: PosingModel, shapes: list[NDArray[np.float64]], tmp_path: Path
) -> None:
    path = tmp_path / "nod.mp4"
    write_animation(path, posing_model, shapes, size=SIZE, samples=1, ground=False)
    frames, seconds = imageio_ffmpeg.count_frames_and_secs(str(path))
    assert frames == 4 and seconds == pytest.approx(4 / 30, abs=0.02)
    reader = imageio_ffmpeg.read_frames(str(path))
    assert next(reader)["size"] == SIZE
    assert list(tmp_path.iterdir()) == [path], "nothing else is left"


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("nod", {"kind": "gltf"}, "unknown kind 'gltf'; known are obj"),
        (
            "nod",
            {"size": SIZE},
            "unknown option size for .*nod; known are kind, frames_per_second; names that",
        ),
        ("nod.avi", {}, r"neither a film \(.gif, .mp4 or .glb\) nor a folder"),
        ("nod.mp4", {"size": (95, 64)}, "95 x 64, but .mp4 takes even numbers"),
        ("nod.gif", {"frames_per_second": 0.0}, "frames_per_second is 0.0"),
        ("no/nod.gif", {}, "folder .* does not exist"),
    ],
)
def test_bad_animations_are_refused(
    posing_model: PosingModel,
    shapes: list[NDArray[np.float64]],
    tmp_path: Path,
    name: str,
    options: dict[str, Any],
    message: str,
) -> None:
    with pytest.raises(ValueError, match=message):
        write_animation(tmp_path / name, posing_model, shapes, **options)


def test_shapes_of_another_mesh_and_no_shapes_are_refused(
    posing_model: PosingModel, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=r"a shape is \(5, 3\), but the model's vertices are"):
        write_animation(tmp_path, posing_model, [np.zeros((5, 3))])
    with pytest.raises(ValueError, match="there are no shapes"):
        write_animation(tmp_path / "no.gif", posing_model, [])


def test_mp4_without_its_extra_names_the_extra(
    posing_model: PosingModel,
    shapes: list[NDArray[np.float64]],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(ValueError, match=r'needs .*: pip install "snapspace\[video\]"'):
        write_animation(tmp_path / "nod.mp4", posing_model, shapes)
