"""train_cubature: few tets whose weighted energies are those of all, near some solutions."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import Any, Generic

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .blended_cubature import BlendedCubature
from .cubature import Cubature
from .elastic_states import BlendingStates, PosingStates, States
from .held_out_errors import CubatureErrors, held_out_errors
from .nonnegative_fit import nonnegative_fit
from .reduced_stiffness import mean_stiffness, reduced_stiffness
from .sampled_tets import sampled_tets
from .tet_budget import (
    BLEND_CANDIDATES,
    CANDIDATES,
    FEWEST_BLENDS,
    FEWEST_SNAPSHOTS,
    HELD_OUT,
    TRAINED,
    TRAINED_BLENDS,
    TetBudget,
    default_blended_tets,
    default_tets,
)
from .tets_by_force import tets_by_force
from .training_rows import training_rows

FloatArray = NDArray[np.float64]

#: How often a blended cubature gets half as many tets again, until the mean shape is a minimum.
GROWTHS = 4
#: One blended state in so many says how large energies are.
PILOT_STEP = 8


def train_cubature(
    problem: PosingProblem,
    subspace: AffineSubspace,
    coordinates: FloatArray,
    handle_hessian: FloatArray,
    *,
    tets: int | None = None,
    quick: bool = False,
    seed: int = 0,
    threads: int | None = None,
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
    quick : bool, default False
        Half the time, see `TetBudget.quick`.
    seed : int, default 0
        Seeds the random rows.
    threads : int, optional
        Default: all. The result is bitwise the same for any number.

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
    states = PosingStates(problem, subspace, coordinates[_moved(coordinates)])
    hessian = problem.energy.hessian(problem.base)
    stiffness = reduced_stiffness(hessian, subspace) + handle_hessian
    budget = TetBudget(
        wanted=tets,
        usual=default_tets(subspace.dimension),
        fewest_states=FEWEST_SNAPSHOTS,
        most_trained=TRAINED,
        candidates=CANDIDATES,
    )
    fit = _fit(states, stiffness, budget.quick if quick else budget, seed=seed, threads=threads)
    cubature = Cubature.of_tets(problem, subspace, fit.tets, fit.volumes)
    errors = held_out_errors(
        fit.unseen,
        lambda k: cubature.value_and_gradient(fit.unseen.coordinates[k]),
        fit.compliances,
    )
    return cubature, fit.record(errors)


def train_blended_cubature(
    problem: InterpolationProblem,
    subspace: AffineSubspace,
    coordinates: FloatArray,
    weights: FloatArray,
    *,
    tets: int | None = None,
    seed: int = 0,
    threads: int | None = None,
) -> tuple[BlendedCubature, dict[str, Any]]:
    """The same for blended poses: one set of tets for all of them.

    Arguments, result and errors as for `train_cubature`, but every state has its weights (k,
    poses), the default of `tets` is `default_blended_tets`, and the subspace is attached to the
    mean shape. The poses themselves, where all tets are at rest, do not count.
    """
    own = weights.max(axis=1, initial=0.0) < 1.0 - 1e-9
    states = BlendingStates(problem, subspace, coordinates[own], weights[own])
    some = slice(None, None, PILOT_STEP)
    shapes = subspace.tau - problem.base + states.coordinates[some] @ subspace.basis.T
    energies = problem.system.evaluate(shapes, states.weights[some], threads=threads or 0)[0]
    states = replace(states, floor=0.01 * float(np.abs(energies).max(initial=0.0)))
    stiffness = mean_stiffness(problem, subspace, threads=threads)
    for usual in _growing(default_blended_tets(subspace.dimension), len(problem.mesh.tets)):
        budget = TetBudget(
            wanted=tets,
            usual=usual,
            fewest_states=FEWEST_BLENDS,
            most_trained=TRAINED_BLENDS,
            candidates=BLEND_CANDIDATES,
        )
        fit = _fit(states, stiffness, budget, seed=seed, threads=threads)
        cubature = BlendedCubature.of_tets(problem, subspace, fit.tets, fit.volumes)
        if tets is not None or _is_stable(cubature, problem.domain.center):
            break
    unseen = fit.unseen
    errors = held_out_errors(
        unseen,
        lambda k: cubature.value_and_gradient(unseen.coordinates[k], unseen.weights[k]),
        fit.compliances,
    )
    return cubature, fit.record(errors)


def _growing(count: int, most: int) -> list[int]:
    """Numbers of tets, each half as many again, that are tried until a cubature is stable."""
    counts = [round(count * 1.5**power) for power in range(GROWTHS + 1)]
    return [count, *(c for c in counts[1:] if c <= most)]


def _is_stable(cubature: BlendedCubature, mean: FloatArray) -> bool:
    """Whether the mean shape is a minimum: where it is soft few tets may leave it a saddle."""
    hessian = cubature.hessian(np.zeros(cubature.dimension), mean)
    return bool(np.linalg.eigvalsh(hessian)[0] > 0.0)


@dataclass(frozen=True)
class _Fit(Generic[States]):
    """Chosen tets with the volumes that they stand for, and what was held out.

    unseen : states
    compliances : (s, d, d) of these
    """

    tets: NDArray[np.int32]
    volumes: FloatArray
    unseen: States
    compliances: FloatArray
    trained: int
    rows: int
    seed: int
    begin: float

    def record(self, errors: CubatureErrors) -> dict[str, Any]:
        """For a model's provenance."""
        return {
            "tets": len(self.tets),
            "trained_states": self.trained,
            "rows": self.rows,
            "seed": self.seed,
            "seconds": time.perf_counter() - self.begin,
            "held_out": errors.as_json(),
        }


