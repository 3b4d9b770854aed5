"""Solutions for some handles, carried to a problem with other handles."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace import (
    HandleBox,
    Handles,
    PosingProblem,
    SampleReport,
    Snapshots,
    SolverOptions,
    StVK,
    carry_over,
    rigid_registration,
    solve_snapshots,
)
from snapspace.problem import rotation_matrix

from ..shapes import bar_problem, deformed, interpolation_problem, irregular_bar
from .bars import assert_same_bits, core_solve, parameters

FloatArray = NDArray[np.float64]
PROBLEM = bar_problem()
MESH, HANDLES = PROBLEM.mesh, PROBLEM.handles
X = (MESH.vertices[:, 0] - MESH.vertices[:, 0].min()) / np.ptp(MESH.vertices[:, 0])
KNEE = (X > 0.2) & (X < 0.35)


def solved(problem: PosingProblem, count: int = 5) -> Snapshots:
    options = SolverOptions(tolerance=1e-9)
    return solve_snapshots(problem, parameters(problem, count), options=options, threads=1)


@pytest.fixture(scope="module")
def old() -> Snapshots:
    return solved(PROBLEM)


def given_shapes(problem: PosingProblem, w: FloatArray, shapes: FloatArray) -> Snapshots:
    """Snapshots of any shapes (k, 3n), as if they were solutions."""
    report = SampleReport("converged", 9, 11, 1.0, 1e-3, 1e-6, 0.1, 0)
    return Snapshots.from_shapes(problem, w, shapes, [report] * len(w))


def following(problem: PosingProblem, w: FloatArray, *, seed: int = 0) -> FloatArray:
    """A shape whose handles follow the motions exactly; all other vertices are arbitrary."""
    x = deformed(MESH, 0.4, seed=seed).reshape(-1, 3)
    offsets = problem.offsets(w)
    x[problem.pinned] = MESH.vertices[problem.pinned] + problem.target_displacements(offsets)
    return x.reshape(-1)


motions = st.lists(st.floats(-1.5, 1.5), min_size=12, max_size=12).map(np.array)


@settings(max_examples=50)
@given(w=motions, seed=st.integers(0, 99))
def test_handles_that_moved_rigidly_are_found_exactly(w: FloatArray, seed: int) -> None:
    new = PROBLEM.with_handles(HANDLES.replacing("head", X > 0.8).replacing("belly", KNEE))
    x = following(new, w, seed=seed)
    result = carry_over(given_shapes(PROBLEM, np.zeros((1, 12)), x[None]), new)
    np.testing.assert_allclose(result.parameters[0], w, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(result.shapes[0], x)
    assert new.handle_energy(x, new.offsets(result.parameters[0])) < 1e-22


@settings(max_examples=50)
@given(w=motions, common=motions, seed=st.integers(0, 99))
def test_motions_count_from_the_handle_that_is_fixed(
    w: FloatArray, common: FloatArray, seed: int
) -> None:
    """Everything moves rigidly, also the new first handle; the common motion is undone."""
    new = PROBLEM.with_handles(HANDLES.replacing("foot", KNEE))
    x = following(new, w, seed=seed)
    there = (x.reshape(-1, 3) @ rotation_matrix(common[:3]).T + common[3:6]).reshape(1, -1)
    # the old problem has none of the new one's handles
    other = PROBLEM.with_handles(Handles([X < 0.1, (X > 0.4) & (X < 0.6)]))
    result = carry_over(given_shapes(other, np.zeros((1, 6)), there), new)
    np.testing.assert_allclose(result.parameters[0], w, rtol=0, atol=1e-12)
    np.testing.assert_allclose(result.shapes[0], x, rtol=0, atol=1e-12)


def test_the_same_handles_keep_every_bit(old: Snapshots) -> None:
    """They are the same solutions under other names and in another box."""
    renamed = Handles([handle.vertices for handle in HANDLES], names=["a", "b", "c"])
    box = HandleBox(translation=0.1, angle=0.1)
    for new in (PROBLEM, PROBLEM.with_handles(renamed, domain=box)):
        result = carry_over(old, new)
        assert result.problem is new
        np.testing.assert_array_equal(result.parameters, old.parameters)
        assert_same_bits(result, old)


def test_an_added_handle_leaves_shapes_and_other_motions_as_they_are(old: Snapshots) -> None:
    new = PROBLEM.with_handles(HANDLES.adding("knee", KNEE))
    result = carry_over(old, new)
    np.testing.assert_array_equal(result.parameters[:, :12], old.parameters)
    np.testing.assert_array_equal(result.shapes, old.shapes)


def test_a_removed_handle_leaves_the_motions_of_the_others(old: Snapshots) -> None:
    result = carry_over(old, PROBLEM.with_handles(HANDLES.without("head")))
    np.testing.assert_array_equal(result.parameters, old.parameters[:, 6:])
    np.testing.assert_array_equal(result.shapes, old.shapes)


def test_no_motion_nearby_fits_better(old: Snapshots) -> None:
    """The shapes' ends are bent, so nothing fits exactly."""
    new = PROBLEM.with_handles(Handles([X < 0.3, X > 0.6]))
    result = carry_over(old, new)
    rng = np.random.default_rng(0)
    for w, x in zip(result.parameters, result.shapes, strict=True):
        best = new.value_and_gradient(x, w)[0]
        for _ in range(20):
            other = new.value_and_gradient(x, w + 1e-3 * rng.normal(size=w.size))[0]
            assert other > best


