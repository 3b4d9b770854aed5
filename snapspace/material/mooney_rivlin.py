"""MooneyRivlin: rubber."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import as_numbers
from .material import Material, Modulus


@dataclass(frozen=True, kw_only=True, eq=False)
class MooneyRivlin(Material):
    """Mooney-Rivlin: mu1/2 (|F|^2 - 3) + mu2/2 (|cof F|^2 - 3), and terms of J.

    The terms of J are -(mu1 + 2 mu2) (J - 1) + (lam + mu1)/2 (J - 1)^2. With mu2 = 0 it is stable
    neo-Hookean.

    Parameters
    ----------
    lam, mu1, mu2 : float or array (m,), default 1, 0.5 and 0.5
        In energy per rest volume, all >= 0; the shear modulus mu = mu1 + mu2 is > 0.

    Raises
    ------
    ValueError
        If a parameter is not finite or outside its range.
    """

    kind: ClassVar[str] = "mooney-rivlin"
    title: ClassVar[str] = "Mooney-Rivlin"

    lam: Modulus = 1.0
    mu1: Modulus = 0.5
    mu2: Modulus = 0.5

    def __post_init__(self) -> None:
        super().__post_init__()
        if np.any(self.mu == 0):
            raise ValueError(
                "MooneyRivlin: mu1 and mu2 are both zero, but mu1 + mu2 must be positive"
            )

    @property
    def mu(self) -> Modulus:
        """Shear modulus mu1 + mu2."""
        mu: Modulus = self.mu1 + self.mu2
        return mu

    @classmethod
    def from_lame(cls, *, lam: ArrayLike, mu: ArrayLike) -> MooneyRivlin:
        """The material with these Lame parameters and mu1 = mu2."""
        half = 0.5 * as_numbers("MooneyRivlin", "mu", mu)
        return cls(lam=lam, mu1=half, mu2=half)  # type: ignore[arg-type]  # __init__ checks
