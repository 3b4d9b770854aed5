"""Models with a cubature: near exact ones, positive weights, reproducible, recorded errors."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from snapspace import (
    AffineSubspace,
    Cubature,
    InterpolationModel,
    PosingModel,
    PosingProblem,
    Snapshots,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.mesh import mass_norms


def cubature(subspace: AffineSubspace, snapshots: Snapshots, **options: Any) -> PosingModel:
    problem = snapshots.problem
    assert isinstance(problem, PosingProblem)
    return reduce(problem, subspace, energy="cubature", snapshots=snapshots, **options)


def test_weights_are_positive_and_tets_few(cubature_model: PosingModel) -> None:
    elastic = cubature_model.elastic
    assert isinstance(elastic, Cubature)
    assert 0 < len(elastic.tets) <= 8 * 16
    assert (elastic.weights > 0).all()
    assert (np.diff(elastic.tets) > 0).all()


def test_solutions_are_near_those_of_the_exact_energy(
    cubature_model: PosingModel, snapshots: Snapshots
) -> None:
    exact = reduce(snapshots.problem, cubature_model.subspace, energy="exact", threads=1)
    here, there = cubature_model.session(), exact.session(minimizer="bfgs")
    errors = []
    for w in sample(snapshots.problem.domain, 15, seed=9):
        here.reset()
        there.reset()
        assert here.pose(w).converged
        assert there.pose(w).converged
        errors.append(np.linalg.norm(here.q - there.q) / np.linalg.norm(there.q))
    assert np.median(errors) < 0.01


def test_errors_on_held_out_samples_are_recorded(cubature_model: PosingModel) -> None:
    record = cubature_model.provenance["cubature"]
    held = record["held_out"]
    assert held["states"] == 6  # one in ten of sixty
    assert 0 < held["energy_median"] <= held["energy_max"] < 0.1
    assert 0 < held["force_median"] <= held["force_max"]
    assert 0 < held["displacement_median"] <= held["displacement_max"] < 0.05
    assert cubature_model.provenance["seed"] == 3
    json.dumps(cubature_model.provenance)


def test_more_tets_make_smaller_errors(snapshots: Snapshots) -> None:
    subspace = snapshot_pca(snapshots, dimension=10)
    errors = [
        cubature(subspace, snapshots, tets=tets).provenance["cubature"]["held_out"][
            "displacement_median"
        ]
        for tets in (15, 60, 240)
    ]
    assert errors[2] < errors[1] < errors[0]


def test_the_same_arguments_give_the_same_model(
    cubature_model: PosingModel, snapshots: Snapshots
) -> None:
    again = cubature(cubature_model.subspace, snapshots)
    np.testing.assert_array_equal(again.elastic.tets, cubature_model.elastic.tets)
    np.testing.assert_array_equal(again.elastic.weights, cubature_model.elastic.weights)
    other = cubature(cubature_model.subspace, snapshots, seed=1)
    assert len(other.elastic.tets) != len(again.elastic.tets) or not np.array_equal(
        other.elastic.weights, again.elastic.weights
    )


def test_a_drag_there_and_back_ends_where_it_started(cubature_model: PosingModel) -> None:
    session = cubature_model.session()
    path = [(0.0, 0.0, 0.02 * k) for k in range(20)]
    for euler in path:
        assert session.move("head", euler=euler).converged
    there = session.vertices
    for euler in [*path[::-1], *path]:
        session.move("head", euler=euler)
    size = mass_norms(cubature_model.subspace.mass, (there - path[0]).reshape(1, -1))
    miss = mass_norms(cubature_model.subspace.mass, (session.vertices - there).reshape(1, -1))
    assert miss < 1e-3 * size


def test_a_warm_frame_takes_fewer_evaluations_than_a_cold_one(cubature_model: PosingModel) -> None:
    session = cubature_model.session()
    cold = session.move("head", euler=(0.3, 0.2, 0.4)).evaluations
    warm = [session.move("head", euler=(0.3, 0.2, 0.4 + 0.01 * k)).evaluations for k in range(1, 8)]
    assert np.median(warm) < cold


def test_newton_and_bfgs_reach_the_same_minimum(cubature_model: PosingModel) -> None:
    shapes = []
    for minimizer in ("bfgs", "newton"):
        session = cubature_model.session(minimizer=minimizer, tolerance=1e-12)
        session.move("head", euler=(0.1, 0.2, 0.1), translation=(0.1, 0.0, 0.2))
        shapes.append(session.q)
    assert shapes[0] == pytest.approx(shapes[1], abs=1e-5 * np.linalg.norm(shapes[0]))


@pytest.mark.parametrize("dimension", [7, 10])
def test_fewer_dimensions_are_those_of_the_smaller_model(
    cubature_model: PosingModel, dimension: int
) -> None:
    small = cubature_model.leading(dimension).session(tolerance=1e-11)
    session = cubature_model.session(tolerance=1e-11)
    session.dimension = dimension
    for one in (small, session):
        assert one.move("head", euler=(0.1, 0.0, 0.2)).converged
    assert session.q == pytest.approx(small.q, abs=1e-5 * np.linalg.norm(small.q))
    before = session.solve().value
    session.dimension = 16
    assert session.solve().value < before


def test_solving_anew_never_raises_the_energy(cubature_model: PosingModel) -> None:
    session = cubature_model.session()
    value = session.move("head", euler=(0.2, -0.3, 0.2), translation=(0.2, 0.0, 0.1)).value
    assert session.solve_anew().value <= value * (1 + 1e-6)


def test_a_choice_of_precision_is_refused(cubature_model: PosingModel) -> None:
    """Rows always have the same precision; accepting the option would promise another model."""
    with pytest.raises(ValueError, match="a cubature always keeps its rows in single"):
        cubature_model.session(precision="single")


def test_bad_input_is_named(
    snapshots: Snapshots, blending_model: InterpolationModel, posing_model: PosingModel
) -> None:
    problem, subspace = snapshots.problem, snapshot_pca(snapshots, dimension=5)
    for tets in (0, len(problem.mesh.tets) + 1):
        with pytest.raises(ValueError, match=f"tets is {tets}, but must be between 1 and"):
            cubature(subspace, snapshots, tets=tets)
    few = snapshots.select(np.arange(len(snapshots)) < 9)
    with pytest.raises(ValueError, match=r"there are 9; give .* 10 samples or more, or energy='ex"):
        cubature(subspace, few)
    with pytest.raises(ValueError, match="snapshots, but there are 0; give"):
        reduce(problem, subspace, energy="cubature")
    with pytest.raises(ValueError, match="snapshots, but there are 0; give"):
        reduce(blending_model.problem, blending_model.subspace, energy="cubature")
    with pytest.raises(ValueError, match="not attached"):
        cubature(posing_model.subspace, snapshots)


def test_the_stiffness_comes_from_a_cubature_of_the_same_elements(
    snapshots: Snapshots,
    cubature_model: PosingModel,
    blending_model: InterpolationModel,
    posing_model: PosingModel,
) -> None:
    subspace = snapshot_pca(snapshots, dimension=12)
    exact = reduce(snapshots.problem, subspace, energy="exact")
    for wrong, words in (
        (exact, "stiffness_from has no cubature of the elements of St.Venant-Kirchhoff"),
        (posing_model, "but the problem is on another mesh"),
        (blending_model, "stiffness_from is of type InterpolationModel; give a PosingModel"),
    ):
        with pytest.raises(ValueError, match=words):
            cubature(subspace, snapshots, stiffness_from=wrong)
    with pytest.raises(ValueError, match="stiffness_from is for cubatures of posing problems"):
        reduce(snapshots.problem, subspace, energy="exact", stiffness_from=cubature_model)


def test_a_cubature_in_another_subspace_replaces_the_rough_fit(
    snapshots: Snapshots, cubature_model: PosingModel
) -> None:
    """Only its tets and their volumes count; errors on held-out samples are about the same."""
    subspace = snapshot_pca(snapshots, dimension=24)
    usual, known = (
        cubature(subspace, snapshots, stiffness_from=model) for model in (None, cubature_model)
    )
    errors = [
        model.provenance["cubature"]["held_out"]["displacement_median"] for model in (usual, known)
    ]
    assert errors[1] < 1.3 * errors[0]
    leading = cubature(subspace, snapshots, stiffness_from=cubature_model.leading(4))
    assert leading.cubature is not None and known.cubature is not None
    assert np.array_equal(leading.cubature.weights, known.cubature.weights)


def test_snapshots_at_rest_do_not_count(snapshots: Snapshots) -> None:
    """Ten others are needed."""
    parameters = snapshots.parameters[:12].copy()
    parameters[:3] = 0.0
    some = solve_snapshots(snapshots.problem, parameters, threads=1)
    assert sum(not row.any() for row in some.displacements) == 3
    with pytest.raises(ValueError, match="9 snapshots that are not at rest are too few to train"):
        cubature(snapshot_pca(some, dimension=4), some)
