"""Certificates: estimates of how far a reduced solution is from the full one."""

from .certificate import Certificate
from .error_estimator import ErrorEstimator
from .local_ratios import LocalRatios
from .residual_growth import grown, growth_exponent, rest_size
from .residual_probe import BlendingProbe, PosingProbe, ResidualProbe
from .residual_sample import (
    ResidualSample,
    residual_sample,
    scalar_diagonal,
)
from .star_probe import BlendingStarProbe, StarProbe, blending_probe, posing_probe

__all__ = [
    "BlendingProbe",
    "BlendingStarProbe",
    "Certificate",
    "ErrorEstimator",
    "LocalRatios",
    "PosingProbe",
    "ResidualProbe",
    "ResidualSample",
    "StarProbe",
    "blending_probe",
    "grown",
    "growth_exponent",
    "posing_probe",
    "residual_sample",
    "rest_size",
    "scalar_diagonal",
]
