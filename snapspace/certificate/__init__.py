"""Certificates: estimates of how far a reduced solution is from the full one."""

from .certificate import Certificate
from .element_probe import ElementProbe
from .error_estimator import ErrorEstimator
from .local_ratios import LocalRatios
from .make_probe import residual_probe
from .residual_growth import grown, growth_exponent, rest_size
from .residual_probe import ResidualProbe
from .residual_sample import (
    ResidualSample,
    residual_sample,
    scalar_diagonal,
)
from .star_probe import StarProbe, stars_of

__all__ = [
    "Certificate",
    "ElementProbe",
    "ErrorEstimator",
    "LocalRatios",
    "ResidualProbe",
    "ResidualSample",
    "StarProbe",
    "grown",
    "growth_exponent",
    "residual_probe",
    "residual_sample",
    "rest_size",
    "scalar_diagonal",
    "stars_of",
]