@pytest.mark.parametrize("name", ["head", "belly"])
def test_fixing_another_handle_moves_solutions_rigidly(old: Snapshots, name: str) -> None:
    """Shape, objective and gradient are those of the old solution in another frame."""
    new = PROBLEM.with_handles(HANDLES.fixing(name))
    result = carry_over(old, new)
    assert list(result.reports) == list(old.reports)
    mass = PROBLEM.mass()
    for w, x, before, report in zip(
        result.parameters, result.shapes, old.shapes, old.reports, strict=True
    ):
        assert np.abs(x - before).max() > 0.1
        back = rigid_registration(x, before, mass).apply(x)
        np.testing.assert_allclose(back, before, rtol=0, atol=1e-12)
        elastic = PROBLEM.energy.value(before)
        assert new.energy.value(x) == pytest.approx(elastic, rel=1e-10)
        value, gradient = new.value_and_gradient(x, w)
        assert value == pytest.approx(report.value, rel=1e-10)
        assert np.linalg.norm(gradient) == pytest.approx(report.gradient_norm, rel=1e-5, abs=1e-9)


def test_carrying_there_and_back_changes_nothing(old: Snapshots) -> None:
    there = carry_over(old, PROBLEM.with_handles(HANDLES.fixing("belly")))
    back = carry_over(there, PROBLEM)
    np.testing.assert_allclose(back.parameters, old.parameters, rtol=0, atol=1e-12)
    np.testing.assert_allclose(back.shapes, old.shapes, rtol=0, atol=1e-12)


def test_a_fitted_handle_is_off_by_its_softness() -> None:
    """Springs hold a handle: forces displace it by force / (2 stiffness mass)."""
    misses = []
    for stiffness in (1e3, 1e4):
        problem = bar_problem(stiffness=stiffness)
        snapshots = solved(problem, 4)
        # one vertex fewer: it is not the old handle, and its motion must be found
        tip = HANDLES["head"].vertices[1:]
        result = carry_over(snapshots, problem.with_handles(HANDLES.replacing("head", tip)))
        # the centroid differs: compare where the motions take the vertices
        both = [
            one.problem.target_displacements(one.problem.offsets(w))[
                np.isin(one.problem.pinned, tip)
            ]
            for one in (snapshots, result)
            for w in one.parameters
        ]
        misses.append(np.abs(np.array(both[:4]) - both[4:]).max())
    assert misses[0] < 0.05
    assert 8 < misses[0] / misses[1] < 12


def test_a_point_has_no_rotation(old: Snapshots) -> None:
    vertex = int(np.flatnonzero(KNEE)[0])
    result = carry_over(old, PROBLEM.with_handles(HANDLES.adding("point", [vertex])))
    moved = old.shapes.reshape(len(old), -1, 3)[:, vertex] - MESH.vertices[vertex]
    np.testing.assert_allclose(result.parameters[:, 12:15], moved, rtol=0, atol=1e-14)
    assert not result.parameters[:, 15:].any()


