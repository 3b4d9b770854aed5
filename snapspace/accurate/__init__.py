"""Models as accurate as is asked: samples and dimension follow from measured errors."""

from .accurate_model import TARGET_ERROR, AccurateModel, Step, accurate_model, check_target
from .plan import usual_most_samples

__all__ = [
    "TARGET_ERROR",
    "AccurateModel",
    "Step",
    "accurate_model",
    "check_target",
    "usual_most_samples",
]
