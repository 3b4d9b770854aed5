"""WorkspaceJobs: the background work of one page."""

from __future__ import annotations

from collections.abc import Callable

from .job import Job
from .page_channel import PageChannel
from .polish_jobs import PolishJobs

#: How long to wait for stopped work to end; solvers check between the parts of an iteration.
STOP_SECONDS = 0.4


class WorkspaceJobs:
    """Opening a body or computing models, one at a time.

    Meanwhile an upload may be read, a surface checked, and shapes polished.

    Parameters
    ----------
    emit : PageChannel
    failed : callable
        Called with the number of a request and the error of its work.
    """

    def __init__(self, emit: PageChannel, failed: Callable[[int, Exception], None]) -> None:
        self._failed = failed
        self._work: Job | None = None
        self._check: Job | None = None
        self._reading: Job | None = None
        self._uploaded = 0  # request of the last upload, or of a cancel since
        self.polishes = PolishJobs(emit, failed)

    @property
    def working(self) -> bool:
        """Whether a body is being opened, or models are being computed."""
        return self._work is not None and self._work.running

    def begin(self, work: Callable[[], None], *, request: int) -> None:
        """Begins work for a request, after `end_work`."""
        self._work = Job(work, failed=lambda error: self._failed(request, error))

    def end_work(self) -> None:
        """Stops the work, and waits for a moment until it has ended."""
        if self._work is not None:
            self._work.stop()
            self._work.wait(STOP_SECONDS)

    def read(self, work: Callable[[], None], request: int) -> bool:
        """Begins to read an upload instead of the last one; False after a later request.

        An upload without a number, 0, is always read.
        """
        if 0 < request < self._uploaded:
            return False
        self.stop_reading(request)
        self._reading = Job(work, failed=lambda error: self._failed(0, error))
        return True

    def count_anew(self) -> None:
        """Accepts the next upload with any number."""
        self._uploaded = 0

    def stop_reading(self, request: int) -> None:
        """Stops the reading of uploads up to a request, without waiting."""
        self._uploaded = request
        if self._reading is not None:
            self._reading.stop()

    def check(self, work: Callable[[], None], *, request: int) -> None:
        """Begins a check instead of the last one."""
        if self._check is not None:
            self._check.stop()
        self._check = Job(work, failed=lambda error: self._failed(request, error))

    def stop(self) -> None:
        """Stops and drops all jobs, since the garbage collector does not see their size."""
        all_jobs = (self._work, self._check, self._reading, self.polishes.stop())
        jobs = [job for job in all_jobs if job is not None]
        for job in jobs:
            job.stop()
        for job in jobs:
            job.wait(STOP_SECONDS)
        self._work = self._check = self._reading = None
