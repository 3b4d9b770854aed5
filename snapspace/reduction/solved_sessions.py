"""solved_sessions: reduced solutions at given parameters, one after the other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .reduced_model import ReducedModel


def solved_sessions(model: ReducedModel, parameters: NDArray[np.float64]) -> Iterator[Any]:
    """A session of the model, solved for each of the parameters (k, p) in turn.

    Each solve starts from tau, so that a solution does not depend on the others.
    """
    session = model.session()
    for w in parameters:
        session.reset()
        session.set_parameters(w)
        yield session
