"""Backend: the interface for solving the samples of a run, here or elsewhere."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .solved import Solved

FloatArray = NDArray[np.float64]


class Backend(Protocol):
    """Solves samples, on threads of this process or on an executor's workers."""

    def submit(self, samples: Sequence[int], inputs: FloatArray, starts: FloatArray) -> None:
        """Adds samples: numbers, inputs (k, input_size), starts (k, 3n)."""
        ...

    def wait(self, timeout: float) -> list[Solved]:
        """Newly finished samples, after at most `timeout` seconds."""
        ...

    def running(self) -> dict[int, int]:
        """Evaluations so far of unfinished samples, by number, as far as known."""
        ...

    def no_more(self) -> None:
        """Declares that all samples are submitted."""
        ...

    def cancel(self) -> None:
        """Ends all solves soon; returns at once."""
        ...

    def close(self) -> None:
        """Cancels unfinished samples, and frees everything."""
        ...

    def stop(self, seconds: float) -> list[Solved]:
        """Cancels, and returns finished samples once solvers have stopped or the time is up."""
        ...
