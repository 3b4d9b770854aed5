"""train_cubature: a few weighted tets whose energy is that of all tets, near solutions."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .all_stars import blended_stars, posed_stars, record_of, takes_all_stars
from .blended_stars import BlendedStars
from .blended_sum import BlendedSum
from .cubature import Cubature
from .elastic_states import BlendingStates, PosingStates
from .elements import element_count, has_hinges, has_stars
from .finite_states import finite_states
from .fit_tets import FEWEST_SNAPSHOTS, Budget, fit_tets
from .held_out_errors import held_out_errors
from .local_coordinates import with_local_coordinates
from .star_poses import StarPoses
from .star_states import BlendedStarStates

FloatArray = NDArray[np.float64]

#: Default number of tets per dimension. On the Dragon, d = 120, solutions are then as close to the
#: full ones as those of the exact energy.
TETS_PER_DIMENSION = 8
#: The same where 8 d exceeds this many tets. With 1000 tets for 207 and 250 dimensions, errors are
#: 1.1 to 1.9 times as large on four bodies. With 8 d they are up to a fifth smaller, and frames
#: take up to a quarter longer.
MANY_TETS, FURTHER_TETS_PER_DIMENSION = 1000, 6.5
#: The same for shells, whose membrane and bending each need their share. On Spot, 829 vertices, d =
#: 120, thickness 3 % and 1.5 % of the diagonal, the cubature's part of live errors is 0.0008 and
#: 0.0026; with 8 it is 0.0022 and 0.0068, with 16 it is 0.0002 and 0.0011. As-rigid-as-possible
#: surfaces use as many stars as solids use tets: on Spot, 11533 vertices, d = 120, the cubature's
#: part is 0.006, 0.0008 and 0.0004 with 4, 8 and 12.
ELEMENTS_PER_DIMENSION, MOST_ELEMENTS = 12, 1500
#: The same for blends. Blends of stars, whose quadratic form is exact, need only as many as posing:
#: the Lion's mean errors are 0.015 and 0.009 with 15 d (d = 40 and 60), and 0.015 and 0.010 with 8
#: d, in half the time per frame.
TETS_PER_BLENDED_DIMENSION = 15
#: Largest default number of tets for blends: the time of an evaluation is proportional to it.
MOST_BLENDED_TETS = 1000
#: Largest number of motions to train on, candidates per wanted tet, and the number of candidates
#: beyond which each tet has only ten. Errors on Dragon, Spot, Elephant, Armadillo, dog head and
#: hand are the same as with 200 motions and twice as many candidates. With at most 10,000
#: candidates for up to 1000 tets, errors are a tenth to a third larger on the Dragon and on a dog
#: with handles at its tips, and the same elsewhere.
TRAINED, CANDIDATES, MANY_CANDIDATES = 60, 20, 20_000
#: The same for blends. Errors on Lion, Dog, Centaur, ten Lions, 11 and 20 poses are the same with
#: 20 blends and with 200, which take four times as long. With half as many candidates the Lion's
#: errors grow by a third. With more, builds of the Lion take as long on average, and some need more
#: samples (docs/notes/snapshot-engine.md).
TRAINED_BLENDS, BLEND_CANDIDATES, MANY_BLEND_CANDIDATES = 40, 20, 10_000
#: How often a blended cubature may get half as many tets again to make the mean shape a minimum.
#: Once a fit uses no more tets than the one before, larger numbers would not help either.
GROWTHS = 4
#: Smallest number of blends for a cubature: one to train on, and one to measure errors.
FEWEST_BLENDS = 2
#: One blended state in this many is evaluated to find out how large energies are.
PILOT_STEP = 8


def default_tets(dimension: int, *, shell: bool = False) -> int:
    """Default number of tets of a cubature: 8 d, but at most the larger of 1000 and 6.5 d.

    For triangles and hinges of a shell it is 12 d, but at most 1500; see `has_hinges`.
    """
    if shell:
        return min(ELEMENTS_PER_DIMENSION * dimension, MOST_ELEMENTS)
    further = max(MANY_TETS, round(FURTHER_TETS_PER_DIMENSION * dimension))
    return min(TETS_PER_DIMENSION * dimension, further)


def default_blended_tets(dimension: int, *, stars: bool = False) -> int:
    """Default number of tets of a blended cubature: 15 d, or 8 d stars, but at most 1000.

    Blends need more tets than posing, since no handles hold them. On Lion, Dog and Centaur (d = 30,
    20 and 50) errors are the same as with twice as many tets; with 10 d the Dog's and the Lion's
    are larger by half.
    """
    share = TETS_PER_DIMENSION if stars else TETS_PER_BLENDED_DIMENSION
    return min(share * dimension, MOST_BLENDED_TETS)


def train_cubature(
    problem: PosingProblem,
    subspace: AffineSubspace,
    coordinates: FloatArray,
    handle_hessian: FloatArray,
    *,
    tets: int | None = None,
    stiffness_from: Cubature | None = None,
    seed: int = 0,
    threads: int | None = None,
) -> tuple[Cubature, dict[str, Any]]:
    """Trains a cubature (An, Kim, James 2008) to have the forces and energies of all tets.

    See `fit_tets`, `training_rows` and `nonnegative_fit` for the steps. For an as-rigid-as-possible
    surface with few stars, the cubature has all of them, without training: see `takes_all_stars`.

    Parameters
    ----------
    problem : PosingProblem
        The full problem.
    subspace : AffineSubspace
        The subspace, attached to the rest shape.
    coordinates : (k, d)
        Projected snapshots, the states to train on. One in ten is held out to measure errors.
        States at rest do not count.
    handle_hessian : (d, d)
        The Hessian of the handles' reduced energy, which is exact.
    tets : int, optional
        Largest number of tets to choose. Default: `default_tets`.
    stiffness_from : Cubature, optional
        A cubature of the same elements in another subspace, see `fit_tets`.
    seed : int, default 0
        Seed of the random rows.
    threads : int, optional
        Default: all. The result is bitwise the same for any number.

    Returns
    -------
    cubature : Cubature
        Bitwise the same for the same arguments.
    record : dict
        For a model's provenance: numbers of tets, states and rows, the seed, the seconds, and
        the errors in "held_out", see `CubatureErrors`; without seed and errors for all stars.

    Raises
    ------
    ValueError
        For fewer than ten states that are not at rest and have a finite energy, or a number of tets
        below 1 or above that of the mesh.
    """
    begin = time.perf_counter()
    usual = default_tets(subspace.dimension, shell=has_hinges(problem))
    if takes_all_stars(problem, tets, usual):
        exact = posed_stars(problem, subspace)
        return exact, record_of(exact, time.perf_counter() - begin)
    states = PosingStates(problem, subspace, coordinates[_moved(coordinates)], handle_hessian)
    states = finite_states(states, FEWEST_SNAPSHOTS, threads=threads)
    budget = Budget(tets, usual, FEWEST_SNAPSHOTS, TRAINED, CANDIDATES, MANY_CANDIDATES)
    fit = fit_tets(states, budget, stiffness_from=stiffness_from, seed=seed, threads=threads)
    dense = Cubature.of_tets(problem, subspace, fit.tets, fit.volumes)
    cubature = with_local_coordinates(dense, fit.known, threads=threads)
    alone = cubature.without_remainder()
    errors = held_out_errors(
        fit.unseen.coordinates,
        fit.exact,
        lambda k: alone.value_and_gradient(fit.unseen.coordinates[k]),
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
) -> tuple[BlendedSum, dict[str, Any]]:
    """Trains a cubature for blended poses, with the same tets for all poses.

    Arguments, result and errors are as for `train_cubature`, except that every state has its
    weights (k, poses), the default of `tets` is `default_blended_tets`, and the subspace is
    attached to the mean shape. The poses themselves, where all tets are at rest, do not count.
    """
    begin = time.perf_counter()
    count = default_blended_tets(subspace.dimension, stars=has_stars(problem))
    if takes_all_stars(problem, tets, count):
        exact = blended_stars(problem, subspace)
        return exact, record_of(exact, time.perf_counter() - begin)
    own = weights.max(axis=1, initial=0.0) < 1.0 - 1e-9
    states = _blending_states(problem, subspace, coordinates[own], weights[own])
    states = finite_states(states, FEWEST_BLENDS, threads=threads)
    some = slice(None, None, PILOT_STEP)
    shapes = subspace.tau - problem.base + states.coordinates[some] @ subspace.basis.T
    energies = problem.system.evaluate(shapes, states.weights[some], threads=threads or 0)[0]
    states = replace(states, floor=0.01 * float(np.abs(energies).max(initial=0.0)))
    taken = 0
    for usual in _growing(count, element_count(problem)):
        budget = Budget(
            tets,
            usual,
            FEWEST_BLENDS,
            TRAINED_BLENDS,
            BLEND_CANDIDATES,
            MANY_BLEND_CANDIDATES,
        )
        fit = fit_tets(states, budget, seed=seed, threads=threads)
        cubature = states.sum_over(fit.tets, fit.volumes)
        no_more, taken = len(fit.tets) <= taken, len(fit.tets)
        if tets is not None or no_more or _is_stable(cubature, problem.domain.center):
            break
    cubature = with_local_coordinates(cubature, fit.known, threads=threads)
    unseen = fit.unseen
    alone = cubature.without_form() if isinstance(cubature, BlendedStars) else cubature
    errors = held_out_errors(
        unseen.coordinates,
        fit.exact,
        lambda k: alone.value_and_gradient(unseen.coordinates[k], unseen.weights[k]),
        fit.compliances,
    )
    return cubature, fit.record(errors)


def _blending_states(
    problem: InterpolationProblem, subspace: AffineSubspace, coordinates: FloatArray, w: FloatArray
) -> BlendingStates:
    if not has_stars(problem):
        return BlendingStates(problem, subspace, coordinates, w)
    forms = StarPoses(problem).forms(subspace)
    return BlendedStarStates(problem, subspace, coordinates, w, forms=forms)


def _growing(count: int, most: int) -> list[int]:
    """Numbers of tets to try until a cubature is stable; each is half as many again."""
    counts = [round(count * 1.5**power) for power in range(GROWTHS + 1)]
    return [count, *(c for c in counts[1:] if c <= most)]


def _is_stable(cubature: BlendedSum, mean: FloatArray) -> bool:
    """Whether the mean shape is a minimum; if it is soft, few tets may make it a saddle."""
    hessian = cubature.hessian(np.zeros(cubature.dimension), mean)
    return bool(np.linalg.eigvalsh(hessian)[0] > 0.0)


def _moved(coordinates: FloatArray) -> NDArray[np.bool_]:
    moved: NDArray[np.bool_] = np.abs(coordinates).max(axis=1, initial=0.0) > 0
    return moved
