"""Bases of snapshots in files: the same bits, from blocks and with known products."""

from __future__ import annotations

import re
import tracemalloc
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from snapspace import (
    AffineSubspace,
    Checkpoint,
    DisplacementRows,
    SnapshotGram,
    Snapshots,
    pca,
    sample,
    snapshot_pca,
    solve_snapshots,
)
from snapspace.problem import Problem

from ..shapes import interpolation_problem
from ..snapshots.bars import parameters, posing_bar
from ..snapshots.samples import displacements, report

FloatArray = NDArray[np.float64]


@pytest.fixture(scope="module", params=["posing", "interpolation"])
def snapshots(request: pytest.FixtureRequest) -> Snapshots:
    if request.param == "posing":
        problem = posing_bar()
        return solve_snapshots(problem, parameters(problem, 20), threads=1)
    poses = interpolation_problem()
    return solve_snapshots(poses, sample(poses.domain, 20, seed=1), threads=1)


def stored(snapshots: Snapshots, folder: Path) -> Snapshots:
    """The same snapshots, with displacements mapped from two files."""
    checkpoint = Checkpoint(folder)
    rows, half = snapshots.displacements, len(snapshots) // 2
    mapped = checkpoint.save(range(half), rows[:half], snapshots.reports[:half])
    mapped += checkpoint.save(range(half, len(rows)), rows[half:], snapshots.reports[half:])
    return replace(snapshots, displacements=DisplacementRows(mapped, rows.size))


def grown(snapshots: Snapshots, *, lumped: bool = False) -> SnapshotGram:
    """The Gram matrix, built block by block as while samples are solved."""
    gram = SnapshotGram.of(snapshots.problem, lumped=lumped)
    for begin in range(0, len(snapshots), 8):
        gram.add(snapshots.displacements[begin : begin + 8])
    return gram


def assert_same_bits(a: AffineSubspace, b: AffineSubspace) -> None:
    np.testing.assert_array_equal(a.basis, b.basis)
    np.testing.assert_array_equal(a.snapshot_energies, b.snapshot_energies)


@pytest.mark.parametrize("lumped", [False, True])
def test_files_known_products_and_threads_do_not_change_a_bit(
    snapshots: Snapshots, tmp_path: Path, lumped: bool
) -> None:
    basis = snapshot_pca(snapshots, dimension=8, lumped=lumped)
    there = stored(snapshots, tmp_path)
    assert_same_bits(snapshot_pca(there, dimension=8, lumped=lumped), basis)
    gram = grown(there, lumped=lumped)
    assert_same_bits(snapshot_pca(there, dimension=8, lumped=lumped, gram=gram), basis)
    assert len(gram) == 20, "the poses must not be added to the caller's matrix"
    with threadpool_limits(limits=2, user_api="blas"):
        assert_same_bits(snapshot_pca(there, dimension=8, lumped=lumped), basis)


def test_known_products_of_all_serve_the_converged_ones(snapshots: Snapshots) -> None:
    reports = list(snapshots.reports)
    for i in (2, 9, 17):
        reports[i] = replace(reports[i], status="max_iterations")
    failing = replace(snapshots, reports=reports)
    basis = snapshot_pca(failing, dimension=6)
    again = snapshot_pca(failing, dimension=6, gram=grown(failing))
    np.testing.assert_allclose(again.basis, basis.basis, rtol=0, atol=1e-9)
    np.testing.assert_allclose(again.snapshot_energies, basis.snapshot_energies, atol=1e-14)


def test_row_coordinates_are_the_coordinates(snapshots: Snapshots, tmp_path: Path) -> None:
    subspace = snapshot_pca(snapshots, dimension=8)
    offset = snapshots.problem.base - subspace.tau
    rows = stored(snapshots, tmp_path).displacements.shifted(offset)
    np.testing.assert_allclose(
        subspace.row_coordinates(rows),
        subspace.coordinates(snapshots.shapes),
        rtol=0,
        atol=1e-12,
    )


def test_several_shapes_are_those_of_each_and_do_not_depend_on_the_others(
    snapshots: Snapshots,
) -> None:
    subspace = snapshot_pca(snapshots, dimension=8)
    coordinates = np.random.default_rng(0).standard_normal((7, 8))
    shapes = subspace.shapes(coordinates)
    each = [subspace.shape(q) for q in coordinates]
    np.testing.assert_allclose(shapes, each, rtol=0, atol=1e-13 * np.abs(shapes).max())
    np.testing.assert_array_equal(subspace.shapes(coordinates[4:5])[0], shapes[4])


def test_memory_does_not_grow_with_the_samples(tmp_path: Path) -> None:
    """200 samples take 46 MB; only blocks and small matrices grow with their number."""
    problem = posing_bar(32, 16, 16)
    few, many = (peak_memory(problem, count, tmp_path / str(count)) for count in (50, 200))
    added_rows = 150 * problem.base.nbytes
    assert many - few < 0.3 * added_rows


def peak_memory(problem: Problem, count: int, folder: Path) -> int:
    """Largest number of bytes in arrays while `snapshot_pca` works on stored samples."""
    reports = [report(i) for i in range(count)]
    mapped: list[FloatArray] = []
    for begin in range(0, count, 25):
        rows = displacements(25, problem.base.size, seed=begin)
        indices = range(begin, begin + 25)
        mapped += Checkpoint(folder).save(indices, rows, reports[begin : begin + 25])
    w = np.zeros((count, problem.parameter_count))
    snapshots = Snapshots(problem, w, DisplacementRows(mapped, problem.base.size), reports)
    tracemalloc.start()
    try:
        snapshot_pca(snapshots, dimension=5)
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_products_of_other_snapshots_are_refused(snapshots: Snapshots) -> None:
    gram = SnapshotGram.of(snapshots.problem)
    gram.add(snapshots.displacements[:7])
    with pytest.raises(ValueError, match="the Gram matrix has 7 snapshots, but there are 20"):
        snapshot_pca(snapshots, dimension=3, gram=gram)
    gram.add(snapshots.displacements[7:])
    message = "snapshot_pca: the Gram matrix has another mass matrix; make it with SnapshotGram.of"
    with pytest.raises(ValueError, match=re.escape(message)):
        snapshot_pca(snapshots, dimension=3, lumped=True, gram=gram)


def test_pca_takes_known_products_of_any_shapes(snapshots: Snapshots) -> None:
    tau, mass = snapshots.problem.tau, snapshots.problem.mass()
    shapes = snapshots.shapes
    gram = SnapshotGram(mass, offset=-tau)
    gram.add(shapes)
    known = pca(shapes, tau, mass, dimension=5, gram=gram.matrix)
    assert_same_bits(known, pca(shapes, tau, mass, dimension=5))
    with pytest.raises(
        ValueError, match=re.escape("has shape (4, 4), but 20 shapes need (20, 20)")
    ):
        pca(shapes, tau, mass, dimension=5, gram=np.eye(4))
