"""Leave-one-out errors: from inner products as from the shapes themselves."""

from __future__ import annotations

import numpy as np
import pytest

import snapspace as ss
from paper.leave_one_out import errors_of_others, leave_one_out_errors
from snapspace.mesh import mass_norms
from snapspace.subspace import pca

from ..shapes import bar_problem

PROBLEM = bar_problem()
SAMPLES = 7


@pytest.fixture(scope="module")
def displacements() -> np.ndarray:
    """Rows with singular values that differ, so that their order is certain."""
    rng = np.random.default_rng(4)
    modes = (
        rng.normal(size=(SAMPLES + 2, PROBLEM.base.size)) * 0.5 ** np.arange(SAMPLES + 2)[:, None]
    )
    rows: np.ndarray = rng.normal(size=(SAMPLES + 2, SAMPLES + 2)) @ modes
    return rows


@pytest.fixture(scope="module")
def gram(displacements: np.ndarray) -> ss.SnapshotGram:
    made = ss.SnapshotGram.of(PROBLEM)
    made.add(list(displacements))
    return made


def from_shapes(training: np.ndarray, left_out: np.ndarray, dimension: int) -> float:
    """The error by the PCA of shapes (paper, sec. 5.1)."""
    mass = PROBLEM.mass()
    subspace = pca(PROBLEM.tau + training, PROBLEM.tau, mass, dimension=dimension)
    shape = (PROBLEM.tau + left_out)[None]
    miss = left_out - subspace.coordinates(shape) @ subspace.basis.T
    return float(mass_norms(mass, miss)[0] / mass_norms(mass, left_out[None])[0])


def test_a_sample_is_approximated_by_all_others(
    displacements: np.ndarray, gram: ss.SnapshotGram
) -> None:
    training = np.arange(SAMPLES)
    errors = leave_one_out_errors(gram, training, (2, 4))
    for i in training:
        others = displacements[training[training != i]]
        for row, d in enumerate((2, 4)):
            assert errors[row, i] == pytest.approx(from_shapes(others, displacements[i], d))


def test_other_samples_are_approximated_by_all_of_them(
    displacements: np.ndarray, gram: ss.SnapshotGram
) -> None:
    training, tested = np.arange(SAMPLES), np.array([2, SAMPLES, SAMPLES + 1])
    errors = errors_of_others(gram, training, tested, (3,))
    assert errors[0, 0] == leave_one_out_errors(gram, training, (3,))[0, 2]
    for column in (1, 2):
        wanted = from_shapes(displacements[:SAMPLES], displacements[tested[column]], 3)
        assert errors[0, column] == pytest.approx(wanted)


def test_a_copy_of_a_sample_has_no_error(displacements: np.ndarray) -> None:
    twice = ss.SnapshotGram.of(PROBLEM)
    twice.add([displacements[0], displacements[0], displacements[1]])
    errors = leave_one_out_errors(twice, [0, 1, 2], (2,))
    assert errors[0, :2] == pytest.approx([0.0, 0.0], abs=1e-6), "the copy spans it"
    assert errors[0, 2] > 0.1, "nothing spans this one"


def test_dimensions_beyond_the_samples_change_nothing(gram: ss.SnapshotGram) -> None:
    few = leave_one_out_errors(gram, [0, 1, 2], (2, 9))
    assert np.array_equal(few[0], few[1]), "two others span two dimensions"
