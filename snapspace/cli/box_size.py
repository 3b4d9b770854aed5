"""notice_wide_box: a notice about motions that are much longer than the body."""

from __future__ import annotations

from ..problem import PosingProblem
from .console import notice

#: Translations of this many diagonals tear any body.
_MOST = 2.0


def notice_wide_box(problem: PosingProblem) -> None:
    """A notice if handles move by more than two diagonals, as with a wrong unit of length."""
    farthest = float(problem.domain.bounds[:, :3].max())
    diagonal = problem.mesh.diagonal
    if farthest <= _MOST * diagonal:
        return
    notice(
        f"notice: handles move by up to {farthest:.4g}, {farthest / diagonal:.3g} times the "
        f"diagonal of the mesh ({diagonal:.4g}); the domain's 'translation' is in the mesh's unit "
        "of length"
    )
