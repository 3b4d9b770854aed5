"""`snapspace pose --path` and `blend --path` as films."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from snapspace import load_posing, read_surface, write_animation

from .conftest import Run

MOTION = ("--handle", "right", "--euler", "0,0,20", "--translate", "0,0,0.2")


def test_a_path_goes_from_rest_to_the_motion(run: Run, model: Path, tmp_path: Path) -> None:
    run("pose", model, *MOTION, "-o", tmp_path / "one.obj")
    report = run("pose", model, *MOTION, "--path", 5, "-o", tmp_path / "frames", "--json").json
    assert [frame["status"] for frame in report["frames"]] == ["converged"] * 5
    assert report["written"] == [str(tmp_path / f"frames/frame-{k:04d}.obj") for k in range(5)]
    first, last = (read_surface(Path(report["written"][k]))[0] for k in (0, -1))
    mesh = load_posing(model).problem.mesh
    np.testing.assert_allclose(first, mesh.vertices[mesh.surface_vertices], atol=1e-9)
    np.testing.assert_allclose(last, read_surface(tmp_path / "one.obj")[0], atol=1e-5)


def test_a_path_becomes_a_film(
    run: Run, model: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def small(*arguments: Any, **options: Any) -> Any:
        return write_animation(*arguments, **options, size=(96, 64), samples=1)

    monkeypatch.setattr("snapspace.cli.write_frames.write_animation", small)
    film = tmp_path / "nod.gif"
    result = run("pose", model, *MOTION, "--path", 2, "-o", film, "--fps", 10)
    assert result.code == 0, result.err
    with Image.open(film) as images:
        assert (images.n_frames, images.size) == (2, (96, 64))  # type: ignore[attr-defined]
        assert images.info["duration"] == 100


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--fps", 10), "--format and --fps are for --path"),
        (("--path", 3, "--fps", 10, "-o", "frames"), "--fps is for a film"),
        (("--path", 3, "--format", "ply", "-o", "a.gif"), "is for files in a folder"),
        (("--path", 3, "-o", "a.gif", "--png", "a.png"), "--png is a picture of one shape"),
        (("--path", 3, "-o", "a.avi"), "frames go to a film (.gif, .mp4, .glb) or to a folder"),
        (("--path", 1), "--path"),
    ],
)
def test_options_that_contradict_are_refused(
    run: Run,
    model: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    words: tuple[object, ...],
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    result = run("pose", model, *MOTION, *words)
    assert result.code == 2 and message in result.err
    assert len(result.err.strip().splitlines()) == 1 or "Usage" in result.err
    assert not list(tmp_path.glob("a.*"))