def test_a_line_takes_the_smallest_rotation(old: Snapshots) -> None:
    """It rotates by the angle between the line before and after."""
    pair = np.flatnonzero(KNEE)[[0, -1]]
    result = carry_over(old, PROBLEM.with_handles(HANDLES.adding("line", pair)))
    before = np.subtract(*MESH.vertices[pair])
    for w, x in zip(result.parameters, result.shapes, strict=True):
        after = np.subtract(*x.reshape(-1, 3)[pair])
        cosine = before @ after / (np.linalg.norm(before) * np.linalg.norm(after))
        rotation = rotation_matrix(w[15:])
        assert (np.trace(rotation) - 1) / 2 == pytest.approx(cosine, abs=1e-12)
        turned = rotation @ before
        np.testing.assert_allclose(np.cross(turned, after), 0, rtol=0, atol=1e-12)


def test_reports_claim_no_solve(old: Snapshots) -> None:
    result = carry_over(old, PROBLEM.with_handles(HANDLES.adding("knee", KNEE)))
    assert not result.converged.any() and result.usable.all()
    assert set(result.reports) == {SampleReport("carried", 0, 0, 0.0, 0.0, 0.0, 0.0, 0)}


def test_an_added_handle_exerts_little_force() -> None:
    """Its target is its position, up to the bending of its region."""
    problem = PROBLEM.with_handles(HANDLES.without("belly"))
    knee = np.flatnonzero(KNEE)[:12]
    new = problem.with_handles(problem.handles.adding("knee", knee))
    result = carry_over(solved(problem), new)
    iterations = []
    for starts in (result.shapes - new.base, np.zeros_like(result.shapes)):
        batch = core_solve(
            new,
            "fast",
            new.inputs(result.parameters),
            np.ascontiguousarray(starts),
            tolerance=1e-5,
            max_iterations=500,
        )
        iterations.append(sum(report.iterations for report in batch.reports))
    assert iterations[0] < 0.7 * iterations[1], iterations


def test_with_another_material_solutions_become_starts(old: Snapshots) -> None:
    soft = PosingProblem(MESH, HANDLES, domain=PROBLEM.domain, material=StVK(lam=0.0, mu=1.0))
    result = carry_over(old, soft)
    np.testing.assert_array_equal(result.parameters, old.parameters)
    assert {report.status for report in result.reports} == {"carried"}
    np.testing.assert_array_equal(result.shapes, old.shapes)


def failing(snapshots: Snapshots, *failed: int) -> Snapshots:
    reports = list(snapshots.reports)
    for i in failed:
        reports[i] = replace(reports[i], status="max_iterations")
    return Snapshots.from_shapes(snapshots.problem, snapshots.parameters, snapshots.shapes, reports)


def test_snapshots_that_did_not_converge_are_left_out(old: Snapshots) -> None:
    new = PROBLEM.with_handles(HANDLES.without("belly"))
    result = carry_over(failing(old, 1, 3), new)
    np.testing.assert_array_equal(result.shapes, old.shapes[[0, 2, 4]])
    twice = carry_over(result, PROBLEM)
    assert [report.status for report in twice.reports] == ["carried"] * 3


OTHER_MESH = bar_problem(irregular_bar(8, 2, 2, seed=6))


@pytest.mark.parametrize(
    ("changes", "new", "message"),
    [
        (
            {},
            OTHER_MESH,
            r"on another mesh, TetMesh\(.*\); make it with snapshots.problem.with_handles",
        ),
        (
            {},
            interpolation_problem(),
            "the problem is an InterpolationProblem, but only a PosingProblem has handles",
        ),
        (
            {"problem": interpolation_problem()},
            PROBLEM,
            "the problem of the snapshots is an InterpolationProblem, but only a PosingProblem",
        ),
        ({"reports": "failed"}, PROBLEM, "none of the 5 snapshots converged; allow more iter"),
    ],
)
def test_snapshots_that_cannot_be_carried_are_refused(
    old: Snapshots, changes: dict[str, Any], new: Any, message: str
) -> None:
    if "reports" in changes:
        changes = {"reports": failing(old, *range(5)).reports}
    with pytest.raises(ValueError, match=f"carry_over: .*{message}") as caught:
        carry_over(replace(old, **changes), new)
    assert "\n" not in str(caught.value)
