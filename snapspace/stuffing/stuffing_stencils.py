"""Stencils: the part of a lattice tet inside the surface, cut into tets.

Labelle & Shewchuk (2007, sec. 3.2) list the cases in a figure; here the table is derived. The
part of a tet inside the surface is a tet, or a prism (perhaps with one line shrunk to a point).
Only the diagonals of the quadrilaterals need a rule. On faces shared with a neighbour the rule
depends only on the face, so that both sides agree:

- two nodes inside on a long edge (both cut points are on short edges and indistinguishable): the
  diagonal starts at the even node;
- two nodes inside on a short edge: the diagonal ends at the cut point on the long edge.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from snapspace.stuffing.cut_points import TET_EDGES

# A lattice tet is (corner, corner, centre, centre), positively oriented; 01 and 23 are its long
# edges. Any such tet has this shape:
_SHAPE = np.array([[-1.0, 0.0, -0.5], [1.0, 0.0, -0.5], [0.0, 1.0, 0.5], [0.0, -1.0, 0.5]])
_PARTNER = (1, 0, 3, 2)

# A line (start, end) of a prism; a line shrunk to a point has start == end.
_Line = tuple[int, int]


def case_numbers(signs: NDArray[np.int8], odd: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Row of `stencil_table` for each tet.

    Parameters
    ----------
    signs : ndarray of int, (m, 4)
        -1 inside, 0 on the surface, 1 outside, for the nodes of each tet.
    odd : ndarray of bool, (m, 4)
        Parity of the nodes; the ends of a long edge differ.

    Returns
    -------
    ndarray of int64, (m,)
        The sum of (sign_i + 1) 3^i, plus 81 if node 0 is odd, plus 162 if node 2 is odd.
    """
    numbers = sign_numbers(signs)
    return np.asarray(numbers + 81 * odd[:, 0] + 162 * odd[:, 2], dtype=np.int64)


def sign_numbers(signs: NDArray[np.int8]) -> NDArray[np.int64]:
    """The sum of (sign_i + 1) 3^i for each tet, (m,), from signs (m, 4)."""
    return np.asarray((signs + 1).astype(np.int64) @ [1, 3, 9, 27], dtype=np.int64)


def signs_of(number: int) -> list[int]:
    """The signs with a sum modulo 81."""
    return [number // 3**i % 3 - 1 for i in range(4)]


@lru_cache(maxsize=1)
def stencil_table() -> tuple[NDArray[np.int64], ...]:
    """Tets of each of the 324 cases, positively oriented.

    Returns
    -------
    tuple of 324 ndarrays of int64, (k, 4) with k from 0 to 3
        Local points: 0..3 are the nodes of the lattice tet, 4..9 the cut points on `TET_EDGES`.
    """
    cases = []
    for number in range(324):
        signs = signs_of(number)
        even = (number // 81 % 2, 2 + number // 162)
        cases.append(_oriented(_stencil(signs, even)))
    return tuple(cases)


def nodes_by_sign(signs: list[int]) -> list[list[int]]:
    """The nodes inside, on the surface and outside."""
    return [[i for i in range(4) if signs[i] == s] for s in (-1, 0, 1)]


def without_diagonals(inside: list[int], outside: list[int]) -> list[tuple[int, ...]] | None:
    """The stencil of nodes whose part inside is a tet, or nothing; otherwise None."""
    if not inside:
        return []
    if not outside:
        return [(0, 1, 2, 3)]
    if len(inside) == 1:
        return [tuple(cut_point(inside[0], i) if i in outside else i for i in range(4))]
    return None


def _stencil(signs: list[int], even: tuple[int, int]) -> list[tuple[int, ...]]:
    inside, zero, outside = nodes_by_sign(signs)
    if (plain := without_diagonals(inside, outside)) is not None:
        return plain
    # Even nodes first: the order in which prisms are built is the order of the parity rule.
    inside.sort(key=lambda i: i not in even)
    if len(outside) == 1:
        return _truncated(inside, zero, outside[0])
    return _wedge(inside, outside)


def _truncated(inside: list[int], zero: list[int], tip: int) -> list[tuple[int, ...]]:
    """One corner, the tip, is cut off; a node on the surface is a shrunk line of the prism."""
    # If the tip's partner on the long edge is inside, all diagonals of its faces end at that cut.
    ranking = sorted(inside, key=lambda i: _PARTNER[i] == tip)
    return staircase([(i, cut_point(i, tip)) for i in ranking] + [(i, i) for i in zero])


def _wedge(inside: list[int], outside: list[int]) -> list[tuple[int, ...]]:
    """Two nodes inside, two outside: a prism from the first inside node to the second."""
    first, second = inside
    spine = (first, second)
    if _PARTNER[first] == second:
        # Lines go from the even to the odd node. The diagonal on the surface is arbitrary.
        return staircase([spine] + [(cut_point(first, o), cut_point(second, o)) for o in outside])
    beside_first, beside_second = (
        (cut_point(first, _PARTNER[i]), cut_point(second, _PARTNER[i])) for i in inside
    )
    return staircase([beside_first, spine, beside_second])


def staircase(lines: list[_Line]) -> list[tuple[int, ...]]:
    """Cut a prism: diagonals go from the start of each line to the ends of all later lines."""
    tets = []
    for k, (start, end) in enumerate(lines):
        if start != end:
            tets.append((*(line[0] for line in lines[: k + 1]), *(line[1] for line in lines[k:])))
    return tets


def cut_point(i: int, j: int) -> int:
    return 4 + TET_EDGES.index((min(i, j), max(i, j)))


def _oriented(tets: list[tuple[int, ...]]) -> NDArray[np.int64]:
    """Order the points of each tet so that its volume is positive."""
    middles = [_SHAPE[list(edge)].mean(axis=0) for edge in TET_EDGES]
    points = np.concatenate([_SHAPE, middles])
    result = np.array(tets, dtype=np.int64).reshape(-1, 4)
    corners = points[result]
    flipped = np.linalg.det(corners[:, 1:] - corners[:, :1]) < 0.0
    result[flipped] = result[flipped][:, [0, 1, 3, 2]]
    return result
