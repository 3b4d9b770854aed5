"""Linear algebra whose rounding does not depend on the machine's number of cores."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

from threadpoolctl import threadpool_limits

P = ParamSpec("P")
R = TypeVar("R")


def single_threaded_blas(function: Callable[P, R]) -> Callable[P, R]:
    """Decorator: NumPy's and SciPy's linear algebra stays on one thread inside of the function.

    BLAS splits long sums between its threads, so that the last bits of a product depend on how many
    there are. What a model is made of should not, and these products take well under a second.
    """

    @wraps(function)
    def limited(*args: P.args, **kwargs: P.kwargs) -> R:
        with threadpool_limits(limits=1, user_api="blas"):
            return function(*args, **kwargs)

    return limited
