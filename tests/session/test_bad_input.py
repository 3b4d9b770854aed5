"""Wrong moves are refused, and the shape stays as it was."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from snapspace import ReducedModel, Session

ROTATION = np.column_stack([np.eye(3), [1.0, 2.0, 3.0]])
NOT_FINITE = ROTATION.copy()
NOT_FINITE[1, 1] = np.nan
STRETCH = ROTATION * [1, 2, 1, 1]
MIRROR = ROTATION * [1, 1, -1, 1]

WRONG: list[tuple[Callable[[Session], Any], str]] = [
    (lambda s: s.move("tail"), "there is no handle 'tail'; the handles are foot, head, belly"),
    (lambda s: s.move_affine("tail", ROTATION), "there is no handle 'tail'; the handles are"),
    (lambda s: s.move("head", euler=(0, 0)), "euler of 'head' needs three numbers, got (0, 0)"),
    (lambda s: s.move("head", euler=0.5), "euler of 'head' needs three numbers, got 0.5"),
    (lambda s: s.move("head", euler=(0, math.nan, 0)), "euler of 'head' has [1] = nan, but it"),
    (lambda s: s.move("head", translation=[[1, 2, 3]]), "translation of 'head' needs three"),
    (lambda s: s.move("head", translation=(0, 0, math.inf)), "of 'head' has [2] = inf, but it"),
    (lambda s: s.move("head", euler="abc"), "euler of 'head' needs three numbers, got 'abc'"),
    (lambda s: s.move("head", euler=[[1], []]), "euler of 'head' needs three numbers, got [[1]"),
    (
        lambda s: s.step(0.1, {"head": (0, 0, 0)}),
        "step: the motion of 'head' must be a pair of a rotation and a translation, such as",
    ),
    (
        lambda s: s.move_all({"head": 0.5}),
        "move: the motion of 'head' must be a pair of",
    ),
    (lambda s: s.step(0.1, ((0, 0, 0), (0, 0, 1))), "step: the motions are a tuple, but a mapping"),
    (lambda s: s.move_affine("head", np.eye(4)), "matrix of 'head' needs a (3, 4) matrix, got"),
    (lambda s: s.move_affine("head", NOT_FINITE), "matrix of 'head' has [1, 1] = nan, but it must"),
    (lambda s: s.move_affine("foot", STRETCH), "'foot' is the reference of all other handles and"),
    (lambda s: s.move_affine("foot", MIRROR), "'foot' is the reference of all other handles and"),
    (lambda s: s.pose(np.zeros(6)), "parameters have shape (6,), but 2 moving handles need (12,)"),
    (lambda s: s.pose(np.full(12, np.nan)), "parameter 0, translation x of 'head', is not finite"),
]


@pytest.mark.parametrize(("call", "message"), WRONG)
def test_a_wrong_move_is_refused_and_changes_nothing(
    posing_model: ReducedModel, call: Callable[[Session], Any], message: str
) -> None:
    session = posing_model.session()
    session.move("foot", euler=(0, 0, 0.1))
    session.move("head", euler=(0.2, 0, 0))
    before = session.vertices
    with pytest.raises(ValueError, match=re.escape(message)) as caught:
        call(session)
    assert "\n" not in str(caught.value)
    assert np.array_equal(session.vertices, before)
    session.solve()
    untouched = posing_model.session()
    untouched.move("foot", euler=(0, 0, 0.1))
    untouched.move("head", euler=(0.2, 0, 0))
    untouched.solve()
    assert np.array_equal(session.vertices, untouched.vertices), "the handles did not move either"


@pytest.mark.parametrize(
    "options",
    [
        {"tolerance": 0.0},
        {"tolerance": -1.0},
        {"tolerance": math.nan},
        {"max_iterations": 0},
        {"max_evaluations": 0},
        {"max_iterations": 10**30},
        {"max_evaluations": 2**31},
    ],
)
def test_options_that_are_out_of_range_are_refused(
    posing_model: ReducedModel, options: dict[str, Any]
) -> None:
    with pytest.raises(ValueError, match=r"Session: tolerance .* max_evaluations .* positive"):
        posing_model.session(**options)


@pytest.mark.parametrize("option", ["minimizer", "precision"])
def test_an_unknown_choice_is_refused(posing_model: ReducedModel, option: str) -> None:
    with pytest.raises(ValueError, match=f"Session: unknown {option} 'best'; known are"):
        posing_model.session(**{option: "best"})


def test_a_huge_move_is_reported_and_can_be_undone(
    posing_model: ReducedModel,
) -> None:
    session = posing_model.session()
    session.move("head", euler=(0.2, 0, 0))
    before = session.vertices
    report = session.move("head", translation=(1e200, 0, 0))
    assert report.status == "not_finite" and not report.converged
    assert np.array_equal(session.vertices, before)
    assert session.solve().converged, "the handle is where it was"
    assert session.vertices == pytest.approx(before, abs=1e-3)
    assert session.move("head", euler=(0.2, 0, 0)).converged
    assert session.vertices == pytest.approx(before, abs=1e-3)
