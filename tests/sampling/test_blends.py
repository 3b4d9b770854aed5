"""Blends of two and three poses: their order, and that longer sequences only add samples."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from snapspace import HandleBox, sample
from snapspace.problem.blends import _in_triangle, _on_edge
from snapspace.problem.simplex import Simplex

FloatArray = NDArray[np.float64]
corner_counts = st.integers(2, 20)
extrapolations = st.sampled_from([0.0, 0.3, 2.0])


def blends(corners: int, count: int, extrapolation: float = 0.0, **options: Any) -> FloatArray:
    domain = Simplex(corners=corners, extrapolation=extrapolation)
    return sample(domain, count, method="blends", **options)


def supports(weights: FloatArray) -> list[tuple[int, ...]]:
    """The corners whose weights are not zero, for each sample."""
    return [tuple(np.flatnonzero(row).tolist()) for row in weights]


@given(
    corners=corner_counts,
    extrapolation=extrapolations,
    lengths=st.tuples(st.integers(1, 150), st.integers(1, 150)),
    seed=st.integers(0, 1000),
    scramble=st.booleans(),
)
@settings(max_examples=60)
def test_longer_sequences_begin_with_shorter_ones(
    corners: int, extrapolation: float, lengths: tuple[int, int], seed: int, scramble: bool
) -> None:
    short, long = (
        blends(corners, count, extrapolation, seed=seed, scramble=scramble)
        for count in sorted(lengths)
    )
    assert np.array_equal(long[: len(short)], short)


@given(corners=corner_counts, extrapolation=extrapolations, seed=st.integers(0, 1000))
@settings(max_examples=60)
def test_blends_are_weights_of_the_domain(corners: int, extrapolation: float, seed: int) -> None:
    domain = Simplex(corners=corners, extrapolation=extrapolation)
    weights = sample(domain, 300, method="blends", seed=seed)
    assert weights.shape == (300, corners)
    assert np.abs(weights.sum(axis=1) - 1).max() < 1e-14
    assert all(domain.contains(row) for row in weights)
    if extrapolation == 0:
        assert weights.min() >= 0


@pytest.mark.parametrize("corners", range(3, 21))
def test_all_pairs_come_before_any_pair_repeats(corners: int) -> None:
    pairs = math.comb(corners, 2)
    count = math.ceil(pairs / 0.9) + 1
    found = [chosen for chosen in supports(blends(corners, count)) if len(chosen) == 2]
    assert len(set(found[:pairs])) == pairs
    # until then every tenth sample is one of all corners, and none is a triple
    first = supports(blends(corners, count))[: count - 2]
    assert sum(len(chosen) == 2 for chosen in first) >= 0.9 * len(first) - 1


@pytest.mark.parametrize("corners", [4, 7, 10])
def test_each_round_of_pairs_is_complete_and_has_one_point(corners: int) -> None:
    pairs = math.comb(corners, 2)
    weights = blends(corners, 20 * pairs)
    rows = [(s, row) for s, row in zip(supports(weights), weights, strict=True) if len(s) == 2]
    for sweep, shares in enumerate([{0.5}, {0.25, 0.75}, {0.25, 0.75}]):
        round_ = rows[sweep * pairs : (sweep + 1) * pairs]
        assert len({chosen for chosen, _ in round_}) == pairs
        assert {float(w) for _, row in round_ for w in row[row != 0]} == shares
    # the two points nearer to an end are at different ends
    second, third = ({s: row.tolist() for s, row in rows[k * pairs :][:pairs]} for k in (1, 2))
    assert all(second[chosen] != third[chosen] for chosen in second)


@pytest.mark.parametrize("corners", [4, 6, 10])
def test_triples_and_inner_points_follow_with_their_shares(corners: int) -> None:
    begin = math.ceil(math.comb(corners, 2) / 0.9)
    sizes = np.array([len(chosen) for chosen in supports(blends(corners, begin + 1000)[begin:])])
    shares = [np.mean(sizes == 2), np.mean(sizes == 3), np.mean(sizes == corners)]
    assert shares == pytest.approx([0.2, 0.3, 0.5], abs=0.01)
    triples = [s for s in supports(blends(corners, 2000)) if len(s) == 3]
    assert len(set(triples[: math.comb(corners, 3)])) == math.comb(corners, 3)


def test_no_two_samples_are_alike() -> None:
    for corners in (3, 5, 10, 20):
        weights = blends(corners, 800)
        assert len(np.unique(weights.round(9), axis=0)) == 800


def test_the_inside_is_the_sobol_sequence() -> None:
    domain = Simplex(corners=8, extrapolation=0.2)
    weights = sample(domain, 200, method="blends", seed=5)
    inside = weights[(weights != 0).all(axis=1)]
    assert np.array_equal(inside, sample(domain, 200, method="sobol", seed=5)[: len(inside)])


@pytest.mark.parametrize("corners", [5, 8, 11, 20])
def test_corners_have_equal_shares(corners: int) -> None:
    """At any length, a corner's mean weight times the number of corners is near one."""
    weights = blends(corners, 1000)
    means = corners * np.cumsum(weights, axis=0) / np.arange(1, 1001)[:, None]
    assert np.abs(means[5 * corners :] - 1).max() < 0.3
    assert np.abs(means[-1] - 1).max() < 0.05


