"""States of a reduced body, and what its tets do there: what a cubature is trained on."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace

FloatArray = NDArray[np.float64]
States = TypeVar("States", bound="ElasticStates")


@dataclass(frozen=True)
class TetForces:
    """All tets at one state.

    stresses : (m, 9), first Piola-Kirchhoff stress times volume
    energies : (m,)
    energy : their sum
    gradient : (3n,), of the sum
    unit : energy that errors of the energy are relative to
    """

    stresses: FloatArray
    energies: FloatArray
    energy: float
    gradient: FloatArray
    unit: float


class ElasticStates(Protocol):
    """Some reduced states of a problem, with what the energy depends on besides."""

    @property
    def problem(self) -> PosingProblem | InterpolationProblem:
        """Of all states."""
        ...

    @property
    def subspace(self) -> AffineSubspace:
        """Attached to the problem's tau."""
        ...

    @property
    def coordinates(self) -> FloatArray:
        """The reduced states, (s, d)."""
        ...

    def __len__(self) -> int: ...

    def forces(self, state: int, displacement: FloatArray) -> TetForces:
        """Of all tets at a state; `displacement` is basis @ coordinates of it, (3n,)."""
        ...


@dataclass(frozen=True)
class PosingStates:
    """States of a posed body: its elastic energy does not depend on the handles."""

    problem: PosingProblem
    subspace: AffineSubspace
    coordinates: FloatArray

    def __len__(self) -> int:
        return len(self.coordinates)

    def forces(self, state: int, displacement: FloatArray) -> TetForces:
        """See `ElasticStates`."""
        stresses, energies = self.problem.energy.core.tet_stresses(displacement)
        energy, gradient = self.problem.energy.core.value_and_gradient(displacement)
        return TetForces(stresses, energies, energy, gradient, energy)


@dataclass(frozen=True)
class BlendingStates:
    """States of blended poses, each with its weights (s, poses).

    Near a pose the energy vanishes: there errors are relative to a hundredth of the largest energy
    of all states, which is `floor`.
    """

    problem: InterpolationProblem
    subspace: AffineSubspace
    coordinates: FloatArray
    weights: FloatArray
    floor: float = 0.0

    def __len__(self) -> int:
        return len(self.coordinates)

    def forces(self, state: int, displacement: FloatArray) -> TetForces:
        """See `ElasticStates`."""
        u = self.subspace.tau - self.problem.base + displacement
        weights = self.weights[state]
        stresses, energies = self.problem.system.tet_stresses(u, weights)
        energy, gradient = self.problem.system.value_and_gradient(u, weights)
        return TetForces(stresses, energies, energy, gradient, max(energy, self.floor))


def chosen(states: States, which: NDArray[np.intp]) -> States:
    """Some of the states."""
    picked = {"coordinates": states.coordinates[which]}
    if isinstance(states, BlendingStates):
        picked["weights"] = states.weights[which]
    return replace(states, **picked)  # type: ignore[type-var]
