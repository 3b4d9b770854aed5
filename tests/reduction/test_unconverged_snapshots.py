"""Snapshots that did not converge are part of a model only on request."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from snapspace import DisplacementRows, PosingModel, Snapshots, reduce, snapshot_pca

FAILED = [3, 20, 41]


@pytest.fixture(scope="module")
def diverged(posing_snapshots: Snapshots) -> Snapshots:
    """The snapshots of the bar, three of which ended far from every solution."""
    rows, reports = posing_snapshots.displacements.array(), list(posing_snapshots.reports)
    for sample in FAILED:
        rows[sample] *= 1e14
        reports[sample] = replace(reports[sample], status="max_iterations")
    stored = DisplacementRows(rows, rows.shape[1])
    return replace(posing_snapshots, displacements=stored, reports=reports)


def model(snapshots: Snapshots, **options: bool) -> PosingModel:
    subspace = snapshot_pca(snapshots, dimension=12, **options)
    made = reduce(snapshots.problem, subspace, energy="cubature", snapshots=snapshots, **options)
    assert isinstance(made, PosingModel)
    return made


def test_diverged_snapshots_train_no_cubature(diverged: Snapshots) -> None:
    found = model(diverged)
    expected = model(diverged.select(diverged.converged))
    assert len(found.training_parameters) == 60 - len(FAILED)
    np.testing.assert_array_equal(found.training_coordinates, expected.training_coordinates)
    assert found.cubature is not None and expected.cubature is not None
    np.testing.assert_array_equal(found.cubature.tets, expected.cubature.tets)
    np.testing.assert_array_equal(found.cubature.weights, expected.cubature.weights)


def test_unconverged_snapshots_are_used_on_request(posing_snapshots: Snapshots) -> None:
    reports = [replace(report, status="max_iterations") for report in posing_snapshots.reports[:50]]
    partly = replace(posing_snapshots, reports=[*reports, *posing_snapshots.reports[50:]])
    assert len(model(partly, include_unconverged=True).training_parameters) == 60


def test_too_few_converged_snapshots_are_counted(posing_snapshots: Snapshots) -> None:
    reports = [replace(report, status="max_iterations") for report in posing_snapshots.reports[:52]]
    partly = replace(posing_snapshots, reports=[*reports, *posing_snapshots.reports[52:]])
    subspace = snapshot_pca(partly, dimension=5)
    with pytest.raises(ValueError, match="only 8 of 60 converged; allow more iterations, choose"):
        reduce(partly.problem, subspace, energy="cubature", snapshots=partly)
