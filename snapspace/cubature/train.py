"""train_cubature: few tets whose weighted energies are those of all, near some solutions."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from ..problem import PosingProblem
from ..subspace import AffineSubspace
from .candidates import candidate_tets
from .cubature import Cubature
from .held_out_errors import held_out_errors
from .nonnegative_fit import nonnegative_fit
from .training_rows import training_rows

FloatArray = NDArray[np.float64]

#: Tets per dimension by default. On the Dragon, d = 120, solutions are then as far from the full
#: ones as those of the exact energy.
TETS_PER_DIMENSION = 8
#: But no more than this: an evaluation takes time in proportion.
MOST_TETS = 1000
#: Candidates, and rows of forces, per wanted tet.
CANDIDATES, ROWS = 20, 3
#: Snapshots that are trained on, and held out, at the most.
TRAINED, HELD_OUT = 200, 20
#: One snapshot in so many is held out, which takes as many at least.
FEWEST_SNAPSHOTS = 10


def default_tets(dimension: int) -> int:
    """How many tets a cubature has by default: 8 d, but at most 1000, where the mesh has them."""
    return min(TETS_PER_DIMENSION * dimension, MOST_TETS)


def train_cubature(
    problem: PosingProblem,
    subspace: AffineSubspace,
    coordinates: FloatArray,
    handle_hessian: FloatArray,
    *,
    tets: int | None = None,
    seed: int = 0,
) -> tuple[Cubature, dict[str, Any]]:
    """A cubature (An, Kim, James 2008) with the forces and energies of all tets at given states.

    See `training_rows` and `nonnegative_fit` for the steps.

    Parameters
    ----------
    problem : PosingProblem
    subspace : AffineSubspace
        Attached to the rest shape.
    coordinates : (k, d)
        Projected snapshots. One in ten is held out for the errors; those at rest say nothing and
        do not count.
    handle_hessian : (d, d)
        The Hessian of the handles' reduced energy, which is exact.
    tets : int, optional
        The most that may be chosen. Default: `default_tets`.
    seed : int, default 0
        Seeds the random rows.

    Returns
    -------
    cubature : Cubature
        Bitwise the same for the same arguments.
    record : dict
        For a model's provenance: numbers of tets, states and rows, the seed, the seconds, and in
        "held_out" the errors, see `CubatureErrors`.

    Raises
    ------
    ValueError
        For fewer than ten states that are not at rest, or a number of tets that is not between 1
        and that of the mesh.
    """
    count = _checked_count(problem, subspace, tets)
    begin = time.perf_counter()
    states = coordinates[np.abs(coordinates).max(axis=1, initial=0.0) > 0]
    if len(states) < FEWEST_SNAPSHOTS:
        raise ValueError(
            f"reduce: {len(states)} snapshots that are not at rest are too few to train a cubature "
            f"on, it takes {FEWEST_SNAPSHOTS}; solve more samples"
        )
    held = np.arange(len(states)) % FEWEST_SNAPSHOTS == FEWEST_SNAPSHOTS // 2
    trained, unseen = _spread(states[~held], TRAINED), _spread(states[held], HELD_OUT)
    compliance = _compliance(problem, subspace, handle_hessian)
    candidates = candidate_tets(problem, subspace, trained, CANDIDATES * count)
    rows = training_rows(
        problem,
        subspace,
        trained,
        candidates,
        compliance,
        directions=min(subspace.dimension, -(-ROWS * count // len(trained))),
        seed=seed,
    )
    chosen, factors = nonnegative_fit(rows.columns, rows.target, count)
    picked = candidates[chosen]
    cubature = Cubature.of_tets(problem, subspace, picked, factors * problem.mesh.volumes[picked])
    errors = held_out_errors(problem, subspace, cubature, unseen, compliance)
    return cubature, {
        "tets": len(picked),
        "trained_states": len(trained),
        "rows": len(rows.target),
        "seed": seed,
        "seconds": time.perf_counter() - begin,
        "held_out": errors.as_json(),
    }


def _checked_count(problem: PosingProblem, subspace: AffineSubspace, tets: int | None) -> int:
    available = len(problem.mesh.tets)
    count = min(default_tets(subspace.dimension), available) if tets is None else tets
    if not 1 <= count <= available:
        raise ValueError(
            f"reduce: tets is {count}, but must be between 1 and the mesh's {available}"
        )
    return count


def _spread(states: FloatArray, count: int) -> FloatArray:
    """At most `count` of the rows, evenly spread."""
    which = np.unique(np.linspace(0, len(states) - 1, count).round().astype(int))
    chosen: FloatArray = states[which]
    return chosen


@single_threaded_blas
def _compliance(
    problem: PosingProblem, subspace: AffineSubspace, handle_hessian: FloatArray
) -> FloatArray:
    """Inverse of the exact reduced Hessian at rest, (d, d)."""
    stiffness = subspace.basis.T @ (problem.energy.hessian(problem.base) @ subspace.basis)
    inverse: FloatArray = np.linalg.inv((stiffness + stiffness.T) / 2 + handle_hessian)
    return inverse
