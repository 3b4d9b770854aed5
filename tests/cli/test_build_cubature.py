"""`snapspace build --method cubature`: the model, what is recorded and shown, and refusals."""

from __future__ import annotations

from pathlib import Path

from snapspace import Cubature, PosingModel, load

from .conftest import Run
from .files import write_problem

SMALL = ("--samples", 24, "--dimension", 10, "--method", "cubature")


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
    assert "--tets is for --method cubature" in result.err
    assert not path.exists()


def test_samples_of_a_cubature_are_near_equilibrium_unless_told(run: Run, tmp_path: Path) -> None:
    """A closure interpolates forces that are left at the samples; settled ones have others."""
    problem, path = write_problem(tmp_path), tmp_path / "m.snapspace"

    def solver(*options: object) -> dict[str, float]:
        run("build", "--problem", problem, *SMALL[:4], *options, "-o", path)
        recorded: dict[str, float] = load(path).provenance["solver"]
        return recorded

    tight = solver(*SMALL[4:])
    assert (tight["tolerance"], tight["settling"]) == (1e-5, 0.0)
    assert solver(*SMALL[4:], "--tolerance", 1e-4)["tolerance"] == 1e-4
    assert solver(*SMALL[4:], "--settling", 0.02) == {**solver(), "settling": 0.02}
