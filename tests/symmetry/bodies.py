"""Bodies with a known mirror plane, shared by the tests."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from snapspace import HandleBox, Handles, MirrorPlane, PosingProblem, StVK, TetMesh
from snapspace.generators import creature_handles

from ..snapshots.creatures import creature

#: Mirror plane of the creature, whose vertices are mirror images of each other.
PLANE = MirrorPlane((0, 1, 0))


def body() -> TetMesh:
    return creature(5000)


@cache
def twins() -> NDArray[np.intp]:
    """The vertex at the mirror image of each vertex of the creature."""
    vertices = body().vertices
    away, twin = map(np.asarray, cKDTree(vertices).query(PLANE.points(vertices)))
    assert away.max() == 0
    return twin


def left_ear() -> NDArray[np.intp]:
    _, y, z = body().vertices.T
    return np.flatnonzero((y > 0.25) & (z > 1.9))


@cache
def one_ear() -> PosingProblem:
    """The creature with its feet held, and a handle on one side only."""
    handles = Handles([creature_handles(body())["feet"], left_ear()], names=["feet", "left ear"])
    domain = HandleBox(translation=0.2, angle=0.6)
    return PosingProblem(body(), handles, domain=domain, material=StVK(lam=1, mu=1))
