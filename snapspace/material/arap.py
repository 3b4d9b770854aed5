"""ARAP: as rigid as possible."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from .shear_material import ShearMaterial


@dataclass(frozen=True, kw_only=True, eq=False)
class ARAP(ShearMaterial):
    """As rigid as possible: mu |F - R|^2, with the rotation R nearest to F.

    The continuous form of Chao, Pinkall, Sanan, Schroeder 2010, "A Simple Geometric Model for
    Elastic Deformations"; fixed corotational without the volume term.

    Parameters and errors as for `ShearMaterial`.
    """

    kind: ClassVar[str] = "arap"
    title: ClassVar[str] = "as rigid as possible"
