"""Motions on the command line: vectors, and which --euler belongs to which --handle."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from snapspace.cli.motions import Motion, as_parameters, collect_motions
from snapspace.cli.options import parse_vector
from snapspace.problem import rotation_matrix

from ..shapes import bar_problem


def test_a_relative_rotation_without_unique_angles_is_found() -> None:
    problem = bar_problem()
    parameters, carrier = as_parameters(problem, {problem.handles.names[0]: Motion((0, 90, 0))})
    turn = rotation_matrix([0, np.pi / 2, 0])
    np.testing.assert_allclose(carrier[:, :3], turn, atol=1e-14)
    np.testing.assert_allclose(rotation_matrix(parameters[3:6]), turn.T, atol=1e-7)


finite = st.floats(allow_nan=False, allow_infinity=False)


def test_motions_belong_to_the_handle_before_them() -> None:
    items = [
        ("handle", "head"),
        ("translate", (0.0, 0.0, 1.0)),
        ("handle", "tail"),
        ("handle", "paw"),
        ("euler", (0.0, 0.0, 30.0)),
        ("translate", (1.0, 0.0, 0.0)),
    ]
    assert collect_motions(items) == {
        "head": Motion(None, (0.0, 0.0, 1.0)),
        "tail": Motion(),
        "paw": Motion((0.0, 0.0, 30.0), (1.0, 0.0, 0.0)),
    }


@given(finite, finite, finite, st.sampled_from([",", ", ", " ", "  "]))
def test_a_vector_is_read_with_all_its_digits(x: float, y: float, z: float, between: str) -> None:
    assert parse_vector(between.join(repr(value) for value in (x, y, z))) == (x, y, z)


@pytest.mark.parametrize("text", ["", "1", "1,2", "1,2,3,4", "1,2,", "a,b,c", "nan,0,0", "inf 0 0"])
def test_text_that_is_not_a_vector_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=f"'{text}'"):
        parse_vector(text)
