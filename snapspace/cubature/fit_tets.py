"""fit_tets: chooses and weights the few tets of a cubature."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any, Generic

import numpy as np
from numpy.typing import NDArray

from .compliances import judging_compliances, sampled_energy
from .cubature import Cubature
from .elastic_states import States
from .elements import elements_of
from .held_out_errors import CubatureErrors
from .sampled_tets import sampled_tets
from .state_forces import StateForces, state_forces
from .tets_by_force import tets_by_force
from .training import Training, repeated

FloatArray = NDArray[np.float64]

#: Number of force rows per wanted tet, and the total beyond which each has only two. On Lion, dog
#: and Spot with 1600 to 2000 tets, three rows leave the same errors and take a fifth longer.
ROWS, MANY_ROWS = 3, 4000
#: Share of the wanted tets in a rough fit, and its force rows per tet.
ROUGH, ROUGH_ROWS = 0.5, 2
#: Largest number of snapshots that are held out.
HELD_OUT = 20
#: Largest number of candidates: the rows of each take 16 KB for 2000 wanted tets. With 10,000
#: candidates, a fit of 2000 tets ends with 1050 on a dog with handles at its tips, since all others
#: would get negative weights.
MOST_CANDIDATES = 20_000
#: One snapshot in this many is held out, so at least this many are needed.
FEWEST_SNAPSHOTS = 10


@dataclass(frozen=True)
class Budget:
    """How many tets to choose, from how many candidates and states.

    wanted : number of tets, or None for the usual number
    usual : usual number of tets
    fewest_states : smallest number of states that a cubature needs
    most_trained : largest number of states that it is trained on
    candidates : number of candidate tets per wanted tet
    many_candidates : number of candidates beyond which each wanted tet has only ten
    """

    wanted: int | None
    usual: int
    fewest_states: int
    most_trained: int
    candidates: int
    many_candidates: int

    def candidate_count(self, count: int) -> int:
        """Number of candidates for `count` wanted tets."""
        some = min(self.candidates * count, max(self.many_candidates, 10 * count))
        return max(min(some, MOST_CANDIDATES), count)


@dataclass(frozen=True)
class Fit(Generic[States]):
    """Chosen tets with the volumes that they stand for, and the held-out states.

    known, unseen : the states that are not held out, and those that are
    exact, compliances : their exact forces and energies, and their compliances
    """

    tets: NDArray[np.int32]
    volumes: FloatArray
    known: States
    unseen: States
    exact: StateForces
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


def fit_tets(
    states: States,
    budget: Budget,
    *,
    seed: int,
    threads: int | None,
    stiffness_from: Cubature | None = None,
) -> Fit[States]:
    """Chooses tets and volumes by some of the states, and holds others out.

    A fit measures errors of forces as displacements, which needs Hessians of the energy at its
    states. The Hessians of a random sample of tets may be negative along soft directions; those of
    a fitted cubature are close to the energy's. So a rough fit uses the Hessians of a sample, and
    the final fit those of the rough fit. On a dog with handles at its tips errors are then 0.0013
    instead of 0.0059; with the Hessians of all tets they are 0.0012.

    A fit in another subspace may replace the rough one, which takes a third of the time.

    stiffness_from : a cubature of the same elements, in any subspace; None for a rough fit

    Raises ValueError for too few states, or for more tets than the mesh has.
    """
    begin = time.perf_counter()
    every = len(elements_of(states.problem).measures)
    count = _checked_count(every, budget.usual, budget.wanted)
    if len(states) < budget.fewest_states:
        raise ValueError(
            f"reduce: {len(states)} snapshots that are not at rest are too few to train a "
            f"cubature, which needs {budget.fewest_states}; solve more samples"
        )
    period = min(FEWEST_SNAPSHOTS, len(states))
    held = np.arange(len(states)) % period == period // 2
    known = states.chosen(np.flatnonzero(~held))
    trained = known.chosen(_spread(np.arange(len(known)), budget.most_trained))
    unseen = states.chosen(_spread(np.flatnonzero(held), HELD_OUT))
    ordered = tets_by_force(trained.with_forces(), threads=threads)
    candidates = sampled_tets(ordered, budget.candidate_count(count), seed=seed).tets
    training = Training(trained, candidates, seed=seed, threads=threads)
    if stiffness_from is None:
        few = max(1, round(ROUGH * count))
        rough = training.fitted(sampled_energy(trained, ordered), few, rows=ROUGH_ROWS * few)
        estimate = states.sum_over(rough.tets, rough.volumes)
    else:
        estimate = states.sum_over(stiffness_from.tets, stiffness_from.weights)
    fine = training.fitted(estimate, count, rows=_row_count(count))
    judging = unseen.with_forces()
    return Fit(
        tets=fine.tets,
        volumes=fine.volumes,
        known=known,
        unseen=judging,
        exact=state_forces(judging, np.zeros(0, np.int32), threads=threads),
        compliances=repeated(judging_compliances(unseen, estimate, threads=threads), len(judging)),
        trained=len(training),
        rows=fine.rows,
        seed=seed,
        begin=begin,
    )


def _row_count(count: int) -> int:
    """Largest number of force rows for `count` wanted tets."""
    return max(min(ROWS * count, MANY_ROWS), 2 * count)


def _checked_count(available: int, usual: int, tets: int | None) -> int:
    count = min(usual, available) if tets is None else tets
    if not 1 <= count <= available:
        raise ValueError(
            f"reduce: tets is {count}, but must be between 1 and the mesh's {available}"
        )
    return count


def _spread(which: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    """At most `count` of the indices, evenly spread."""
    places = np.unique(np.linspace(0, len(which) - 1, count).round().astype(int))
    some: NDArray[np.intp] = which[places]
    return some
