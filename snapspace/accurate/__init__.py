"""Models as accurate as is asked: samples and dimension follow from measured errors."""

from .accurate_model import AccurateModel, Step, accurate_model, check_target
from .plan import BLENDS, MOTIONS, usual_most_samples

__all__ = [
    "BLENDS",
    "MOTIONS",
    "AccurateModel",
    "Step",
    "accurate_model",
    "check_target",
    "usual_most_samples",
]
