"""Vibration modes and modal derivatives (Barbic & James 2005; Hildebrandt et al. 2011)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import snapspace as ss

from .vibration_modes import RIGID, Vibrations, hessian_at, vibrations

FloatArray = NDArray[np.float64]

#: Rounds of iterative refinement; each leaves less than a thousandth of what the shift did.
REFINEMENTS = 2
#: Step of the difference of Hessians, as the longest displacement over the body's size. Hessians of
#: St.Venant-Kirchhoff are quadratic, so that its central differences are exact for every step.
STEP = 1e-3


def modal_subspace(
    problem: ss.PosingProblem | ss.InterpolationProblem, dimension: int
) -> ss.AffineSubspace:
    """The subspace of modes and modal derivatives; for several poses those of all of them.

    Handles are ignored, as in the paper (sec. 7). A body that is posed gives its six rigid motions
    first, which are eigenvectors too: without them errors are twice as large. Poses to blend are
    registered, and give none. Half of the rest are the softest modes, and the others derivatives,
    those of the softest pairs first: of 40 and 86 dimensions about twice as good on generated
    creatures as the fewest modes whose derivatives fill the dimension.
    """
    if isinstance(problem, ss.PosingProblem):
        bodies = [(problem.energy.core, problem.mass(), problem.mesh.vertices)]
    else:
        rests = problem.pose_shapes.reshape(len(problem.poses), -1, 3)
        energies = [problem.pose_energy(k) for k in range(len(rests))]
        masses = [ss.mass_matrix(ss.TetMesh(rest, problem.mesh.cells)) for rest in rests]
        bodies = list(zip(energies, masses, rests, strict=True))
    shares = np.full(len(bodies), dimension // len(bodies))
    shares[: dimension % len(bodies)] += 1
    rigid = RIGID if isinstance(problem, ss.PosingProblem) else 0
    if min(shares) <= rigid:
        least = (rigid + 1) * len(bodies)
        raise ValueError(f"modal_subspace: dimension is {dimension}, but must be at least {least}")
    directions = []
    for body, share in zip(bodies, shares, strict=True):
        found = vibrations(*body, mode_count(share - rigid))
        directions += [found.rigid[:, :rigid], _directions(found, share - rigid)]
    return ss.affine_subspace(np.hstack(directions), problem, nested=False)


def mode_count(dimension: int) -> int:
    """Half of the directions, or the least m with m + m (m + 1) / 2 directions if that is more."""
    count = 1
    while count + count * (count + 1) // 2 < dimension:
        count += 1
    return max(count, dimension // 2)


def modal_derivatives(found: Vibrations, pairs: list[tuple[int, int]]) -> FloatArray:
    """Derivatives (3n, k) of modes i along modes j, for pairs (i, j).

    K psi_ij = -D^3 E(modes_i, modes_j), the second-order response of the body to a load that moves
    it along the modes; M-orthogonal to rigid motions, and symmetric in i and j.
    """
    third = np.empty((len(found.modes), len(pairs)))
    for j in sorted({j for _, j in pairs}):
        mode = found.modes[:, j]
        size = _step(mode, found)
        after, before = (hessian_at(found.energy, sign * size * mode) for sign in (1.0, -1.0))
        change = (after - before) / (2.0 * size)
        columns = [k for k, pair in enumerate(pairs) if pair[1] == j]
        third[:, columns] = change @ found.modes[:, [pairs[k][0] for k in columns]]
    return _solved(found, -third)


def _directions(found: Vibrations, count: int) -> FloatArray:
    values = found.eigenvalues
    modes = len(values)
    pairs = [(i, j) for j in range(modes) for i in range(j + 1)]
    pairs.sort(key=lambda pair: (values[pair[0]] * values[pair[1]], pair))
    chosen = pairs[: max(count - modes, 0)]
    directions = found.modes[:, :count]
    return np.hstack([directions, modal_derivatives(found, chosen)]) if chosen else directions


def _step(mode: FloatArray, found: Vibrations) -> float:
    """Length of a step along a mode."""
    volume = float(found.mass.sum()) / 3.0
    longest = float(np.linalg.norm(mode.reshape(-1, 3), axis=1).max())
    return float(STEP * volume ** (1.0 / 3.0) / longest)


def _solved(found: Vibrations, right: FloatArray) -> FloatArray:
    """K^+ right, M-orthogonal to rigid motions."""
    rigid, mass = found.rigid, found.mass
    load = right - mass @ (rigid @ (rigid.T @ right))
    solved: FloatArray = np.zeros_like(load)
    for _ in range(REFINEMENTS):
        solved += found.solver.solve(load - found.stiffness @ solved)
        solved -= rigid @ (rigid.T @ (mass @ solved))
    return solved
