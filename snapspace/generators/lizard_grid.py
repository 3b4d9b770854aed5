"""The lizard's grid: a torso and six limbs of cells on one lattice, cut into tets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from snapspace.generators.bar import kuhn_paths

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

# The torso has 4 x 3 x 2 blocks, x forward, y to the left, z up. Limbs start one block wide.
BLOCK = 0.25
TORSO = (4, 3, 2)


@dataclass(frozen=True)
class Limb:
    """A limb that grows out of one block of the torso's surface.

    Attributes
    ----------
    block : (int, int, int)
        Indices of the block along x, y, z.
    axis, sign : int
        Direction: axis 0, 1 or 2, and 1 or -1 along it.
    length : float
        Length from the torso's surface to the tip.
    tip : float
        Width of the tip relative to the base.
    bend, twist : float
        Typical angles of a pose over the whole limb, in radians.
    """

    block: tuple[int, int, int]
    axis: int
    sign: int
    length: float
    tip: float
    bend: float
    twist: float


LIMBS = (
    Limb((0, 1, 1), 0, -1, length=2.5, tip=0.25, bend=1.6, twist=1.0),  # tail
    Limb((3, 1, 1), 0, 1, length=0.8, tip=0.8, bend=0.8, twist=0.6),  # neck and head
    *(
        Limb((x, y, 0), 2, -1, length=0.9, tip=0.6, bend=0.9, twist=0.3)  # legs
        for x in (0, 3)
        for y in (0, 2)
    ),
)


@dataclass(frozen=True)
class LizardGrid:
    """Vertices at rest, tets, and the vertices of the limbs.

    Attributes
    ----------
    vertices : ndarray, (n, 3)
        Rest positions.
    tets : ndarray, (m, 4) int32
        Vertex indices.
    limbs : tuple of int arrays
        Vertices of each of `LIMBS`, without those on the torso's surface.
    """

    vertices: FloatArray
    tets: NDArray[np.int32]
    limbs: tuple[IntArray, ...]


def lizard_grid(tets: int) -> LizardGrid:
    """Makes the grid with about `tets` tets: whole cells across blocks, then layers to match."""
    across, layers = _resolution(tets)
    lowest = _cells(across, layers)
    steps = np.array(np.meshgrid(*[[0, 1]] * 3, indexing="ij")).reshape(3, -1).T
    corners = lowest[:, None, :] + steps  # corner 4 x + 2 y + z of each cell
    lattice, index = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    index = index.reshape(-1, 8)
    paths = np.stack(kuhn_paths(np.array([4, 2, 1])))
    cut = index[:, paths].reshape(-1, 4).astype(np.int32)
    vertices, limbs = _at_rest(lattice, across, layers)
    return LizardGrid(vertices, cut, limbs)


def _resolution(tets: int) -> tuple[IntArray, list[int]]:
    """Cells across a block along x, y, z, and layers of each limb."""
    chosen: tuple[IntArray, list[int]] | None = None
    level = 0
    while True:
        across = np.array([1 + (level + 2 - axis) // 3 for axis in range(3)])
        torso = int(np.prod(TORSO) * np.prod(across))
        width = [int(np.prod(np.delete(across, limb.axis))) for limb in LIMBS]
        # layers as thick as cells are wide at the base; then more until the number is met
        cubes = [limb.length / BLOCK * np.cbrt(np.prod(across)) for limb in LIMBS]
        more = (tets / 6 - torso) / np.dot(width, cubes)
        if chosen is not None and more < 1.0:
            return chosen
        chosen = across, [round(max(more, 1.0) * layer) for layer in cubes]
        level += 1


def _cells(across: IntArray, layers: list[int]) -> IntArray:
    """Lowest corners of all cells on the lattice, (k, 3): the torso, then limb by limb."""
    boxes = [(np.zeros(3, np.int64), np.array(TORSO) * across)]
    for limb, thickness in zip(LIMBS, layers, strict=True):
        low = np.array(limb.block) * across
        high = low + across
        if limb.sign < 0:
            low[limb.axis], high[limb.axis] = -thickness, 0
        else:
            low[limb.axis] = high[limb.axis]
            high[limb.axis] += thickness
        boxes.append((low, high))
    cells = []
    for low, high in boxes:
        ranges = [np.arange(a, b) for a, b in zip(low, high, strict=True)]
        cells.append(np.stack(np.meshgrid(*ranges, indexing="ij"), axis=-1).reshape(-1, 3))
    return np.concatenate(cells)


def _at_rest(
    lattice: IntArray, across: IntArray, layers: list[int]
) -> tuple[FloatArray, tuple[IntArray, ...]]:
    """Positions of lattice points, and the points of each limb."""
    size = BLOCK * np.array(TORSO)
    vertices = lattice * (BLOCK / across)
    limbs = []
    for limb, thickness in zip(LIMBS, layers, strict=True):
        low = np.array(limb.block) * across
        side = np.ones(len(lattice), np.bool_)
        for axis in range(3):
            if axis != limb.axis:
                inside = lattice[:, axis] - low[axis]
                side &= (inside >= 0) & (inside <= across[axis])
        along = lattice[:, limb.axis]
        beyond = -along if limb.sign < 0 else along - TORSO[limb.axis] * across[limb.axis]
        points = np.flatnonzero(side & (beyond > 0))
        distance = beyond[points] / thickness
        middle = BLOCK * (np.array(limb.block) + 0.5)
        vertices[points] = middle + (1.0 - (1.0 - limb.tip) * distance)[:, None] * (
            vertices[points] - middle
        )
        base = size[limb.axis] if limb.sign > 0 else 0.0
        vertices[points, limb.axis] = base + limb.sign * limb.length * distance
        limbs.append(points)
    return vertices, tuple(limbs)
