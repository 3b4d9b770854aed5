"""Validation: errors of reduced models against full solutions, their causes and cures."""

from .error_curve import ErrorCurve, error_curve, usual_dimensions
from .error_split import PARTS, ErrorSplit, Part, split_errors
from .frame_errors import projection_errors, solution_errors, unseen_errors
from .given_reference import check_reference
from .lower_minima import with_lower_minima
from .next_option import FACTOR, NextOption, needs_advice, next_option
from .other_minima import other_minima
from .unseen import REFERENCE_TOLERANCE, reference_options, solved_reference, unseen_parameters
from .validate import validate
from .validation import Validation

__all__ = [
    "FACTOR",
    "PARTS",
    "REFERENCE_TOLERANCE",
    "ErrorCurve",
    "ErrorSplit",
    "NextOption",
    "Part",
    "Validation",
    "check_reference",
    "error_curve",
    "needs_advice",
    "next_option",
    "other_minima",
    "projection_errors",
    "reference_options",
    "solution_errors",
    "solved_reference",
    "split_errors",
    "unseen_errors",
    "unseen_parameters",
    "usual_dimensions",
    "validate",
    "with_lower_minima",
]
