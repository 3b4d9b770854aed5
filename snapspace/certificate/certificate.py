"""Certificate: an estimate of how far one frame is from the full solution."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Certificate:
    """How far a frame is from the full solution for the same handles or weights.

    distance : estimate of the root mean square distance of the two shapes over the body's mass,
    |x_red - x_full|_M / sqrt(mass), in the mesh's length unit
    relative : `distance` divided by the frame's distance from the rest or mean shape
    upper_distance, upper_relative : upper bounds that hold with probability `confidence`
    confidence : that probability, for parameters drawn at random from the sampled domain
    seconds : time that the certificate took

    The estimate is a median: the true distance is above it as often as below. For a single frame a
    factor of two is usual.
    """

    distance: float
    relative: float
    upper_distance: float
    upper_relative: float
    confidence: float
    seconds: float
