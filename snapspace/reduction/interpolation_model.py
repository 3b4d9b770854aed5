"""InterpolationModel: an interpolation problem restricted to a subspace."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..problem import InterpolationProblem
from .quartic import Quartic, coefficient_count
from .reduced_model import ReducedModel

if TYPE_CHECKING:
    from ..session import BlendingSession

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, repr=False)
class InterpolationModel(ReducedModel):
    """An interpolation problem restricted to a subspace attached to the mean shape.

    Fields as for `ReducedModel`, and
    coefficients : (poses, C(d + 4, 4)), the quartic of every pose as in `Quartic`

    The subspace is M-orthogonal to the translations and infinitesimal rotations of the mean shape,
    because all its snapshots were registered there: the reduced problem has no rigid null
    directions.
    """

    problem: InterpolationProblem
    coefficients: FloatArray

    def elastic(self, weights: ArrayLike) -> Quartic:
        """The reduced energy for weights (poses,): the weighted sum of the poses' quartics."""
        combined = np.asarray(weights, np.float64) @ self.coefficients
        return Quartic(self.dimension, combined)

    def value(self, q: FloatArray, weights: ArrayLike) -> float:
        """Reduced objective at coordinates (d,); equal to F at tau + U q."""
        return self.elastic(weights).value(q)

    def leading(self, dimension: int) -> InterpolationModel:
        """The model on the first coordinates; nothing is computed anew."""
        subspace = self.subspace.leading(dimension)
        count = coefficient_count(dimension)
        return replace(
            self,
            subspace=subspace,
            coefficients=np.ascontiguousarray(self.coefficients[:, :count]),
            training_coordinates=self.training_coordinates[:, :dimension],
        )

    def session(self, **options: Any) -> BlendingSession:
        """A live session that sets weights; options as for `Session`."""
        from ..session import BlendingSession

        return BlendingSession(self, **options)
