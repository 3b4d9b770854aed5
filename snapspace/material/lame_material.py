"""Materials whose moduli are the Lame parameters."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from numpy.typing import ArrayLike

from .material import Material, Modulus

Own = TypeVar("Own", bound="LameMaterial")


@dataclass(frozen=True, kw_only=True, eq=False)
class LameMaterial(Material):
    """A density whose moduli are the Lame parameters.

    Parameters
    ----------
    lam, mu : float or array (m,), default 1
        In energy per rest volume; mu > 0 and lam >= 0; arrays have one number per tet.

    Raises
    ------
    ValueError
        If a parameter is not finite or outside its range.
    """

    lam: Modulus = 1.0
    mu: Modulus = 1.0

    @classmethod
    def from_lame(cls: type[Own], *, lam: ArrayLike, mu: ArrayLike) -> Own:
        """The material with these parameters."""
        return cls(lam=lam, mu=mu)  # type: ignore[arg-type]  # __init__ checks
