"""A save that fails says so, leaves the old file unchanged, and leaves no temporary file."""

from __future__ import annotations

import errno
import os
from pathlib import Path
from typing import Any, NoReturn

import pytest

from snapspace import ReducedModel, load


def disk_full(*arguments: Any, **options: Any) -> NoReturn:
    raise OSError(errno.ENOSPC, "No space left on device")


def interrupted(*arguments: Any, **options: Any) -> NoReturn:
    raise KeyboardInterrupt


def half_written(path: Path, content: bytes) -> NoReturn:
    with path.open("wb") as file:
        file.write(content[: len(content) // 2])
    disk_full()


@pytest.mark.parametrize(
    ("owner", "name", "failure"),
    [
        (Path, "write_bytes", disk_full),
        (Path, "write_bytes", half_written),
        (os, "replace", disk_full),
    ],
)
def test_a_full_disk_leaves_the_old_model(
    model: ReducedModel, saved: Path, monkeypatch: pytest.MonkeyPatch,
    owner: Any, name: str, failure: Any,
) -> None:  # fmt: skip
    before = saved.read_bytes()
    with monkeypatch.context() as patched:
        patched.setattr(owner, name, failure)
        with pytest.raises(ValueError, match=r"bar\.snapspace: cannot be written: No space left"):
            model.leading(2).save(saved)
    assert saved.read_bytes() == before
    assert list(saved.parent.iterdir()) == [saved]
    assert load(saved).dimension == model.dimension


@pytest.mark.parametrize(("owner", "name"), [(Path, "write_bytes"), (os, "replace")])
def test_ctrl_c_leaves_the_old_model(
    model: ReducedModel, saved: Path, monkeypatch: pytest.MonkeyPatch, owner: Any, name: str
) -> None:
    before = saved.read_bytes()
    with monkeypatch.context() as patched:
        patched.setattr(owner, name, interrupted)
        with pytest.raises(KeyboardInterrupt):
            model.leading(2).save(saved)
    assert saved.read_bytes() == before
    assert list(saved.parent.iterdir()) == [saved]


def test_a_folder_that_does_not_exist_is_named(model: ReducedModel, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"m\.snapspace: the folder .*models does not exist"):
        model.save(tmp_path / "models" / "m.snapspace")
    assert list(tmp_path.iterdir()) == []


def test_a_file_in_place_of_the_folder_is_named(model: ReducedModel, saved: Path) -> None:
    before = saved.read_bytes()
    with pytest.raises(ValueError, match=r"m\.snapspace: the folder .* does not exist"):
        model.save(saved / "m.snapspace")
    assert saved.read_bytes() == before


def test_a_folder_in_place_of_the_file_is_kept(model: ReducedModel, tmp_path: Path) -> None:
    folder = tmp_path / "m.snapspace"
    folder.mkdir()
    (folder / "mine.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(ValueError, match=r"m\.snapspace: cannot be written"):
        model.save(folder)
    assert (folder / "mine.txt").read_text(encoding="utf-8") == "mine"
    assert list(tmp_path.iterdir()) == [folder]


def test_a_good_save_replaces_the_old_model(model: ReducedModel, saved: Path) -> None:
    model.leading(2).save(saved)
    assert load(saved).dimension == 2
    assert list(saved.parent.iterdir()) == [saved]
