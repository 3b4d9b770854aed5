"""HeldProblems: problems kept in a process for the tasks of executors."""

from __future__ import annotations

import os
import pickle
import threading
from collections import OrderedDict
from dataclasses import dataclass
from weakref import WeakValueDictionary

from .. import _core as core
from ..problem import Problem
from .fast_solve import seed_of
from .predictions import coarse_space
from .solver_options import ResolvedOptions

#: Number of held problems: enough for a cluster that alternates between two runs. A problem with
#: its factor can take gigabytes.
_MOST_RECEIVED = 2


@dataclass(frozen=True, eq=False)
class HeldProblem:
    """A problem, and the coarse space of predictions of its samples, if there are any."""

    problem: Problem
    coarse: core.CoarseSpace | None

    def prepare(self, options: ResolvedOptions) -> HeldProblem:
        """Makes the parts that all tasks share, unless they exist; returns this object."""
        _ = self.problem.system, seed_of(self.problem, options, self.coarse)
        return self


@dataclass(frozen=True, eq=False)
class RunContext:
    """A run's problem and the control that ends its tasks, shared with tasks in its own process."""

    held: HeldProblem
    control: core.SolveControl


class HeldProblems:
    """Problems by the keys with which tasks ask for them; safe to use from several threads.

    This is the only process-wide state of the package. Tasks of an executor share only their
    process, and the copy and factor of a problem cost more than a block of samples. Results do not
    depend on what is held. The state is bounded: it keeps the last few problems that came with a
    task, and problems of runs in this process only as long as the runs exist.
    """

    def __init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        """Forgets everything."""
        # under the lock, one factor is made per process, not one per thread
        self._lock = threading.Lock()
        self._runs: WeakValueDictionary[str, RunContext] = WeakValueDictionary()
        self._received: OrderedDict[str, HeldProblem] = OrderedDict()

    def share(self, run: str, context: RunContext) -> None:
        """Lets tasks in this process find a run's context for as long as it is referenced."""
        with self._lock:
            self._runs[run] = context

    def run_context(self, run: str, options: ResolvedOptions) -> RunContext | None:
        """The context of a run of this process, with its system and modes made; else None."""
        with self._lock:
            context = self._runs.get(run)
            if context is not None:
                context.held.prepare(options)
            return context

    def received(
        self, key: str, payload: bytes | None, options: ResolvedOptions
    ) -> HeldProblem | None:
        """The problem of this key, with system and modes made; from the payload if it is new.

        None if it is not held and there is no payload.
        """
        with self._lock:
            held = self._received.get(key)
            if held is None:
                if payload is None:
                    return None
                problem, basis = pickle.loads(payload)
                held = HeldProblem(problem, coarse_space(problem, basis))
                self._received[key] = held
            held.prepare(options)
            self._received.move_to_end(key)
            while len(self._received) > _MOST_RECEIVED:
                self._received.popitem(last=False)
            return held


HELD_PROBLEMS = HeldProblems()
if hasattr(os, "register_at_fork"):
    # a forked worker must not inherit a locked lock, or the control of a run that cannot reach it
    os.register_at_fork(after_in_child=HELD_PROBLEMS.clear)
