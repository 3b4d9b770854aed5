"""Models as accurate as is asked: samples and dimension follow from measured errors."""

from .accurate_blends import (
    TARGET_ERROR,
    AccurateBlends,
    Step,
    accurate_blends,
    check_target,
    usual_most_samples,
)

__all__ = [
    "TARGET_ERROR",
    "AccurateBlends",
    "Step",
    "accurate_blends",
    "check_target",
    "usual_most_samples",
]
