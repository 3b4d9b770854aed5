"""Errors at unseen parameters, compared with references that the tests compute."""

from __future__ import annotations

import re

import numpy as np
import pytest

from snapspace import (
    ReducedModel,
    Snapshots,
    SolverOptions,
    Validation,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
    validate,
)
from snapspace.mesh import mass_norm
from snapspace.validation import unseen_parameters

from ..snapshots.bars import parameters, posing_bar

COUNT = 6


def build(count: int, *, bound: float = 0.25) -> ReducedModel:
    """A model with as many dimensions as snapshots."""
    problem = posing_bar(bound=bound)
    options = SolverOptions(tolerance=1e-10)
    snapshots = solve_snapshots(problem, parameters(problem, count), options=options, threads=1)
    subspace = snapshot_pca(snapshots, dimension=count)
    return reduce(problem, subspace, snapshots=snapshots, threads=1)


@pytest.fixture(scope="module")
def model() -> ReducedModel:
    return build(30)


@pytest.fixture(scope="module")
def checked(model: ReducedModel) -> Validation:
    return validate(model, samples=COUNT, seed=4, threads=1)


def test_errors_are_small_at_parameters_like_the_training_ones(checked: Validation) -> None:
    """Thirty snapshots span a Taylor expansion to second order in six parameters, which has 27
    terms. The error of unseen shapes is of third order.
    """
    assert checked.projection_error.max() < 0.01
    assert checked.error.max() < 0.03


def test_nothing_in_the_subspace_beats_the_projection(checked: Validation) -> None:
    assert len(checked.error) == COUNT
    assert (checked.error >= checked.projection_error * (1.0 - 1e-9)).all()


def test_no_reduced_solution_has_less_energy_than_the_full_one(checked: Validation) -> None:
    """The full solve minimises over all shapes, the reduced one over some of them."""
    assert (checked.energy_ratio >= 1.0 - 1e-8).all()
    assert checked.energy_ratio.max() < 1.01


def test_figures_match_their_definitions(model: ReducedModel, checked: Validation) -> None:
    """Recomputed from the reference: solve from rest, project, measure in the M-norm."""
    subspace, session = model.subspace, model.session()
    for i, w in enumerate(unseen_parameters(model.problem.domain, COUNT, seed=4)):
        full = checked.reference.shapes[i]
        assert checked.reference.reports[i].converged
        size = mass_norm(subspace.mass, full - subspace.tau)
        session.reset()
        report = session.pose(w)
        reduced = session.vertices.reshape(-1)
        error = mass_norm(subspace.mass, reduced - full) / size
        assert checked.error[i] == pytest.approx(error, rel=1e-9)
        projected = subspace.shape(subspace.coordinates(full))
        least = mass_norm(subspace.mass, projected - full) / size
        assert checked.projection_error[i] == pytest.approx(least, rel=1e-6)
        value, _ = model.problem.value_and_gradient(reduced, w)
        at_full, _ = model.problem.value_and_gradient(full, w)
        assert checked.energy_ratio[i] == pytest.approx(value / at_full, rel=1e-9)
        assert checked.iterations[i] == report.iterations


def test_references_are_converged_beyond_the_errors(
    model: ReducedModel, checked: Validation
) -> None:
    """Their distance from Newton's tighter solution is a hundredth of the measured errors."""
    options = SolverOptions(solver="newton", tolerance=1e-14)
    tight = solve_snapshots(model.problem, checked.reference.parameters, options=options, threads=1)
    for i in range(COUNT):
        distance = mass_norm(model.subspace.mass, tight.shapes[i] - checked.reference.shapes[i])
        size = mass_norm(model.subspace.mass, tight.shapes[i] - model.subspace.tau)
        assert distance / size < 0.01 * checked.projection_error[i]


def test_a_larger_subspace_is_better(checked: Validation, model: ReducedModel) -> None:
    smaller = validate(model.leading(12), samples=COUNT, seed=4, threads=1)
    assert (smaller.projection_error > checked.projection_error).all()
    assert np.median(smaller.error) > np.median(checked.error)
    np.testing.assert_array_equal(smaller.reference.shapes, checked.reference.shapes)


def test_training_samples_are_reproduced(model: ReducedModel) -> None:
    """Where the subspace contains the solution, the reduced minimiser is the full one."""
    session = model.session(tolerance=1e-14)
    for w, q in zip(model.training_parameters[:4], model.training_coordinates[:4], strict=True):
        session.reset()
        session.pose(w)
        difference = model.subspace.basis @ (session.q - q)
        displacement = model.subspace.basis @ q
        assert np.linalg.norm(difference) < 1e-3 * np.linalg.norm(displacement)


