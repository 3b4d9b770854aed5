"""Models as accurate as is asked: samples and dimension follow from measured errors."""

from .accurate_blends import (
    MOST_SAMPLES,
    TARGET_ERROR,
    AccurateBlends,
    Step,
    accurate_blends,
    check_target,
)

__all__ = [
    "MOST_SAMPLES",
    "TARGET_ERROR",
    "AccurateBlends",
    "Step",
    "accurate_blends",
    "check_target",
]
