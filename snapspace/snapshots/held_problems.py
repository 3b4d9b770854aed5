"""The problems that tasks of an executor find in their process."""

from __future__ import annotations

import os
import pickle
import threading
from collections import OrderedDict
from dataclasses import dataclass
from weakref import WeakValueDictionary

from .. import _core as core
from ..problem import Problem
from .solver_options import ResolvedOptions

#: A cluster that serves two runs in turns needs no more; a problem with its factor can take GBs.
_MOST_RECEIVED = 2


@dataclass(frozen=True, eq=False)
class RunContext:
    """What a run shares with the tasks in its own process: the problem, and what ends them."""

    problem: Problem
    control: core.SolveControl


class HeldProblems:
    """Problems by the names under which tasks ask for them; safe to use from several threads.

    The one process-wide state of this package. Tasks of an executor have only their process in
    common, and its factor and copy of a problem cost more than a block of samples. Results do not
    depend on what is held. It is bounded: problems that came with a task are the last few, those
    of runs in this process live no longer than the runs.
    """

    def __init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        """Forgets everything."""
        # building a factor under the lock makes one for a process, not one for each of its threads
        self._lock = threading.Lock()
        self._homes: WeakValueDictionary[str, RunContext] = WeakValueDictionary()
        self._received: OrderedDict[str, Problem] = OrderedDict()

    def share(self, run: str, home: RunContext) -> None:
        """Lets tasks in this process find a run's home for as long as it is referenced."""
        with self._lock:
            self._homes[run] = home

    def home(self, run: str, options: ResolvedOptions) -> RunContext | None:
        """The home of a run of this process, with what its options need compiled; else None."""
        with self._lock:
            home = self._homes.get(run)
            if home is not None:
                _ = home.problem.system, options.modes_of(home.problem)
            return home

    def received(self, key: str, payload: bytes | None, options: ResolvedOptions) -> Problem | None:
        """The problem of this key, with what the options need; from the payload if it is new.

        None if it is not there and there is no payload.
        """
        with self._lock:
            problem = self._received.get(key)
            if problem is None:
                if payload is None:
                    return None
                problem = pickle.loads(payload)
                assert problem is not None
                self._received[key] = problem
            _ = problem.system, options.modes_of(problem)
            self._received.move_to_end(key)
            while len(self._received) > _MOST_RECEIVED:
                self._received.popitem(last=False)
            return problem


HELD_PROBLEMS = HeldProblems()
if hasattr(os, "register_at_fork"):
    # a forked worker is a worker like any other; it must not inherit a lock that is taken, nor the
    # control of a run that cannot reach it
    os.register_at_fork(after_in_child=HELD_PROBLEMS.clear)
