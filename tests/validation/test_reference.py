"""Known full solutions serve as references in place of new ones."""

from __future__ import annotations

from dataclasses import replace
from typing import NoReturn

import numpy as np
import pytest

from snapspace import (
    HandleBox,
    Handles,
    InterpolationModel,
    PosingModel,
    PosingProblem,
    Snapshots,
    Validation,
    error_curve,
    sample,
    solve_snapshots,
    validate,
)
from snapspace.validation import solved_reference

from ..shapes import bar

COUNT = 5
FIGURES = ("error", "projection_error", "energy_ratio", "iterations", "inverted_tets")


@pytest.fixture(scope="module")
def checked(posing_model: PosingModel) -> Validation:
    return validate(posing_model, samples=COUNT, seed=3, threads=1)


def no_solve(*_: object, **__: object) -> NoReturn:
    raise AssertionError("something was solved")


def test_a_known_reference_gives_the_same_figures_without_a_solve(
    posing_model: PosingModel, checked: Validation, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("snapspace.validation.unseen.solve_snapshots", no_solve)
    again = validate(posing_model, reference=checked.reference)
    for name in FIGURES:
        np.testing.assert_array_equal(getattr(again, name), getattr(checked, name))
    assert again.reference is checked.reference


def test_a_curve_is_a_validation_of_each_dimension_with_one_reference(
    posing_model: PosingModel, checked: Validation, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("snapspace.validation.unseen.solve_snapshots", no_solve)
    curve = error_curve(posing_model, dimensions=[20, 5, 5], reference=checked.reference)
    assert curve.dimensions.tolist() == [5, 20]
    small = validate(posing_model.leading(5), reference=checked.reference)
    for found, wanted in zip(curve.validations, (small, checked), strict=True):
        for name in FIGURES:
            np.testing.assert_array_equal(getattr(found, name), getattr(wanted, name))
    assert [entry["dimension"] for entry in curve.as_json()] == [5, 20]
    usual = error_curve(posing_model, reference=checked.reference)
    assert usual.dimensions[0] == 2 and usual.dimensions[-1] == 20
    least = np.array([v.projection_error for v in usual.validations])
    assert (np.diff(least, axis=0) <= 1e-12).all(), "larger subspaces hold smaller ones"


@pytest.mark.parametrize("dimensions", [[0, 5], [21], []])
def test_a_curve_has_dimensions_of_the_model(
    posing_model: PosingModel, checked: Validation, dimensions: list[int]
) -> None:
    with pytest.raises(ValueError, match=r"error_curve: dimensions are .* and the model.s, 20"):
        error_curve(posing_model, dimensions=dimensions, reference=checked.reference)


def test_a_reference_of_another_problem_is_refused(
    checked: Validation, blending_model: InterpolationModel, posing_model: PosingModel
) -> None:
    with pytest.raises(ValueError, match="validate: the reference is of another problem, Posing"):
        validate(blending_model, reference=checked.reference)
    stiffer = replace(posing_model, problem=_stiffer(posing_model))
    with pytest.raises(ValueError, match="another problem"):
        validate(stiffer, reference=checked.reference)


def _stiffer(model: PosingModel) -> object:
    problem = model.problem
    return type(problem)(
        problem.mesh,
        problem.handles,
        domain=problem.domain,
        material=problem.material,
        stiffness=2.0 * problem.stiffness,
    )


def test_samples_that_did_not_converge_are_refused(
    posing_model: PosingModel, checked: Validation
) -> None:
    reports = list(checked.reference.reports)
    reports[2] = replace(reports[2], status="max_iterations")
    broken = replace(checked.reference, reports=reports)
    with pytest.raises(
        ValueError, match="1 of 5 reference samples are not full solutions: the status of sample 2"
    ):
        validate(posing_model, reference=broken)
    kept = validate(posing_model, reference=broken.select(broken.converged))
    np.testing.assert_array_equal(kept.error, np.delete(checked.error, 2))


def test_slow_motions_are_not_left_out() -> None:
    """With at most 5000 iterations only the easy motions of a wire would judge its model."""
    mesh = bar(250, 1, 1, length=400.0)
    x = mesh.vertices[:, 0]
    domain = HandleBox(translation=40.0, angle=np.pi / 4)
    wire = PosingProblem(mesh, Handles([x < 1.7, x > 398.3]), domain=domain)
    reference = solved_reference(wire, samples=4)
    assert len(reference) == 4
    assert max(report.iterations for report in reference.reports) > 5000


def test_training_samples_are_refused(
    posing_model: PosingModel, posing_snapshots: Snapshots, checked: Validation
) -> None:
    seen = checked.reference.joined(posing_snapshots.select(np.arange(60) == 7))
    with pytest.raises(ValueError, match="1 of 6 reference samples, the first is 5, are at train"):
        validate(posing_model, reference=seen)


def test_a_reference_needs_samples_and_excludes_sampling_options(
    posing_model: PosingModel, checked: Validation
) -> None:
    none = checked.reference.select(np.zeros(COUNT, bool))
    with pytest.raises(ValueError, match="the reference has no samples"):
        validate(posing_model, reference=none)
    with pytest.raises(ValueError, match="samples and seed have no effect"):
        validate(posing_model, reference=checked.reference, samples=3)


def test_any_converged_snapshots_may_be_a_reference(posing_model: PosingModel) -> None:
    """They may have been solved for another purpose."""
    problem = posing_model.problem
    own = solve_snapshots(problem, sample(problem.domain, 3, seed=99), threads=1)
    assert len(validate(posing_model, reference=own.select(own.converged)).error) > 0


def test_inverted_tets_are_counted_in_the_frames(
    posing_model: PosingModel, checked: Validation
) -> None:
    """The energy counts them by deformation gradients and not by volumes."""
    session, energy = posing_model.session(), posing_model.problem.energy
    for w, found in zip(checked.reference.parameters, checked.inverted_tets, strict=True):
        session.reset()
        session.pose(w)
        assert found == energy.inverted_tets(session.vertices)
