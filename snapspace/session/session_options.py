"""The options of sessions."""

from __future__ import annotations

from .. import _core as core
from ..arguments import is_finite, is_number, is_whole, shown, wrong_type

MINIMIZERS = {"newton": core.Method.newton, "bfgs": core.Method.bfgs}
PRECISIONS = ("double", "single")


def check_options(
    tolerance: float, max_iterations: int, max_evaluations: int, minimizer: str, precision: str
) -> None:
    """Raises a ValueError for an invalid option."""
    if not is_number(tolerance):
        raise wrong_type("Session", "tolerance", tolerance, "give a positive number")
    for name, count in (("max_iterations", max_iterations), ("max_evaluations", max_evaluations)):
        if not is_whole(count):
            raise wrong_type("Session", name, count, "give a whole number")
    bounds = (max_iterations, max_evaluations)
    if not is_finite(tolerance) or tolerance <= 0 or not all(1 <= n < 2**31 for n in bounds):
        raise ValueError(
            f"Session: tolerance {tolerance}, max_iterations {max_iterations} and "
            f"max_evaluations {max_evaluations} must be positive and finite, the last two below "
            "2^31"
        )
    if minimizer not in tuple(MINIMIZERS):
        raise ValueError(
            f"Session: unknown minimizer {shown(minimizer)}; known are {', '.join(MINIMIZERS)}"
        )
    if precision not in PRECISIONS:
        raise ValueError(
            f"Session: unknown precision {shown(precision)}; known are {', '.join(PRECISIONS)}"
        )
