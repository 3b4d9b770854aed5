"""The same body with other handles."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import HandleBox, Handles, PosingProblem

from ..shapes import bar_problem, deformed

PROBLEM = bar_problem()
N = len(PROBLEM.mesh.vertices)
HANDLES = Handles([[0, 1, 2], [7, 8]], names=["foot", "head"])


def parts(handles: Handles) -> dict[str, list[int]]:
    return {handle.name: handle.vertices.tolist() for handle in handles}


def test_a_handle_is_added_at_the_end() -> None:
    mask = np.arange(9) == 4
    assert parts(HANDLES.adding("tail", mask)) == {"foot": [0, 1, 2], "head": [7, 8], "tail": [4]}
    assert HANDLES.adding("tail", mask).names == ("foot", "head", "tail")
    assert HANDLES.names == ("foot", "head"), "values are not changed"


def test_a_handle_is_replaced_in_its_place() -> None:
    moved = HANDLES.replacing("foot", [3, 2])
    assert parts(moved) == {"foot": [2, 3], "head": [7, 8]} and moved.names == HANDLES.names


def test_a_handle_is_left_out() -> None:
    three = HANDLES.adding("tail", [4])
    assert three.without("head").names == ("foot", "tail")
    assert three.without("foot").names == ("head", "tail"), "the next one is fixed"


def test_a_different_handle_is_fixed() -> None:
    three = HANDLES.adding("tail", [4])
    assert three.fixing("tail").names == ("tail", "foot", "head")
    assert parts(three.fixing("tail")) == parts(three)
    assert three.fixing("foot").names == three.names


def test_wrong_changes_are_refused() -> None:
    for change in (HANDLES.without, HANDLES.fixing, lambda name: HANDLES.replacing(name, [4])):
        with pytest.raises(ValueError, match="no handle 'tail'; the handles are foot, head"):
            change("tail")
    with pytest.raises(ValueError, match="the name 'head' is used twice"):
        HANDLES.adding("head", [4])
    with pytest.raises(ValueError, match="'head' and 'tail' overlap in 1 vertices"):
        HANDLES.adding("tail", [4, 8])
    with pytest.raises(ValueError, match="got 1, but posing needs a fixed handle and at least one"):
        HANDLES.without("foot")


def test_everything_except_the_handles_stays_the_same() -> None:
    other = PROBLEM.with_handles(PROBLEM.handles.without("belly"))
    assert other.mesh is PROBLEM.mesh
    assert (other.material, other.stiffness) == (PROBLEM.material, PROBLEM.stiffness)
    assert other.handles.names == ("foot", "head")
    assert other.domain == HandleBox(translation=0.8, angle=0.8, moving=1)
    assert PROBLEM.domain.moving == 2 and PROBLEM.handles.names == ("foot", "head", "belly")


def test_the_result_equals_a_newly_constructed_problem() -> None:
    """Neither shared nor computed parts keep anything of the old handles."""
    assert PROBLEM.system and PROBLEM.centroids.size  # computed before
    handles = PROBLEM.handles.without("head").adding("corner", [N - 1, N - 2])
    other = PROBLEM.with_handles(handles)
    alone = PosingProblem(
        PROBLEM.mesh,
        handles,
        domain=PROBLEM.domain,
        material=PROBLEM.material,
        stiffness=PROBLEM.stiffness,
    )
    assert other.fingerprint == alone.fingerprint != PROBLEM.fingerprint
    w, x = np.linspace(-0.5, 0.5, other.parameter_count), deformed(PROBLEM.mesh, 0.2)
    value, gradient = other.value_and_gradient(x, w)
    expected, expected_gradient = alone.value_and_gradient(x, w)
    assert value == expected
    np.testing.assert_array_equal(gradient, expected_gradient)
    np.testing.assert_array_equal(other.inputs(w[None]), alone.inputs(w[None]))
    assert other.energy is PROBLEM.energy


def test_a_new_box_may_be_given() -> None:
    box = HandleBox(translation=(0.1, 0.2, 0.3), angle=0.4)
    other = PROBLEM.with_handles(PROBLEM.handles, domain=box)
    np.testing.assert_array_equal(other.domain.half_widths, 2 * [0.1, 0.2, 0.3, 0.4, 0.4, 0.4])


def test_vertices_outside_of_the_mesh_are_refused() -> None:
    with pytest.raises(ValueError, match=f"handle 'tail' has vertex index {N}, but the mesh has"):
        PROBLEM.with_handles(PROBLEM.handles.adding("tail", [N]))
