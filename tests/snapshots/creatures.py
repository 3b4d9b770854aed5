"""Creatures to pose: thin parts that bend, and samples that invert a few tets."""

from __future__ import annotations

import numpy as np

from snapspace import HandleBox, Handles, PosingProblem, generators


def posing_creature(tets: int) -> PosingProblem:
    """A creature held at its feet, its head moved."""
    mesh = generators.creature(tets)
    parts = generators.creature_handles(mesh)
    handles = Handles([parts["feet"], parts["head"]])
    return PosingProblem(mesh, handles, domain=HandleBox(translation=0.3, angle=np.pi / 4))
