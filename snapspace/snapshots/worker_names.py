"""Names of worker processes, and how to send a task to one of them."""

from __future__ import annotations

import os
import socket
import sys
from concurrent.futures import Executor
from typing import Any


def worker_name() -> str:
    """Name of this process among the workers of an executor: its address if dask runs it."""
    distributed: Any = sys.modules.get("distributed")
    if distributed is not None:
        try:
            return str(distributed.get_worker().address)
        except ValueError:  # dask is loaded, but this process is not one of its workers
            pass
    return f"{socket.gethostname()}:{os.getpid()}"


def for_worker(executor: Executor, name: str) -> dict[str, Any]:
    """Arguments of `executor.submit` that send a task to the worker of this name.

    These are for dask's executor; if that worker is gone, the task goes to another one. Empty for
    other executors, which cannot choose a worker.
    """
    if type(executor).__module__.startswith("distributed."):
        return {"workers": [name], "allow_other_workers": True}
    return {}
