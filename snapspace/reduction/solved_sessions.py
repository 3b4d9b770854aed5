"""solved_sessions and functions based on it: reduced solutions at given parameters."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .reduced_model import ReducedModel

FloatArray = NDArray[np.float64]


def solved_sessions(
    model: ReducedModel, parameters: FloatArray, *, tolerance: float | None = None
) -> Iterator[Any]:
    """A session of the model, solved for each of the parameters (k, p) in turn.

    Each solve starts from tau, so that a solution does not depend on the others.

    tolerance : as for `Session`
    """
    session = model.session(tolerance=tolerance)
    for w in parameters:
        session.reset()
        session.set_parameters(w)
        yield session


def solved_coordinates(
    model: ReducedModel, parameters: FloatArray, *, tolerance: float | None = None
) -> FloatArray:
    """The coordinates (k, d) of these solutions."""
    coordinates = np.empty((len(parameters), model.dimension))
    sessions = solved_sessions(model, parameters, tolerance=tolerance)
    for q, session in zip(coordinates, sessions, strict=True):
        q[:] = session.q
    return coordinates


def solved_shapes(model: ReducedModel, parameters: FloatArray) -> FloatArray:
    """Their shapes (k, 3n)."""
    return model.subspace.shapes(solved_coordinates(model, parameters))


def reduced_solutions(model: ReducedModel, parameters: FloatArray) -> FloatArray:
    """Their displacements (k, 3n) from the problem's base."""
    return solved_shapes(model, parameters) - model.problem.base
