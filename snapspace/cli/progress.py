"""Progress over samples: a bar on a terminal, a line for every tenth in a log."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, Task, TextColumn
from rich.text import Text

from .console import console, notice
from .units import in_time

Report = Callable[[int, int], None]
# Samples end in waves, so the rate is taken over a long time.
_RATE_PERIOD = 600.0


@contextmanager
def sample_progress(
    label: str, *, done: int = 0, total: int, unit: str = "samples"
) -> Iterator[Report]:
    """Gives a callable(done, total) to be called now and then; `done` samples exist already."""
    screen = console()
    if not screen.is_terminal:
        yield _Log(label, done, unit)
        return
    columns = (
        TextColumn("{task.description}"),
        BarColumn(bar_width=40),
        MofNCompleteColumn(),
        _RateColumn(),
    )
    with Progress(*columns, console=screen, speed_estimate_period=_RATE_PERIOD) as progress:
        task = progress.add_task(label, completed=done, total=total)
        yield lambda now, _: progress.update(task, completed=now)


class _RateColumn(ProgressColumn):
    """Time per sample, and the time that is left."""

    def render(self, task: Task) -> Text:
        if task.finished:
            return Text(f"in {in_time(task.finished_time or 0.0)}", style="dim")
        if not task.speed:
            return Text("")
        left = task.remaining or 0.0
        each, eta = 1.0 / task.speed, left / task.speed
        return Text(f"{in_time(each)} each, {in_time(eta)} left", style="dim")


class _Log:
    """One line whenever another tenth is done."""

    def __init__(self, label: str, done: int, unit: str) -> None:
        self.label = label
        self.unit = unit
        self.before = done
        self.begin = time.perf_counter()
        self.tenths: int | None = None

    def __call__(self, done: int, total: int) -> None:
        tenths = 10 * done // total
        if self.tenths is None:
            self.tenths = 10 * self.before // total
        if tenths <= self.tenths:
            return
        self.tenths = tenths
        each = (time.perf_counter() - self.begin) / max(done - self.before, 1)
        left = f", {in_time(each * (total - done))} left" if done < total else ""
        notice(f"{self.label}: {done} of {total} {self.unit}, {in_time(each)} each{left}")
