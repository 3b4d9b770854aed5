"""Conditions that every tet mesh must satisfy, checked slowly and plainly."""

from __future__ import annotations

from collections import Counter
from itertools import combinations

import numpy as np

from snapspace.mesh.tet_mesh import TetMesh


def assert_solid(mesh: TetMesh, *, euler: int) -> None:
    """Positive volumes; faces of one or two tets; a closed surface, one fan at each vertex."""
    assert mesh.volumes.min() > 0.0
    faces = Counter(
        tuple(sorted(face)) for tet in mesh.tets.tolist() for face in combinations(tet, 3)
    )
    assert set(faces.values()) <= {1, 2}
    surface = {face for face, count in faces.items() if count == 1}
    assert surface == {tuple(sorted(face)) for face in mesh.surface.tolist()}
    # Two tets on the two sides of each interior face: the surface's volume is the tets' volume.
    corners = mesh.vertices[mesh.surface]
    enclosed = np.linalg.det(corners).sum() / 6.0
    np.testing.assert_allclose(enclosed, mesh.volume, rtol=1e-12)

    directed = Counter(
        (face[k], face[(k + 1) % 3]) for face in mesh.surface.tolist() for k in range(3)
    )
    assert set(directed.values()) == {1}
    assert all((b, a) in directed for a, b in directed)
    following: dict[int, dict[int, int]] = {}
    for a, b, c in mesh.surface.tolist():
        for v, left, right in ((a, b, c), (b, c, a), (c, a, b)):
            following.setdefault(v, {})[left] = right
    for fan in following.values():
        start = at = next(iter(fan))
        steps = 0
        while steps == 0 or at != start:
            at, steps = fan[at], steps + 1
        assert steps == len(fan)
    assert len(following) - len(directed) // 2 + len(mesh.surface) == euler
