"""split_errors: splits a model's error into parts due to subspace, stiffness, cubature, minimum."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ..mesh import mass_norms
from ..reduction import ReducedModel
from ..snapshots import Snapshots
from ..thread_count import checked_threads
from .given_reference import check_reference
from .other_minima import frame_and_near
from .restricted_energy import RestrictedEnergy

FloatArray = NDArray[np.float64]
Part = Literal["subspace", "stiffness", "cubature", "minimum"]
PARTS: tuple[Part, ...] = ("subspace", "stiffness", "cubature", "minimum")
#: Parts that another build can reduce.
BUILT_PARTS = PARTS[:3]


@dataclass(frozen=True, eq=False)
class ErrorSplit:
    """The error of reduced solutions in four parts, each (k,) for k samples.

    All are M-norms, divided by |x_full - tau|_M. P is the M-projection onto the subspace. From
    P x_full descents lead to x_all, the reduced minimiser with the energy of all tets, and to
    x_near, that of the model. A frame, x_red, starts elsewhere:

    subspace : |P x_full - x_full|, the least error that the subspace allows
    stiffness : |x_all - P x_full|; a subspace is too stiff, since it cannot relax as the full mesh
        does
    cubature : |x_near - x_all|, the error of summing over few tets; zero for an exact energy
    minimum : |x_red - x_near| if above 0.02, since the frame is then at another minimum of the
        reduced energy; else zero, and x_near is x_red
    error_of_all_tets : |x_all - x_full|, the least error that more tets can reach
    error : |x_red - x_full|, as `Validation.error` without the last registration of blends

    subspace^2 + stiffness^2 = error_of_all_tets^2, since the basis is M-orthonormal, and error is
    at most error_of_all_tets + cubature + minimum.
    """

    subspace: FloatArray
    stiffness: FloatArray
    cubature: FloatArray
    minimum: FloatArray
    error_of_all_tets: FloatArray
    error: FloatArray

    @property
    def largest(self) -> Part:
        """The part with the largest median."""
        return self._largest_of(PARTS)

    @property
    def largest_built(self) -> Part:
        """The part with the largest median among those that another build can reduce."""
        return self._largest_of(BUILT_PARTS)

    def _largest_of(self, parts: tuple[Part, ...]) -> Part:
        return max(parts, key=lambda part: float(np.median(getattr(self, part))))

    def as_json(self) -> dict[str, Any]:
        """Medians and maxima, with the keys of `snapspace validate --split --json`."""
        names = (*PARTS, "error_of_all_tets", "error")
        figures = {
            name: {
                "median": float(np.median(getattr(self, name))),
                "max": float(getattr(self, name).max()),
            }
            for name in names
        }
        return {"samples": len(self.error), "largest": self.largest, **figures}

    def __repr__(self) -> str:
        names = ("error", *PARTS)
        medians = ", ".join(f"{name} {np.median(getattr(self, name)):.3g}" for name in names)
        return f"ErrorSplit(medians of {len(self.error)} samples: {medians})"


def split_errors(
    model: ReducedModel,
    reference: Snapshots,
    *,
    threads: int | None = None,
) -> ErrorSplit:
    """Splits the errors of a model at known full solutions.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    reference : Snapshots
        Full solutions that the model has not seen, as for `validate`. A few are enough. For a
        cubature, each one costs 2 d evaluations of the full energy and one per descent step: 0.2 to
        3.3 times the time of its full solution (benchmarks/next_options.py). An exact energy costs
        none.
    threads : int, optional
        Default: all. The result does not depend on it.

    Returns
    -------
    ErrorSplit

    Raises
    ------
    ValueError
        For a reference that `validate` would refuse, or threads out of range.
    """
    check_reference(model, reference, who="split_errors")
    checked_threads(threads, "split_errors")
    problem, subspace = model.problem, model.subspace
    rows = reference.displacements.shifted(problem.base - subspace.tau)
    projections = subspace.row_coordinates(rows)
    session = model.session()
    parts = np.empty((len(rows), 6))
    samples = zip(parts, reference.parameters, rows, projections, strict=True)
    for target, w, row, projection in samples:
        miss = row - (subspace.shape(projection) - subspace.tau)
        size, least = mass_norms(subspace.mass, np.stack([row, miss]))
        reduced, near = frame_and_near(session, w, projection, size)
        every = near
        if model.cubature is not None:
            energy = RestrictedEnergy(problem, subspace, w, threads=threads)
            every = energy.minimiser(
                projection, value_scale=model.value_scale, scale=model.coordinate_scale
            )
        ends = ((projection, every), (every, near), (near, reduced))
        inside = [np.linalg.norm(a - b) for a, b in ends]
        outside = [np.hypot(least, np.linalg.norm(q - projection)) for q in (every, reduced)]
        target[:] = np.array([least, *inside, *outside]) / size
    return ErrorSplit(*parts.T)
