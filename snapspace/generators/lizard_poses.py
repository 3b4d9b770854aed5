"""The lizard: poses of one mesh with a long thin tail and legs, for tests and benchmarks."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from snapspace.arguments import require_count, require_positive
from snapspace.generators.bent_rod import bent_rod, rod_points
from snapspace.generators.lizard_grid import BLOCK, LIMBS, TORSO, Limb, LizardGrid, lizard_grid
from snapspace.mesh.tet_mesh import TetMesh

FloatArray = NDArray[np.float64]

_FEWEST, _MOST = 500, 500_000
_STRONGEST = 2.0
# How bends vary along a limb: amplitudes of the constant and of two cosines.
_MODES = np.array([1.0, 0.8, 0.5])


def lizard_poses(
    count: int, tets: int = 4_000, *, seed: int = 0, bend: float = 1.0
) -> list[TetMesh]:
    """Makes poses of a lizard of blocks: tail, neck and legs bend and twist at random.

    The torso is a box of 1 x 0.75 x 0.5; the tail is 2.5 long and tapers to a quarter of its width.
    Limbs are rods whose cross-sections stay plane and undistorted. All cells are cut as in `bar`.

    Parameters
    ----------
    count : int
        Number of poses, at least 1. The first one is straight.
    tets : int, default 4000
        Target number of tets, from 500 to 500000; met within 10 %.
    seed : int, default 0
        Seed of the bends, not negative.
    bend : float, default 1
        Scales all bends and twists, in (0, 2]. At 1 a typical bend of the tail is 1.6 radians about
        either axis, and of a leg 0.9.

    Returns
    -------
    list of TetMesh
        Vertex i and tet i correspond, as `Poses.of` requires. No tet is inverted. Poses may touch
        or cross themselves. Pose k depends only on seed, k and bend, and the shape is the same at
        all resolutions.

    Raises
    ------
    ValueError
        If an argument is out of its range.
    """
    count = require_count("lizard_poses", "count", count, at_least=1)
    tets = require_count("lizard_poses", "tets", tets, at_least=_FEWEST)
    if tets > _MOST:
        raise ValueError(f"lizard_poses: tets is {tets}, but must be at most {_MOST}")
    seed = require_count("lizard_poses", "seed", seed, at_least=0)
    bend = require_positive("lizard_poses", "bend", bend)
    if bend > _STRONGEST:
        raise ValueError(f"lizard_poses: bend is {bend}, but must be at most {_STRONGEST:g}")
    grid = lizard_grid(tets)
    poses = [TetMesh(grid.vertices, grid.tets)]
    for pose in range(1, count):
        rng = np.random.default_rng([seed, pose])
        poses.append(TetMesh(_posed(grid, rng, bend), grid.tets))
    return poses


def _posed(grid: LizardGrid, rng: np.random.Generator, bend: float) -> FloatArray:
    vertices = grid.vertices.copy()
    for limb, points in zip(LIMBS, grid.limbs, strict=True):
        angles = bend * np.array([limb.twist, limb.bend, limb.bend])
        coefficients = rng.standard_normal((3, len(_MODES))) * _MODES * angles[:, None]
        # angles above two standard deviations are rare, and would coil the limb
        coefficients = np.clip(coefficients, -2.0 * angles[:, None], 2.0 * angles[:, None])
        vertices[points] = _bent(grid.vertices[points], limb, coefficients)
    return vertices


def _bent(rest: FloatArray, limb: Limb, coefficients: FloatArray) -> FloatArray:
    """Points (k, 3) of a limb moved from the straight rod onto the bent one."""
    radius = BLOCK * np.sqrt(0.5)
    rod = bent_rod(coefficients, limb.length, (radius, limb.tip * radius))
    base = BLOCK * (np.array(limb.block) + 0.5)
    base[limb.axis] = BLOCK * TORSO[limb.axis] if limb.sign > 0 else 0.0
    # the direction of the limb, then two axes of its cross-section, right-handed
    axes = np.roll(np.eye(3), -limb.axis, axis=0)
    if limb.sign < 0:
        axes[:2] *= -1.0
    local = (rest - base) @ axes.T
    return base + rod_points(rod, local[:, 0], local[:, 1:]) @ axes
