"""States of a reduced body, and what its tets do there: what a cubature is trained on."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .blending_compliances import blending_compliances

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

    def compliances(
        self, stiffness: FloatArray, ordered: NDArray[np.int32], threads: int | None
    ) -> FloatArray:
        """Inverse Hessians (s, d, d), which make displacements of forces.

        stiffness (d, d) is the Hessian at tau, ordered are tets, see `tets_by_force`; threads
        default to all.
        """
        ...

    def chosen(self: States, which: NDArray[np.intp]) -> States:
        """Some of the states."""
        ...

    def with_forces(self: States) -> States:
        """States that tell how large forces are, these among them."""
        ...

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

    def chosen(self, which: NDArray[np.intp]) -> PosingStates:
        """See `ElasticStates`."""
        return replace(self, coordinates=self.coordinates[which])

    def compliances(
        self, stiffness: FloatArray, ordered: NDArray[np.int32], threads: int | None
    ) -> FloatArray:
        """That of the rest shape for all: handles hold what is soft."""
        compliance = np.linalg.inv(stiffness)
        return np.broadcast_to(compliance, (len(self), *compliance.shape))

    def with_forces(self) -> PosingStates:
        """Themselves: elastic forces hold those of the handles."""
        return self

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

    def chosen(self, which: NDArray[np.intp]) -> BlendingStates:
        """See `ElasticStates`."""
        return replace(self, coordinates=self.coordinates[which], weights=self.weights[which])

    def compliances(
        self, stiffness: FloatArray, ordered: NDArray[np.int32], threads: int | None
    ) -> FloatArray:
        """See `blending_compliances`."""
        return blending_compliances(
            self.problem,
            self.subspace,
            self.coordinates,
            self.weights,
            stiffness,
            ordered,
            threads=threads,
        )

    def with_forces(self) -> BlendingStates:
        """Each state, and the same shape with weights halfway to those of the state before.

        At a solution all forces balance, and any multiple of them would fit: the second one has
        forces that do not.
        """
        away = (self.weights + np.roll(self.weights, 1, axis=0)) / 2.0
        both = np.stack([self.weights, away], axis=1)
        return replace(
            self,
            coordinates=np.repeat(self.coordinates, 2, axis=0),
            weights=both.reshape(-1, both.shape[2]),
        )

    def forces(self, state: int, displacement: FloatArray) -> TetForces:
        """See `ElasticStates`."""
        u = self.subspace.tau - self.problem.base + displacement
        weights = self.weights[state]
        stresses, energies, gradient = self.problem.system.tet_stresses(u, weights)
        energy = float(energies.sum())
        return TetForces(stresses, energies, energy, gradient, max(energy, self.floor))
