"""Held-out blends of solids are solved so tightly that they can judge models."""

from __future__ import annotations

import numpy as np

from snapspace import InterpolationProblem, Poses, SolverOptions, sample, solve_snapshots
from snapspace.accurate.plan import BLENDS
from snapspace.accurate.solving import Solving
from snapspace.generators import lizard_poses
from snapspace.mesh import mass_norms


def test_they_are_off_by_at_most_a_tenth_of_the_target() -> None:
    problem = InterpolationProblem(Poses.of(lizard_poses(4, 4000, seed=11)))
    weights = sample(problem.domain, 6, method="blends", seed=2)
    judging = Solving().judging(problem)
    usual = Solving().usual(problem)
    assert judging.resolved(problem).tolerance < usual.resolved(problem).tolerance
    loose, tight = (
        solve_snapshots(problem, weights, options=options)
        for options in (judging, SolverOptions(tolerance=1e-15, max_iterations=4000))
    )
    exact = np.asarray(tight.displacements) - (problem.tau - problem.base)
    missed = np.asarray(loose.displacements) - np.asarray(tight.displacements)
    errors = mass_norms(problem.mass(), missed) / mass_norms(problem.mass(), exact)
    assert 0 < errors.max() < 0.1 * BLENDS.target
