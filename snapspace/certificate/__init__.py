"""Certificates: estimates of how far a reduced solution is from the full one."""

from .certificate import Certificate
from .error_estimator import ErrorEstimator
from .local_ratios import LocalRatios
from .residual_growth import grown, growth_exponent, rest_size
from .residual_probe import BlendingProbe, PosingProbe, ResidualProbe, has_certificates
from .residual_sample import (
    ResidualSample,
    residual_sample,
    scalar_diagonal,
)

__all__ = [
    "BlendingProbe",
    "Certificate",
    "ErrorEstimator",
    "LocalRatios",
    "PosingProbe",
    "ResidualProbe",
    "ResidualSample",
    "grown",
    "growth_exponent",
    "has_certificates",
    "residual_sample",
    "rest_size",
    "scalar_diagonal",
]
