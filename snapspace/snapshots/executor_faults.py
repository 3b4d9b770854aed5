"""Errors for blocks that an executor fails to return."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import BrokenExecutor

_KEPT = "finished samples are in the checkpoint, if there is one; the same call continues from it"


def task_fault(error: BaseException, samples: Sequence[int]) -> BaseException:
    """The error to raise for the exception of a task with these samples.

    A lost worker or cluster gives a ValueError that says what is kept. A ValueError or MemoryError
    of the solve stays one; other errors become a RuntimeError. Ctrl-C in a worker stays unchanged.
    """
    text = _one_line(error)
    if _is_lost_worker(error):
        return ValueError(
            f"executor: lost the worker that solved {named(samples)} ({text}), perhaps because it "
            f"ran out of memory; {_KEPT}"
        )
    if not isinstance(error, Exception):
        return error
    kind = next((kind for kind in (ValueError, MemoryError) if isinstance(error, kind)), None)
    return (kind or RuntimeError)(f"executor: {named(samples)}: {text}")


def cancelled_fault(samples: Sequence[int]) -> ValueError:
    """The error to raise for samples that the executor cancelled, not the run."""
    return ValueError(
        f"executor: cancelled {named(samples)}; an executor does so when it is shut down or loses "
        f"its cluster; {_KEPT}"
    )


def refused_fault(error: Exception, samples: Sequence[int]) -> Exception:
    """The error to raise for an exception of `submit`: broken, shut down, or disconnected."""
    if not (isinstance(error, RuntimeError) or _is_of_dask(error)):
        return error
    return ValueError(f"executor: does not accept {named(samples)} ({_one_line(error)}); {_KEPT}")


def named(samples: Sequence[int]) -> str:
    """The samples in words, for example: samples 8 to 15."""
    if len(samples) == 1:
        return f"sample {samples[0]}"
    if list(samples) == list(range(samples[0], samples[-1] + 1)):
        return f"samples {samples[0]} to {samples[-1]}"
    return f"samples {', '.join(map(str, samples))}"


def _is_lost_worker(error: BaseException) -> bool:
    """Whether a pool broke, or dask.distributed raised the error: KilledWorker, CommClosedError."""
    return isinstance(error, BrokenExecutor) or _is_of_dask(error)


def _is_of_dask(error: BaseException) -> bool:
    # by the name of its package, which need not be installed
    return type(error).__module__.startswith("distributed.")


def _one_line(error: BaseException) -> str:
    text = " ".join(str(error).split())
    return f"{type(error).__name__}: {text}" if text else type(error).__name__
