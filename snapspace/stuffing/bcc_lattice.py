"""The body-centred cubic lattice and its tetrahedra, near the inside of an implicit shape."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

# The four cell centres around a lattice edge along one axis, in counterclockwise order: their
# offsets along the next two axes (in cyclic order).
_RING = ((0, 0), (-1, 0), (-1, -1), (0, -1))


@dataclass(frozen=True)
class BccLattice:
    """A box of cubic cells. The corners and centres of the cells are the lattice nodes.

    Nodes are numbered corners first, then centres, each with z running fastest. Coordinates are
    whole (corners) or half (centres) multiples of `cell`, so the lattice is bitwise its own mirror
    image in the coordinate planes.

    Attributes
    ----------
    cell : float
        Edge length of the cells, and length of the long edges of the tets. Short edges join a
        corner to a centre; their length is sqrt(3)/2 times `cell`.
    first : (int, int, int)
        Lowest corner, in cells.
    corners : (int, int, int)
        Number of corners along x, y, z.
    """

    cell: float
    first: tuple[int, int, int]
    corners: tuple[int, int, int]

    @property
    def corner_count(self) -> int:
        """Number of cell corners; nodes from here on are cell centres."""
        return int(np.prod(self.corners))

    @property
    def centres(self) -> tuple[int, int, int]:
        """Number of cell centres along x, y, z."""
        nx, ny, nz = self.corners
        return nx - 1, ny - 1, nz - 1

    def points(self) -> NDArray[np.float64]:
        """Coordinates of all nodes, (nodes, 3)."""
        return np.concatenate([self._grid(self.corners, 0.0), self._grid(self.centres, 0.5)])

    def on_border(self) -> NDArray[np.bool_]:
        """Mask (nodes,) of the nodes in the outermost layer of corners or of centres."""
        layers = []
        for shape in (self.corners, self.centres):
            border = np.ones(shape, dtype=np.bool_)
            border[1:-1, 1:-1, 1:-1] = False
            layers.append(border.reshape(-1))
        return np.concatenate(layers)

    def odd_nodes(self) -> NDArray[np.bool_]:
        """Parity of the sum of each node's cell indices, (nodes,); it differs along long edges."""
        parities = []
        for shape in (self.corners, self.centres):
            index = [
                first + np.arange(count) for first, count in zip(self.first, shape, strict=True)
            ]
            total = index[0][:, None, None] + index[1][:, None] + index[2]
            parities.append((total % 2 == 1).reshape(-1))
        return np.concatenate(parities)

    def tets_touching(self, inside: NDArray[np.bool_]) -> NDArray[np.int64]:
        """Lattice tets with at least one node of `inside`, (m, 4), positively oriented.

        Each tet is (corner, corner, centre, centre): it has a long edge between corners, the
        opposite long edge between centres, and four short edges. Inside nodes must not be on the
        border.
        """
        corner = np.arange(self.corner_count).reshape(self.corners)
        centre = self.corner_count + np.arange(np.prod(self.centres)).reshape(self.centres)
        corner_in = inside[: self.corner_count].reshape(self.corners)
        centre_in = inside[self.corner_count :].reshape(self.centres)
        found = []
        for axis in range(3):
            ends = [_edge_ends(self.corners, axis, offset) for offset in (0, 1)]
            ring = [_ring_centres(self.centres, axis, offset) for offset in _RING]
            for k in range(4):
                pair = (ring[k], ring[(k + 1) % 4])
                touched = corner_in[ends[0]] | corner_in[ends[1]]
                touched = touched | centre_in[pair[0]] | centre_in[pair[1]]
                found.append(
                    np.stack(
                        [corner[end][touched] for end in ends] + [centre[c][touched] for c in pair],
                        axis=1,
                    )
                )
        return np.concatenate(found)

    def _grid(self, shape: tuple[int, int, int], shift: float) -> NDArray[np.float64]:
        axes = [
            self.cell * (first + np.arange(count) + shift)
            for first, count in zip(self.first, shape, strict=True)
        ]
        return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def lattice_around(
    lower: NDArray[np.float64], upper: NDArray[np.float64], cell: float
) -> BccLattice:
    """The smallest lattice with a margin of one full cell around the box from lower to upper."""
    first = np.floor(lower / cell).astype(int) - 1
    last = np.ceil(upper / cell).astype(int) + 1
    i, j, k = (int(value) for value in first)
    nx, ny, nz = (int(value) for value in last - first + 1)
    return BccLattice(cell, (i, j, k), (nx, ny, nz))


def _edge_ends(corners: tuple[int, int, int], axis: int, offset: int) -> tuple[slice, ...]:
    """Slices of the first (offset 0) or second ends (offset 1) of the inner edges along `axis`."""
    slices = [slice(1, n - 1) for n in corners]
    slices[axis] = slice(offset, corners[axis] - 1 + offset)
    return tuple(slices)


def _ring_centres(
    centres: tuple[int, int, int], axis: int, offset: tuple[int, int]
) -> tuple[slice, ...]:
    """Slices of the centres beside these edges, on the side given by `offset`."""
    slices = [slice(None)] * 3
    for step, side in zip((1, 2), offset, strict=True):
        other = (axis + step) % 3
        slices[other] = slice(1 + side, centres[other] + side)
    return tuple(slices)
