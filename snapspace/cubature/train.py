"""train_cubature: few tets whose weighted energies are those of all, near some solutions."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .blended_cubature import BlendedCubature
from .cubature import Cubature
from .elastic_states import BlendingStates, PosingStates
from .fit_tets import FEWEST_SNAPSHOTS, Budget, fit_tets
from .held_out_errors import held_out_errors

FloatArray = NDArray[np.float64]

#: Tets per dimension by default. On the Dragon, d = 120, solutions are then as far from the full
#: ones as those of the exact energy.
TETS_PER_DIMENSION = 8
#: The same for blends.
TETS_PER_BLENDED_DIMENSION = 15
#: But no more than this: an evaluation takes time in proportion.
MOST_TETS = 1000
#: Motions that are trained on at the most, and candidates per wanted tet. Errors on Dragon, Spot,
#: Elephant, Armadillo, dog head and hand are those of 200 motions and twice as many candidates,
#: which take twice as long.
TRAINED, CANDIDATES = 60, 20
#: The same for blends. Errors of Lion, Dog, Centaur, ten Lions, 11 and 20 poses are the same with
#: 20 blends and with 200, which take four times as long; half as many candidates leave the Lion a
#: third more.
TRAINED_BLENDS, BLEND_CANDIDATES = 40, 20
#: How often a blended cubature gets half as many tets again, until the mean shape is a minimum.
GROWTHS = 4
#: Fewest blends that a cubature is trained on: one, and one to judge by.
FEWEST_BLENDS = 2
#: One blended state in so many says how large energies are.
PILOT_STEP = 8


def default_tets(dimension: int) -> int:
    """How many tets a cubature has by default: 8 d, but at most 1000, where the mesh has them."""
    return min(TETS_PER_DIMENSION * dimension, MOST_TETS)


def default_blended_tets(dimension: int) -> int:
    """How many tets a blended cubature has by default: 15 d, but at most 1000.

    Nothing holds blends as handles do, and they take more than posing. On Lion, Dog and Centaur
    (d = 30, 20 and 50) errors are those of twice as many tets; with 10 d the Dog's and the Lion's
    are larger by half.
    """
    return min(TETS_PER_BLENDED_DIMENSION * dimension, MOST_TETS)


def train_cubature(
    problem: PosingProblem,
    subspace: AffineSubspace,
    coordinates: FloatArray,
    handle_hessian: FloatArray,
    *,
    tets: int | None = None,
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
    states = PosingStates(problem, subspace, coordinates[_moved(coordinates)], handle_hessian)
    budget = Budget(tets, default_tets(subspace.dimension), FEWEST_SNAPSHOTS, TRAINED, CANDIDATES)
    fit = fit_tets(states, budget, seed=seed, threads=threads)
    cubature = Cubature.of_tets(problem, subspace, fit.tets, fit.volumes)
    errors = held_out_errors(
        fit.unseen.coordinates,
        fit.exact,
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
    for usual in _growing(default_blended_tets(subspace.dimension), len(problem.mesh.tets)):
        budget = Budget(tets, usual, FEWEST_BLENDS, TRAINED_BLENDS, BLEND_CANDIDATES)
        fit = fit_tets(states, budget, seed=seed, threads=threads)
        cubature = BlendedCubature.of_tets(problem, subspace, fit.tets, fit.volumes)
        if tets is not None or _is_stable(cubature, problem.domain.center):
            break
    unseen = fit.unseen
    errors = held_out_errors(
        unseen.coordinates,
        fit.exact,
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


def _moved(coordinates: FloatArray) -> NDArray[np.bool_]:
    moved: NDArray[np.bool_] = np.abs(coordinates).max(axis=1, initial=0.0) > 0
    return moved