def test_over_seeds_no_corner_is_preferred() -> None:
    """The order of the corners is a random permutation: the first pair is any pair."""
    first = [supports(blends(5, 1, seed=seed))[0] for seed in range(1000)]
    counts = np.bincount(np.ravel(first), minlength=5)
    assert np.abs(counts - 400).max() < 4 * math.sqrt(1000 * 0.4 * 0.6)


def test_the_seed_determines_the_samples() -> None:
    a, b, again = (blends(8, 60, seed=seed) for seed in (0, 1, 0))
    assert np.array_equal(a, again) and not np.array_equal(a, b)
    plain = [blends(8, 60, seed=seed, scramble=False) for seed in (0, 1)]
    assert np.array_equal(*plain)


def test_two_poses_are_blended_evenly() -> None:
    weights = blends(2, 18, scramble=False)
    edge = np.delete(weights, [5, 15], axis=0)[:7, 0]
    assert sorted(edge) == pytest.approx(np.arange(1, 8) / 8)


@pytest.mark.parametrize("corners", [5, 10])
def test_extrapolation_enlarges_pairs_and_triples_in_their_own_plane(corners: int) -> None:
    plain, wide = blends(corners, 900), blends(corners, 900, 0.6)
    lowest = -0.6 / corners
    few = np.array([len(chosen) <= 3 for chosen in supports(plain)])
    for narrow, enlarged in zip(plain[few], wide[few], strict=True):
        chosen = np.flatnonzero(narrow)
        assert set(np.flatnonzero(enlarged)) <= set(chosen.tolist())
        middle = 1 / len(chosen)
        factor = 1 - len(chosen) * lowest
        assert enlarged[chosen] - middle == pytest.approx(factor * (narrow[chosen] - middle))
    assert lowest <= wide.min() < 0.8 * lowest


def test_points_of_a_pair_are_those_of_van_der_corput() -> None:
    firsts = [_on_edge(k)[0] for k in range(7)]
    assert firsts == [1 / 2, 1 / 4, 3 / 4, 1 / 8, 5 / 8, 3 / 8, 7 / 8]


def test_points_of_a_triple_fill_its_quarters_alike() -> None:
    assert _in_triangle(0) == pytest.approx([1 / 3] * 3)
    assert _in_triangle(1) == pytest.approx([2 / 3, 1 / 6, 1 / 6])
    points = np.array([_in_triangle(k) for k in range(64)])
    assert np.abs(points.sum(axis=1) - 1).max() < 1e-15 * 8
    assert points.mean(axis=0) == pytest.approx([1 / 3] * 3)
    quarters = np.where((points > 0.5).any(axis=1), points.argmax(axis=1), 3)
    assert np.bincount(quarters).tolist() == [16] * 4


def test_a_box_has_no_blends() -> None:
    box = HandleBox(translation=1.0, angle=1.0)
    message = "sample: the method 'blends' is for weights of poses, but the domain is a HandleBox"
    with pytest.raises(ValueError, match=re.escape(message)):
        sample(box, 5, method="blends")


@pytest.mark.parametrize(("count", "seed"), [(0, 0), (-3, 0), (5, -1)])
def test_bad_numbers_are_refused(count: int, seed: int) -> None:
    with pytest.raises(ValueError, match="sample: the "):
        blends(5, count, seed=seed)
