"""The creature as an implicit shape: a young horned animal, half fawn, half dragon.

x points forward, y to its left, z up; it stands on z = 0, and y = 0 is its mirror plane.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from snapspace.generators.blended_shape import Part, blended, limb, lump

FloatArray = NDArray[np.float64]

# A box around the shape.
CREATURE_LOWER = (-1.75, -0.85, -0.05)
CREATURE_UPPER = (1.55, 0.85, 2.45)


def creature_shape(points: FloatArray) -> FloatArray:
    """Value of the implicit creature at points (k, 3): negative inside, exactly even in y."""
    folded = points.copy()
    np.abs(folded[:, 1], out=folded[:, 1])
    return blended(folded, _PARTS)


def _axes(pitch: float, yaw: float, roll: float) -> FloatArray:
    """Rows are x, y, z turned about x by roll, then y by pitch, then z by yaw (degrees)."""
    (cr, cp, cy), (sr, sp, sy) = (f(np.radians([roll, pitch, yaw])) for f in (np.cos, np.sin))
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return np.asarray((about_z @ about_y @ about_x).T)


# The left ear: its middle, and the directions it faces, spreads and points to.
EAR_CENTRE = np.array([0.63, 0.475, 1.92])
EAR_AXES = _axes(-20.0, -30.0, -44.0)

# The left horn and the left eye.
HORN = ((0.79, 0.13, 1.92, 0.115), (0.84, 0.18, 2.1, 0.095), (0.71, 0.21, 2.23, 0.08))
EYE_CENTRE, EYE_RADII = (0.99, 0.21, 1.715), (0.125, 0.125, 0.135)


def _ear() -> tuple[Part, ...]:
    """A leaf, hollow at the front: three limbs from a common base to a common tip."""
    front, side, up = EAR_AXES
    base, middle, tip = (EAR_CENTRE + step * up for step in (-0.28, 0.04, 0.29))
    ribs = ((0.0, -0.06, 0.1), (0.2, 0.1, 0.08), (-0.2, 0.1, 0.08))
    return tuple(
        limb(
            [(*base, 0.1), (*(middle + across * side + ahead * front), radius), (*tip, 0.07)],
            blend=0.08,
        )
        for across, ahead, radius in ribs
    )


# One half; the other is its mirror image. Parts that cross the plane y = 0 are symmetric. Nothing
# is thinner than the cells of the coarsest mesh (0.14), except the tips.
_TRUNK = (
    limb(  # rump to chest
        [(-0.5, 0, 0.74, 0.28), (-0.2, 0, 0.84, 0.32), (0.05, 0, 0.68, 0.29), (0.33, 0, 0.8, 0.31)],
        blend=0.1,
    ),
    limb(  # neck
        [(0.37, 0, 0.86, 0.25), (0.62, 0, 1.0, 0.19), (0.57, 0, 1.25, 0.15), (0.68, 0, 1.5, 0.165)],
        blend=0.2,
    ),
)
_FORELEG = (
    limb(
        [
            (0.34, 0.16, 0.72, 0.18),
            (0.33, 0.25, 0.5, 0.13),
            (0.36, 0.235, 0.3, 0.1),
            (0.38, 0.235, 0.13, 0.115),
        ],
        blend=0.12,
    ),
    lump((0.425, 0.238, 0.117), (0.17, 0.14, 0.12), blend=0.1),  # paw
)
_HINDLEG = (
    lump((-0.47, 0.18, 0.63), (0.25, 0.175, 0.27), axes=_axes(-20, 0, 0), blend=0.12),  # haunch
    limb(
        [
            (-0.42, 0.23, 0.5, 0.16),
            (-0.5, 0.245, 0.36, 0.11),
            (-0.68, 0.235, 0.32, 0.1),
            (-0.57, 0.235, 0.13, 0.11),
        ],
        blend=0.12,
    ),
    lump((-0.49, 0.238, 0.117), (0.18, 0.14, 0.12), blend=0.1),  # paw
)
_TAIL = (
    limb(
        [
            (-0.66, 0, 0.78, 0.18),
            (-1.1, 0, 0.7, 0.12),
            (-1.5, 0, 0.72, 0.07),
            (-1.44, 0, 1.25, 0.1),
        ],
        blend=0.16,
    ),
    limb(  # tuft
        [
            (-1.42, 0, 1.1, 0.08),
            (-1.5, 0, 1.3, 0.23),
            (-1.36, 0, 1.55, 0.15),
            (-1.22, 0, 1.7, 0.03),
        ],
        blend=0.1,
    ),
)
_HEAD = (
    lump((0.79, 0, 1.67), (0.345, 0.345, 0.32), blend=0.12),
    limb([(0.93, 0, 1.58, 0.2), (1.1, 0, 1.55, 0.165), (1.2, 0, 1.52, 0.14)], blend=0.14),  # snout
    lump((0.9, 0.18, 1.54), (0.18, 0.15, 0.14), blend=0.12),  # cheek
    lump((1.3, 0, 1.595), (0.065, 0.085, 0.06), blend=0.05),  # nose
    lump(EYE_CENTRE, EYE_RADII, blend=0.02),
    *_ear(),
    limb(HORN, blend=0.08),
)
_PARTS = _TRUNK + _FORELEG + _HINDLEG + _TAIL + _HEAD
