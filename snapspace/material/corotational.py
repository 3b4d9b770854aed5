"""Corotational: fixed corotational material."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from .lame_material import LameMaterial


@dataclass(frozen=True, kw_only=True, eq=False)
class Corotational(LameMaterial):
    """Fixed corotational: mu |F - R|^2 + lam/2 (J - 1)^2, with the rotation R nearest to F.

    After Stomakhin, Howes, Schroeder, Teran 2012, "Energetically Consistent Invertible Elasticity".

    Parameters and errors as for `LameMaterial`.
    """

    kind: ClassVar[str] = "corotational"
    title: ClassVar[str] = "fixed corotational"
