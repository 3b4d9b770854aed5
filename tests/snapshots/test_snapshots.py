"""Collections of samples: which of them count, and samples of several runs together."""

from __future__ import annotations

import re

import numpy as np
import pytest
from numpy.typing import ArrayLike

from snapspace import Snapshots, carry_over, snapshot_pca, solve_snapshots

from ..shapes import bar_problem
from .bars import parameters

PROBLEM = bar_problem()
SMALLER = PROBLEM.with_handles(PROBLEM.handles.without("belly"))


@pytest.fixture(scope="module")
def fresh() -> Snapshots:
    return solve_snapshots(PROBLEM, parameters(PROBLEM, 4), threads=1)


@pytest.fixture(scope="module")
def from_before() -> Snapshots:
    before = solve_snapshots(SMALLER, parameters(SMALLER, 3), threads=1)
    return carry_over(before, PROBLEM)


def test_joined_snapshots_have_the_samples_of_both_in_order(
    fresh: Snapshots, from_before: Snapshots
) -> None:
    both = fresh.joined(from_before)
    assert len(both) == 7 and both.problem is PROBLEM
    for part, samples in ((fresh, np.arange(7) < 4), (from_before, np.arange(7) >= 4)):
        chosen = both.select(samples)
        np.testing.assert_array_equal(chosen.parameters, part.parameters)
        np.testing.assert_array_equal(chosen.shapes, part.shapes)
        assert chosen.reports == list(part.reports)


def test_samples_are_selected_by_number_in_the_given_order(fresh: Snapshots) -> None:
    order = [3, 0, 2, 1]  # as many as there are samples: a mask of ones and a zero drops one
    chosen = fresh.select(order)
    np.testing.assert_array_equal(chosen.parameters, fresh.parameters[order])
    np.testing.assert_array_equal(chosen.shapes, fresh.shapes[order])
    assert chosen.reports == [fresh.reports[sample] for sample in order]
    np.testing.assert_array_equal(fresh.select(range(2)).shapes, fresh.shapes[:2])
    assert len(fresh.select([])) == 0


@pytest.mark.parametrize(
    ("which", "reason"),
    [
        (np.ones(3, bool), "Snapshots.select: the mask has 3 entries, but there are 4"),
        ([0, 4], "Snapshots.select: 4 is not between 0 and 3"),
        ([-1], "Snapshots.select: -1 is not between 0 and 3"),
        ([0.0, 1.0], "needs a boolean mask (4,) or whole numbers (c,), got float64 of shape (2,)"),
        (2, "of shape ()"),
    ],
)
def test_a_selection_that_is_no_mask_and_no_numbers_is_refused(
    fresh: Snapshots, which: ArrayLike, reason: str
) -> None:
    with pytest.raises(ValueError, match=re.escape(reason)):
        fresh.select(which)


def test_samples_of_another_problem_are_not_joined(fresh: Snapshots) -> None:
    before = solve_snapshots(SMALLER, parameters(SMALLER, 2), threads=1)
    with pytest.raises(ValueError, match="joined: the others are of another problem") as caught:
        fresh.joined(before)
    assert "`carry_over` brings them to the handles" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_carried_snapshots_are_usable_but_not_converged(
    fresh: Snapshots, from_before: Snapshots
) -> None:
    both = fresh.joined(from_before)
    assert both.converged.tolist() == [True] * 4 + [False] * 3
    assert both.usable.all()


def test_carried_snapshots_are_part_of_the_basis(fresh: Snapshots, from_before: Snapshots) -> None:
    both = fresh.joined(from_before)
    subspace = snapshot_pca(both, dimension=7)
    again = subspace.tau + subspace.coordinates(both.shapes) @ subspace.basis.T
    np.testing.assert_allclose(again, both.shapes, rtol=0, atol=1e-9)


def test_the_summary_counts_carried_snapshots_separately(
    fresh: Snapshots, from_before: Snapshots
) -> None:
    """They neither failed to converge nor took iterations."""
    both = fresh.joined(from_before)
    mean = np.mean([report.iterations for report in fresh.reports])
    most = max(report.inverted_tets for report in both.reports)
    assert both.summary() == (
        f"4 of 4 samples converged, 3 carried, {mean:.0f} iterations on average, "
        f"at most {most} inverted tets"
    )
    assert from_before.summary() == "3 carried, at most 0 inverted tets"


def test_a_gram_matrix_is_computed_once_and_gives_the_same_basis(
    fresh: Snapshots, from_before: Snapshots
) -> None:
    both = fresh.joined(from_before)
    assert both.gram is None
    known = both.with_gram(threads=1)
    assert known.gram is not None and known.with_gram() is known
    alone, with_it = snapshot_pca(both, dimension=7), snapshot_pca(known, dimension=7)
    np.testing.assert_array_equal(with_it.basis, alone.basis)
