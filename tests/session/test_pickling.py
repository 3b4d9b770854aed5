"""Models of every energy can be pickled; sessions say why they cannot."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest

from snapspace import PosingModel

MODELS = ["posing_model", "cubature_model", "blending_model", "blended_cubature_model"]


def frame(model: Any) -> np.ndarray[Any, Any]:
    """The coordinates of one frame; it also evaluates the model's energy."""
    if isinstance(model, PosingModel):
        model.elastic.value(np.zeros(model.dimension))
    session = model.session()
    if hasattr(session, "blend"):
        session.blend([0.2, 0.5, 0.3])
    else:
        session.pose(0.4 * model.problem.domain.half_widths)
    q: np.ndarray[Any, Any] = session.q
    return q


@pytest.mark.parametrize("name", MODELS)
def test_a_used_model_gives_the_same_frames_after_pickling(
    request: pytest.FixtureRequest, name: str
) -> None:
    model = request.getfixturevalue(name)
    expected = frame(model)
    unpickled = pickle.loads(pickle.dumps(model))
    assert type(unpickled) is type(model)
    assert frame(unpickled).tobytes() == expected.tobytes()
    assert frame(copy.deepcopy(model)).tobytes() == expected.tobytes()


@pytest.mark.parametrize("name", MODELS)
def test_a_session_says_why_it_cannot_be_pickled(request: pytest.FixtureRequest, name: str) -> None:
    session = request.getfixturevalue(name).session()
    for attempt in (pickle.dumps, copy.copy, copy.deepcopy):
        with pytest.raises(TypeError, match=r"Session: a session cannot .*; pickle session\.model"):
            attempt(session)
