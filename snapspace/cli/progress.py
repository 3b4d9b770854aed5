"""Progress of long work: a bar on a terminal, a line per tenth in a log, or a spinner."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, Task, TextColumn
from rich.status import Status
from rich.text import Text

from ..snapshots import SolveProgress
from ..stopping import ctrl_c_at_checks
from .console import console, notice
from .units import in_time

Report = Callable[[int, int], None]
# Samples finish in blocks, so the rate is averaged over a long time, in seconds.
_RATE_PERIOD = 600.0


@contextmanager
def step_progress(
    label: str, *, done: int = 0, total: int, unit: str = "samples"
) -> Iterator[Report]:
    """Yields a callable(done, total) for progress; `done` steps exist already."""
    with _shown(label, done, total, unit) as show:
        yield lambda now, _: show(now, "")


@contextmanager
def sample_progress(
    label: str, *, done: int = 0, total: int, training: bool = False
) -> Iterator[Callable[[SolveProgress], None]]:
    """Yields a `progress` callable for `solve_snapshots`; `done` samples exist already.

    With `training`, for samples of a model, it also shows how well earlier samples represent the
    newest ones.
    """
    with _shown(label, done, total, "samples") as show:
        yield lambda state: show(state.done, _held_out(state) if training else "")


def _held_out(state: SolveProgress) -> str:
    if state.held_out_error is None:
        return ""
    return f"unseen samples within {100 * state.held_out_error:.2g} %"


@contextmanager
def spinner(label: str) -> Iterator[None]:
    """Shows a text while this block runs, for work that does not report progress."""
    with _displayed(console().status(label)):
        yield


@contextmanager
def _shown(label: str, done: int, total: int, unit: str) -> Iterator[Callable[[int, str], None]]:
    screen = console()
    if not screen.is_terminal:
        yield _Log(label, done, total, unit)
        return
    columns = (
        TextColumn("{task.description}"),
        BarColumn(bar_width=40),
        MofNCompleteColumn(),
        _RateColumn(),
        TextColumn("{task.fields[note]}", style="dim"),
    )
    progress = Progress(*columns, console=screen, speed_estimate_period=_RATE_PERIOD)
    with _displayed(progress):
        task = progress.add_task(label, completed=done, total=total, note="")
        yield lambda now, note: progress.update(task, completed=now, note=note)


@contextmanager
def _displayed(display: Progress | Status) -> Iterator[None]:
    """Starts and stops a display completely, since a half-started one leaves the cursor hidden."""
    try:
        with ctrl_c_at_checks():
            display.start()
        yield
    finally:
        with ctrl_c_at_checks():
            display.stop()


class _RateColumn(ProgressColumn):
    """Time per sample, and remaining time."""

    def render(self, task: Task) -> Text:
        if task.finished:
            return Text(f"in {in_time(task.finished_time or 0.0)}", style="dim")
        if not task.speed:
            return Text("")
        left = task.remaining or 0.0
        each, eta = 1.0 / task.speed, left / task.speed
        return Text(f"{in_time(each)} each, {in_time(eta)} left", style="dim")


class _Log:
    """Prints one line whenever another tenth is done."""

    def __init__(self, label: str, done: int, total: int, unit: str) -> None:
        self.label = label
        self.total = total
        self.unit = unit
        self.before = done
        self.begin = time.perf_counter()
        self.tenths: int | None = None

    def __call__(self, done: int, note: str) -> None:
        tenths = 10 * done // self.total
        if self.tenths is None:
            self.tenths = 10 * self.before // self.total
        if tenths <= self.tenths:
            return
        self.tenths = tenths
        each = (time.perf_counter() - self.begin) / max(done - self.before, 1)
        left = self.total - done
        words = [f"{self.label}: {done} of {self.total} {self.unit}", f"{in_time(each)} each"]
        words += [f"{in_time(each * left)} left"] if left else []
        notice(", ".join([*words, note] if note else words))
