"""BlendedStarStates: states of a blended as-rigid-as-possible surface."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import _core as core
from .blended_stars import BlendedStars
from .elastic_states import BlendingStates, GroupForces

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int32]


@dataclass(frozen=True)
class BlendedStarStates(BlendingStates):
    """States of blended poses whose elements are stars, with nine numbers per star and pose.

    Stresses (m, 9 poses) are those of the poses one after the other, times their weights. Energies
    and forces are those of the stars, without the quadratic form of the rest.

    forms : (poses, d + 1, d + 1), that form, see `BlendedStars`
    """

    forms: FloatArray | None = None

    def evaluated(self, first: int, displacements: FloatArray, tets: IntArray) -> GroupForces:
        """See `ElasticStates`."""
        count = len(displacements)
        energies, gradients = np.zeros(count), np.zeros(displacements.shape)
        stresses = np.empty((count, len(tets), 9 * len(self._energies)))
        tet_energies = np.zeros((count, len(tets)))
        stars = self.problem.pose_energies.stars or []
        for pose, (energy, one) in enumerate(zip(self._energies, stars, strict=True)):
            weights = self.weights[first : first + count, pose]
            if not weights.any():
                stresses[:, :, 9 * pose : 9 * pose + 9] = 0.0
                continue
            moved = displacements + (self.subspace.tau - self.problem.pose_shapes[pose])
            values, slopes = energy.lane_values_and_gradients(moved)
            rest, rest_slopes = one.remainder_at(moved)
            energies += weights * (values - rest)
            gradients += weights[:, None] * (slopes - rest_slopes)
            for k, u in enumerate(moved if len(tets) else ()):
                P, psi = energy.some_tet_stresses(u, tets)
                stresses[k, :, 9 * pose : 9 * pose + 9] = weights[k] * P
                tet_energies[k] += weights[k] * psi
        return GroupForces(energies, gradients, stresses, tet_energies)

    def stresses(self, state: int, displacement: FloatArray) -> FloatArray:
        """See `ElasticStates`."""
        parts = [
            weight * energy.tet_stresses(self.subspace.tau - pose + displacement)[0]
            for weight, energy, pose in zip(
                self.weights[state], self._energies, self.problem.pose_shapes, strict=True
            )
        ]
        return np.hstack(parts)

    def sum_over(self, tets: IntArray, volumes: FloatArray) -> BlendedStars:
        """See `ElasticStates`."""
        return BlendedStars.of_tets(self.problem, self.subspace, tets, volumes, forms=self.forms)

    @property
    def _energies(self) -> list[core.ElasticEnergy]:
        return [self.problem.pose_energy(k) for k in range(len(self.problem.poses))]
