"""ReducedModel: all that posing needs, at a cost independent of the mesh."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..problem import PosingProblem
from ..snapshots import Snapshots
from ..subspace import AffineSubspace
from .handle_quadric import HandleQuadric, handle_quadric
from .quartic import Quartic, reduced_quartic

if TYPE_CHECKING:
    from ..session import Session

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class ReducedModel:
    """A posing problem restricted to a subspace.

    problem : PosingProblem
    subspace : AffineSubspace, attached to the rest shape
    elastic : Quartic
    handles : HandleQuadric
    training_parameters : (k, p) of the snapshots, or (0, p)
    training_coordinates : (k, d) of their projections, or (0, d)
    provenance : what made it: versions, seeds, options, timings
    """

    problem: PosingProblem
    subspace: AffineSubspace
    elastic: Quartic
    handles: HandleQuadric
    training_parameters: FloatArray
    training_coordinates: FloatArray
    provenance: dict[str, Any] = field(default_factory=dict)

    @property
    def dimension(self) -> int:
        """d."""
        return self.subspace.dimension

    @property
    def value_scale(self) -> float:
        """Unit of energy for the termination tests: that of a strain of 10 %, 0.01 mu * volume."""
        return 0.01 * self.problem.material.mu * self.problem.mesh.volume

    @property
    def coordinate_scale(self) -> float:
        """Unit of q: the M-norm of a displacement by a tenth of the diagonal everywhere."""
        mesh = self.problem.mesh
        return float(0.1 * mesh.diagonal * np.sqrt(mesh.volume))

    def value(self, q: FloatArray, offsets: FloatArray) -> float:
        """Reduced objective at coordinates (d,) for offsets (h, 3, 4); equal to F at tau + U q."""
        return self.elastic.value(q) + self.handles.value(q, offsets)

    def leading(self, dimension: int) -> ReducedModel:
        """The model on the first coordinates; nothing is computed anew."""
        return replace(
            self,
            subspace=self.subspace.leading(dimension),
            elastic=self.elastic.leading(dimension),
            handles=self.handles.leading(dimension),
            training_coordinates=self.training_coordinates[:, :dimension],
        )

    def session(self, **options: Any) -> Session:
        """A live session; options as for `Session`."""
        from ..session import Session

        return Session(self, **options)

    def save(self, path: str | Path) -> Path:
        """Writes a .snapspace file, as `save_model`."""
        from ..model_file import save_model

        return save_model(self, path)

    def __repr__(self) -> str:
        return f"ReducedModel(dimension {self.dimension}, {self.problem!r})"


def reduce(
    problem: PosingProblem,
    subspace: AffineSubspace,
    *,
    snapshots: Snapshots | None = None,
    threads: int | None = None,
    provenance: dict[str, Any] | None = None,
) -> ReducedModel:
    """Restricts a problem to a subspace (paper, sec. 6.1).

    Parameters
    ----------
    problem : PosingProblem
    subspace : AffineSubspace
        Attached to the problem's rest shape.
    snapshots : Snapshots, optional
        Recorded in the model by parameters and coordinates.
    threads : int, optional
        Default: all. The result does not depend on it.
    provenance : dict, optional
        Recorded in the model; must be valid JSON.

    Returns
    -------
    ReducedModel
        Exact: its objective equals F at tau + U q for all q and all affine motions of the handles.

    Raises
    ------
    ValueError
        If the subspace is of another mesh or not attached to its rest shape.
    """
    rest = problem.mesh.vertices.reshape(-1)
    if subspace.tau.shape != rest.shape or not np.array_equal(subspace.tau, rest):
        raise ValueError(
            "reduce: the subspace is not attached to the rest shape of the problem's mesh"
        )
    if snapshots is None:
        parameters = np.zeros((0, problem.dimension))
        coordinates = np.zeros((0, subspace.dimension))
    else:
        parameters = snapshots.parameters
        coordinates = np.ascontiguousarray(subspace.coordinates(snapshots.shapes).T)
    return ReducedModel(
        problem,
        subspace,
        reduced_quartic(problem.energy, subspace, threads=threads),
        handle_quadric(problem, subspace),
        parameters,
        coordinates,
        provenance or {},
    )
