"""Backend: what solves the samples of a run, wherever it does."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .solved import Solved

FloatArray = NDArray[np.float64]


class Backend(Protocol):
    """What solves samples: threads here, or an executor's workers."""

    def submit(self, samples: Sequence[int], inputs: FloatArray, starts: FloatArray) -> None:
        """Adds samples: numbers, inputs (k, input_size), starts (k, 3n)."""
        ...

    def wait(self, timeout: float) -> list[Solved]:
        """Samples that are finished, after at most `timeout` seconds."""
        ...

    def running(self) -> dict[int, int]:
        """Evaluations so far of samples that are not finished, as far as it is known."""
        ...

    def no_more(self) -> None:
        """Tells that all samples are submitted."""
        ...

    def cancel(self) -> None:
        """Ends all solves soon; returns at once."""
        ...

    def close(self) -> None:
        """Cancels what is left, and lets go of everything."""
        ...

    def stop(self, seconds: float) -> list[Solved]:
        """Cancels, and gives what is finished when solvers have stopped or time is up."""
        ...
