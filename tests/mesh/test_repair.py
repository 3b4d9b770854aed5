"""repair_tets: each fault is mended and listed, or refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from snapspace.mesh import TetMesh, repair_tets

from .boxes import box_arrays


def test_a_valid_mesh_comes_back_unchanged() -> None:
    vertices, tets = box_arrays()
    mesh, notes = repair_tets(vertices, tets)
    assert mesh.fingerprint == TetMesh(vertices, tets).fingerprint
    assert notes == []


def test_every_fault_is_mended_and_listed() -> None:
    vertices, tets = box_arrays()
    island = np.array([[9, 9, 9], [10, 9, 9], [9, 10, 9], [9, 9, 10]])
    planted = tets.copy()
    planted[[1, 4]] = planted[[1, 4]][:, [0, 1, 3, 2]]
    flat = [[0, 1, 2, 10]]  # 0, 1, 2 lie on a line
    repeats = [[0, 1, 1, 4], [3, 3, 3, 3]]
    all_vertices = np.concatenate([[[7, 7, 7]], vertices, island])
    all_tets = np.concatenate(
        [planted, flat, repeats, planted[:1, [2, 0, 1, 3]], [[27, 28, 29, 30]]]
    )
    mesh, notes = repair_tets(all_vertices, all_tets + 1)
    assert notes == [
        "dropped 2 of 53 tets with a repeated vertex",
        "dropped 1 of 51 tets with the same vertices as an earlier tet",
        "dropped 1 of 50 tets of zero volume",
        "reoriented 2 of 49 tets, which were inverted",
        "kept the largest of 2 components, 48 of 49 tets",
        "dropped 5 of 32 vertices, which belong to no tet",
    ]
    assert np.array_equal(mesh.vertices, vertices)
    assert np.array_equal(np.sort(mesh.tets, axis=1), np.sort(tets, axis=1))
    assert mesh.volume == pytest.approx(1.0)


def test_tets_with_vertices_of_their_own_are_joined() -> None:
    """Files with a value per corner of each tet; the largest component was a single tet."""
    vertices, tets = box_arrays()
    alone = np.arange(tets.size).reshape(-1, 4)
    with pytest.raises(ValueError, match="165 vertices have the position of one of another compon"):
        TetMesh(vertices[tets].reshape(-1, 3), alone)
    mesh, notes = repair_tets(vertices[tets].reshape(-1, 3), alone)
    assert notes == [
        "merged 165 of 192 vertices with others at the same position, which joins components"
    ]
    assert np.array_equal(mesh.vertices[mesh.tets], vertices[tets])
    assert len(mesh.vertices) == len(vertices)


def test_the_sides_of_a_slit_stay_apart() -> None:
    """They belong to one component, and the mesh is valid; an island does not change that."""
    vertices, tets = box_arrays()
    inner = int(np.flatnonzero((vertices == 0.5).all(axis=1))[0])
    side = (tets == inner).any(axis=1) & (vertices[tets].mean(axis=1)[:, 0] > 0.5)
    slit = np.where((tets == inner) & side[:, None], len(vertices), tets)
    points = np.concatenate([vertices, vertices[[inner]]])
    assert repair_tets(points, slit)[1] == []
    island = np.array([[9, 9, 9], [10, 9, 9], [9, 10, 9], [9, 9, 10]])
    both = np.concatenate([slit, [[28, 29, 30, 31]]])
    mesh, notes = repair_tets(np.concatenate([points, island]), both)
    assert notes[0].startswith("kept the largest of 2 components")
    assert len(mesh.vertices) == len(points)


@settings(max_examples=40)
@given(st.integers(0, 2**32 - 1))
def test_any_mixture_of_faults_ends_in_a_valid_mesh(seed: int) -> None:
    rng = np.random.default_rng(seed)
    vertices, tets = box_arrays()
    keep = rng.random(len(tets)) < 0.4
    keep[rng.integers(len(tets))] = True
    tets = tets[keep]
    swapped = rng.random(len(tets)) < 0.3
    tets[swapped] = tets[swapped][:, [1, 0, 2, 3]]
    junk = rng.integers(0, len(vertices), size=(rng.integers(0, 4), 4))
    mesh, _ = repair_tets(vertices, np.concatenate([tets, junk]))
    again, notes = repair_tets(mesh.vertices, mesh.tets)
    assert notes == [] and again.fingerprint == mesh.fingerprint


@pytest.mark.parametrize(
    ("vertices", "tets", "message"),
    [
        ([[0, 0, np.nan]], [[0, 0, 0, 0]], "repair_tets: vertex 0 is not finite"),
        ([[0, 0, 0]], [[0, 0, 0, 5]], "tet 0 has vertex index 5, but vertices has 1 rows"),
        ([[0, 0, 0]], [[0.0, 0, 0, 5]], "tets must be integers"),
        ([[0, 0, 0]], np.empty((0, 4), dtype=int), "there are no tets"),
        ([[0, 0, 0]], [[0, 0, 0, 0]], "no tet would be left after dropping the 1 tets with a rep"),
        (
            [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]],
            [[0, 1, 2, 3]],
            "no tet would be left after dropping the 1 tets of zero volume",
        ),
    ],
)
def test_refuses_what_cannot_be_mended(vertices: ArrayLike, tets: ArrayLike, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        repair_tets(vertices, tets)
