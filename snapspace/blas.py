"""Linear algebra whose rounding does not depend on the machine's number of cores."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import threadpoolctl
from threadpoolctl import ThreadpoolController

from .stopping import ctrl_c_at_checks

P = ParamSpec("P")
R = TypeVar("R")


def single_threaded_blas(function: Callable[P, R]) -> Callable[P, R]:
    """Decorator: NumPy's and SciPy's linear algebra stays on one thread inside the function.

    BLAS splits long sums between its threads, so the rounding of a product depends on their number.
    A model should not depend on that, and its products take well under a second. Functions that run
    at the same time on several threads share the limit.
    """

    @wraps(function)
    def limited(*args: P.args, **kwargs: P.kwargs) -> R:
        with ctrl_c_at_checks(), _limit:  # a Ctrl-C between the two would leave the limit set
            return function(*args, **kwargs)

    return limited


class _SharedLimit:
    """The process-wide limit: set by the first to enter, lifted by the last to leave."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._inside = 0
        self._limits: Any = None
        self._controller: ThreadpoolController | None = None
        self._modules = 0  # number of modules when the controller searched for libraries

    def __enter__(self) -> None:
        with self._lock:
            if self._inside == 0:
                _take_control()
                self._limits = self._libraries().limit(limits=1, user_api="blas")
            self._inside += 1

    def _libraries(self) -> ThreadpoolController:
        """The BLAS libraries of this process. A search takes milliseconds: only after imports."""
        if self._controller is None or self._modules != len(sys.modules):
            self._modules = len(sys.modules)
            self._controller = ThreadpoolController()
        return self._controller

    def __exit__(self, *_: object) -> None:
        with self._lock:
            self._inside -= 1
            if self._inside == 0 and self._limits is not None:
                _take_control()
                self._limits.restore_original_limits()
                self._limits = None
                _take_control()


def _take_control() -> None:
    """Lets this thread change OpenBLAS's limit.

    From version 3.8 on, threadpoolctl silently ignores all threads except the first one that
    changed the limit. Our threads take turns under the lock.
    """
    controller: Any = getattr(threadpoolctl, "OpenBLASController", None)
    if hasattr(controller, "clear_controlling_thread"):
        controller.clear_controlling_thread(force=True)


_limit = _SharedLimit()
