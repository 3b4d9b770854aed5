from __future__ import annotations

import numpy as np

from snapspace import ElasticEnergy, StVK, TetMesh
from snapspace.generators import bar

from ..shapes import CORNER_TET, deformed, irregular_bar


def test_counts_the_planted_inversions() -> None:
    """Pushing an apex through the face that its tet shares inverts that tet only."""
    vertices = np.vstack([CORNER_TET, [[1.0, 1.0, 1.0], [-1.0, 0.2, 0.2]]])
    mesh = TetMesh(vertices, [[0, 1, 2, 3], [1, 2, 3, 4], [0, 3, 2, 5]])
    energy = ElasticEnergy(mesh, StVK())
    x = vertices.copy()
    assert energy.inverted_tets(x) == 0
    x[4] = [0.1, 0.1, 0.1]
    assert energy.inverted_tets(x) == 1
    x[5] = [0.1, 0.2, 0.2]
    assert energy.inverted_tets(x) == 2


def test_a_flattened_tet_counts_as_inverted() -> None:
    mesh = bar(2, 2, 2, length=2.0, width=2.0, height=2.0)  # coordinates without rounding
    flattened = mesh.vertices * [1.0, 1.0, 0.0]
    assert ElasticEnergy(mesh, StVK()).inverted_tets(flattened) == len(mesh.tets)


def test_agrees_with_the_signed_volumes_of_the_deformed_mesh() -> None:
    mesh = irregular_bar()
    x = deformed(mesh, 0.6)
    corners = x.reshape(-1, 3)[mesh.tets]
    negative = int((np.linalg.det(corners[:, 1:] - corners[:, :1]) <= 0).sum())
    assert 0 < negative < len(mesh.tets)
    assert ElasticEnergy(mesh, StVK()).inverted_tets(x) == negative
