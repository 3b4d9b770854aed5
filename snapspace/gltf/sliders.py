"""sliders: weights from 0 to 1, which Blender and game engines do not clamp."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..reduction import ReducedModel
from .morph_targets import MorphTargets, fitted_targets

FloatArray = NDArray[np.float64]
#: A negative weight of a size below this share of its target's largest one counts as zero.
_NOTHING = 1e-9


def sliders(weights: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Weights between 0 and 1, and their targets.

    Blender gives imported keys this range and clamps other values, as some engines do.

    Parameters
    ----------
    weights : (k, m)
        Of m targets in k shapes.

    Returns
    -------
    mix : (m, m), or (m + 1, m)
        The new targets as sums of the old ones. If weights are negative, there is one more at the
        end, the sum of all lower bounds.
    values : (k, m), or (k, m + 1)
        The weights of the new targets, with values @ mix = weights. The weight of the additional
        target is 1 in all shapes.
    """
    low = weights.min(axis=0, initial=0.0)
    low[-low <= _NOTHING * np.abs(weights).max(axis=0, initial=0.0)] = 0.0
    span = weights.max(axis=0, initial=0.0) - low
    span[span == 0.0] = 1.0
    values = np.clip((weights - low) / span, 0.0, 1.0)
    if not low.any():
        return np.diag(span), values
    return np.vstack([np.diag(span), low]), np.hstack([values, np.ones((len(values), 1))])


def with_sliders(morphs: MorphTargets) -> MorphTargets:
    """The same shapes by weights between 0 and 1, see `sliders`."""
    mix, values = sliders(morphs.weights)
    return replace(
        morphs,
        targets=np.tensordot(mix, morphs.targets, axes=1),
        normal_targets=np.tensordot(mix, morphs.normal_targets, axes=1),
        weights=values,
    )


def film_targets(model: ReducedModel, shapes: ArrayLike, *, count: int = 8) -> MorphTargets:
    """`fitted_targets` with weights between 0 and 1, for animations.

    ValueError for no shapes, or a count below two: the last target may be an offset.
    """
    if count < 2:
        raise ValueError(
            f"targets: a film needs at least two, not {count}; one of them may be an offset, since "
            "weights lie between 0 and 1"
        )
    return with_sliders(fitted_targets(model, shapes, count=count - 1))
