"""Deterministic, well-shaped tetrahedral meshes for tests, demos and benchmarks."""

from __future__ import annotations

from snapspace.generators.bar import bar
from snapspace.generators.creature import creature
from snapspace.generators.creature_handles import CREATURE_REGIONS, creature_handles
from snapspace.generators.creature_paint import creature_paint
from snapspace.generators.creature_shape import CREATURE_LOWER, CREATURE_UPPER, creature_shape
from snapspace.generators.cylinder import cylinder
from snapspace.generators.helix import helix
from snapspace.generators.lizard_poses import lizard_poses
from snapspace.stuffing.isosurface_stuffing import stuff

__all__ = [
    "CREATURE_LOWER",
    "CREATURE_REGIONS",
    "CREATURE_UPPER",
    "bar",
    "creature",
    "creature_handles",
    "creature_paint",
    "creature_shape",
    "cylinder",
    "helix",
    "lizard_poses",
    "stuff",
]
