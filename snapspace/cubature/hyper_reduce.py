"""hyper_reduce: a problem, a subspace and its snapshots become a model with a cubature."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from ..mesh import EmbeddedSurface
from ..problem import PosingProblem
from ..reduction import Cubature, HandleQuadric, PosingModel, handle_quadric
from ..reduction.shown_surface import surface_in
from ..reduction.training import check_attached, training
from ..snapshots import Snapshots
from ..subspace import AffineSubspace
from .candidates import candidate_tets
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
#: One snapshot in so many is held out.
HELD_OUT_SHARE = 10


def hyper_reduce(
    problem: PosingProblem,
    subspace: AffineSubspace,
    snapshots: Snapshots,
    *,
    tets: int | None = None,
    seed: int = 0,
    surface: EmbeddedSurface | None = None,
    provenance: dict[str, Any] | None = None,
) -> PosingModel:
    """Restricts a posing problem to a subspace, with the energy of few tets instead of all.

    The way past the d^4 of `reduce`: a cubature (An, Kim, James 2008) whose positive weights make
    forces and energies at the snapshots' projections those of all tets. See `training_rows` and
    `nonnegative_fit` for the steps.

    Parameters
    ----------
    problem : PosingProblem
    subspace : AffineSubspace
        Attached to the rest shape.
    snapshots : Snapshots
        At least 10 of the problem. One in ten is held out for the errors, and recorded like all
        others in the model. For sessions with a closure they should be solved with
        `SolverOptions(tolerance=1e-5)`, which is not the default.
    tets : int, optional
        The most that may be chosen. Default: 8 d, but at most 1000, or all tets if there are
        fewer.
    seed : int, default 0
        Of the random rows.
    surface : EmbeddedSurface, optional
        That pages and files show. Default: that of the tets.
    provenance : dict, optional
        Recorded in the model, with a record of the cubature beside; must be valid JSON.

    Returns
    -------
    PosingModel
        With a `Cubature` as its elastic energy; the handles' energy is exact. Bitwise the same for
        the same arguments. `model.provenance["cubature"]` has the errors on the held-out snapshots,
        see `CubatureErrors`, and the seconds of training.

    Raises
    ------
    ValueError
        For a problem that is not one of posing, a subspace or surface of another mesh, too few
        snapshots, or a number of tets that is not between 1 and that of the mesh.
    """
    if not isinstance(problem, PosingProblem):
        raise ValueError(
            f"hyper_reduce: works for posing problems, got a {type(problem).__name__}; use reduce"
        )
    check_attached(problem, subspace, who="hyper_reduce")
    shown = surface_in(problem.mesh, surface, who="hyper_reduce")
    count = _checked_count(problem, subspace, tets)
    if len(snapshots) < HELD_OUT_SHARE:
        raise ValueError(
            f"hyper_reduce: {len(snapshots)} snapshots are too few to train on, it takes "
            f"{HELD_OUT_SHARE}"
        )
    begin = time.perf_counter()
    parameters, coordinates = training(problem, subspace, snapshots)
    held = np.arange(len(coordinates)) % HELD_OUT_SHARE == HELD_OUT_SHARE // 2
    trained = _spread(coordinates[~held], TRAINED)
    handles = handle_quadric(problem, subspace)
    compliance = _compliance(problem, subspace, handles)
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
    unseen = _spread(coordinates[held], HELD_OUT)
    errors = held_out_errors(problem, subspace, cubature, unseen, compliance)
    record = {
        "tets": len(picked),
        "trained_states": len(trained),
        "rows": len(rows.target),
        "seed": seed,
        "seconds": time.perf_counter() - begin,
        "held_out": errors.as_json(),
    }
    return PosingModel(
        problem=problem,
        subspace=subspace,
        elastic=cubature,
        handles=handles,
        surface=shown,
        training_parameters=parameters,
        training_coordinates=coordinates,
        provenance={**(provenance or {}), "cubature": record},
    )


def _checked_count(problem: PosingProblem, subspace: AffineSubspace, tets: int | None) -> int:
    available = len(problem.mesh.tets)
    default = min(TETS_PER_DIMENSION * subspace.dimension, MOST_TETS, available)
    count = default if tets is None else tets
    if not 1 <= count <= available:
        raise ValueError(
            f"hyper_reduce: tets is {count}, but must be between 1 and the mesh's {available}"
        )
    return count


def _spread(states: FloatArray, count: int) -> FloatArray:
    """At most `count` of the rows, evenly spread; without the rest shape, which has no energy."""
    moved = states[np.abs(states).max(axis=1) > 0]
    which = np.unique(np.linspace(0, len(moved) - 1, count).round().astype(int))
    chosen: FloatArray = moved[which]
    return chosen


@single_threaded_blas
def _compliance(
    problem: PosingProblem, subspace: AffineSubspace, handles: HandleQuadric
) -> FloatArray:
    """Inverse of the exact reduced Hessian at rest, (d, d)."""
    stiffness = subspace.basis.T @ (problem.energy.hessian(problem.base) @ subspace.basis)
    inverse: FloatArray = np.linalg.inv((stiffness + stiffness.T) / 2 + 2.0 * handles.K)
    return inverse