def _fit(
    states: States,
    stiffness: FloatArray,
    budget: TetBudget,
    *,
    seed: int,
    threads: int | None,
) -> _Fit[States]:
    begin = time.perf_counter()
    mesh, dimension = states.problem.mesh, states.subspace.dimension
    count = budget.count(len(mesh.tets))
    if len(states) < budget.fewest_states:
        raise ValueError(
            f"reduce: {len(states)} snapshots that are not at rest are too few to train a cubature "
            f"on, it takes {budget.fewest_states}; solve more samples"
        )
    period = min(FEWEST_SNAPSHOTS, len(states))
    held = np.arange(len(states)) % period == period // 2
    trained = states.chosen(_spread(np.flatnonzero(~held), budget.most_trained))
    unseen = states.chosen(_spread(np.flatnonzero(held), HELD_OUT))
    with_forces = trained.with_forces()
    ordered = tets_by_force(with_forces, pilots=budget.pilots)
    candidates = sampled_tets(ordered, budget.candidates * count, seed=seed).tets
    directions = min(dimension, -(-budget.rows * count // len(with_forces)))
    rows = training_rows(
        with_forces,
        candidates,
        _repeated(trained.compliances(stiffness, ordered, threads), len(with_forces)),
        directions=directions,
        seed=seed,
        threads=threads,
    )
    picks, factors = nonnegative_fit(
        rows.columns, rows.target, count, batch=budget.batch, missing=budget.missing
    )
    if not len(picks):
        raise ValueError(
            f"reduce: no tet carries a force at the {len(states)} snapshots that a cubature is "
            "trained on; solve more samples"
        )
    picked = candidates[picks]
    volumes = factors * mesh.volumes[picked]
    judging = unseen.with_forces()
    compliances = _repeated(unseen.compliances(stiffness, ordered, threads), len(judging))
    return _Fit(
        picked, volumes, judging, compliances, len(with_forces), len(rows.target), seed, begin
    )


def _repeated(compliances: FloatArray, count: int) -> FloatArray:
    """Those of states for their `with_forces`, which has each state as often as any other."""
    return np.repeat(compliances, count // len(compliances), axis=0)


def _moved(coordinates: FloatArray) -> NDArray[np.bool_]:
    moved: NDArray[np.bool_] = np.abs(coordinates).max(axis=1, initial=0.0) > 0
    return moved


def _spread(which: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    """At most `count` of the indices, evenly spread."""
    places = np.unique(np.linspace(0, len(which) - 1, count).round().astype(int))
    some: NDArray[np.intp] = which[places]
    return some
