"""The energy of all tets with the Hessian of an approximation, for fast exact minimisers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

import snapspace as ss
from snapspace import _core as core
from snapspace.reduction import Cubature, FullEnergy, Quartic

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class NearlyNewton(FullEnergy):
    """FullEnergy, whose Hessian is that of a cubature or quartic.

    Values and gradients are those of all tets, and so are minimisers. On the Dragon ten of them
    take a thirtieth of the time.
    """

    near: Cubature | Quartic | None = None

    def hessian(
        self, q: ArrayLike, *, projection: core.Projection = core.Projection.none
    ) -> FloatArray:
        """Hessian of the approximation, without a projection."""
        assert self.near is not None
        return self.near.hessian(q)


def with_near_hessian(model: ss.PosingModel, near: Cubature | Quartic) -> ss.PosingModel:
    """A model of all tets that takes the Hessian of a cubature or quartic."""
    full = model.elastic
    assert isinstance(full, FullEnergy)
    energy = NearlyNewton(full.parts, full.weights, full.origins, full.basis, full.threads, near)
    return replace(model, elastic=energy)
