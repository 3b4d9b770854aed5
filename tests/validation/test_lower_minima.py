"""Full solutions that are not the lowest minima: a strut may buckle to either side."""

from __future__ import annotations

import numpy as np
import pytest

import snapspace as ss
from snapspace.generators import bar
from snapspace.validation import other_minima, solved_reference, validate, with_lower_minima


@pytest.fixture(scope="module")
def strut() -> ss.PosingModel:
    """A slender bar held at both ends; one end moves towards the other and rotates."""
    mesh = bar(20, 2, 2, length=8.0, width=0.5, height=0.5)
    x = mesh.vertices[:, 0]
    handles = ss.Handles([np.flatnonzero(x < 0.5), np.flatnonzero(x > 7.5)])
    box = ss.HandleBox(translation=(1.0, 0.1, 0.1), angle=(0.01, 0.3, 0.01))
    problem = ss.PosingProblem(mesh, handles, domain=box)
    snapshots = ss.solve_snapshots(problem, ss.sample(problem.domain, 60), threads=1)
    subspace = ss.snapshot_pca(snapshots, dimension=30)
    return ss.reduce(problem, subspace, snapshots=snapshots, threads=1)


#: A slight rotation decides to which side the strut buckles; the other side is a minimum too.
TURN = -0.02


def buckled(strut: ss.PosingModel, turn: float, start: ss.Snapshots | None = None) -> ss.Snapshots:
    """The strut shortened by a tenth with its end rotated by `turn`, solved from a known shape."""
    w = np.array([[-0.8, 0.0, 0.0, 0.0, turn, 0.0]])
    if start is not None:
        start = ss.Snapshots.from_shapes(strut.problem, w, start.shapes, start.reports)
    options = ss.SolverOptions(tolerance=1e-10, max_iterations=5000)
    return ss.solve_snapshots(strut.problem, w, options=options, known=start, threads=1)


def test_a_frame_leads_to_the_lower_of_two_minima(strut: ss.PosingModel) -> None:
    lowest = buckled(strut, TURN)
    other = buckled(strut, TURN, start=buckled(strut, -TURN))
    assert lowest.reports[0].value < 0.98 * other.reports[0].value
    elsewhere = solved_reference(strut.problem, samples=1, threads=1)
    reference, lower = with_lower_minima(strut, elsewhere.joined(other), threads=1)
    assert lower == 1
    np.testing.assert_array_equal(reference.displacements[0], elsewhere.displacements[0])
    assert reference.reports[1].value == pytest.approx(lowest.reports[0].value, rel=1e-6)
    size = np.abs(lowest.displacements[0]).max()
    np.testing.assert_allclose(
        reference.displacements[1], lowest.displacements[0], atol=1e-3 * size
    )


def test_lowest_minima_stay_as_they_are(strut: ss.PosingModel) -> None:
    lowest = buckled(strut, TURN)
    reference, lower = with_lower_minima(strut, lowest, threads=1)
    assert reference is lowest and lower == 0


def test_a_validation_compares_with_the_lowest(strut: ss.PosingModel) -> None:
    """Its reference holds the lowest minima, and a validation by that reference agrees."""
    first = validate(strut, samples=6, threads=1)
    again = validate(strut, reference=first.reference)
    np.testing.assert_array_equal(first.error, again.error)
    assert with_lower_minima(strut, first.reference, threads=1) == (first.reference, 0)


def test_another_minimum_is_no_error_of_the_cubature(strut: ss.PosingModel) -> None:
    """From the full solution the reduced solve stays beside it; the frame is at the other side."""
    other = buckled(strut, TURN, start=buckled(strut, -TURN))
    split = ss.split_errors(strut, other, threads=1)
    assert split.error[0] > 0.5 and split.minimum[0] > 0.5
    assert split.cubature[0] < 0.1 and split.error_of_all_tets[0] < 0.1
    assert split.largest == "minimum" and split.largest_built != "minimum"
    assert ss.next_option(strut, split).part == split.largest_built
    lowest = buckled(strut, TURN)
    assert ss.split_errors(strut, lowest, threads=1).minimum[0] == 0.0
    assert other_minima(strut, other, [0]).tolist() == [True]
    assert other_minima(strut, lowest, [0]).tolist() == [False]
    assert other_minima(strut, lowest, []).tolist() == []
