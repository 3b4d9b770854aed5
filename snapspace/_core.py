"""The compiled core: the widest of its builds that this processor can run.

``SNAPSPACE_LEVEL`` (``baseline``, ``v3`` or ``v4``) forces one, for tests and comparisons. Results agree across levels up to
rounding; within a level they are bitwise reproducible.
"""

from __future__ import annotations

import importlib
import os
from types import ModuleType

from snapspace._cpu_level import cpu_level

#: Builds by the x86-64 level that they need; other processors have level 0 and take the plain build.
BUILDS = {"v4": 4, "v3": 3, "baseline": 0}


def available_levels() -> list[str]:
    """Names of the builds that this processor can run, widest first."""
    level = cpu_level()
    return [name for name, needed in BUILDS.items() if level >= needed]


def _chosen_level() -> str:
    available = available_levels()
    wanted = os.environ.get("SNAPSPACE_LEVEL")
    if not wanted:
        return available[0]
    if wanted not in BUILDS:
        raise ImportError(f"SNAPSPACE_LEVEL={wanted}: known levels are {', '.join(BUILDS)}")
    if wanted not in available:
        raise ImportError(
            f"SNAPSPACE_LEVEL={wanted}: this processor runs {', '.join(available)}; unset the variable"
        )
    return wanted


level = _chosen_level()
core: ModuleType = importlib.import_module(f"snapspace._core_{level}")
