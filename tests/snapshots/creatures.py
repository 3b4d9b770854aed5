"""Creatures to pose: thin parts that bend, and samples that invert a few tets."""

from __future__ import annotations

from functools import cache

import numpy as np

from snapspace import HandleBox, Handles, Material, PosingProblem, StVK, generators

#: Made once for all tests: a third of a second.
creature = cache(generators.creature)


def posing_creature(tets: int, material: Material | None = None) -> PosingProblem:
    """A creature held at its feet and moved by its head; the default material is the paper's."""
    mesh = creature(tets)
    parts = generators.creature_handles(mesh)
    handles = Handles([parts["feet"], parts["head"]])
    domain = HandleBox(translation=0.3, angle=np.pi / 4)
    return PosingProblem(mesh, handles, domain=domain, material=material or StVK())


def adding_a_tail(old: PosingProblem) -> PosingProblem:
    """The same creature, also moved by its tail."""
    return old.with_handles(
        old.handles.adding("tail", generators.creature_handles(old.mesh)["tail"])
    )
