"""newton_samples: the paper's Newton method on a few samples, and the seconds that it takes."""

from __future__ import annotations

import numpy as np

import snapspace as ss

from .timing import timed


def newton_samples(
    solved: ss.Snapshots, count: int, *, threads: int | None = None
) -> tuple[ss.Snapshots, float]:
    """Solves samples from the middle of a sequence again, by Newton's method (paper, sec. 4.2).

    Each starts from the nearest sample of the first half, as it would in the middle of a run of
    Newton's method: the cost of such samples is about the mean of a whole run.

    Parameters
    ----------
    solved : the whole sequence, two samples or more
    count : how many are solved again, at most half of them
    threads : default all

    Returns
    -------
    Snapshots, float
        The samples, and the wall time in seconds.

    Raises
    ------
    ValueError
        For a count that is not between 1 and half of the samples.
    """
    half = len(solved) // 2
    if not 1 <= count <= half:
        raise ValueError(
            f"newton_samples: count is {count}, but must be between 1 and {half}, half of the "
            f"{len(solved)} samples"
        )
    options = ss.SolverOptions(solver="newton")
    parameters = solved.parameters[half : half + count]
    known = solved.select(np.arange(len(solved)) < half)
    return timed(
        lambda: ss.solve_snapshots(
            solved.problem, parameters, options=options, threads=threads, known=known
        )
    )
