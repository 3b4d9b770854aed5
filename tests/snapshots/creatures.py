"""Creatures to pose: thin parts that bend, and samples that invert a few tets."""

from __future__ import annotations

import numpy as np

from snapspace import HandleBox, Handles, Material, PosingProblem, StVK, generators


def posing_creature(tets: int, material: Material | None = None) -> PosingProblem:
    """A creature held at its feet and moved by its head; the default material is the paper's."""
    mesh = generators.creature(tets)
    parts = generators.creature_handles(mesh)
    handles = Handles([parts["feet"], parts["head"]])
    domain = HandleBox(translation=0.3, angle=np.pi / 4)
    return PosingProblem(mesh, handles, domain=domain, material=material or StVK())
