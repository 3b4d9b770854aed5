"""`interpolate --material`: the model's material, and the form of its energy."""

from __future__ import annotations

from pathlib import Path

import pytest

from snapspace import load

from .conftest import Run
from .files import write_tet_poses

SMALL = ("--samples", 12, "--dimension", 5)


@pytest.mark.parametrize(
    ("options", "material", "energy"),
    [
        ((), "stable-neo-hookean", "cubature of"),
        (("--cubature-tets", 9), "stable-neo-hookean", "cubature of 9 tets"),
        (("--material", "arap", "--mu", 2), "arap", "cubature of"),
        (("--material", "stvk"), "stvk", "exact quartics of 3 poses"),
    ],
)
def test_the_summary_says_what_the_energy_is(
    run: Run, tmp_path: Path, options: tuple[object, ...], material: str, energy: str
) -> None:
    path = tmp_path / "m.snapspace"
    result = run("interpolate", *write_tet_poses(tmp_path), *SMALL, *options, "-o", path)
    assert energy in result.err
    assert energy in run("info", path).err
    assert load(path).problem.material.kind == material


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--material", "rubber"), "'rubber' is not one of 'arap'"),
        (("--mu", -1), "StableNeoHookean: mu is -1.0, but it must be positive"),
        (("--material", "arap", "--lam", 2), "--lam is for materials with a first Lame parameter"),
        (("--shell", 0.01, "--lam", 2), "but arap has none; leave it out"),
        (("--material", "stvk", "--cubature-tets", 9), "that of stvk is exact"),
        (("--target-error", 0.01, "--cubature-tets", 9), "chooses what --cubature-tets decides"),
        (("--samples", 1, "--dimension", 1), "needs at least 2 samples, but there is 1"),
    ],
)
def test_bad_options_are_refused(
    run: Run, tmp_path: Path, options: tuple[object, ...], message: str
) -> None:
    path = tmp_path / "m.snapspace"
    result = run("interpolate", *write_tet_poses(tmp_path), *options, "-o", path)
    assert result.code == 2
    assert message in result.err
    assert not path.exists()
