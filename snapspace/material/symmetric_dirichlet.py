"""SymmetricDirichlet: the material of surface fits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from .shear_material import ShearMaterial


@dataclass(frozen=True, kw_only=True, eq=False)
class SymmetricDirichlet(ShearMaterial):
    """Symmetric Dirichlet: mu (|F|^2 + |F^-1|^2 - 6) / 4, infinite where det F <= 0.

    After Smith & Schaefer 2015, "Bijective Parameterization with Free Boundaries". Poses are fitted
    to surfaces with this energy, because it prevents inversion.

    Parameters and errors as for `ShearMaterial`.
    """

    kind: ClassVar[str] = "symmetric-dirichlet"
    title: ClassVar[str] = "symmetric Dirichlet"
    barrier: ClassVar[bool] = True
