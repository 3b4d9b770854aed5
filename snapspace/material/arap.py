"""ARAP: as rigid as possible."""

from __future__ import annotations

from dataclasses import dataclass, field
from numbers import Real
from typing import ClassVar

from ..arguments import shown
from .material import SETTING
from .shear_material import ShearMaterial

#: Radius of the stars of posed surfaces whose material is not named.
SURFACE_RADIUS = 0.02
#: The same for blended surfaces: the smallest radius with which all paths between poses were
#: continuous, and the same in both directions, on the sets that it was chosen on, see
#: docs/notes/surface-blends.md. Smaller stars have two minima where a part turns by 180 degrees
#: between poses.
BLEND_RADIUS = 0.05


@dataclass(frozen=True, kw_only=True, eq=False)
class ARAP(ShearMaterial):
    """As rigid as possible: mu |F - R|^2, with the rotation R nearest to F.

    The continuous form of Chao, Pinkall, Sanan, Schroeder 2010, "A Simple Geometric Model for
    Elastic Deformations"; fixed corotational without the volume term.

    Parameters
    ----------
    mu : as for `ShearMaterial`
    radius : float, default 0
        For surfaces only: distance along the surface, relative to the diagonal, between the centers
        of neighbourhoods that share a rotation. Neighbourhoods overlap like hat functions. So a
        surface resists bending by this radius, however fine its mesh is. Where edges are longer,
        and everywhere with 0, there is one neighbourhood per vertex, with the triangles around it:
        spokes and rims (Sorkine, Alexa 2007). Larger neighbourhoods are like the rotation clusters
        of Jacobson, Baran, Kavan, Popovic, Sorkine 2012. Parts smaller than twice the radius are
        blended linearly. Without a given material, the radius is 0.02 for posed surfaces and 0.05
        for blended ones.

    Raises
    ------
    ValueError
        As for `ShearMaterial`; for a radius that is not between 0 and 1.
    """

    kind: ClassVar[str] = "arap"
    title: ClassVar[str] = "as rigid as possible"

    radius: float = field(default=0.0, metadata=SETTING)

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (isinstance(self.radius, Real) and 0.0 <= self.radius <= 1.0):
            raise ValueError(
                f"ARAP: radius is {shown(self.radius)}, but must be a number from 0 to 1, relative "
                "to the diagonal"
            )
        object.__setattr__(self, "radius", float(self.radius))
