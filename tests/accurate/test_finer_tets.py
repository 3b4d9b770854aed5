"""A model that misses the target with all samples gets eight tets for each of its dimensions."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import PosingProblem, accurate_model, growing_models
from snapspace.cubature import train
from snapspace.cubature.train import finer_tets
from snapspace.validation import unseen_errors

from ..shapes import interpolation_problem
from ..shells.strips import strip_problem


def test_only_many_modes_of_posed_solids_get_more(motions: PosingProblem) -> None:
    assert finer_tets(motions, 149) is None
    assert finer_tets(motions, 150) == 1200
    assert finer_tets(motions, 400) == 2000
    assert finer_tets(strip_problem(), 200) is None
    assert finer_tets(interpolation_problem(), 200) is None


@pytest.fixture
def coarse(monkeypatch: pytest.MonkeyPatch) -> None:
    """Numbers of tets that small models reach."""
    monkeypatch.setattr(train, "MOST_TETS", 60)
    monkeypatch.setattr(train, "MOST_FINER_TETS", 200)


@pytest.mark.usefixtures("coarse")
def test_a_model_that_misses_its_target_is_made_finer_at_the_end(motions: PosingProblem) -> None:
    told: list[str] = []
    result = accurate_model(motions, target_error=1e-6, most_samples=60, tell=told.append)
    steps = result.model.provenance["accurate"]["steps"]
    assert [step["tets"] for step in steps[:-1]] == [None] * (len(steps) - 1)
    coarse, finer = steps[-2:]
    assert finer["dimension"] == coarse["dimension"] and finer["samples"] == coarse["samples"]
    assert finer["tets"] == min(8 * finer["dimension"], 200) and ", 200 tets:" in told[-1]
    assert finer["error"] < 0.8 * coarse["error"], "the tets were what limited it"
    assert result.model.cubature is not None and len(result.model.cubature.tets) > 60
    unseen = result.snapshots.select(result.held_out)
    assert np.median(unseen_errors(result.model, unseen)) == pytest.approx(finer["error"], rel=0.05)


@pytest.mark.usefixtures("coarse")
def test_a_model_that_meets_its_target_stays_fast(motions: PosingProblem) -> None:
    result = accurate_model(motions, target_error=0.5, most_samples=60)
    assert result.model.cubature is not None and len(result.model.cubature.tets) <= 60
    assert result.step.tets is None


@pytest.mark.usefixtures("coarse")
def test_a_budget_that_is_used_up_leaves_the_coarse_model(motions: PosingProblem) -> None:
    *_, last = growing_models(motions, target_error=1e-6, most_samples=60, budget=1e-3)
    assert last.step is not None and last.step.tets is None
