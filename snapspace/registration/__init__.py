"""Registration of shapes: rigid motions in the M-norm, and units of length."""

from .rigid import RigidMotion, registered, rigid_registration
from .scales import SCALE_POLICIES, UNITS_DIFFER_BEYOND, ScalePolicy, matched_scales, scale_factors

__all__ = [
    "SCALE_POLICIES",
    "UNITS_DIFFER_BEYOND",
    "RigidMotion",
    "ScalePolicy",
    "matched_scales",
    "registered",
    "rigid_registration",
    "scale_factors",
]
