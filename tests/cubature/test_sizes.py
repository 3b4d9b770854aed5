"""How many tets a cubature has, and how many equations and candidates it is fitted with."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from snapspace.cubature import default_tets
from snapspace.cubature.fit_tets import MOST_CANDIDATES, _candidate_count, _row_count


@given(st.integers(1, 5000), st.integers(1, 20))
def test_weights_are_overdetermined_and_chosen_from_several(count: int, each: int) -> None:
    """More equations than unknowns; several candidates for each tet, unless there are too many."""
    assert 2 * count <= _row_count(count) <= 3 * count
    candidates = _candidate_count(each, count)
    assert candidates >= count
    assert candidates == each * count or candidates == max(MOST_CANDIDATES, count)
    assert candidates <= max(each * count, count)


@given(st.integers(1, 5000))
def test_more_tets_never_have_fewer_equations_or_candidates(count: int) -> None:
    assert _row_count(count) <= _row_count(count + 1)
    assert _candidate_count(20, count) <= _candidate_count(20, count + 1)


@given(st.integers(1, 400))
def test_tets_grow_with_the_dimension_and_more_slowly_from_1000_on(dimension: int) -> None:
    tets = default_tets(dimension)
    assert tets == (8 * dimension if dimension <= 125 else max(1000, round(6.5 * dimension)))
    assert default_tets(dimension + 1) >= tets
    assert 6.5 * dimension - 0.5 <= tets <= 8 * dimension
