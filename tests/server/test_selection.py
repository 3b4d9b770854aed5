"""Handles chosen in a page become a problem, and handles of a problem are shown."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from snapspace import HandleBox, PosingProblem, StVK, sample, solve_snapshots
from snapspace.server.messages import Choose, HandleChoice
from snapspace.server.selection import choices_of, selection_of
from snapspace.server.solved_samples import SolvedSamples

from ..shapes import bar_problem

PROBLEM = bar_problem()
FOOT, HEAD, BELLY = ([*map(int, handle.vertices)] for handle in PROBLEM.handles)


def choice(*handles: HandleChoice) -> Choose:
    return Choose(request=1, handles=handles, translation=(1.0, 1.0, 1.0), angle=(0.5, 0.5, 0.5))


def handle(name: str, vertices: list[int], **more: Any) -> HandleChoice:
    return HandleChoice(name=name, vertices=tuple(vertices), **more)


def chosen_problem(*handles: HandleChoice, known: PosingProblem | None = None) -> PosingProblem:
    selection = selection_of(choice(*handles))
    return selection.problem(PROBLEM.mesh, material=StVK(), stiffness=100.0, known=known)


def test_fixed_handles_come_first_and_are_held_in_all_samples() -> None:
    problem = chosen_problem(
        handle("head", HEAD),
        handle("foot", FOOT, moving=False),
        handle("belly", BELLY, moving=False, translation=(9.0, 9.0, 9.0)),
    )
    assert problem.handles.names == ("foot", "belly", "head")
    motions = sample(problem.domain, 8).reshape(8, 2, 6)
    assert not motions[:, 0].any() and motions[:, 1].all()


def test_bounds_of_a_handle_replace_the_common_ones() -> None:
    problem = chosen_problem(
        handle("foot", FOOT, moving=False),
        handle("head", HEAD, translation=(0.0, 0.0, 2.0)),
        handle("belly", BELLY, angle=(0.1, 0.0, 0.0)),
    )
    assert problem.domain.bounds.tolist() == [
        [0, 0, 2, 0.5, 0.5, 0.5],
        [1, 1, 1, 0.1, 0, 0],
    ]


def test_equal_bounds_become_common_bounds() -> None:
    problem = chosen_problem(
        handle("foot", FOOT, moving=False),
        handle("head", HEAD, translation=(1.0, 1.0, 1.0)),
        handle("belly", BELLY),
    )
    assert problem.domain.common is problem.domain


@pytest.mark.parametrize(
    "box",
    [
        HandleBox(translation=(1.0, 0.0, 2.0), angle=0.5),
        HandleBox(translation=[(1.0, 0.0, 2.0), (0.0, 0.0, 0.0)], angle=[(1, 0, 0)] * 2, moving=2),
        HandleBox(
            translation=[(0.0, 0.0, 0.0), (0.0, 0.0, 1.0)], angle=np.eye(3)[1:] * 0, moving=2
        ),
    ],
)
def test_a_problem_shown_and_chosen_again_has_the_same_handles(box: HandleBox) -> None:
    problem = PROBLEM.with_handles(PROBLEM.handles, domain=box)
    bounds = problem.domain.common.bounds[0].tolist()
    again = selection_of(
        Choose(
            request=1,
            handles=choices_of(problem),
            translation=tuple(bounds[:3]),
            angle=tuple(bounds[3:]),
        )
    )
    made = again.problem(problem.mesh, material=problem.material, stiffness=100.0, known=None)
    order = [problem.handles.index(name) for name in made.handles.names]
    all_bounds = np.vstack([np.zeros(6), problem.domain.bounds])
    np.testing.assert_array_equal(made.domain.bounds, all_bounds[order][1:])
    for name in made.handles.names:
        assert made.handles[name].vertices.tolist() == problem.handles[name].vertices.tolist()


@pytest.mark.parametrize(
    ("handles", "message"),
    [
        ([], "no handles are chosen"),
        ([handle("a", FOOT), handle("b", HEAD)], "no handle is fixed.*mark one as fixed"),
        ([handle("a", FOOT, moving=False)], "no handle moves.*mark one as moving"),
        (
            [
                handle("a", FOOT, moving=False),
                handle("b", HEAD, translation=(0.0, 0.0, 0.0), angle=(0.0, 0.0, 0.0)),
                handle("c", BELLY),
            ],
            "'b' moves, but its ranges are all zero",
        ),
        ([handle("a", FOOT, moving=False), handle("a", HEAD)], "the name 'a' is used twice"),
        ([handle("a", FOOT, moving=False), handle("b", FOOT[:2])], "overlap in 2 vertices"),
        ([handle("a", FOOT, moving=False), handle("b", [10**8])], "but the mesh has 81 vertices"),
        ([handle("a", FOOT, moving=False), handle("b", [10**30])], "must be a list of vertex"),
        ([handle("a", FOOT, moving=False), handle("b", [])], "'b' has no vertices"),
        ([handle("a", [0], moving=False), handle("b", [1])], "lie on one line"),
    ],
)
def test_choices_that_make_no_problem_are_refused(
    handles: list[HandleChoice], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        chosen_problem(*handles)


def test_the_same_choice_is_the_same_problem_and_others_share_its_energy() -> None:
    chosen = handle("foot", FOOT, moving=False), handle("head", HEAD)
    first = chosen_problem(*chosen)
    assert chosen_problem(*chosen, known=first) is first
    other = chosen_problem(*chosen, handle("belly", BELLY), known=first)
    assert other is not first and other.energy is first.energy
    stiff = selection_of(choice(*chosen))
    changed = stiff.problem(PROBLEM.mesh, material=StVK(), stiffness=200.0, known=first)
    assert changed.stiffness == 200.0


def test_solved_samples_serve_the_same_handles_only() -> None:
    two = chosen_problem(handle("foot", FOOT, moving=False), handle("head", HEAD))
    three = chosen_problem(
        handle("foot", FOOT, moving=False), handle("head", HEAD), handle("belly", BELLY)
    )
    known = SolvedSamples()
    assert known.starts(two) is None
    snapshots = solve_snapshots(two, sample(two.domain, 6), threads=1)
    known.add(snapshots)
    assert known.starts(two) is snapshots
    assert known.starts(three) is None, "for other handles a model is a better start than samples"


def test_the_newest_sample_at_the_same_parameters_is_kept() -> None:
    two = chosen_problem(handle("foot", FOOT, moving=False), handle("head", HEAD))
    wanted = sample(two.domain, 6)
    known = SolvedSamples()
    first = solve_snapshots(two, wanted, threads=1)
    known.add(first)
    newer = replace(
        first.select(np.arange(6) < 3),
        reports=[replace(r, iterations=-1) for r in first.reports[:3]],
    )
    known.add(newer)
    kept = known.starts(two)
    assert kept is not None and len(kept) == 6
    assert sorted(report.iterations == -1 for report in kept.reports) == [False] * 3 + [True] * 3
