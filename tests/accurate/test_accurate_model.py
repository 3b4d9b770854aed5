"""Blends as accurate as asked: the error is that of blends that the model was not made from."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from snapspace import InterpolationProblem, Poses, validate
from snapspace.accurate import AccurateModel, accurate_model
from snapspace.generators import lizard_poses
from snapspace.snapshots import Checkpoint, SolveProgress


@pytest.fixture(scope="module")
def problem() -> InterpolationProblem:
    return InterpolationProblem(Poses.of(lizard_poses(3, 600, seed=3)))


@pytest.fixture(scope="module")
def usual(problem: InterpolationProblem) -> AccurateModel:
    return accurate_model(problem)


def test_unseen_blends_are_as_accurate_as_asked(usual: AccurateModel) -> None:
    """Uniform blends that did not judge the model are accurate too, by tighter solutions."""
    assert usual.reached and usual.step.error <= usual.target == 0.005
    assert usual.step.projection <= usual.step.error, "projections are the best possible"
    assert validate(usual.model, samples=12).error.mean() < 1.5 * usual.target


def test_samples_that_judge_a_model_do_not_train_it(usual: AccurateModel) -> None:
    trained = int((~usual.held_out).sum())
    unseen = usual.snapshots.parameters[usual.held_out]
    apart = np.abs(usual.model.training_parameters[:, None] - unseen).max(axis=2)
    assert apart.min() > 1e-6
    poses = len(usual.model.problem.poses)
    assert len(usual.model.training_parameters) == trained + poses, "the poses train it too"


def test_a_smaller_target_takes_more(problem: InterpolationProblem, usual: AccurateModel) -> None:
    better = accurate_model(problem, target_error=usual.step.error / 4)
    assert better.step.error <= usual.step.error / 4
    assert better.model.dimension > usual.model.dimension
    assert validate(better.model, samples=12).error.mean() < usual.step.error / 2


def test_if_no_model_meets_the_target_the_best_is_returned(problem: InterpolationProblem) -> None:
    lines: list[str] = []
    built = accurate_model(problem, target_error=1e-9, most_samples=24, tell=lines.append)
    assert not built.reached
    assert built.step.error == min(step.error for step in built.steps)
    assert built.model.dimension == built.step.dimension
    assert [str(step) for step in built.steps] == lines
    assert len(built.snapshots) == 24
    assert built.held_out.sum() == 6, "the same share of few samples as of many"


def test_it_is_the_same_on_any_number_of_threads(
    problem: InterpolationProblem, usual: AccurateModel
) -> None:
    again = accurate_model(problem, threads=1)
    assert again.steps == usual.steps
    np.testing.assert_array_equal(again.model.subspace.basis, usual.model.subspace.basis)
    np.testing.assert_array_equal(again.model.blends.weights, usual.model.blends.weights)


def test_an_interrupted_run_resumes_to_the_same_model(
    problem: InterpolationProblem, usual: AccurateModel, tmp_path: Path
) -> None:
    checkpoint = Checkpoint(tmp_path / "samples")

    class StopError(Exception):
        pass

    def stop(state: SolveProgress) -> None:
        if state.done >= 16:
            raise StopError

    with pytest.raises(StopError):
        accurate_model(problem, checkpoint=checkpoint, progress=stop)
    solved: list[int] = []
    again = accurate_model(
        problem, checkpoint=checkpoint, progress=lambda state: solved.append(state.solved)
    )
    assert again.steps == usual.steps
    assert max(solved) < len(usual.snapshots), "some were in the checkpoint"


@pytest.mark.parametrize("target", [0.0, -1.0, np.nan, np.inf, 1.0, 5, "5 %"])
def test_a_target_is_a_share(problem: InterpolationProblem, target: float) -> None:
    """The command line has the same bound: every model would meet 500 %."""
    with pytest.raises(
        ValueError,
        match=f"accurate_model: the target error is {target!r}, but it must be between 0",
    ):
        accurate_model(problem, target_error=target)


def test_a_mesh_in_place_of_a_problem_is_refused_with_the_cure(
    problem: InterpolationProblem,
) -> None:
    with pytest.raises(ValueError, match=r"accurate_model: got a TetMesh, but .* PosingProblem\("):
        accurate_model(problem.mesh)  # type: ignore[call-overload]


def test_some_samples_must_be_left_to_judge(problem: InterpolationProblem) -> None:
    with pytest.raises(ValueError, match="most_samples is 19, but at least 20"):
        accurate_model(problem, most_samples=19)
