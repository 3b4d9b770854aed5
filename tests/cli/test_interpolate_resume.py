"""Ctrl-C during `interpolate` keeps tets, poses and samples; the same command resumes from them."""

from __future__ import annotations

import re
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors.numpy import load_file

from snapspace import interruptible
from snapspace.cli import pipeline, pose_files, samples
from snapspace.filling import SurfaceFilling

from .conftest import Run
from .files import contents, enclosing_mesh, write_surface_poses

SMALL = ("--samples", 6, "--dimension", 5)


def stop(*_: object, **__: object) -> None:
    raise KeyboardInterrupt


def assert_same_model(first: Path, second: Path) -> None:
    arrays, others = load_file(first), load_file(second)
    assert arrays.keys() == others.keys()
    for name in arrays:
        assert arrays[name].tobytes() == others[name].tobytes(), name


def kept_files(folder: Path) -> list[str]:
    """The kinds of the files that an interrupted run has left."""
    names = (path.name.partition("-")[0] for path in folder.glob("m.snapspace.poses/*"))
    return sorted(names)


@pytest.mark.parametrize(
    ("sent", "code", "word"), [(None, 130, "interrupted"), (signal.SIGTERM, 143, "terminated")]
)
def test_ctrl_c_keeps_the_poses_that_are_fitted(
    run: Run,
    tmp_path: Path,
    surface_words: list[object],
    monkeypatch: pytest.MonkeyPatch,
    sent: signal.Signals | None,
    code: int,
    word: str,
) -> None:
    """SIGTERM, which arrives while compiled code fits on another thread, keeps them too."""
    path = tmp_path / "m.snapspace"

    def stop() -> None:
        if sent is None:
            raise KeyboardInterrupt
        signal.raise_signal(sent)

    @contextmanager
    def stop_after_the_first(*_: object, **__: object) -> Iterator[Callable[[int, int], None]]:
        yield lambda done, _: stop() if done else None

    with monkeypatch.context() as patch:
        patch.setattr(interruptible, "POLL_SECONDS", 0.002)
        patch.setattr(pose_files, "step_progress", stop_after_the_first)
        result = run(*surface_words, "--threads", 1, "-o", path, "--json")
    assert (result.code, result.out) == (code, "")
    line = result.err.splitlines()[-1]
    kept = re.fullmatch(
        rf"snapspace: {word}: ([12]) of 2 fitted poses are kept; the same command resumes "
        "from there",
        line,
    )
    assert kept, result.err
    assert kept_files(tmp_path) == ["pose"] * int(kept[1])
    assert not path.exists()

    resumed = run(*surface_words, "-o", path)
    assert resumed.code == 0, resumed.err
    assert f"resuming: {kept[1]} of 2 poses were fitted before" in resumed.err
    assert not (tmp_path / "m.snapspace.poses").exists()
    run(*surface_words, "-o", tmp_path / "at_once.snapspace")
    assert_same_model(path, tmp_path / "at_once.snapspace")


def flip_a_bit(path: Path) -> None:
    """Flips a bit of a coordinate: without a checksum the model would differ unnoticed."""
    content = bytearray(path.read_bytes())
    content[-4] ^= 1
    path.write_bytes(content)


@pytest.mark.parametrize("damage", [Path.unlink, flip_a_bit])
def test_a_pose_that_is_missing_or_damaged_is_fitted_again(
    run: Run,
    tmp_path: Path,
    surface_words: list[object],
    monkeypatch: pytest.MonkeyPatch,
    damage: Any,
) -> None:
    path = tmp_path / "m.snapspace"
    with monkeypatch.context() as patch:
        patch.setattr(pipeline, "reduce", stop)
        result = run(*surface_words, "-o", path)
    assert result.code == 130
    assert "6 of 6 samples are kept" in result.err.splitlines()[-1]
    assert kept_files(tmp_path) == ["pose", "pose"]
    damage(sorted(tmp_path.glob("m.snapspace.poses/*"))[0])

    resumed = run(*surface_words, "-o", path, "--json")
    assert "resuming: 1 of 2 poses were fitted before" in resumed.err
    reported = "not used (its content has changed); its pose is fitted again" in resumed.err
    assert reported == (damage is flip_a_bit)
    # the pose is bitwise the same, so the samples still belong to it
    assert "resuming: 6 of 6 samples were finished before" in resumed.err
    assert [fit["name"] for fit in resumed.json["fits"]] == ["bent", "twisted"]
    assert len([name for name in contents(tmp_path) if name.startswith("m.")]) == 1
    run(*surface_words, "-o", tmp_path / "at_once.snapspace")
    assert_same_model(path, tmp_path / "at_once.snapspace")


def test_tets_that_fill_the_surface_are_kept(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every filling differs, so samples could not be resumed with a new one."""
    words = ("interpolate", *write_surface_poses(tmp_path), *SMALL, "-o", tmp_path / "m.snapspace")
    with monkeypatch.context() as patch:
        patch.setattr(SurfaceFilling, "fill", lambda *_, **__: enclosing_mesh())
        patch.setattr(pose_files, "fit_poses", stop)
        result = run(*words)
    assert result.code == 130
    assert "0 of 2 fitted poses are kept" in result.err.splitlines()[-1]
    assert kept_files(tmp_path) == ["tets"]

    def filled_again(*_: object, **__: object) -> None:
        raise AssertionError("the surface was filled before")

    monkeypatch.setattr(SurfaceFilling, "fill", filled_again)
    resumed = run(*words, "--json")
    assert "resuming: the first pose was filled before" in resumed.err
    assert resumed.json["tets"] == len(enclosing_mesh().tets)
    assert kept_files(tmp_path) == []


def test_other_options_do_not_use_what_is_kept(
    run: Run, tmp_path: Path, surface_words: list[object], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "m.snapspace"
    with monkeypatch.context() as patch:
        patch.setattr(samples, "solve_snapshots", stop)
        assert run(*surface_words, "-o", path).code == 130
    softer = run(*surface_words, "--deviation", 0.01, "-o", path)
    assert softer.code == 0
    assert "resuming" not in softer.err
    # options that do not change the fits keep them
    with monkeypatch.context() as patch:
        patch.setattr(samples, "solve_snapshots", stop)
        assert run(*surface_words, "-o", path).code == 130
    stiffer = run(*surface_words, "--mu", 5, "--samples", 7, "-o", path)
    assert "resuming: 2 of 2 poses were fitted before" in stiffer.err


def test_a_full_disk_while_fitting_is_one_line(
    run: Run, tmp_path: Path, surface_words: list[object]
) -> None:
    (tmp_path / "m.snapspace.poses").write_text("a file where the folder would be")
    result = run(*surface_words, "-o", tmp_path / "m.snapspace")
    assert result.code == 2
    assert "m.snapspace.poses: cannot create the folder" in result.err.splitlines()[-1]
    assert "Traceback" not in result.err


def test_an_old_model_stays_until_the_new_one_is_written(
    run: Run, tmp_path: Path, surface_words: list[object], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "m.snapspace"
    path.write_bytes(np.arange(9).tobytes())
    before = path.read_bytes()
    with monkeypatch.context() as patch:
        patch.setattr(pipeline, "reduce", stop)
        assert run(*surface_words, "-o", path).code == 130
    assert path.read_bytes() == before
    assert run(*surface_words, "-o", path).code == 0
    assert path.read_bytes() != before
