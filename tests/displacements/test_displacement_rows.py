"""DisplacementRows acts as the matrix of its rows, wherever they are stored."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import Checkpoint, DisplacementRows, Snapshots, solve_snapshots
from snapspace.displacements import BLOCK

from ..snapshots.bars import parameters, posing_bar
from ..snapshots.samples import displacements, report

FloatArray = NDArray[np.float64]
SIZE = BLOCK + 300  # two blocks
MATRIX = displacements(7, SIZE)


def apart(_: Path) -> list[FloatArray]:
    return [row.copy() for row in MATRIX]


def together(_: Path) -> FloatArray:
    return MATRIX.copy()


def part_of_wider_ones(_: Path) -> FloatArray:
    return np.hstack([MATRIX, MATRIX])[:, :SIZE]


def mapped(folder: Path) -> list[FloatArray]:
    checkpoint = Checkpoint(folder / "run")
    first = checkpoint.save(range(4), MATRIX[:4], [report(i) for i in range(4)])
    return first + checkpoint.save(range(4, 7), MATRIX[4:], [report(i) for i in range(4, 7)])


def first_block(rows: DisplacementRows) -> FloatArray:
    return next(iter(rows.blocks()))[1]


@pytest.mark.parametrize("store", [apart, together, part_of_wider_ones, mapped])
def test_rows_blocks_and_selections(store: Callable[[Path], FloatArray], tmp_path: Path) -> None:
    rows = DisplacementRows(store(tmp_path), SIZE)
    offset = np.arange(float(SIZE))
    mask = np.array([True, False, True, True, False, False, True])
    cases = [
        (rows, MATRIX),
        (rows.shifted(offset), MATRIX + offset),
        (rows.shifted(offset).shifted(-offset), MATRIX),
        (rows[2:6], MATRIX[2:6]),
        (rows[::-2], MATRIX[::-2]),
        (rows.select(mask), MATRIX[mask]),
        (rows.select([5, 0, 5]), MATRIX[[5, 0, 5]]),
        (rows.shifted(offset).select(mask)[1:], MATRIX[mask][1:] + offset),
        (rows[:0], MATRIX[:0]),
        (rows[:2].followed_by(rows[5:]), MATRIX[[0, 1, 5, 6]]),
        (rows.shifted(offset).followed_by(rows), np.vstack([MATRIX, MATRIX]) + offset),
    ]
    for chosen, expected in cases:
        assert len(chosen) == len(expected)
        np.testing.assert_array_equal(chosen.array(), expected)
        for columns, block in chosen.blocks():
            np.testing.assert_array_equal(block, expected[:, columns])
        np.testing.assert_array_equal(np.reshape(list(chosen), (-1, SIZE)), expected)
        assert sum(columns.stop - columns.start for columns, _ in chosen.blocks()) == SIZE


def test_rows_side_by_side_are_not_copied(tmp_path: Path) -> None:
    """A block of one file, or of a solver's result, is a view; rows of two files are copied."""
    matrix = MATRIX.copy()
    for rows in (DisplacementRows(matrix, SIZE), DisplacementRows(list(matrix), SIZE)):
        assert np.shares_memory(first_block(rows[2:5]), matrix[2:5])
    files = DisplacementRows(mapped(tmp_path), SIZE)
    assert np.shares_memory(first_block(files[1:4]), files[2])
    assert not np.shares_memory(first_block(files[3:5]), files[3])


def test_nothing_can_be_written_to(tmp_path: Path) -> None:
    for rows in (DisplacementRows(MATRIX, SIZE), DisplacementRows(apart(tmp_path), SIZE)):
        for array in (rows[0], first_block(rows), first_block(rows.shifted(MATRIX[0]))):
            with pytest.raises(ValueError, match="read-only"):
                array[...] = 0.0
    assert MATRIX.flags.writeable, "the arrays of the caller stay as they were"


@pytest.mark.parametrize(
    ("row", "message"),
    [
        (np.zeros(5), "row 1 is float64 of shape (5,), but must be a contiguous float64 array of"),
        (np.zeros(6, np.float32), "row 1 is float32 of shape (6,), but must be"),
        (np.zeros((6, 1)), "row 1 is float64 of shape (6, 1), but must be"),
        (np.zeros(12)[::2], "row 1 is float64 of shape (6,), but must be a contiguous"),
    ],
)
def test_arrays_that_are_not_rows_are_refused(row: FloatArray, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        DisplacementRows([np.zeros(6), row], 6)


def test_shifted_rows_cannot_be_appended() -> None:
    rows = DisplacementRows(np.ones((2, 6)), 6)
    with pytest.raises(ValueError, match="append first, then shift"):
        rows.followed_by(rows.shifted(np.ones(6)))


@pytest.fixture(scope="module")
def snapshots() -> Snapshots:
    problem = posing_bar()
    return solve_snapshots(problem, parameters(problem, 4), threads=1)


def test_snapshots_convert_to_shapes_and_back(snapshots: Snapshots) -> None:
    base = snapshots.problem.base
    assert snapshots.shapes.shape == (4, base.size)
    assert snapshots.shapes.flags.c_contiguous
    np.testing.assert_array_equal(snapshots.shapes[2], base + snapshots.displacements[2])
    again = Snapshots.from_shapes(
        snapshots.problem, snapshots.parameters, snapshots.shapes, snapshots.reports
    )
    np.testing.assert_allclose(
        again.displacements.array(), snapshots.displacements.array(), rtol=0, atol=1e-15
    )


def test_selecting_copies_no_shape(snapshots: Snapshots) -> None:
    some = snapshots.select(np.array([True, False, False, True]))
    assert np.shares_memory(some.displacements[1], snapshots.displacements[3])
    np.testing.assert_array_equal(some.shapes, snapshots.shapes[[0, 3]])
    assert some.reports == [snapshots.reports[0], snapshots.reports[3]]
    assert len(some.select(np.zeros(2, bool))) == 0


def test_snapshots_that_do_not_fit_are_refused(snapshots: Snapshots) -> None:
    problem, w, reports = snapshots.problem, snapshots.parameters, snapshots.reports
    rows = snapshots.displacements
    with pytest.raises(ValueError, match="are a ndarray, but must be DisplacementRows"):
        Snapshots(problem, w, snapshots.shapes, reports)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="displacements have 6 coordinates, but the problem's"):
        Snapshots(problem, w, DisplacementRows(np.zeros((4, 6)), 6), reports)
    with pytest.raises(ValueError, match="got 4 parameter vectors, 3 displacements and 4 reports"):
        Snapshots(problem, w, rows[:3], reports)
    with pytest.raises(ValueError, match="4 displacements and 0 reports, but each sample needs"):
        Snapshots(problem, w, rows, [])
    with pytest.raises(ValueError, match=r"from_shapes: .* one shape per row; .*: shapes\.T"):
        Snapshots.from_shapes(problem, w, snapshots.shapes.T, reports)
