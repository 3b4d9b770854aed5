"""notice_outliers: a notice about the few motions that a median hides."""

from __future__ import annotations

import numpy as np

from ..reduction import ReducedModel
from ..validation import Validation, other_minima
from .console import notice
from .units import in_percent

#: A mean error is examined if it is above this value, and above this many medians.
_MEAN, _MEDIANS = 0.02, 3.0
#: Motions with this error look wrong. If the projection error is a tenth of it, the subspace is not
#: the cause.
_FAR, _SHARE = 0.1, 0.1
#: Why frames are at other minima, and what helps.
OTHER_MINIMUM = "at another minimum of the energy, for example because a thin part buckles"
CURE = "make the box of motions smaller, or put a handle on the part that buckles"


def notice_outliers(model: ReducedModel, validation: Validation) -> None:
    """A notice if a few motions have large errors while the median is small, with the likely cause.

    A thin part under compression buckles to one of several sides, and the energy has a minimum for
    each. Reduced and full solution may then be at different minima, and a better model does not
    change that. A reduced solve that starts beside the full solution tells these motions from those
    for which the subspace is too stiff.
    """
    errors = validation.error
    mean, far = float(errors.mean()), errors > _FAR
    if mean <= max(_MEAN, _MEDIANS * float(np.median(errors))) or not far.any():
        return
    near = np.flatnonzero(far & (validation.projection_error < _SHARE * errors))
    snapped = int(other_minima(model, validation.reference, near).sum())
    cause, cure = "", "give a smaller --target-error, or make the box of motions smaller"
    if 2 * snapped > far.sum():
        which = "" if snapped == far.sum() else f"{snapped} of them "
        cause, cure = f", {which}{OTHER_MINIMUM}", CURE
    notice(
        f"notice: {int(far.sum())} of {len(errors)} unseen motions are more than "
        f"{in_percent(_FAR)} off, at most {in_percent(float(errors.max()))}{cause}; {cure}"
    )
