"""PosingModel: a posing problem restricted to a subspace."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..cubature import Cubature
from ..problem import PosingProblem
from .full_energy import FullEnergy
from .handle_quadric import HandleQuadric
from .quartic import Quartic
from .reduced_model import ReducedModel

if TYPE_CHECKING:
    from ..session import PosingSession

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class PosingModel(ReducedModel):
    """A posing problem restricted to a subspace attached to the rest shape.

    Fields as for `ReducedModel`, and
    elastic : Quartic, exact, Cubature, a sum over few tets, or FullEnergy, the sum over all
    handles : HandleQuadric
    """

    problem: PosingProblem
    elastic: Quartic | Cubature | FullEnergy
    handles: HandleQuadric

    @property
    def cubature(self) -> Cubature | None:
        """The reduced elastic energy where it is a sum over few tets; None where it is exact."""
        return self.elastic if isinstance(self.elastic, Cubature) else None

    def value(self, q: FloatArray, offsets: FloatArray) -> float:
        """Reduced objective at coordinates (d,) for offsets (h, 3, 4).

        Equal to F at tau + U q, except for the cubature's error.
        """
        return self.elastic.value(q) + self.handles.value(q, offsets)

    def leading(self, dimension: int) -> PosingModel:
        """The model on the first coordinates; nothing is computed anew."""
        return replace(
            self,
            subspace=self.subspace.leading(dimension),
            elastic=self.elastic.leading(dimension),
            handles=self.handles.leading(dimension),
            training_coordinates=self.training_coordinates[:, :dimension],
        )

    def session(self, **options: Any) -> PosingSession:
        """A live session that moves handles; options as for `Session`."""
        from ..session import PosingSession

        return PosingSession(self, **options)
