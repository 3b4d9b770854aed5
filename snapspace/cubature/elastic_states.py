"""States of a reduced body with energies and forces of its tets, to train a cubature."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem
from ..subspace import AffineSubspace
from .blended_sum import BlendedSum, blended_sum
from .cubature import Cubature

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int32]
States = TypeVar("States", bound="ElasticStates")


@dataclass(frozen=True)
class GroupForces:
    """Energies and forces at g states, of all tets together and of some tets alone.

    energies : (g,), of all tets together
    gradients : (g, 3n), of these energies
    stresses : (g, c, 9), first Piola-Kirchhoff stress times volume of some tets
    tet_energies : (g, c), energies of the same tets
    """

    energies: FloatArray
    gradients: FloatArray
    stresses: FloatArray
    tet_energies: FloatArray


class ElasticStates(Protocol):
    """Some reduced states of a problem, with everything that its energy depends on."""

    @property
    def problem(self) -> PosingProblem | InterpolationProblem:
        """The problem of all states."""
        ...

    @property
    def subspace(self) -> AffineSubspace:
        """The subspace, attached to the problem's tau."""
        ...

    @property
    def coordinates(self) -> FloatArray:
        """The reduced states, (s, d)."""
        ...

    def __len__(self) -> int: ...

    @property
    def floor(self) -> float:
        """Smallest energy that errors are relative to."""
        ...

    def chosen(self: States, which: NDArray[np.intp]) -> States:
        """Some of the states."""
        ...

    def with_forces(self: States) -> States:
        """These states and more, whose forces show how large forces are."""
        ...

    def stresses(self, state: int, displacement: FloatArray) -> FloatArray:
        """First Piola-Kirchhoff stress times volume of all tets, (m, 9), at a state.

        `displacement` is basis @ coordinates of the state, (3n,).
        """
        ...

    def evaluated(self, first: int, displacements: FloatArray, tets: IntArray) -> GroupForces:
        """Energies and forces at the states from `first`, with displacements (g, 3n)."""
        ...

    def sum_over(self, tets: IntArray, volumes: FloatArray) -> Cubature | BlendedSum:
        """The energy summed over some tets with these volumes."""
        ...

    def hessians(self, estimate: Any) -> Callable[[int | None], FloatArray]:
        """Estimates the Hessian (d, d) of the objective by the energy of `sum_over`.

        The returned function takes the index of a state, or None for tau. Only one thread may call
        it at a time.
        """
        ...

    def curvatures(self, energy: Any) -> NDArray[np.float32]:
        """Hessians (r, 9, 9) of the tets of a `sum_over` at tau, times volume."""
        ...

    def sum_stresses(self, energy: Any) -> FloatArray:
        """Stresses (s, r, 9) of the tets of a `sum_over` at all states, times volume."""
        ...


@dataclass(frozen=True)
class PosingStates:
    """States of a posed body: its elastic energy does not depend on the handles.

    handle_hessian : (d, d), Hessian of the handles' energy
    """

    problem: PosingProblem
    subspace: AffineSubspace
    coordinates: FloatArray
    handle_hessian: FloatArray
    floor: float = 0.0

    def __len__(self) -> int:
        return len(self.coordinates)

    def chosen(self, which: NDArray[np.intp]) -> PosingStates:
        """See `ElasticStates`."""
        return replace(self, coordinates=self.coordinates[which])

    @property
    def rest(self) -> PosingStates:
        """The rest shape as the only state."""
        return replace(self, coordinates=np.zeros((1, self.subspace.dimension)))

    def with_forces(self) -> PosingStates:
        """The states themselves, whose elastic forces balance those of the handles."""
        return self

    def stresses(self, state: int, displacement: FloatArray) -> FloatArray:
        """See `ElasticStates`."""
        stresses: FloatArray = self.problem.energy.core.tet_stresses(displacement)[0]
        return stresses

    def evaluated(self, first: int, displacements: FloatArray, tets: IntArray) -> GroupForces:
        """See `ElasticStates`."""
        core = self.problem.energy.core
        energies, gradients = core.lane_values_and_gradients(displacements)
        if self.problem.energy.stars is not None:
            rest, slopes = self.problem.energy.stars.remainder_at(displacements)
            energies, gradients = energies - rest, gradients - slopes
        single = [core.some_tet_stresses(u, tets) for u in displacements]
        stresses, tet_energies = (np.array(part) for part in zip(*single, strict=True))
        return GroupForces(energies, gradients, stresses, tet_energies)

    def sum_over(self, tets: IntArray, volumes: FloatArray) -> Cubature:
        """See `ElasticStates`."""
        return Cubature.of_tets(self.problem, self.subspace, tets, volumes)

    def hessians(self, estimate: Cubature) -> Callable[[int | None], FloatArray]:
        """See `ElasticStates`."""

        def hessian(state: int | None) -> FloatArray:
            q = np.zeros(estimate.dimension) if state is None else self.coordinates[state]
            return estimate.rough_hessian(q) + self.handle_hessian

        return hessian

    def curvatures(self, energy: Cubature) -> NDArray[np.float32]:
        """See `ElasticStates`."""
        return energy.curvatures(np.zeros(energy.dimension))

    def sum_stresses(self, energy: Cubature) -> FloatArray:
        """See `ElasticStates`."""
        return np.array([energy.stresses(q) for q in self.coordinates], np.float64)


