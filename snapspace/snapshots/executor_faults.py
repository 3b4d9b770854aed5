"""What is said when an executor does not give a block back."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import BrokenExecutor

_KEPT = "finished samples are in the checkpoint, if there is one, and the same call goes on from it"


def task_fault(error: BaseException, samples: Sequence[int]) -> BaseException:
    """What to raise for the exception of a task that had these samples.

    A lost worker or cluster is a ValueError that says what is kept. An error of the solve stays a
    ValueError or MemoryError if it was one, and is a RuntimeError else. Ctrl-C in a worker stays
    what it is.
    """
    said = _one_line(error)
    if _is_lost_worker(error):
        return ValueError(
            f"executor: lost the worker that solved {named(samples)} ({said}), perhaps it ran out "
            f"of memory; {_KEPT}"
        )
    if not isinstance(error, Exception):
        return error
    kind = next((kind for kind in (ValueError, MemoryError) if isinstance(error, kind)), None)
    return (kind or RuntimeError)(f"executor: {named(samples)}: {said}")


def cancelled_fault(samples: Sequence[int]) -> ValueError:
    """What to raise for samples that the executor cancelled, not the run."""
    return ValueError(
        f"executor: cancelled {named(samples)}, as it does when it is shut down or loses its "
        f"cluster; {_KEPT}"
    )


def refused_fault(error: Exception, samples: Sequence[int]) -> Exception:
    """What to raise for the exception of `submit`: broken, shut down, or cut off."""
    if not (isinstance(error, RuntimeError) or _is_of_dask(error)):
        return error
    return ValueError(f"executor: does not take {named(samples)} ({_one_line(error)}); {_KEPT}")


def named(samples: Sequence[int]) -> str:
    """Such as: samples 8 to 15."""
    if len(samples) == 1:
        return f"sample {samples[0]}"
    if list(samples) == list(range(samples[0], samples[-1] + 1)):
        return f"samples {samples[0]} to {samples[-1]}"
    return f"samples {', '.join(map(str, samples))}"


def _is_lost_worker(error: BaseException) -> bool:
    """Whether a pool broke, or dask.distributed itself complains: KilledWorker, CommClosedError."""
    return isinstance(error, BrokenExecutor) or _is_of_dask(error)


def _is_of_dask(error: BaseException) -> bool:
    # known by the name of its package, as it need not be installed
    return type(error).__module__.startswith("distributed.")


def _one_line(error: BaseException) -> str:
    said = " ".join(str(error).split())
    return f"{type(error).__name__}: {said}" if said else type(error).__name__
