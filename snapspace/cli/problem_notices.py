"""notice_odd_problem: notices about a valid problem that is probably not what the user meant."""

from __future__ import annotations

from ..problem import PosingProblem
from .console import notice

#: Translations of this many diagonals tear any body.
_MOST = 2.0
#: Translations below this share of the diagonal cannot be seen.
_LEAST = 1e-3


def notice_odd_problem(problem: PosingProblem) -> None:
    """Notices about the length of the motions, and about handles that leave no vertex free."""
    _notice_box(problem)
    _notice_held(problem)


def _notice_box(problem: PosingProblem) -> None:
    """A notice if all translations are very long or very short, as with a wrong unit of length."""
    farthest = float(problem.domain.bounds[:, :3].max())
    diagonal = problem.mesh.diagonal
    if farthest == 0 or _LEAST * diagonal <= farthest <= _MOST * diagonal:
        return
    at_most = "by up to" if farthest > diagonal else "by only"
    notice(
        f"notice: handles move {at_most} {farthest:.4g}, {farthest / diagonal:.3g} times the "
        f"diagonal of the mesh ({diagonal:.4g}); the domain's 'translation' is in the mesh's unit "
        "of length"
    )


def _notice_held(problem: PosingProblem) -> None:
    """A notice if every vertex belongs to a handle."""
    count = len(problem.mesh.vertices)
    if sum(len(handle.vertices) for handle in problem.handles) < count:
        return
    notice(
        f"notice: the handles contain all {count} vertices of the mesh, so only the elements "
        "between two handles deform; make the handles smaller"
    )
