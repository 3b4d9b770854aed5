"""Materials in model files: they come back, also from old files; bad ones are refused by name."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors import safe_open

from snapspace import (
    MATERIALS,
    Cubature,
    InterpolationProblem,
    Material,
    PosingModel,
    StableNeoHookean,
    StVK,
    load,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.generators import bar

from ..shapes import bar_poses
from ..snapshots.bars import posing_bar
from .test_bad_files import refused, rewrite

TETS = len(bar(8, 2, 2).tets)
STIFF_AND_SOFT = np.where(np.arange(TETS) % 3 == 0, 5.0, 1.0)


def posing_model(material: Material) -> PosingModel:
    problem = posing_bar(material=material)
    snapshots = solve_snapshots(problem, sample(problem.domain, 14, seed=3), threads=1)
    return reduce(problem, snapshot_pca(snapshots, dimension=5), snapshots=snapshots, threads=1)


def header_of(path: Path) -> dict[str, Any]:
    with safe_open(path, framework="np") as file:
        header, arrays = dict(file.metadata()), set(file.keys())
    return {**header, "problem": json.loads(header["problem"]), "arrays": arrays}


def solved(model: PosingModel) -> np.ndarray:
    session = model.session()
    session.move("tip", euler=(0.1, 0.2, 0.0), translation=(0.1, 0.0, -0.1))
    return session.vertices


@pytest.mark.parametrize("kind", sorted(k for k in MATERIALS if not MATERIALS[k].barrier))
def test_a_model_comes_back_with_its_material(kind: str, tmp_path: Path) -> None:
    made = posing_model(MATERIALS[kind].from_lame(lam=1.0, mu=0.7))
    path = made.save(tmp_path / "m.snapspace")
    again = load(path)
    assert isinstance(again, PosingModel)
    assert again.problem.material == made.problem.material
    assert again.problem.fingerprint == made.problem.fingerprint
    np.testing.assert_array_equal(solved(again), solved(made))
    header = header_of(path)
    assert header["version"] == "4"
    assert header["problem"]["material"]["model"] == kind
    assert "material_moduli" not in header["arrays"]


@pytest.mark.parametrize("kind", [StVK, StableNeoHookean])
def test_moduli_of_single_tets_are_an_array(kind: type[StVK], tmp_path: Path) -> None:
    """The file has the moduli of all tets of the mesh; a cubature has those of its own tets."""
    made = posing_model(kind(lam=2.0, mu=STIFF_AND_SOFT))
    path = made.save(tmp_path / "m.snapspace")
    again = load(path)
    assert isinstance(again, PosingModel)
    assert again.problem.material == made.problem.material
    assert again.problem.material.lam == 2.0
    np.testing.assert_array_equal(solved(again), solved(made))
    header = header_of(path)
    assert header["problem"]["material"] == {"model": kind.kind, "lam": 2.0, "mu": None}
    assert "material_moduli" in header["arrays"]
    if isinstance(again.elastic, Cubature):
        assert again.elastic.material == made.problem.material.of_tets(again.elastic.tets)


def test_poses_keep_moduli_of_single_tets(tmp_path: Path) -> None:
    poses = bar_poses()
    mu = np.where(np.arange(len(poses.tets)) % 3 == 0, 5.0, 1.0)
    problem = InterpolationProblem(poses, material=StVK(lam=2.0, mu=mu))
    snapshots = solve_snapshots(problem, sample(problem.domain, 5), threads=1)
    made = reduce(problem, snapshot_pca(snapshots, dimension=3), threads=1)
    again = load(made.save(tmp_path / "m.snapspace"))
    assert again.problem.material == problem.material
    assert again.problem.fingerprint == problem.fingerprint


def test_files_of_the_first_version_are_st_venant_kirchhoff(saved: Path) -> None:
    before = load(saved)

    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        assert json.loads(header["problem"])["material"] == {"model": "stvk", "lam": 1, "mu": 1}
        header["version"] = "1"

    rewrite(saved, change)
    again = load(saved)
    assert again.problem.material == StVK() == before.problem.material


def test_an_unknown_material_is_refused_by_its_name(saved: Path) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        header["problem"] = header["problem"].replace('"stvk"', '"foo"')

    rewrite(saved, change)
    message = refused(saved)
    assert message.startswith(
        f"{saved}: the material is 'foo', but this snapspace knows arap, corotational"
    )
    assert message.endswith("install the snapspace that wrote it")


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (float("nan"), "mu is nan, but it must be positive"),
        (-1.0, "mu is -1.0, but it must be positive"),
        ("soft", "mu must be a number"),
        (None, "material_moduli"),
    ],
)
def test_an_invalid_modulus_is_refused(saved: Path, value: Any, expected: str) -> None:
    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        content = json.loads(header["problem"])
        content["material"]["mu"] = value
        header["problem"] = json.dumps(content)

    rewrite(saved, change)
    message = refused(saved)
    assert "the model is inconsistent" in message
    assert expected in message


@pytest.mark.parametrize(
    ("wrong", "expected"),
    [
        (lambda moduli: moduli[:-1], "'material_moduli' has shape"),
        (lambda moduli: moduli[:, :1], "'material_moduli' has shape"),
        (lambda moduli: moduli * np.nan, "the array 'material_moduli' has a number at"),
        (lambda moduli: -moduli, "mu of tet 0 is -5.0"),
        (lambda moduli: moduli.astype(np.float32), "'material_moduli' is float32, not float64"),
    ],
)
def test_moduli_that_do_not_fit_are_refused(wrong: Any, expected: str, tmp_path: Path) -> None:
    path = posing_model(StVK(lam=2.0, mu=STIFF_AND_SOFT)).save(tmp_path / "m.snapspace")

    def change(arrays: dict[str, Any], header: dict[str, str]) -> None:
        arrays["material_moduli"] = np.ascontiguousarray(wrong(arrays["material_moduli"]))

    rewrite(path, change)
    assert expected in refused(path)
