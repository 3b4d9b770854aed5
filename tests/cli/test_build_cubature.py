"""`snapspace build --energy cubature`: the model, what is recorded and shown, and refusals."""

from __future__ import annotations

import json
from pathlib import Path

from snapspace import Cubature, PosingModel, StableNeoHookean, load

from .conftest import Run
from .files import write_problem

SMALL = ("--samples", 24, "--dimension", 10, "--energy", "cubature")


def test_a_model_with_few_tets(run: Run, tmp_path: Path) -> None:
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    run("build", "--problem", problem, *SMALL, "--tets", 30, "-o", path)
    model = load(path)
    assert isinstance(model, PosingModel)
    assert isinstance(model.elastic, Cubature)
    assert len(model.elastic.tets) <= 30
    assert model.provenance["cubature"]["held_out"]["states"] == 2
    assert model.provenance["snapshots"]["converged"] == 24

    shown = run("info", path)
    words = " ".join((shown.out + shown.err).split())  # lines are wrapped
    assert f"cubature of {len(model.elastic.tets)} tets" in words
    assert "2 held-out samples" in words
    assert run("info", path, "--json").json["energy"].startswith("cubature")

    exact = tmp_path / "exact.snapspace"
    run("build", "--problem", problem, *SMALL[:4], "-o", exact)
    errors = [
        run("validate", file, "--samples", 2, "--json").json["error"]["mean"]
        for file in (path, exact)
    ]
    assert abs(errors[0] - errors[1]) < 0.1 * errors[1]


def test_tets_are_for_the_cubature_only(run: Run, tmp_path: Path) -> None:
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"
    result = run("build", "--problem", problem, "--tets", 30, "-o", path)
    assert result.code != 0
    assert "--tets is for a cubature, but the energy is exact; add --energy cubature" in result.err
    assert not path.exists()


def test_samples_of_a_cubature_are_near_equilibrium_by_default(run: Run, tmp_path: Path) -> None:
    """A cubature is trained on the forces at the samples; settled samples have other forces."""
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"

    def solver(*options: object) -> dict[str, float]:
        run("build", "--problem", problem, *SMALL[:4], *options, "-o", path)
        recorded: dict[str, float] = load(path).provenance["solver"]
        return recorded

    tight = solver(*SMALL[4:])
    assert (tight["tolerance"], tight["settling"]) == (1e-5, 0.0)
    assert solver(*SMALL[4:], "--tolerance", 1e-4)["tolerance"] == 1e-4
    assert solver(*SMALL[4:], "--settling", 0.02) == {**solver(), "settling": 0.02}


def test_by_default_the_material_is_stable_neo_hookean_and_the_energy_a_cubature(
    run: Run, tmp_path: Path
) -> None:
    problem, path = default_material(tmp_path), tmp_path / "m.snapspace"
    result = run("build", "--problem", problem, *SMALL[:4], "-o", path, "--json")
    model = load(path)
    assert isinstance(model, PosingModel)
    assert model.problem.material == StableNeoHookean()
    assert isinstance(model.elastic, Cubature)
    solver = model.provenance["solver"]
    assert (solver["tolerance"], solver["settling"]) == (1e-7, 0.0)
    assert f"cubature of {len(model.elastic.tets)} tets" in result.err
    shown = run("info", path)
    assert "stable neo-Hookean, lam 1, mu 1" in " ".join((shown.out + shown.err).split())


def test_an_impossible_energy_is_refused_before_the_work(run: Run, tmp_path: Path) -> None:
    problem, path = default_material(tmp_path), tmp_path / "m.snapspace"
    for options, message in (
        (("--energy", "exact"), "stable neo-Hookean is not a polynomial of degree four"),
        (("--samples", 9, "--dimension", 3), "needs at least 10 samples, but there are 9"),
        (("--samples", 9, "--energy-fraction", 0.9), "needs at least 10 samples"),
        ((*SMALL[:4], "--tets", 193), "--tets is 193, but the mesh has only 192; give fewer"),
    ):
        result = run("build", "--problem", problem, *options, "-o", path)
        assert (result.code, message in result.error) == (2, True)
        assert not list(tmp_path.glob("*snapspace*"))


def test_few_samples_and_an_energy_fraction_are_enough_for_an_exact_energy(
    run: Run, tmp_path: Path
) -> None:
    """A subspace has at most as many dimensions as there are samples."""
    path = tmp_path / "m.snapspace"
    words = ("--samples", 6, "--energy-fraction", 0.9, "-o", path)
    assert run("build", "--problem", write_problem(tmp_path), *words).code == 0
    assert load(path).dimension <= 6


def test_soft_and_stiff_parts_are_shown_by_their_range(run: Run, tmp_path: Path) -> None:
    stiff = {"boxes": [[[2, None, None], [None, None, None]]], "factor": 4}
    material = {"model": "stable-neo-hookean", "lam": 2.0, "mu": 0.5, "regions": [stiff]}
    problem, path = write_problem(tmp_path, material=material), tmp_path / "m.snapspace"
    run("build", "--problem", problem, *SMALL[:4], "-o", path)
    for file in (problem, path):
        figures = run("info", file, "--json").json["material"]
        assert figures == {
            "model": "stable-neo-hookean",
            "lam": {"min": 2.0, "max": 8.0},
            "mu": {"min": 0.5, "max": 2.0},
        }
        shown = run("info", file)
        words = " ".join((shown.out + shown.err).split())
        assert "stable neo-Hookean, lam varies from tet to tet: 2 to 8" in words
        assert "mu varies from tet to tet: 0.5 to 2;" in words


def default_material(folder: Path) -> Path:
    path = write_problem(folder)
    content = json.loads(path.read_text(encoding="utf-8"))
    del content["material"]
    path.write_text(json.dumps(content), encoding="utf-8")
    return path
