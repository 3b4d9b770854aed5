"""The compiled parts of training, compared with explicit sums."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import _core as core
from snapspace.cubature.displacement_gradients import displacement_gradients

from ..shapes import irregular_bar


@pytest.mark.parametrize(
    ("candidates", "numbers", "dimension", "states", "directions"),
    [(1, 9, 1, 1, 1), (33, 27, 7, 2, 5), (70, 9, 17, 3, 50), (32, 36, 16, 1, 33)],
)
def test_columns_are_products_of_forces_and_directions(
    candidates: int, numbers: int, dimension: int, states: int, directions: int
) -> None:
    """Sizes leave any remainder of groups, packs and tiles; columns beyond are not touched."""
    rng = np.random.default_rng(candidates)
    rows = rng.normal(size=(candidates, numbers, dimension)).astype(np.float32)
    stresses = rng.normal(size=(states, candidates, numbers)).astype(np.float32)
    along = rng.normal(size=(states, dimension, directions)).astype(np.float32)
    results = []
    for threads in (1, 2):
        columns = np.full((candidates, states * directions + 2), 7.0, np.float32)
        core.training_columns(rows, stresses, along, columns, threads=threads)
        results.append(columns)
    wanted = np.einsum("sce,ced,sdk->csk", *(a.astype(float) for a in (stresses, rows, along)))
    scale = np.abs(wanted).max()
    assert results[0][:, :-2] == pytest.approx(wanted.reshape(candidates, -1), abs=1e-5 * scale)
    assert (results[0][:, -2:] == 7.0).all()
    np.testing.assert_array_equal(*results)


def test_arrays_that_do_not_match_are_refused() -> None:
    rows, stresses = np.zeros((4, 9, 3), np.float32), np.zeros((2, 4, 9), np.float32)
    columns = np.zeros((4, 9), np.float32)
    with pytest.raises(ValueError, match="columns must be"):
        along = np.zeros((2, 3, 5), np.float32)
        core.training_columns(rows, stresses, along, columns, threads=1)
    with pytest.raises(ValueError, match="do not match"):
        along = np.zeros((2, 3, 4), np.float32)
        stars = np.zeros((4, 27, 3), np.float32)
        core.training_columns(stars, stresses, along, columns, threads=1)
    with pytest.raises(ValueError, match="do not match"):
        along = np.zeros((2, 2, 4), np.float32)
        core.training_columns(rows, stresses, along, columns, threads=1)


def test_an_affine_mode_has_its_matrix_in_every_tet() -> None:
    mesh = irregular_bar(4, 2, 2)
    matrices = np.random.default_rng(1).normal(size=(5, 3, 3))
    basis = np.stack([(mesh.vertices @ A.T).reshape(-1) for A in matrices], axis=1)
    tets = np.arange(0, len(mesh.tets), 3, dtype=np.int32)
    rows = displacement_gradients(mesh, basis, tets)
    wanted = np.broadcast_to(matrices.reshape(5, 9).T, rows.shape)
    assert rows == pytest.approx(wanted, abs=1e-6)
