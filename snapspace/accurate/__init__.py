"""Models of a given accuracy: samples and dimension follow from measured errors."""

from .accurate_model import AccurateModel, accurate_model
from .checks import check_budget, check_most
from .growing_models import Growth, growing_models
from .plan import BLENDS, MOTIONS, plan_of, usual_most_samples
from .step import Step

__all__ = [
    "BLENDS",
    "MOTIONS",
    "AccurateModel",
    "Growth",
    "Step",
    "accurate_model",
    "check_budget",
    "check_most",
    "growing_models",
    "plan_of",
    "usual_most_samples",
]
