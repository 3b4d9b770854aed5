"""PolishJobs: runs one polish at a time for a page, the newest one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..reduction import ReducedModel
from ..stopping import check_stop
from .job import Job
from .messages import Polish
from .polishing import Polishing

#: Longest wait for a stopped polish, which ends after its current iteration.
STOP_SECONDS = 10.0


class PolishJobs:
    """Runs polishes in the background; a new one replaces the running one.

    Parameters
    ----------
    emit : callable
        Called with the binary frame and the message of each finished polish.
    failed : callable
        Called with the request and the error of a polish that fails.
    """

    def __init__(self, emit: Callable[..., Any], failed: Callable[[int, Exception], None]) -> None:
        self._emit, self._failed = emit, failed
        self._job: Job | None = None
        self._polishing: Polishing | None = None  # that of the newest job

    def begin(self, order: Polish, model: ReducedModel) -> None:
        """Starts a polish of a frame of a model."""
        before = self._job
        if before is not None:
            before.stop()

        def work() -> None:
            if before is not None:
                before.wait(STOP_SECONDS)  # they share a session
            check_stop()
            if self._polishing is None or self._polishing.model is not model:
                self._polishing = Polishing(model)
            content, message = self._polishing.polish(order)
            check_stop()
            self._emit(content, message)

        self._job = Job(work, failed=lambda error: self._failed(order.request, error))

    def stop(self) -> Job | None:
        """Stops the running polish soon, and returns its job, if there is one."""
        if self._job is not None:
            self._job.stop()
        return self._job
