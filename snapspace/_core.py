"""The compiled core: the widest of its builds that this processor can run.

A wheel has a build for each x86-64 level; `make setup` makes only that of its machine.
``SNAPSPACE_LEVEL`` (``baseline``, ``v3`` or ``v4``) forces one, for tests and comparisons. Results
agree across levels up to rounding; within a level they are bitwise reproducible.
"""

from __future__ import annotations

import importlib
import importlib.util
import os
from typing import Any

from snapspace._cpu_level import cpu_level

#: Builds, with the x86-64 level that each needs. Other processors have level 0: the baseline.
BUILDS = {"v4": 4, "v3": 3, "baseline": 0}


def available_levels() -> list[str]:
    """Names of the builds that are installed and that this processor can run, widest first."""
    level = cpu_level()
    return [
        name
        for name, needed in BUILDS.items()
        if level >= needed and importlib.util.find_spec(f"snapspace._core_{name}") is not None
    ]


def _chosen_level() -> str:
    available = available_levels()
    wanted = os.environ.get("SNAPSPACE_LEVEL")
    if not available:
        raise ImportError(
            "snapspace: none of the installed builds of the core runs on this processor; they were "
            "built on another machine, for that machine only: run `make setup` here, or install a "
            "wheel"
        )
    if not wanted:
        return available[0]
    if wanted not in BUILDS:
        raise ImportError(f"SNAPSPACE_LEVEL={wanted}: known levels are {', '.join(BUILDS)}")
    if wanted not in available:
        raise ImportError(
            f"SNAPSPACE_LEVEL={wanted}: available here are {', '.join(available)} (installed, and "
            "supported by this processor); unset it"
        )
    return wanted


level = _chosen_level()
core = importlib.import_module(f"snapspace._core_{level}")


def __getattr__(name: str) -> Any:
    # forwards the names of the compiled module; _core.pyi lists them
    return getattr(core, name)
