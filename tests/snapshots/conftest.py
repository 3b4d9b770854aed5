"""Worker processes, which take a second to start and are made once."""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor

import pytest

WORKERS = 2
#: Iterations until a worker factors an interpolation's own matrix; every sample needs more.
WORKERS_PATIENCE = 17
#: The code that a worker runs first, so that none is idle while another one imports.
READY = f"""
import snapspace, time
snapspace.problem.solver_traits.PATIENCE = {WORKERS_PATIENCE}
time.sleep(0.3)
"""


@pytest.fixture(scope="package")
def processes() -> Iterator[ProcessPoolExecutor]:
    """Two running processes, which share nothing with this one."""
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(
        WORKERS, mp_context=context, initializer=exec, initargs=(READY,)
    ) as pool:
        list(pool.map(exec, ["import time; time.sleep(0.2)"] * WORKERS))
        yield pool
