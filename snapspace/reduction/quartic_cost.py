"""The time that an exact reduced energy takes, reported before it begins."""

from __future__ import annotations

import warnings

from ..notice import Notice
from ..problem import InterpolationProblem, PosingProblem
from .quartic import coefficient_count

#: The user is warned if it takes more than this many seconds.
LONG = 60.0
#: Per tet and coefficient, on one or two threads: 0.70 to 1.41 ns were measured, d = 20 to 80.
_SECONDS = 0.8e-9


class LongWorkNotice(Notice):
    """A step takes long, and there is a faster alternative."""


def exact_seconds(problem: PosingProblem | InterpolationProblem, dimension: int) -> float:
    """About how long `reduce` takes for an exact energy, in seconds on one core.

    Proportional to the number of tets times the C(d + 4, 4) coefficients; an interpolation takes
    that for every pose.
    """
    poses = len(problem.poses) if isinstance(problem, InterpolationProblem) else 1
    return _SECONDS * poses * len(problem.mesh.cells) * coefficient_count(dimension)


def warn_of_long_quartics(problem: PosingProblem | InterpolationProblem, dimension: int) -> None:
    """Warns with a `LongWorkNotice` if an exact energy takes more than a minute."""
    seconds = exact_seconds(problem, dimension)
    if seconds <= LONG:
        return
    size = 8e-6 * coefficient_count(dimension)
    warnings.warn(
        f"reduce: the exact energy of {len(problem.mesh.cells)} tets in {dimension} dimensions has "
        f"{coefficient_count(dimension)} coefficients ({size:.0f} MB) and takes about "
        f"{seconds:.0f} s on one core; energy='cubature' (command line: --energy cubature) is "
        "trained on the snapshots in seconds",
        LongWorkNotice,
        stacklevel=3,
    )
