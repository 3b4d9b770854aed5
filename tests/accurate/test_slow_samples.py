"""Slender bodies, whose samples take many evaluations: models predict most of them."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import (
    HandleBox,
    Handles,
    PosingModel,
    PosingProblem,
    SolverOptions,
    sample,
    solve_snapshots,
    validate,
)
from snapspace.accurate import AccurateModel, accurate_model, solving
from snapspace.accurate.growing_samples import GrowingSamples
from snapspace.accurate.plan import MOTIONS
from snapspace.accurate.solving import Solving

from ..shapes import bar, slender_problem


@pytest.fixture(scope="module")
def slender() -> PosingProblem:
    return slender_problem()


@pytest.fixture(scope="module")
def built(slender: PosingProblem) -> AccurateModel[PosingModel]:
    return accurate_model(slender, target_error=0.01, threads=2)


def test_only_slow_bodies_are_predicted(
    built: AccurateModel[PosingModel], motions: PosingProblem
) -> None:
    quick = GrowingSamples(
        motions, 48, method="sobol", seed=0, first=40, held_out=8, pilot=32, slow=MOTIONS.slow
    )
    assert not quick.are_predicted
    quick.solve_up_to(48, Solving(), predict=lambda: None)
    assert not quick.are_predicted
    reports = [report.evaluations for report in built.snapshots.reports[: MOTIONS.pilot]]
    assert np.mean(reports) > MOTIONS.slow


def test_held_out_samples_that_come_first_are_no_pilot(motions: PosingProblem) -> None:
    samples = GrowingSamples(
        motions, 24, method="sobol", seed=0, first=0, held_out=8, pilot=4, slow=0.0
    )
    predicted = []
    for count in (8, 24):
        samples.solve_up_to(
            count, Solving(), predict=lambda: predicted.append(samples.are_predicted)
        )
    assert predicted == [False, False, True], "8 held-out ones, the pilot, and 12 others"


def test_predicted_samples_are_solved_as_tightly_as_others(
    slender: PosingProblem, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Loose samples leave larger errors. Those of large bodies are loose, predicted or not."""
    tolerances = []
    for large in (False, True):
        monkeypatch.setattr(solving, "is_large", lambda problem, large=large: large)
        tolerances.append(Solving().usual(slender).tolerance)
        assert Solving().seeded(slender) == Solving().usual(slender)
    assert tolerances == [1e-7, 1e-6]


def test_predicted_samples_take_less(
    slender: PosingProblem, built: AccurateModel[PosingModel]
) -> None:
    """The same motions, with a model's predictions and from a guess."""
    samples = built.snapshots
    predicted = ~built.held_out
    predicted[: MOTIONS.pilot] = False
    unaided = solve_snapshots(
        slender, samples.parameters[predicted], options=Solving().usual(slender), threads=2
    )
    usual = np.mean([report.evaluations for report in unaided.reports])
    taken = np.array([report.evaluations for report in samples.reports])[predicted]
    assert taken.mean() < 0.75 * usual


def test_the_model_is_as_accurate_as_asked(built: AccurateModel[PosingModel]) -> None:
    assert built.reached
    assert np.median(validate(built.model, samples=12).error) < 1.5 * built.target


def test_it_is_the_same_on_any_number_of_threads(
    slender: PosingProblem, built: AccurateModel[PosingModel]
) -> None:
    alone = accurate_model(slender, target_error=0.01, threads=1)
    assert np.array_equal(alone.snapshots.shapes, built.snapshots.shapes)
    assert alone.model.dimension == built.model.dimension


def test_samples_of_a_wire_converge_without_options() -> None:
    """With a limit of 1000 iterations, a third did not, and models saw only the easy motions."""
    mesh = bar(150, 1, 1, length=200.0)
    x = mesh.vertices[:, 0]
    domain = HandleBox(translation=20.0, angle=np.pi / 4)
    wire = PosingProblem(mesh, Handles([x < 1.5, x > 198.5]), domain=domain)
    solved = solve_snapshots(wire, sample(domain, 16, seed=0), options=Solving().usual(wire))
    assert solved.converged.all()
    assert max(report.iterations for report in solved.reports) > 1000


def test_too_few_converged_samples_are_counted(slender: PosingProblem) -> None:
    """The reduction once saw only the converged ones, and said that there were no more."""
    options = SolverOptions(max_iterations=60)
    with pytest.raises(ValueError, match="of 80 samples converged, but at least 10 are needed"):
        accurate_model(slender, options=options)


def test_energies_beyond_all_numbers_need_smaller_motions(slender: PosingProblem) -> None:
    """More iterations do not help where no sample has a finite energy."""
    domain = HandleBox(translation=1e6, angle=1.0)
    far = PosingProblem(slender.mesh, slender.handles, domain=domain)
    with pytest.raises(ValueError, match="make the motions smaller, since their energies are too"):
        accurate_model(far)
