"""The basis of solved snapshots: about rest, from converged ones, with the mesh's mass."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from snapspace import Snapshots, pca, snapshot_pca, solve_snapshots
from snapspace.mesh import mass_gram, mass_matrix
from snapspace.subspace import spanned_dimension

from ..snapshots.bars import parameters, posing_bar


@pytest.fixture(scope="module")
def snapshots() -> Snapshots:
    problem = posing_bar()
    return solve_snapshots(problem, parameters(problem, 10), threads=1)


def with_failures(
    snapshots: Snapshots, failed: list[int], status: str = "max_iterations"
) -> Snapshots:
    reports = [
        replace(report, status=status) if i in failed else report
        for i, report in enumerate(snapshots.reports)
    ]
    return replace(snapshots, reports=reports)


@pytest.mark.parametrize("lumped", [False, True])
def test_is_the_pca_about_rest_with_the_mass_of_the_mesh(
    snapshots: Snapshots, lumped: bool
) -> None:
    mesh = snapshots.problem.mesh
    subspace = snapshot_pca(snapshots, dimension=6, lumped=lumped, handle_weight=0)
    mass = mass_matrix(mesh, lumped=lumped)
    gram = mass_gram(mass, subspace.basis.T, subspace.basis.T)
    np.testing.assert_allclose(gram, np.eye(6), rtol=0, atol=1e-12)
    np.testing.assert_array_equal(subspace.tau, mesh.vertices.reshape(-1))
    same = pca(snapshots.shapes, subspace.tau, mass, dimension=6)
    # displacements are stored; shapes have lost digits to their positions
    np.testing.assert_allclose(subspace.basis, same.basis, rtol=0, atol=1e-9)


def test_all_snapshots_are_in_their_own_span(snapshots: Snapshots) -> None:
    subspace = snapshot_pca(snapshots, dimension=10)
    again = subspace.tau + subspace.coordinates(snapshots.shapes) @ subspace.basis.T
    np.testing.assert_allclose(again, snapshots.shapes, rtol=0, atol=1e-9)


def test_unconverged_snapshots_are_left_out_unless_requested(snapshots: Snapshots) -> None:
    failing = with_failures(snapshots, [1, 4, 7])
    chosen = snapshot_pca(failing, dimension=7)
    np.testing.assert_array_equal(
        chosen.basis, snapshot_pca(failing.select(failing.converged), dimension=7).basis
    )
    everything = snapshot_pca(failing, dimension=7, include_unconverged=True)
    np.testing.assert_array_equal(everything.basis, snapshot_pca(snapshots, dimension=7).basis)
    with pytest.raises(
        ValueError,
        match=r"pca: dimension 8 exceeds the 7 independent directions of 7 usable snapshots; "
        r"use more samples or a smaller dimension",
    ):
        snapshot_pca(failing, dimension=8)


def test_usable_snapshots_span_their_independent_directions(snapshots: Snapshots) -> None:
    failing = with_failures(snapshots, [1, 4, 7])
    assert spanned_dimension(snapshots) == 10
    assert spanned_dimension(failing) == 7
    assert spanned_dimension(failing.joined(failing)) == 7, "repetitions add nothing"


def test_snapshots_without_a_converged_one_are_refused_with_the_cure(snapshots: Snapshots) -> None:
    failing = with_failures(snapshots, list(range(10)))
    with pytest.raises(
        ValueError, match=r"none of the 10 snapshots converged; .*include_unconverged=True"
    ):
        snapshot_pca(failing, dimension=2)
    assert snapshot_pca(failing, dimension=2, include_unconverged=True).dimension == 2


def test_rest_alone_spans_nothing() -> None:
    problem = posing_bar()
    at_rest = solve_snapshots(problem, np.zeros((3, 6)), threads=1)
    with pytest.raises(ValueError, match="all 3 snapshots equal the reference shape"):
        snapshot_pca(at_rest, energy_fraction=0.9)


def test_more_dimensions_never_hurt(snapshots: Snapshots) -> None:
    """The spaces are nested, so the error of unseen shapes falls with every column."""
    subspace = snapshot_pca(snapshots, dimension=10)
    problem = snapshots.problem
    unseen = solve_snapshots(problem, parameters(problem, 4, seed=11), threads=1).shapes
    displacements = unseen - subspace.tau
    errors = []
    for dimension in range(1, 11):
        smaller = subspace.leading(dimension)
        left = displacements - smaller.coordinates(unseen) @ smaller.basis.T
        errors.append(np.diag(mass_gram(subspace.mass, left, left)))
    assert (np.diff(errors, axis=0) <= 1e-15).all()
    assert np.mean(errors[-1]) < 0.01 * np.mean(errors[0])


def test_the_cure_of_energies_out_of_range_is_another_unit(snapshots: Snapshots) -> None:
    failing = with_failures(snapshots, list(range(10)), "not_finite")
    with pytest.raises(ValueError, match=r"energies of all 10 snapshots leave .*; use units in"):
        snapshot_pca(failing, dimension=2)
