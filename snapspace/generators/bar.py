"""A rectangular bar cut into a structured grid of tetrahedra."""

from __future__ import annotations

from itertools import permutations

import numpy as np

from snapspace.arguments import require_count, require_positive
from snapspace.mesh.tet_mesh import TetMesh


def bar(
    nx: int = 12,
    ny: int = 3,
    nz: int = 3,
    *,
    length: float = 4.0,
    width: float = 1.0,
    height: float = 1.0,
) -> TetMesh:
    """Fills the box [0, length] x [0, width] x [0, height] with 6 nx ny nz tetrahedra.

    Every grid cell is cut into the six tetrahedra of Kuhn (1960): one for each order in which the
    steps along x, y, z lead from the cell's lowest to its highest corner. All cells are cut in the
    same way, and neighbours match for every nx, ny, nz. (The alternating cut into five needs two
    kinds of cells, and tets of two sizes.)

    Parameters
    ----------
    nx, ny, nz : int
        Cells along x, y, z, at least 1.
    length, width, height : float, default 4, 1, 1
        Size along x, y, z.

    Returns
    -------
    TetMesh
        (nx+1)(ny+1)(nz+1) vertices, z running fastest. All tets have the same volume; with
        cubical cells all dihedral angles are 45, 60 or 90 degrees.

    Raises
    ------
    ValueError
        If a count is below 1 or a size is not positive and finite.
    """
    counts = [
        require_count("bar", name, value, at_least=1)
        for name, value in (("nx", nx), ("ny", ny), ("nz", nz))
    ]
    sizes = [
        require_positive("bar", name, value)
        for name, value in (("length", length), ("width", width), ("height", height))
    ]
    axes = [np.linspace(0.0, s, c + 1) for s, c in zip(sizes, counts, strict=True)]
    vertices = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)

    node = np.arange(len(vertices)).reshape([c + 1 for c in counts])
    lowest = node[:-1, :-1, :-1].reshape(-1)
    steps = np.array([node[1, 0, 0], node[0, 1, 0], node[0, 0, 1]])
    tets = np.stack([lowest[:, None] + path for path in kuhn_paths(steps)], axis=1)
    return TetMesh(vertices, tets.reshape(-1, 4).astype(np.int32))


def kuhn_paths(steps: np.ndarray) -> list[np.ndarray]:
    """Index offsets of the corners of the six tets of a cell, positively oriented."""
    paths = []
    for order in permutations(range(3)):
        path = np.concatenate([[0], np.cumsum(steps[list(order)])])
        if np.linalg.det(np.eye(3)[list(order)]) < 0:
            path[[1, 2]] = path[[2, 1]]
        paths.append(path)
    return paths
