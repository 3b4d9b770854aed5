"""Live loops with known objectives, and options to solve them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from snapspace import ReducedModel
from snapspace import _core as core
from snapspace.reduction import coefficient_count

FloatArray = NDArray[np.float64]
TIGHT: dict[str, Any] = {
    "tolerance": 1e-14,
    "max_iterations": 500,
    "max_evaluations": 2000,
    "value_scale": 1.0,
    "coordinate_scale": 1.0,
}


def pulled(K: FloatArray, force: FloatArray, coefficients: FloatArray | None = None) -> Any:
    """A loop for quartic(q) + q^T K q - 2 force . q: one handle whose first entry is the pull."""
    d = len(K)
    L = np.zeros((1, d, 12))
    L[0, :, 0] = force
    if coefficients is None:
        coefficients = np.zeros(coefficient_count(d))
    loop = core.PosingLoop(coefficients, K, L, np.zeros((1, 4, 4)))
    loop.set_offsets(np.eye(1, 12).reshape(1, 3, 4))
    return loop


def scaled(model: ReducedModel, **options: Any) -> dict[str, Any]:
    scales = {"value_scale": model.value_scale, "coordinate_scale": model.coordinate_scale}
    return {"tolerance": 1e-7, "max_iterations": 300, "max_evaluations": 500, **scales, **options}
