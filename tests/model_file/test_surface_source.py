"""Models keep the user's surface file, compressed, and refuse an altered one."""

from __future__ import annotations

import zlib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors.numpy import load_file

from snapspace import PosingModel, SurfaceFile, load
from snapspace.model_file import shown_surface

from .test_bad_files import Change, refused, rewrite

FILE = SurfaceFile("own.obj", b"# the user's\n" * 1000)


@pytest.fixture
def with_file(own_surface_model: PosingModel) -> PosingModel:
    return replace(own_surface_model, surface=replace(own_surface_model.surface, source=FILE))


def test_the_file_comes_back_to_the_last_byte(with_file: PosingModel, tmp_path: Path) -> None:
    path = with_file.save(tmp_path / "own.snapspace")
    source = load(path).surface.source
    assert source is not None
    assert (source.name, source.data, source.used_only) == (FILE.name, FILE.data, False)
    assert load_file(path)[shown_surface.SOURCE].nbytes < len(FILE.data) / 50


def test_the_boundary_of_the_tets_is_stored_if_it_came_from_a_file(
    posing_model: PosingModel, tmp_path: Path
) -> None:
    model = replace(posing_model, surface=replace(posing_model.surface, source=FILE))
    found = load(model.save(tmp_path / "own.snapspace")).surface
    assert found.is_boundary(model.problem.mesh)
    assert found.source is not None and found.source.data == FILE.data


def test_a_large_file_is_not_kept(
    with_file: PosingModel, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shown_surface, "LARGEST_SOURCE", len(FILE.data) - 1)
    assert load(with_file.save(tmp_path / "own.snapspace")).surface.source is None


def cut(arrays: dict[str, Any], _: object) -> None:
    arrays[shown_surface.SOURCE] = arrays[shown_surface.SOURCE][:20].copy()


def noise(arrays: dict[str, Any], _: object) -> None:
    arrays[shown_surface.SOURCE] = np.arange(99, dtype=np.uint8)


def bomb(arrays: dict[str, Any], _: object) -> None:
    packed = zlib.compress(bytes(shown_surface.LARGEST_SOURCE + 1), 9)
    arrays[shown_surface.SOURCE] = np.frombuffer(packed, np.uint8)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (cut, "'surface_source' is incomplete, or larger than 67108864 bytes"),
        (noise, "'surface_source' cannot be unpacked"),
        (bomb, "'surface_source' is incomplete, or larger than 67108864 bytes"),
    ],
)
def test_an_altered_file_is_refused(
    with_file: PosingModel, tmp_path: Path, change: Change, message: str
) -> None:
    path = with_file.save(tmp_path / "own.snapspace")
    rewrite(path, change)
    assert message in refused(path)


def test_materials_and_textures_beside_it_come_along(
    with_file: PosingModel, tmp_path: Path
) -> None:
    beside = {"own.mtl": b"newmtl skin", "skins/own.png": bytes(range(256)), "empty.mtl": b""}
    source = replace(FILE, beside=beside)
    model = replace(with_file, surface=replace(with_file.surface, source=source))
    path = model.save(tmp_path / "own.snapspace")
    found = load(path).surface.source
    assert found is not None and dict(found.beside) == beside

    def shorter(arrays: dict[str, Any], _: object) -> None:
        arrays[shown_surface.BESIDE] = arrays[shown_surface.BESIDE][:-1].copy()

    rewrite(path, shorter)
    assert "'surface_beside' has 266 bytes, but its files have 267" in refused(path)


def test_what_is_beside_it_is_not_kept_if_it_is_large(
    with_file: PosingModel, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shown_surface, "LARGEST_SOURCE", len(FILE.data))
    source = replace(FILE, beside={"skin.png": bytes(len(FILE.data) + 1)})
    model = replace(with_file, surface=replace(with_file.surface, source=source))
    found = load(model.save(tmp_path / "own.snapspace")).surface.source
    assert found is not None and found.data == FILE.data and not found.beside
