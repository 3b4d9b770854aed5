"""posing_loop: the compiled solver of a posing model."""

from __future__ import annotations

from typing import Any

from .. import _core as core
from ..reduction import Cubature, FullEnergy, PosingModel
from .full_loop import FullPosingLoop

SINGLE_CUBATURE = (
    "Session: precision 'single' is for exact quartics only; a cubature always keeps its rows in "
    "single precision"
)


def posing_loop(model: PosingModel, *, single: bool) -> Any:
    """The loop for the model's energy; ValueError for a cubature in single precision."""
    elastic, handles = model.elastic, model.handles
    if isinstance(elastic, FullEnergy):
        return FullPosingLoop(model, single=single)
    if not isinstance(elastic, Cubature):
        return core.PosingLoop(elastic.coefficients, handles.K, handles.L, handles.S, single=single)
    if single:
        raise ValueError(SINGLE_CUBATURE)
    energy = elastic.core_rows, elastic.weights, elastic.material.core
    quadratic = handles.K if elastic.remainder is None else handles.K + elastic.remainder
    return core.CubatureLoop(*energy, quadratic, handles.L, handles.S)
