from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from snapspace import Handles


def test_indices_and_masks_mean_the_same() -> None:
    mask = np.zeros(9, dtype=bool)
    mask[[2, 5]] = True
    handles = Handles([[5, 2, 5], mask[::-1]], names=["a", "b"])
    assert handles["a"].vertices.tolist() == [2, 5]
    assert handles[1].vertices.tolist() == [3, 6]
    assert handles["a"].vertices.dtype == np.int32
    assert np.array_equal(Handles([mask, [0]])[0].vertices, handles["a"].vertices)


def test_the_first_two_vertices_may_be_a_handle() -> None:
    """They are no mask of integers."""
    assert Handles([[0, 1], [2]])[0].vertices.tolist() == [0, 1]
    assert Handles([[1, 1], [2]])[0].vertices.tolist() == [1]


def test_order_names_and_length() -> None:
    handles = Handles([[0], [1], [2]])
    assert handles.names == ("handle_0", "handle_1", "handle_2")
    assert len(handles) == 3
    assert [handle.name for handle in handles] == list(handles.names)
    assert handles.index("handle_2") == 2
    assert repr(handles) == "Handles(handle_0: 1, handle_1: 1, handle_2: 1)"


def test_handles_are_found_by_their_vertices_whatever_their_names() -> None:
    others = Handles([[0, 1], [4], [7, 8]], names=["foot", "belly", "head"])
    handles = Handles([[8, 7], [1, 0], [2], [6]], names=["foot", "b", "c", "d"])
    assert handles.places_in(others) == (2, 0, None, None)
    assert others.places_in(others) == (0, 1, 2)


def test_vertices_cannot_be_changed_afterwards() -> None:
    with pytest.raises(ValueError, match="read-only"):
        Handles([[0, 1], [2]])[0].vertices[0] = 7


def test_an_unknown_name_lists_the_known_ones() -> None:
    with pytest.raises(ValueError, match="there is no handle 'tail'; the handles are foot, head"):
        Handles([[0], [1]], names=["foot", "head"])["tail"]


BAD: list[tuple[Any, Any, str]] = [
    ([[0, 1]], ["foot"], "got 1, but posing needs a fixed handle and at least one to move"),
    ([], [], "got 0, but posing needs"),
    ([[0], []], ["foot", "head"], "'head' has no vertices"),
    ([np.zeros(4, bool), [1]], ["foot", "head"], "'foot' has no vertices"),
    (
        [[0, 1, 2], [3], [2, 1]],
        ["a", "b", "c"],
        "'a' and 'c' overlap in 2 vertices, the first is 1",
    ),
    ([[0], [1.5]], ["foot", "head"], "'head' must be a list of vertex indices"),
    ([[0], [[1, 2]]], ["foot", "head"], "'head' must be a list of vertex indices"),
    ([[0], np.eye(3, dtype=bool)], ["foot", "head"], "'head' must be a list of vertex indices"),
    ([[0], ["x"]], ["foot", "head"], "'head' must be a list of vertex indices"),
    ([[0], [1, -3]], ["foot", "head"], "'head' has the negative vertex index -3"),
    ([[0], [2**31]], ["foot", "head"], "'head' has the vertex index 2147483648, beyond 32 bits"),
    (
        [np.ones(9, int), [1]],
        ["foot", "head"],
        "'foot' has 9 entries that are all 0 or 1; give",
    ),
    ([[0], np.uint8([0, 0, 1, 1])], ["foot", "head"], "'head' has 4 entries that are all 0 or 1"),
    (
        {"foot": [0], "head": [1]},
        None,
        "vertices is of type dict; give list(parts.values())",
    ),
    ([[0], [1]], "ab", "names is the string 'ab', but must be a list of names"),
    ([[0], [1]], ["foot"], "got 1 names for 2 handles"),
    ([[0], [1]], ["foot", "foot"], "the name 'foot' is used twice"),
    ([[0], [1]], ["foot", " "], "a name must be a non-empty string, got ' '"),
    ([[0], [1]], ["foot", 3], "a name must be a non-empty string, got 3"),
]


@pytest.mark.parametrize(("vertices", "names", "message"), BAD)
def test_wrong_handles_are_refused_by_name(vertices: Any, names: Any, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(f"Handles: {message}")) as caught:
        Handles(vertices, names=names)
    assert "\n" not in str(caught.value)