@dataclass(frozen=True)
class BlendingStates:
    """States of blended poses, each with its weights (s, poses).

    The energy vanishes near a pose, so errors there are relative to `floor`, a hundredth of the
    largest energy of all states.
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

    def with_forces(self) -> BlendingStates:
        """Each state, and the same shape with weights halfway to those of the state before.

        At a solution all forces balance, so any multiple of them would fit. The second state has
        forces that do not balance.
        """
        away = (self.weights + np.roll(self.weights, 1, axis=0)) / 2.0
        both = np.stack([self.weights, away], axis=1)
        return replace(
            self,
            coordinates=np.repeat(self.coordinates, 2, axis=0),
            weights=both.reshape(-1, both.shape[2]),
        )

    def stresses(self, state: int, displacement: FloatArray) -> FloatArray:
        """See `ElasticStates`."""
        every = np.arange(len(self.problem.mesh.elements), dtype=np.int32)
        shape = self.subspace.tau - self.problem.base + displacement
        stresses: FloatArray
        stresses, _ = self.problem.system.some_tet_stresses(shape, self.weights[state], every)
        return stresses

    def evaluated(self, first: int, displacements: FloatArray, tets: IntArray) -> GroupForces:
        """See `ElasticStates`."""
        system, weights = self.problem.system, self.weights[first : first + len(displacements)]
        shapes = self.subspace.tau - self.problem.base + displacements
        energies, gradients = system.evaluate(shapes, weights, threads=1)
        pairs = zip(shapes, weights, strict=True)
        single = [system.some_tet_stresses(shape, w, tets) for shape, w in pairs]
        stresses, tet_energies = (np.array(part) for part in zip(*single, strict=True))
        return GroupForces(energies, gradients, stresses, tet_energies)

    def sum_over(self, tets: IntArray, volumes: FloatArray) -> BlendedSum:
        """See `ElasticStates`."""
        return blended_sum(self.problem, self.subspace, tets, volumes)

    def hessians(self, estimate: BlendedSum) -> Callable[[int | None], FloatArray]:
        """See `ElasticStates`."""

        def hessian(state: int | None) -> FloatArray:
            if state is None:
                mean = np.zeros(estimate.dimension)
                return estimate.rough_hessian(mean, self.problem.domain.center)
            return estimate.rough_hessian(self.coordinates[state], self.weights[state])

        return hessian

    def curvatures(self, energy: BlendedSum) -> NDArray[np.float32]:
        """See `ElasticStates`."""
        return energy.curvatures(np.zeros(energy.dimension), self.problem.domain.center)

    def sum_stresses(self, energy: BlendedSum) -> FloatArray:
        """See `ElasticStates`."""
        every = zip(self.coordinates, self.weights, strict=True)
        return np.array([energy.stresses(q, w) for q, w in every], np.float64)
