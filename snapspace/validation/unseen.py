"""Unseen samples: tight full solutions at parameters that no model is trained with."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require_count
from ..problem import Problem
from ..sampling import Domain
from ..snapshots import Progress, Snapshots, SolverOptions, solve_snapshots

FloatArray = NDArray[np.float64]

#: The reference is solved until twice the predicted decrease is below this share of F, or below a
#: hundredth of the snapshots' tolerance. On the Dragon its shapes are then within 1e-4 of the
#: limit, relative to the displacement.
REFERENCE_TOLERANCE = 1e-10
#: Samples that need more iterations are left out. A small bound would leave out one kind of motion:
#: on a spring of six turns one sample in ten takes more than 5000 iterations, and a long wire takes
#: 16,000.
REFERENCE_ITERATIONS = 20_000


def unseen_parameters(domain: Domain, count: int, *, seed: int) -> FloatArray:
    """Uniform random parameters (count, p), from a stream that `sample` never uses."""
    count = require_count("validate", "the number of samples", count, at_least=1)
    seed = require_count("validate", "the seed", seed, at_least=0)
    stream = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(1,)))
    return domain.from_unit(stream.random((count, domain.dimension)))


def reference_options(problem: Problem) -> SolverOptions:
    """Solver options for the full solutions with which models are compared."""
    tolerance = min(REFERENCE_TOLERANCE, 0.01 * problem.solving.tolerance)
    return SolverOptions(tolerance=tolerance, max_iterations=REFERENCE_ITERATIONS)


def solved_reference(
    problem: Problem,
    *,
    samples: int = 30,
    seed: int = 1,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Snapshots:
    """Tightly solved full solutions at unseen parameters, without those that did not converge.

    Parameters
    ----------
    problem : Problem
    samples : int, default 30
        Number of solutions.
    seed : int, default 1
        Seed of `unseen_parameters`.
    threads, progress : as for `solve_snapshots`

    Raises
    ------
    ValueError
        If none converged.
    """
    parameters = unseen_parameters(problem.domain, samples, seed=seed)
    solved = solve_snapshots(
        problem,
        parameters,
        options=reference_options(problem),
        threads=threads,
        progress=progress,
    )
    reference = solved.select(solved.converged)
    if len(reference) == 0:
        raise ValueError(
            "validate: no full solution converged, so there is nothing to compare with"
        )
    return reference
