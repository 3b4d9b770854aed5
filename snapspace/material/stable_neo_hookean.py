"""StableNeoHookean: the default material."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from .lame_material import LameMaterial


@dataclass(frozen=True, kw_only=True, eq=False)
class StableNeoHookean(LameMaterial):
    """Stable neo-Hookean: mu/2 (|F|^2 - 3) - mu (J - 1) + (lam + mu)/2 (J - 1)^2, J = det F.

    After Smith, de Goes, Kim 2018, "Stable Neo-Hookean Flesh Simulation": the form without the
    barrier at F = 0, with parameters chosen so that lam and mu are the Lame parameters at small
    strains. Inverted tets are pushed back; volume is preserved well up to a Poisson ratio of 0.49.

    Parameters and errors as for `LameMaterial`.
    """

    kind: ClassVar[str] = "stable-neo-hookean"
    title: ClassVar[str] = "stable neo-Hookean"
    collapses: ClassVar[bool] = True
