"""certify: the certificate of a session's frame."""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING, Any

import numpy as np

from ..certificate import Certificate, ErrorEstimator, grown
from .polish import relative

if TYPE_CHECKING:
    from .session import Session

#: Iterations of the polish in a thorough certificate.
THOROUGH_ITERATIONS = 10
#: The tolerance of that polish. It is never reached, so every sample and frame takes the same
#: number of steps.
NEVER = 1e-300


def certify(session: Session[Any], *, confidence: float, thorough: bool) -> Certificate:
    """The certificate of the current frame, see `Session.certificate`."""
    begin = time.perf_counter()
    if session.velocity.any():
        raise ValueError(
            "certificate: the body is moving, and the estimate is for frames at rest; call solve() "
            "first"
        )
    q, estimator = session.q, _estimator(session)
    # the basis is M-orthonormal: the norm of q is the M-norm of the displacement
    size = float(np.linalg.norm(q)) / math.sqrt(estimator.mass)
    if thorough:
        ratios = estimator.of_movement
        indicator = movement(session)
    else:
        residual, ratios = session.residual(estimator.sample), estimator.of_residual
        indicator = grown(residual, max(size, estimator.rest), estimator.exponent)
    median, bound = ratios.at(q, confidence)
    return Certificate(
        distance=indicator * median,
        relative=relative(indicator * median, size),
        upper_distance=indicator * bound,
        upper_relative=relative(indicator * bound, size),
        confidence=confidence,
        seconds=time.perf_counter() - begin,
    )


def movement(session: Session[Any]) -> float:
    """How far a polish with a fixed number of steps moves the frame: the thorough indicator."""
    return session.polish(iterations=THOROUGH_ITERATIONS, tolerance=NEVER).moved


def _estimator(session: Session[Any]) -> ErrorEstimator:
    estimator: ErrorEstimator | None = session.model.error_estimator
    if estimator is None:
        raise ValueError(
            "certificate: the model has no calibrated error estimate; make one with "
            "snapspace.calibrate(model)"
        )
    if estimator.dimension != len(session.q):
        raise ValueError(
            f"certificate: the error estimate was calibrated for dimension {estimator.dimension}, "
            f"but the session has {len(session.q)}; use snapspace.calibrate on the model of that "
            "dimension"
        )
    return estimator
