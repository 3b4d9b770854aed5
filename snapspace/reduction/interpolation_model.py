"""InterpolationModel: an interpolation problem restricted to a subspace."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import as_coordinates, as_numbers
from ..cubature import BlendedCubature, BlendedStars, BlendedSum, WeightedCubature
from ..mesh import ShellMesh
from ..problem import CertainRange, InterpolationProblem, certain_range
from .full_energy import FullBlends, FullEnergy
from .quartic import PoseQuartics, Quartic
from .reduced_model import ReducedModel

if TYPE_CHECKING:
    from ..session import BlendingSession

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class InterpolationModel(ReducedModel):
    """An interpolation problem restricted to a subspace attached to the mean shape.

    Fields as for `ReducedModel`, and
    blends : PoseQuartics, exact, BlendedCubature or BlendedStars, sums over few elements, or
        FullBlends, over all

    The subspace is M-orthogonal to the translations and infinitesimal rotations of the mean shape,
    because all its snapshots were registered there: the reduced problem has no rigid null
    directions.
    """

    problem: InterpolationProblem
    blends: PoseQuartics | BlendedSum | FullBlends

    @property
    def cubature(self) -> BlendedSum | None:
        """The reduced elastic energy where it is a sum over few tets; None where it is exact."""
        return self.blends if isinstance(self.blends, BlendedSum) else None

    @cached_property
    def certain_range(self) -> CertainRange | None:
        """Weights for which the reduced energy certainly has a minimum; None if no test is known.

        The test looks at the cubature's tets, since sessions and pages minimise their energy. The
        full energy has more tets and a smaller range: `InterpolationProblem.certain_range`.
        """
        if isinstance(self.blends, BlendedStars):
            return CertainRange.of_forms(self.blends.dirichlet_forms[:, None])
        if not isinstance(self.blends, BlendedCubature) or isinstance(self.problem.mesh, ShellMesh):
            return None
        return certain_range(self.problem.material, self.blends.corners[:-1])

    def elastic(self, weights: ArrayLike) -> Quartic | WeightedCubature | FullEnergy:
        """The reduced energy for any weights (poses,); ValueError for another number of them."""
        w = as_numbers("InterpolationModel", "weights", weights)
        if w.shape != (self.problem.parameter_count,):
            raise ValueError(
                f"InterpolationModel: weights have shape {w.shape}, but must be "
                f"({self.problem.parameter_count},), one per pose"
            )
        return self.blends.at(w)

    def value(self, q: FloatArray, weights: ArrayLike) -> float:
        """Reduced objective at coordinates (d,).

        Equal to F at tau + U q, except for the cubature's error.
        """
        return self.elastic(weights).value(as_coordinates("InterpolationModel", q, self.dimension))

    def leading(self, dimension: int) -> InterpolationModel:
        """The model on the first coordinates; nothing is computed anew."""
        return replace(
            self,
            subspace=self.subspace.leading(dimension),
            blends=self.blends.leading(dimension),
            training_coordinates=self.training_coordinates[:, :dimension],
        )

    def session(self, **options: Any) -> BlendingSession:
        """A live session that sets weights; options as for `Session`."""
        from ..session import BlendingSession

        return BlendingSession(self, **options)
