"""error_curve: errors and times of a model's leading dimensions against one reference."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arguments import require_count, require_type
from ..reduction import ReducedModel, check_model
from ..snapshots import Progress, Snapshots
from .validate import given_or_solved, validate
from .validation import Validation

#: Default number of dimensions of a curve, in equal ratios, and the smallest as a share of the
#: largest.
POINTS, SMALLEST_SHARE = 8, 0.1


@dataclass(frozen=True, eq=False)
class ErrorCurve:
    """Validations of a model's leading dimensions.

    dimensions : (c,), ascending
    validations : one per dimension, all against the same full solutions
    """

    dimensions: NDArray[np.int64]
    validations: tuple[Validation, ...]

    @property
    def reference(self) -> Snapshots:
        """The full solutions."""
        return self.validations[0].reference

    def as_json(self) -> list[dict[str, Any]]:
        """The result of `Validation.as_json` for each dimension."""
        pairs = zip(self.dimensions.tolist(), self.validations, strict=True)
        return [validation.as_json(dimension) for dimension, validation in pairs]

    def __repr__(self) -> str:
        pairs = zip(self.dimensions.tolist(), self.validations, strict=True)
        medians = ", ".join(f"{np.median(v.error):.3g} at d = {d}" for d, v in pairs)
        return f"ErrorCurve(median errors of {len(self.reference)} samples: {medians})"


def usual_dimensions(dimension: int) -> list[int]:
    """At most eight dimensions in equal ratios, from a tenth of the largest to the largest."""
    spread = np.geomspace(max(SMALLEST_SHARE * dimension, 1.0), dimension, POINTS)
    return sorted({int(d) for d in np.rint(spread)})


def error_curve(
    model: ReducedModel,
    *,
    dimensions: Sequence[int] | None = None,
    samples: int | None = None,
    seed: int | None = None,
    reference: Snapshots | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> ErrorCurve:
    """Validates `model.leading(d)` for several d, with one set of full solutions.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    dimensions : sequence of int, optional
        Between 1 and the model's. Default: `usual_dimensions`.
    samples, seed, reference, threads, progress : as for `validate`

    Returns
    -------
    ErrorCurve
        Its projection errors never grow with d. The tets of a cubature were chosen for the whole
        model, and smaller dimensions use all of them. So times are proportional to d and not to
        d^2; a model built for a small d has fewer tets and is faster.

    Raises
    ------
    ValueError
        As for `validate`, and if a dimension is out of range or there are none.
    """
    check_model(model, "error_curve")
    chosen = usual_dimensions(model.dimension) if dimensions is None else _whole(dimensions)
    wrong = [d for d in chosen if not 1 <= d <= model.dimension]
    if wrong or not chosen:
        raise ValueError(
            f"error_curve: dimensions are {chosen}, but one or more are needed, each between 1 and "
            f"the model's, {model.dimension}"
        )
    reference, lower = given_or_solved(
        model, reference, samples=samples, seed=seed, threads=threads, progress=progress
    )
    validations = [
        replace(validate(model.leading(d), reference=reference), lower_minima=lower) for d in chosen
    ]
    return ErrorCurve(np.array(chosen, np.int64), tuple(validations))


def _whole(dimensions: Sequence[int]) -> list[int]:
    """Ascending dimensions, each once; ValueError for anything but a list of whole numbers."""
    require_type("error_curve", "dimensions", dimensions, Iterable, "give a list, such as [10, 20]")
    who, name = "error_curve", "a dimension"
    return sorted({require_count(who, name, d) for d in dimensions})
