"""One sample per lane of a pack; no bit depends on the lane or on other samples."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import ElasticEnergy, Material, TetMesh
from snapspace import _core as core

from ..shapes import deformed, irregular_bar
from .densities import every_kind, has_barrier, varied

FloatArray = NDArray[np.float64]
MESH = irregular_bar()
REST = MESH.vertices.reshape(-1)
#: Lanes of a pack in double and in single precision.
WIDTHS = {False: core.lane_count, True: 2 * core.lane_count}
precisions = pytest.mark.parametrize("single", WIDTHS, ids=["double", "single"])


def displaced(count: int) -> FloatArray:
    """Displacements (count, 3n): the rest shape, small and large ones, with inverted tets."""
    sizes = np.resize([0.0, 1e-6, 0.02, 0.05, 0.4, 1.5], count)
    return np.stack([deformed(MESH, size, seed=k) - REST for k, size in enumerate(sizes)])


def compiled(kind: type[Material], mesh: TetMesh = MESH) -> core.ElasticEnergy:
    return ElasticEnergy(mesh, varied(kind, len(mesh.tets))).core


def assert_same_bits(a: tuple[FloatArray, FloatArray], b: tuple[FloatArray, FloatArray]) -> None:
    for one, other in zip(a, b, strict=True):
        np.testing.assert_array_equal(one, other)


def in_packs(
    energy: core.ElasticEnergy, shapes: FloatArray, *, single: bool = False
) -> tuple[FloatArray, FloatArray]:
    """Values and gradients of any number of samples; the number of lanes depends on the build."""
    width = WIDTHS[single]
    parts = [
        energy.lane_values_and_gradients(shapes[k : k + width], single=single)
        for k in range(0, len(shapes), width)
    ]
    return np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])


@every_kind
def test_a_lane_is_bitwise_the_sample_alone(kind: type[Material]) -> None:
    energy, shapes = compiled(kind), displaced(12)
    values, gradients = in_packs(energy, shapes)
    for u, value, gradient in zip(shapes, values, gradients, strict=True):
        alone, force = energy.value_and_gradient(u)
        assert value == alone
        np.testing.assert_array_equal(gradient, force)


@precisions
@every_kind
def test_a_sample_is_bitwise_the_same_in_any_lane_beside_any_others(
    kind: type[Material], single: bool
) -> None:
    energy, shapes = compiled(kind), displaced(16)
    values, gradients = in_packs(energy, shapes, single=single)
    for shift in (1, 3):
        moved = in_packs(energy, np.roll(shapes, shift, axis=0), single=single)
        assert_same_bits(moved, (np.roll(values, shift), np.roll(gradients, shift, axis=0)))
    for lane in range(0, len(shapes), 3):
        alone = energy.lane_values_and_gradients(shapes[lane : lane + 1], single=single)
        assert_same_bits(alone, (values[lane : lane + 1], gradients[lane : lane + 1]))
    same = in_packs(energy, np.repeat(shapes[3:4], WIDTHS[single], axis=0), single=single)
    assert len(np.unique(same[0])) == 1
    assert len(np.unique(same[1], axis=0)) == 1


@precisions
@pytest.mark.parametrize("wild", [np.nan, np.inf, 1e200])
@every_kind
def test_a_lane_that_is_not_finite_spoils_no_other(
    kind: type[Material], wild: float, single: bool
) -> None:
    energy, shapes = compiled(kind), displaced(WIDTHS[single])
    before = energy.lane_values_and_gradients(shapes, single=single)
    shapes[1, 4] = wild
    after = energy.lane_values_and_gradients(shapes, single=single)
    others = np.arange(len(shapes)) != 1
    assert_same_bits((after[0][others], after[1][others]), (before[0][others], before[1][others]))
    assert not np.isfinite(after[0][1])


@every_kind
def test_single_precision_agrees_with_double_to_its_digits(kind: type[Material]) -> None:
    """Sums are in double precision; the terms of each tet in single precision."""
    energy, shapes = compiled(kind), displaced(4 if has_barrier(kind()) else 6)
    values, gradients = in_packs(energy, shapes)
    single_values, single_gradients = in_packs(energy, shapes, single=True)
    for k in range(2, len(shapes)):
        assert single_values[k] == pytest.approx(values[k], rel=1e-4)
        scale = np.abs(gradients[k]).max()
        np.testing.assert_allclose(single_gradients[k], gradients[k], rtol=0, atol=2e-5 * scale)
    assert single_values[0] == 0.0
    assert not single_gradients[0].any()


@every_kind
def test_the_sum_over_tets_is_that_of_their_stresses(kind: type[Material]) -> None:
    """Lanes sum over groups of tets; tet_stresses works tet by tet."""
    mesh = irregular_bar(6, 3, 3)
    energy, u = compiled(kind, mesh), deformed(mesh, 0.03) - mesh.vertices.reshape(-1)
    stresses, energies = energy.tet_stresses(u)
    corners = mesh.vertices[mesh.tets]
    inverse = np.linalg.inv((corners[:, 1:] - corners[:, :1]).swapaxes(1, 2))
    # a column for each corner except the first, whose force is their negative sum
    forces = stresses.reshape(-1, 3, 3) @ inverse.swapaxes(1, 2)
    expected = np.zeros_like(mesh.vertices)
    for corner in range(3):
        np.add.at(expected, mesh.tets[:, corner + 1], forces[:, :, corner])
        np.add.at(expected, mesh.tets[:, 0], -forces[:, :, corner])
    value, gradient = energy.value_and_gradient(u)
    assert value == pytest.approx(energies.sum(), rel=1e-12)
    scale = np.abs(expected).max()
    np.testing.assert_allclose(gradient, expected.reshape(-1), rtol=0, atol=1e-12 * scale)


@every_kind
def test_more_samples_than_lanes_are_refused(kind: type[Material]) -> None:
    for single, width in WIDTHS.items():
        with pytest.raises(ValueError, match="k at most the number of lanes"):
            compiled(kind).lane_values_and_gradients(displaced(width + 1), single=single)
