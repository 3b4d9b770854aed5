"""A solid cube: with few tets, its factor is as dense as those of large bodies."""

from __future__ import annotations

from snapspace import HandleBox, Handles, PosingProblem, StVK
from snapspace.generators import bar
from snapspace.mesh import TetMesh


def solid_cube(*, flat: float = 1.0) -> PosingProblem:
    """A cube that a cycle suits better than a factor, held at two faces; flat < 1 makes it thinner.

    Its factor has more than 140 entries per column. The material is the paper's. Its samples stop
    by settling, and the bound on evaluations assumes that.
    """
    mesh = bar(18, 18, 18, length=1.0, width=1.0, height=1.0)
    vertices = mesh.vertices * (1.0, 1.0, flat)
    x = vertices[:, 0]
    handles = Handles([x < 0.01, x > 0.99])
    domain = HandleBox(translation=0.1, angle=0.3)
    return PosingProblem(TetMesh(vertices, mesh.tets), handles, domain=domain, material=StVK())