def test_the_same_seed_gives_the_same_figures(model: ReducedModel, checked: Validation) -> None:
    again = validate(model, samples=COUNT, seed=4, threads=2)
    for name in ("error", "projection_error", "energy_ratio", "iterations"):
        np.testing.assert_array_equal(getattr(again, name), getattr(checked, name))
    other = validate(model, samples=COUNT, seed=5, threads=1)
    assert not np.isin(other.error, checked.error).any()


def test_json_has_the_keys_of_the_command_line(checked: Validation) -> None:
    content = checked.as_json(30)
    full, short = {"mean", "median", "ninth", "std", "max"}, {"median", "max"}
    assert {key: set(v) if isinstance(v, dict) else v for key, v in content.items()} == {
        "samples": COUNT,
        "dimension": 30,
        "error": full,
        "projection_error": full,
        "energy_ratio": full,
        "iterations": full,
        "solve_ms": short,
        "frame_ms": short,
        "inverted_tets": {"frames_max", "samples_max"},
        "lower_minima": 0,
    }
    assert content["error"] == {
        "mean": np.mean(checked.error),
        "median": np.median(checked.error),
        "ninth": np.quantile(checked.error, 0.9),
        "std": np.std(checked.error),
        "max": np.max(checked.error),
    }
    assert content["iterations"]["max"] == checked.iterations.max()
    assert content["inverted_tets"]["frames_max"] == checked.inverted_tets.max()
    del content["inverted_tets"]
    numbers = [v for entry in content.values() if isinstance(entry, dict) for v in entry.values()]
    assert all(type(number) is float and np.isfinite(number) for number in numbers)


def test_a_frame_takes_longer_than_its_solve(checked: Validation) -> None:
    assert (checked.solve_ms > 0.0).all()
    assert (checked.frame_ms >= checked.solve_ms).all()


def test_samples_that_did_not_converge_are_not_compared(
    model: ReducedModel, checked: Validation, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Only some references fit the budget; the figures are those of these, in their order."""
    counts = sorted(report.iterations for report in checked.reference.reports)
    budget = counts[COUNT // 2]

    def hurried(*arguments: object, **options: object) -> Snapshots:
        given = options["options"]
        assert isinstance(given, SolverOptions)
        options["options"] = SolverOptions(tolerance=given.tolerance, max_iterations=budget)
        return solve_snapshots(*arguments, **options)  # type: ignore[arg-type]

    monkeypatch.setattr("snapspace.validation.unseen.solve_snapshots", hurried)
    partly = validate(model, samples=COUNT, seed=4, threads=1)
    kept = [report.iterations <= budget for report in checked.reference.reports]
    assert 0 < sum(kept) < COUNT
    np.testing.assert_array_equal(partly.error, checked.error[kept])
    assert partly.as_json(30)["samples"] == sum(kept)

    budget = 1
    with pytest.raises(ValueError, match="validate: no full solution converged, so there is noth"):
        validate(model, samples=2, seed=4, threads=1)


def test_unseen_parameters_are_in_the_box_and_unseen(model: ReducedModel) -> None:
    """They come from other random streams than those of `sample`, for any seed."""
    domain = model.problem.domain
    drawn = {seed: unseen_parameters(model.problem.domain, 40, seed=seed) for seed in range(20)}
    for points in drawn.values():
        assert points.shape == (40, 6)
        assert (np.abs(points) <= domain.half_widths).all()
    training = np.concatenate([sample(domain, 40, seed=seed) for seed in range(100)])
    unseen = np.concatenate(list(drawn.values()))
    assert not np.isin(unseen, training).any()
    assert len(np.unique(unseen)) == unseen.size
    np.testing.assert_array_equal(unseen_parameters(model.problem.domain, 40, seed=3), drawn[3])
    np.testing.assert_array_equal(
        unseen_parameters(model.problem.domain, 10, seed=3), drawn[3][:10]
    )


def test_unseen_parameters_are_uniform(model: ReducedModel) -> None:
    points = (
        unseen_parameters(model.problem.domain, 4000, seed=1) / model.problem.domain.half_widths
    )
    np.testing.assert_allclose(points.mean(axis=0), 0.0, atol=0.05)
    np.testing.assert_allclose(points.var(axis=0), 1 / 3, atol=0.03)


@pytest.mark.parametrize("count", [0, -3])
def test_refuses_no_samples(model: ReducedModel, count: int) -> None:
    message = f"validate: the number of samples is {count}, but must be at least 1"
    with pytest.raises(ValueError, match=re.escape(message)):
        validate(model, samples=count)
