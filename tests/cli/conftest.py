"""The program as a function, and small models that it built."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

import click
import pytest

from snapspace import write_tets
from snapspace.cli import main

from .files import surface_first, write_problem, write_surface_poses, write_tet_poses


def no_such_option(name: str) -> str:
    """How click refuses an option, which differs from version to version."""
    return click.NoSuchOption(name).message.rstrip(".")


def interrupted_as(error: Exception) -> Callable[..., NoReturn]:
    """A function in which Ctrl-C arrives, and a library turns it into `error`."""

    def interrupted(*_: object, **__: object) -> NoReturn:
        try:
            raise KeyboardInterrupt
        except KeyboardInterrupt as interrupt:
            raise error from interrupt

    return interrupted


@dataclass(frozen=True)
class Result:
    """Exit code, standard output and standard error of a run of the program."""

    code: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        """Standard output as the one JSON object that it must be."""
        assert self.code == 0, self.err
        return json.loads(self.out)

    @property
    def error(self) -> str:
        """The one line of a refusal: exit code 2, nothing on standard output, no traceback."""
        assert self.code == 2, (self.code, self.err)
        assert self.out == ""
        assert self.err.count("\n") == 1, self.err
        assert self.err.startswith("snapspace: error: ")
        return self.err.removeprefix("snapspace: error: ").rstrip("\n")


Run = Callable[..., Result]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """run("info", path) is `snapspace info PATH`."""

    def call(*words: object) -> Result:
        capsys.readouterr()
        code = main([str(word) for word in words])
        out, err = capsys.readouterr()
        return Result(code, out, err)

    return call


@pytest.fixture(scope="session")
def built_model(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A model of the bar, dimension 10 from 24 samples. Tests must not write to it."""
    folder = tmp_path_factory.mktemp("model")
    problem, path = write_problem(folder), folder / "bar.snapspace"
    words = ["build", "--problem", problem, "--samples", 24, "--dimension", 10, "-o", path]
    assert main([str(word) for word in words]) == 0
    return path


@pytest.fixture
def model(built_model: Path, tmp_path: Path) -> Path:
    """A copy of the model in its own folder."""
    path = tmp_path / built_model.name
    path.write_bytes(built_model.read_bytes())
    return path


@pytest.fixture(scope="session")
def built_blend(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three tet poses of the bar, dimension 8 from 12 samples. Tests must not write to it."""
    folder = tmp_path_factory.mktemp("blend")
    path = folder / "poses.snapspace"
    words = [*write_tet_poses(folder), "--samples", 12, "--dimension", 8, "-o", path]
    assert main(["interpolate", *map(str, words)]) == 0
    return path


@pytest.fixture
def blend_model(built_blend: Path, tmp_path: Path) -> Path:
    """A copy of the model of poses in its own folder."""
    path = tmp_path / built_blend.name
    path.write_bytes(built_blend.read_bytes())
    return path


@pytest.fixture
def surface_words(tmp_path: Path) -> list[object]:
    """`interpolate` for three surfaces of the bar, with tets whose vertices begin with theirs."""
    write_tets(tmp_path / "tets.mesh", surface_first())
    poses = write_surface_poses(tmp_path)
    size = ["--samples", 6, "--dimension", 5]
    return ["interpolate", *poses, "--tets", tmp_path / "tets.mesh", *size]
