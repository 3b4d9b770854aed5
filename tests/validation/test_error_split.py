"""The parts of an error, compared with the cubature of all tets and with Pythagoras."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from snapspace import (
    Cubature,
    ErrorSplit,
    InterpolationModel,
    PosingModel,
    ReducedModel,
    Snapshots,
    StableNeoHookean,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
    split_errors,
    validate,
)
from snapspace.cubature import BlendedCubature
from snapspace.mesh import mass_norms
from snapspace.reduction import solved_coordinates
from snapspace.validation import solved_reference

from ..snapshots.bars import posing_bar

COUNT = 4


@pytest.fixture(scope="module")
def graded_model() -> PosingModel:
    """A bar with different moduli in every tet, and a cubature of far too few tets."""
    count = len(posing_bar().mesh.tets)
    material = StableNeoHookean(lam=1.5, mu=np.linspace(0.5, 2.0, count))
    problem = posing_bar(bound=0.5, material=material)
    snapshots = solve_snapshots(problem, sample(problem.domain, 60, seed=1), threads=1)
    subspace = snapshot_pca(snapshots, dimension=24)
    return reduce(problem, subspace, snapshots=snapshots, tets=24, threads=1)


def reference(model: ReducedModel) -> Snapshots:
    return solved_reference(model.problem, samples=COUNT, seed=2, threads=1)


def with_all_tets(model: PosingModel | InterpolationModel) -> PosingModel | InterpolationModel:
    """The same subspace with the energy of all tets, which is exact except for rounded rows."""
    mesh = model.problem.mesh
    every = np.arange(len(mesh.tets), dtype=np.int32)
    if isinstance(model, PosingModel):
        cubature = Cubature.of_tets(model.problem, model.subspace, every, mesh.volumes)
        return replace(model, elastic=cubature)
    blended = BlendedCubature.of_tets(model.problem, model.subspace, every, mesh.volumes)
    return replace(model, blends=blended)


@pytest.mark.parametrize("name", ["graded_model", "blended_cubature_model"])
def test_the_error_of_all_tets_is_that_of_a_cubature_of_all_tets(
    name: str, request: pytest.FixtureRequest
) -> None:
    """The same minimiser from independent code: a compiled loop with 9 d numbers per tet."""
    model = request.getfixturevalue(name)
    full = reference(model)
    split = split_errors(model, full)
    exact = with_all_tets(model)
    tight = solved_coordinates(exact, full.parameters, tolerance=1e-13)
    live = solved_coordinates(exact, full.parameters)
    # bases in single precision are M-orthonormal to 1e-8
    wanted = pytest.approx(_errors(exact, full, tight), rel=1e-3, abs=5e-8)
    assert split.error_of_all_tets == wanted
    exact_split = split_errors(exact, full)
    unsolved = np.linalg.norm(live - tight, axis=1) / _sizes(exact, full)
    # rows are rounded to 5e-7 of their entries
    assert exact_split.cubature == pytest.approx(unsolved, rel=1e-3, abs=2e-7), (
        "all tets leave only what a session's tolerance does"
    )
    np.testing.assert_array_equal(exact_split.stiffness, split.stiffness)
    np.testing.assert_array_equal(exact_split.subspace, split.subspace)


def _sizes(model: ReducedModel, full: Snapshots) -> np.ndarray:
    offset = model.problem.base - model.subspace.tau
    return mass_norms(model.subspace.mass, full.displacements.shifted(offset).array())


def _errors(model: ReducedModel, full: Snapshots, solved: np.ndarray) -> np.ndarray:
    rows = full.displacements.shifted(model.problem.base - model.subspace.tau)
    projections = model.subspace.row_coordinates(rows)
    missed = rows.array() - projections @ model.subspace.basis.T
    least = mass_norms(model.subspace.mass, missed)
    errors: np.ndarray = np.hypot(least, np.linalg.norm(solved - projections, axis=1))
    return errors / _sizes(model, full)


def test_the_first_two_parts_are_at_right_angles(graded_model: PosingModel) -> None:
    """The error is at most their sum with the last part, by the triangle inequality."""
    split = split_errors(graded_model, reference(graded_model))
    both = np.hypot(split.subspace, split.stiffness)
    np.testing.assert_allclose(split.error_of_all_tets, both, rtol=1e-12)
    assert (split.error <= split.error_of_all_tets + split.cubature + 1e-12).all()
    assert split.largest == "cubature", "24 tets for 24 modes are too few"


@pytest.mark.parametrize("name", ["graded_model", "posing_model", "blending_model"])
def test_the_whole_error_is_that_of_validate(name: str, request: pytest.FixtureRequest) -> None:
    model = request.getfixturevalue(name)
    full = reference(model)
    split, checked = split_errors(model, full), validate(model, reference=full)
    np.testing.assert_allclose(split.error, checked.error, rtol=5e-3)
    np.testing.assert_allclose(split.subspace, checked.projection_error, rtol=1e-4)


@pytest.mark.parametrize("name", ["posing_model", "blending_model"])
def test_an_exact_energy_has_no_cubature_error(name: str, request: pytest.FixtureRequest) -> None:
    model = request.getfixturevalue(name)
    split = split_errors(model, reference(model))
    np.testing.assert_array_equal(split.cubature, 0.0)
    np.testing.assert_array_equal(split.error, split.error_of_all_tets)
    assert split.largest != "cubature"


def test_the_split_is_the_same_on_any_number_of_threads(graded_model: PosingModel) -> None:
    full = reference(graded_model)
    first, second = (split_errors(graded_model, full, threads=n) for n in (1, 2))
    for name in ErrorSplit.__dataclass_fields__:
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))


def test_json_names_the_largest_part(graded_model: PosingModel) -> None:
    split = split_errors(graded_model, reference(graded_model))
    content = split.as_json()
    assert (content["samples"], content["largest"]) == (COUNT, "cubature")
    assert content["stiffness"]["median"] == np.median(split.stiffness)


def test_a_reference_without_solutions_is_refused(graded_model: PosingModel) -> None:
    full = reference(graded_model)
    reports = [replace(report, status="max_iterations") for report in full.reports]
    with pytest.raises(ValueError, match="split_errors: 4 of 4 reference samples are not full"):
        split_errors(graded_model, replace(full, reports=reports))
