"""How many tets a cubature has, and how many equations and candidates it is fitted with."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from snapspace.cubature import default_tets
from snapspace.cubature.fit_tets import MOST_CANDIDATES, Budget, _row_count


def budget(each: int, many: int) -> Budget:
    return Budget(None, 1, 1, 1, candidates=each, many_candidates=many)


@given(st.integers(1, 5000), st.integers(1, 20), st.integers(1, MOST_CANDIDATES))
def test_weights_are_overdetermined_and_chosen_from_several(
    count: int, each: int, many: int
) -> None:
    """More equations than unknowns; several candidates for each tet, unless there are too many."""
    assert 2 * count <= _row_count(count) <= 3 * count
    candidates = budget(each, many).candidate_count(count)
    assert candidates >= count
    assert candidates >= min(each, 10) * count or candidates == max(MOST_CANDIDATES, count)
    assert candidates >= min(each * count, many)
    assert candidates <= max(each * count, count)


@given(st.integers(1, 5000), st.integers(1, MOST_CANDIDATES))
def test_more_tets_never_have_fewer_equations_or_candidates(count: int, many: int) -> None:
    assert _row_count(count) <= _row_count(count + 1)
    some = budget(20, many)
    assert some.candidate_count(count) <= some.candidate_count(count + 1)


@given(st.integers(1, 400))
def test_tets_grow_with_the_dimension_and_more_slowly_from_1000_on(dimension: int) -> None:
    tets = default_tets(dimension)
    assert tets == (8 * dimension if dimension <= 125 else max(1000, round(6.5 * dimension)))
    assert default_tets(dimension + 1) >= tets
    assert 6.5 * dimension - 0.5 <= tets <= 8 * dimension
