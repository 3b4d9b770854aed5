"""Materials."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class StVK:
    """St.Venant-Kirchhoff: density mu |E|^2 + lam/2 tr(E)^2 of the strain E = (F^T F - I) / 2.

    Parameters
    ----------
    lam, mu : float, default 1
        Lame parameters, in energy per rest volume; mu > 0 and lam >= 0.

    Raises
    ------
    ValueError
        If a parameter is not finite or outside of its range.

    Notes
    -----
    The reduced energy is an exact polynomial of degree four (paper, sec. 6.1). The material does
    not resist inversion: psi(F) = psi(-F), and strong compression softens it.
    """

    lam: float = 1.0
    mu: float = 1.0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.mu) and self.mu > 0):
            raise ValueError(f"StVK: mu is {self.mu}, but the shear modulus must be positive")
        if not (math.isfinite(self.lam) and self.lam >= 0):
            raise ValueError(f"StVK: lam is {self.lam}, but it must be zero or positive")

    @classmethod
    def from_young(cls, *, youngs_modulus: float, poisson_ratio: float) -> StVK:
        """The material with a Young's modulus > 0 and a Poisson ratio in [0, 0.5)."""
        if not (math.isfinite(youngs_modulus) and youngs_modulus > 0):
            raise ValueError(f"StVK: youngs_modulus is {youngs_modulus}, but it must be positive")
        if not 0 <= poisson_ratio < 0.5:
            raise ValueError(f"StVK: poisson_ratio is {poisson_ratio}, but it must be in [0, 0.5)")
        mu = youngs_modulus / (2 * (1 + poisson_ratio))
        lam = youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))
        return cls(lam=lam, mu=mu)
