"""ProbePins: the sampled vertices that handles hold."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..problem import InterpolationProblem, PosingProblem

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ProbePins:
    """The sampled vertices in handles, among those that a probe has; none for blending.

    pinned, handles : (p,) int32, their indices and those of their handles
    pulls : (p,), twice the weights of their springs
    arms : (p, 3), vectors to them from the centroids of their handles, at rest
    """

    pinned: NDArray[np.int32]
    handles: NDArray[np.int32]
    pulls: FloatArray
    arms: FloatArray

    @classmethod
    def of_vertices(
        cls,
        problem: PosingProblem | InterpolationProblem,
        known: NDArray[np.integer[Any]],
        sampled: NDArray[np.integer[Any]],
    ) -> ProbePins:
        """Finds them.

        Parameters
        ----------
        known : (c,)
            The vertices that the probe has, ascending.
        sampled : (s,)
            The sampled vertices, a subset of `known`.
        """
        if not isinstance(problem, PosingProblem):
            none = np.zeros(0, np.int32)
            return cls(none, none, np.zeros(0), np.zeros((0, 3)))
        sizes = [len(handle.vertices) for handle in problem.handles]
        owners = np.repeat(np.arange(len(sizes), dtype=np.int32), sizes)
        seen = np.isin(problem.pinned, sampled)
        vertices, handles = problem.pinned[seen], owners[seen]
        return cls(
            pinned=np.searchsorted(known, vertices).astype(np.int32),
            handles=handles,
            pulls=2.0 * problem.pin_weights[seen],
            arms=problem.mesh.vertices[vertices] - problem.centroids[handles],
        )

    @property
    def arguments(self) -> dict[str, NDArray[Any]]:
        """Arguments for the compiled probes."""
        return {
            "pinned": self.pinned,
            "handles": self.handles,
            "pulls": self.pulls,
            "arms": self.arms,
        }
