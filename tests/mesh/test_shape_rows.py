"""shape_rows and shape_or_rows: one sample per row, and errors that say how to get there."""

from __future__ import annotations

import re

import numpy as np
import pytest

from snapspace.mesh import shape_or_rows, shape_rows

SIZE = 12  # four vertices


@pytest.mark.parametrize("count", [0, 1, 5, SIZE])
def test_rows_are_returned_without_a_copy(count: int) -> None:
    rows = np.zeros((count, SIZE))
    assert shape_rows(rows, SIZE, who="me") is rows
    assert shape_or_rows(rows, SIZE, who="me") is rows


def test_one_shape_stays_a_vector() -> None:
    vector = np.zeros(SIZE)
    assert shape_or_rows(vector, SIZE, who="me") is vector
    assert shape_or_rows(range(SIZE), SIZE, who="me").tolist() == list(range(SIZE))


CURES = [
    ((SIZE, 5), "transpose it: x.T"),
    ((SIZE, 1), "transpose it: x.T"),
    ((4, 3), "flatten the vertices: x.reshape(1, -1)"),
    ((5, 4, 3), "flatten the vertices: x.reshape(5, -1)"),
    ((5, 9), "use shapes of this mesh, x0 y0 z0 x1 ..."),
    ((9,), "use shapes of this mesh, x0 y0 z0 x1 ..."),
    ((), "use shapes of this mesh, x0 y0 z0 x1 ..."),
]


@pytest.mark.parametrize(("got", "cure"), CURES)
def test_other_layouts_are_refused_with_the_cure(got: tuple[int, ...], cure: str) -> None:
    came = f"me: x has shape {got}, but a mesh of 4 vertices needs "
    several = f"{came}(k, 12), one shape per row; {cure}"
    with pytest.raises(ValueError, match=f"^{re.escape(several)}$"):
        shape_rows(np.zeros(got), SIZE, who="me", what="x")
    either = f"{came}(12,) or (k, 12), one shape per row; {cure}"
    with pytest.raises(ValueError, match=f"^{re.escape(either)}$"):
        shape_or_rows(np.zeros(got), SIZE, who="me", what="x")


def test_a_vector_for_several_shapes_is_refused_with_the_cure() -> None:
    with pytest.raises(ValueError, match=re.escape("a single shape is x[None]")):
        shape_rows(np.zeros(SIZE), SIZE, who="me", what="x")
