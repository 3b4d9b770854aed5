"""Pairs of problems, before and after a change of handles."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import problems

import snapspace as ss
from snapspace.generators import creature_handles

Pair = tuple[ss.PosingProblem, ss.PosingProblem]


def changed(name: str, change: Callable[[ss.TetMesh, ss.Handles], ss.Handles]) -> Pair:
    """A problem of `problems` in stable neo-Hookean, and the same with other handles."""
    given = problems.read(name)
    old = ss.PosingProblem(given.mesh, given.handles, domain=given.domain)
    return old, old.with_handles(change(old.mesh, old.handles))


def with_tail(mesh: ss.TetMesh, handles: ss.Handles) -> ss.Handles:
    """Adds the Dragon's tail."""
    x, y, _ = mesh.vertices.T
    return handles.adding("tail", np.flatnonzero((x < -3.9) & (y > 0)))


def with_spots_tail(mesh: ss.TetMesh, handles: ss.Handles) -> ss.Handles:
    """Adds Spot's tail."""
    _, y, z = mesh.vertices.T
    return handles.adding("tail", np.flatnonzero((z > 0.85) & (y > -0.4)))


def with_creatures_tail(mesh: ss.TetMesh, handles: ss.Handles) -> ss.Handles:
    """Adds the creature's tail."""
    return handles.adding("tail", creature_handles(mesh)["tail"])


def without(name: str, handle: str) -> Pair:
    """A problem, and the same without a handle."""
    return changed(name, lambda mesh, handles: handles.without(handle))


def backwards(pair: Pair) -> Pair:
    """The inverse change."""
    return pair[1], pair[0]


#: Problems before and after; each call makes them again.
CHANGES: dict[str, Callable[[], Pair]] = {
    "Dragon, and the tail": lambda: changed("dragon", with_tail),
    "creature, and the tail": lambda: changed("creature", with_creatures_tail),
    "Armadillo, and the right hand": lambda: backwards(without("armadillo", "right_hand")),
    "Spot, and the tail": lambda: changed("spot", with_spots_tail),
    "tripod, and the right arm": lambda: backwards(without("tripod", "right")),
    "Dragon, without the tail": lambda: backwards(changed("dragon", with_tail)),
    "creature, without the tail": lambda: backwards(changed("creature", with_creatures_tail)),
    "Armadillo, without the right hand": lambda: without("armadillo", "right_hand"),
    "Spot, without the tail": lambda: backwards(changed("spot", with_spots_tail)),
    "tripod, without the right arm": lambda: without("tripod", "right"),
}
