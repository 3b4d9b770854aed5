"""reduce(..., energy="full"): the energy of all tets on a subspace, for any material."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from snapspace import ARAP, InterpolationModel, PosingModel, export_html, reduce, save_model
from snapspace.problem import PosingProblem
from snapspace.reduction import FullBlends, FullEnergy

from ..taylor import observed_order


@pytest.fixture(scope="module")
def full(posing_model: PosingModel) -> PosingModel:
    return reduce(posing_model.problem, posing_model.subspace, energy="full")


@pytest.fixture(scope="module")
def full_blends(blended_cubature_model: InterpolationModel) -> InterpolationModel:
    model = blended_cubature_model
    return reduce(model.problem, model.subspace, energy="full")


def coordinates(model: PosingModel | InterpolationModel, seed: int) -> np.ndarray:
    chance = np.random.default_rng(seed)
    return 0.2 * model.coordinate_scale * chance.standard_normal(model.dimension)


def test_it_is_the_exact_quartic_where_there_is_one(
    posing_model: PosingModel, full: PosingModel
) -> None:
    for seed in range(3):
        q = coordinates(full, seed)
        value, gradient = full.elastic.value_and_gradient(q)
        known, slope = posing_model.elastic.value_and_gradient(q)
        assert value == pytest.approx(known, rel=1e-9)
        assert np.allclose(gradient, slope, rtol=0, atol=1e-9 * np.abs(slope).max())


def test_sessions_end_where_those_of_the_quartic_do(
    posing_model: PosingModel, full: PosingModel
) -> None:
    with_quartic, with_all = (m.session(tolerance=1e-12) for m in (posing_model, full))
    for sign in (0.5, -0.5):
        parameters = full.problem.domain.from_unit(
            np.full(full.problem.parameter_count, 0.5 + 0.3 * sign)
        )
        with_quartic.pose(parameters)
        report = with_all.pose(parameters)
        assert report.status == "converged"
        distance = np.abs(with_all.vertices - with_quartic.vertices).max()
        assert distance < 1e-6 * full.problem.mesh.diagonal


def test_bfgs_ends_where_newton_does_with_fewer_hessians(
    full: PosingModel, monkeypatch: pytest.MonkeyPatch
) -> None:
    counts, original = {"newton": 0, "bfgs": 0}, FullEnergy.hessian
    unit = np.full(full.problem.parameter_count, 0.7)
    ends = {}
    for minimizer in counts:

        def counted(*args: object, name: str = minimizer, **options: object) -> np.ndarray:
            counts[name] += 1
            return original(*args, **options)  # type: ignore[arg-type]

        monkeypatch.setattr(FullEnergy, "hessian", counted)
        session = full.session(minimizer=minimizer, tolerance=1e-12)
        assert session.pose(full.problem.domain.from_unit(unit)).status == "converged"
        ends[minimizer] = session.vertices
    assert counts["bfgs"] <= counts["newton"] // 2
    distance = np.abs(ends["newton"] - ends["bfgs"]).max()
    assert distance < 1e-6 * full.problem.mesh.diagonal


def test_blends_are_those_of_the_problem(full_blends: InterpolationModel) -> None:
    """The oracle is the compiled system of all poses, whose form collapses."""
    weights = np.array([0.2, 0.5, 0.3])
    q = coordinates(full_blends, 1)
    x = full_blends.subspace.shape(q)
    value, gradient = full_blends.problem.value_and_gradient(x, weights)
    energy = full_blends.elastic(weights)
    assert isinstance(energy, FullEnergy)
    found, slope = energy.value_and_gradient(q)
    assert found == pytest.approx(value, rel=1e-9)
    wanted = full_blends.subspace.basis.T @ gradient
    assert np.allclose(slope, wanted, rtol=0, atol=1e-8 * np.abs(wanted).max())


def test_poses_without_weight_are_not_evaluated(
    full_blends: InterpolationModel,
) -> None:
    """Most blends are between two of many poses."""
    q = coordinates(full_blends, 1)
    every = replace(full_blends.elastic([0.2, 0.5, 0.3]), weights=np.array([0.7, 0.0, 0.3]))
    assert isinstance(every, FullEnergy)
    energy = full_blends.elastic([0.7, 0.0, 0.3])
    assert isinstance(energy, FullEnergy)
    assert len(energy.parts) == len(energy.origins) == 2
    value, gradient = energy.value_and_gradient(q)
    known, slope = every.value_and_gradient(q)
    assert value == known
    assert np.array_equal(gradient, slope)
    assert np.array_equal(energy.hessian(q), every.hessian(q))


@pytest.mark.parametrize("weights", [[0.5, 0.5], [0.2, 0.5, 0.3, 0.0]])
def test_every_pose_needs_a_weight(full_blends: InterpolationModel, weights: list[float]) -> None:
    with pytest.raises(ValueError, match=r"but must be \(3,\), one per pose"):
        full_blends.elastic(weights)


def test_blended_sessions_end_in_a_minimum(full_blends: InterpolationModel) -> None:
    session = full_blends.session()
    session.blend([1.0, 0.0, 0.0])
    report = session.blend([0.2, 0.5, 0.3])
    assert report.status == "converged"
    energy = full_blends.elastic([0.2, 0.5, 0.3])
    assert isinstance(energy, FullEnergy)
    assert np.linalg.eigvalsh(energy.hessian(session.q)).min() > 0.0
    away = coordinates(full_blends, 3)
    assert energy.value(session.q + 1e-3 * away) > report.value


@pytest.mark.parametrize("kind", ["posing", "arap", "blending"])
def test_derivatives_have_their_taylor_orders(
    kind: str, full: PosingModel, full_blends: InterpolationModel
) -> None:
    if kind == "blending":
        model, energy = full_blends, full_blends.elastic([0.4, 0.4, 0.2])
    elif kind == "arap":
        old = full.problem
        problem = PosingProblem(old.mesh, old.handles, domain=old.domain, material=ARAP())
        model = reduce(problem, full.subspace, energy="full")
        energy = model.elastic
    else:
        model, energy = full, full.elastic
    q, move = coordinates(model, 1), coordinates(model, 2)
    value, gradient = energy.value_and_gradient(q)
    curved = energy.hessian(q) @ move

    def first(step: float) -> float:
        return energy.value(q + step * move) - value - step * float(gradient @ move)

    def second(step: float) -> np.ndarray:
        return energy.value_and_gradient(q + step * move)[1] - gradient - step * curved

    assert observed_order(first) == pytest.approx(2.0, abs=0.15)
    assert observed_order(second) == pytest.approx(2.0, abs=0.15)


def test_hessians_do_not_depend_on_the_number_of_threads(posing_model: PosingModel) -> None:
    problem, subspace = posing_model.problem, posing_model.subspace
    q = coordinates(posing_model, 4)
    one, two = (
        reduce(problem, subspace, energy="full", threads=count).elastic.hessian(q)
        for count in (1, 2)
    )
    assert np.array_equal(one, two)


def test_leading_coordinates_are_those_of_a_smaller_subspace(full: PosingModel) -> None:
    q = coordinates(full, 5)
    some = full.leading(7)
    padded = np.concatenate([q[:7], np.zeros(full.dimension - 7)])
    assert some.elastic.value(q[:7]) == pytest.approx(full.elastic.value(padded), rel=1e-12)
    session = full.session()
    session.dimension = 7
    session.pose(np.zeros(full.problem.parameter_count))
    assert len(session.q) == 7


def test_files_and_pages_refuse_it(
    full: PosingModel, full_blends: InterpolationModel, tmp_path: Path
) -> None:
    for model in (full, full_blends):
        for write, name in ((save_model, "a.snapspace"), (export_html, "a.html")):
            with pytest.raises(ValueError, match="the energy of all tets, which is for experim"):
                write(model, tmp_path / name)
    assert list(tmp_path.iterdir()) == []
    assert isinstance(full_blends.blends, FullBlends)


def test_what_it_cannot_do_is_refused(full: PosingModel) -> None:
    with pytest.raises(ValueError, match="'full' takes all tets"):
        reduce(full.problem, full.subspace, energy="full", tets=10)
    with pytest.raises(ValueError, match="precision 'single' is for exact quartics"):
        full.session(precision="single")
