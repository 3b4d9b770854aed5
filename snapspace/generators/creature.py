"""The creature: a tetrahedral animal of any resolution, for demos, tests and benchmarks."""

from __future__ import annotations

from snapspace.arguments import require_count
from snapspace.generators.creature_shape import CREATURE_LOWER, CREATURE_UPPER, creature_shape
from snapspace.mesh.tet_mesh import TetMesh
from snapspace.stuffing.isosurface_stuffing import stuff_unchecked
from snapspace.stuffing.manifold import euler_characteristic, is_closed_manifold

# tets * cell^3 = 12 volume + c cell: the lattice has 12 tets per cell, and the layer clipped by the
# surface adds some (c measured from 5k to 1M tets).
_TWELVE_VOLUMES, _SURFACE_LAYER = 12.0, 12.5
_FEWEST, _MOST = 5_000, 1_500_000
_TOLERANCE = 0.15
# Factors of the cell, tried in turn. The first one nearly always works. Below 7k tets, where horns
# and ears are as thin as the cells, the surface sometimes touches itself; then slightly different
# cells are tried.
_SCALES = (1.0, 0.985, 1.015, 0.975, 1.025, 0.965, 1.035)


def creature(tets: int = 25_000) -> TetMesh:
    """Makes a young horned animal of about `tets` well-shaped tetrahedra.

    An implicit surface (`creature_shape`) filled by isosurface stuffing (`stuff`).

    Parameters
    ----------
    tets : int, default 25000
        Target number of tets, from 5000 to 1500000; met within 15 %.

    Returns
    -------
    TetMesh
        It stands on z = 0 with its head towards +x and its back towards +z, about 3 long, 1.6 wide
        and 2.3 high; the vertices are mirror-symmetric about y = 0. The surface is
        topologically a sphere; dihedral angles are over 8 degrees (measured: over 10).

    Raises
    ------
    ValueError
        If `tets` is not a whole number in that range.

    See Also
    --------
    creature_handles : natural handles on this mesh.
    """
    tets = require_count("creature", "tets", tets, at_least=_FEWEST)
    if tets > _MOST:
        raise ValueError(f"creature: tets is {tets}, but must be at most {_MOST}")
    cell = _expected_cell(tets)
    for scale in _SCALES:
        mesh = stuff_unchecked(creature_shape, CREATURE_LOWER, CREATURE_UPPER, scale * cell)
        if abs(len(mesh.tets) - tets) <= _TOLERANCE * tets and _is_sphere(mesh):
            return mesh
    raise RuntimeError(f"creature: no good mesh of {tets} tets found in {len(_SCALES)} tries")


def _expected_cell(tets: int) -> float:
    cell = 0.0
    for _ in range(4):  # a contraction: the right-hand side hardly depends on the cell
        cell = ((_TWELVE_VOLUMES + _SURFACE_LAYER * cell) / tets) ** (1.0 / 3.0)
    return cell


def _is_sphere(mesh: TetMesh) -> bool:
    return is_closed_manifold(mesh.surface) and euler_characteristic(mesh.surface) == 2
