"""Training: chooses a few candidate tets by their forces at some states."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic

import numpy as np
from numpy.typing import NDArray

from .blended_sum import BlendedSum
from .compliances import compliances
from .cubature import Cubature
from .elastic_states import States
from .elements import elements_of
from .nonnegative_fit import nonnegative_fit
from .state_forces import state_forces
from .training_rows import training_rows

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class WeightedTets:
    """Some tets (r,), ascending, with the volumes that they represent.

    rows : number of equations that they were fitted to
    """

    tets: NDArray[np.int32]
    volumes: FloatArray
    rows: int


class Training(Generic[States]):
    """Fits the forces of all tets at some states by those of a few candidates.

    Parameters
    ----------
    states : States
        The states to train on.
    candidates : (c,) int32
        The tets to choose from.
    seed : int
        Seed of random rows and batches.
    threads : int, optional
        Default: all. Results are bitwise the same for any number.
    """

    def __init__(
        self,
        states: States,
        candidates: NDArray[np.int32],
        *,
        seed: int,
        threads: int | None = None,
    ) -> None:
        self._states, self._candidates = states, candidates
        self._with_forces = states.with_forces()
        self._found = state_forces(self._with_forces, candidates, threads=threads)
        self._elements = elements_of(states.problem)
        self._modes = self._elements.gradients(states.subspace.basis, candidates, threads=threads)
        self._seed, self._threads = seed, threads

    def __len__(self) -> int:
        """Number of states with forces."""
        return len(self._with_forces)

    def fitted(self, estimate: Cubature | BlendedSum, count: int, *, rows: int) -> WeightedTets:
        """Chooses at most `count` tets.

        estimate : an energy whose Hessians show how far an error of the forces moves a state
        rows : about how many equations of forces there are, at most d for each state
        """
        states, with_forces = self._states, self._with_forces
        factors = compliances(states, estimate, threads=self._threads)
        system = training_rows(
            with_forces,
            self._found,
            self._modes,
            repeated(factors, len(with_forces)),
            directions=min(states.subspace.dimension, -(-rows // len(with_forces))),
            seed=self._seed,
            threads=self._threads,
        )
        picks, shares = nonnegative_fit(
            system.columns, system.target, count, seed=self._seed, threads=self._threads
        )
        if not len(picks):
            raise ValueError(
                f"reduce: no tet carries a force at the {len(states)} snapshots that train a "
                "cubature; solve more samples"
            )
        tets = self._candidates[picks]
        volumes = shares * self._elements.measures[tets]
        return WeightedTets(tets, volumes, len(system.target))


def repeated(factors: FloatArray, count: int) -> FloatArray:
    """Factors of states repeated for their `with_forces`, which repeats each state equally."""
    return np.repeat(factors, count // len(factors), axis=0)
