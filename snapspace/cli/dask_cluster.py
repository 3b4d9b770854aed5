"""--dask: samples are solved on a cluster."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from .. import __version__
from .._core import level
from ..extras import need_extra
from .console import notice, one_line

CONNECT_SECONDS = 10.0


@contextmanager
def dask_executor(address: str | None) -> Iterator[Executor | None]:
    """Yields the executor of the cluster with a scheduler at `address`, or None without one.

    Raises
    ------
    ValueError
        If dask.distributed is not installed, there is no scheduler at the address, or it has no
        worker or one with another version of snapspace.
    """
    if address is None:
        yield None
        return
    if not re.search(r":\d+$", address):
        raise ValueError(f"--dask {address}: this is not an address such as tcp://127.0.0.1:8786")
    client = _client(address)
    try:
        _check_workers(client, address)
        yield client.get_executor()
    finally:
        client.close()


def _client(address: str) -> Any:
    need_extra("dask", who="--dask")
    distributed: Any = import_module("distributed")
    with warnings.catch_warnings():
        # dask would print a table of all packages; the relevant ones are checked below
        warnings.simplefilter("ignore", distributed.versions.VersionMismatchWarning)
        try:
            return distributed.Client(address, timeout=CONNECT_SECONDS, set_as_default=False)
        except (OSError, ValueError) as error:
            raise ValueError(
                f"--dask {address}: no scheduler answers ({one_line(str(error))}); start one with "
                "'dask scheduler', and workers with 'dask worker'"
            ) from None


def _check_workers(client: Any, address: str) -> None:
    """ValueError unless all workers have our version; a notice if their rounding differs."""
    workers = client.get_versions(packages=["snapspace"])["workers"]
    if not workers:
        raise ValueError(
            f"--dask {address}: the cluster has no workers; start some with 'dask worker {address}'"
        )
    for name, versions in sorted(workers.items()):
        found = versions["packages"].get("snapspace")
        if found != __version__:
            has = f"snapspace {found}" if found else "no snapspace"
            raise ValueError(
                f"--dask {address}: worker {name} has {has}, but this is snapspace {__version__}; "
                "install the same on all workers"
            )
    # a worker that is lost meanwhile gives no answer, but no samples either
    for name, built_for in sorted(client.run(core_level, on_error="ignore").items()):
        if built_for != level:
            notice(
                f"notice: worker {name} runs the {built_for} build, this machine {level}: its "
                "results differ by rounding"
            )
            break


def core_level() -> str:
    """The processor level that the compiled core was built for; run on the workers."""
    return level
