"""A model learns from snapshots of its own problem only."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from snapspace import (
    HandleBox,
    Handles,
    InterpolationModel,
    InterpolationProblem,
    PosingProblem,
    Snapshots,
    StableNeoHookean,
    carry_over,
    reduce,
    sample,
    snapshot_pca,
    solve_snapshots,
)

Change = Callable[[PosingProblem], PosingProblem]


def swapped(problem: PosingProblem) -> PosingProblem:
    """The handle that was moved is fixed, and the parameters mean other motions."""
    first, *others = problem.handles
    order = Handles([others[0].vertices, first.vertices, others[1].vertices])
    return problem.with_handles(order, domain=problem.domain)


CHANGES: dict[str, Change] = {
    "handles in another order": swapped,
    "fewer handles": lambda one: one.with_handles(one.handles.without("belly")),
    "another material": lambda one: PosingProblem(
        one.mesh, one.handles, domain=one.domain, material=StableNeoHookean(mu=5.0)
    ),
    "another domain": lambda one: PosingProblem(
        one.mesh, one.handles, domain=HandleBox(translation=9.0, angle=0.1), material=one.material
    ),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_snapshots_of_another_problem_are_refused(
    posing_snapshots: Snapshots, change: Change
) -> None:
    other, subspace = change(posing_snapshots.problem), snapshot_pca(posing_snapshots, dimension=9)
    with pytest.raises(ValueError, match="reduce: the snapshots are of another problem; `carry_ov"):
        reduce(other, subspace, energy="cubature", snapshots=posing_snapshots)
    carried = carry_over(posing_snapshots, other)
    model = reduce(other, subspace, energy="cubature", snapshots=carried)
    assert len(model.training_parameters) == len(carried)


def test_blends_of_other_poses_are_solved_again(blending_model: InterpolationModel) -> None:
    problem, subspace = blending_model.problem, blending_model.subspace
    other = InterpolationProblem(problem.poses, material=StableNeoHookean(mu=5.0))
    snapshots = solve_snapshots(other, sample(other.domain, 3), threads=1)
    with pytest.raises(ValueError, match="are of another problem; solve samples of this one"):
        reduce(problem, subspace, snapshots=snapshots)
