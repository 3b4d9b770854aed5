"""StVK: the paper's material."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from .lame_material import LameMaterial


@dataclass(frozen=True, kw_only=True, eq=False)
class StVK(LameMaterial):
    """St.Venant-Kirchhoff: mu |E|^2 + lam/2 tr(E)^2 of the strain E = (F^T F - I) / 2 (paper, 3.1).

    Parameters and errors as for `LameMaterial`.

    Notes
    -----
    The reduced energy is an exact polynomial of degree four (paper, sec. 6.1). The material does
    not resist inversion: psi(F) = psi(-F), strong compression softens it, and its solutions are not
    unique.
    """

    kind: ClassVar[str] = "stvk"
    title: ClassVar[str] = "St.Venant-Kirchhoff"
    exact_degree: ClassVar[int | None] = 4
