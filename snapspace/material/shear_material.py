"""Materials whose only modulus is the shear modulus."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from numpy.typing import ArrayLike

from .material import Material, Modulus

Own = TypeVar("Own", bound="ShearMaterial")


@dataclass(frozen=True, kw_only=True, eq=False)
class ShearMaterial(Material):
    """A density without a volume term: its first Lame parameter is zero.

    Parameters
    ----------
    mu : float or array (m,), default 1
        Shear modulus in energy per rest volume, > 0; an array has one number per tet.

    Raises
    ------
    ValueError
        If `mu` is not finite or not positive.
    """

    mu: Modulus = 1.0

    @property
    def lam(self) -> float:
        """Zero."""
        return 0.0

    @classmethod
    def from_lame(cls: type[Own], *, lam: ArrayLike, mu: ArrayLike) -> Own:
        """The material with this shear modulus; `lam` is ignored."""
        return cls(mu=mu)  # type: ignore[arg-type]  # __init__ checks
