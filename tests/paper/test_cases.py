"""The cases of the paper's programs."""

from __future__ import annotations

import numpy as np
import pytest

import snapspace as ss
from paper.cases import CASES, read, scaled

from ..shapes import bar_problem


def test_a_scaled_problem_has_the_same_solutions_up_to_scale() -> None:
    """Elastic energies grow with the volume, handles' with the volume and the squared length."""
    problem = bar_problem()
    scale = 10.0
    stiffness = problem.stiffness / scale**2
    larger = scaled(problem, scale**3 * problem.mesh.volume, stiffness=stiffness)
    unit = np.full((1, problem.parameter_count), 0.6)
    options = ss.SolverOptions(tolerance=1e-12, settling=0.0, max_iterations=5000)
    small, large = (
        ss.solve_snapshots(one, one.domain.from_unit(unit), options=options, threads=1).shapes[0]
        for one in (problem, larger)
    )
    assert np.allclose(large, scale * small, atol=1e-5 * scale * problem.mesh.diagonal)


@pytest.mark.parametrize("name", sorted(CASES))
def test_every_case_has_a_generated_stand_in(name: str) -> None:
    case = read(name, "stable-neo-hookean", quick=True)
    assert case.generated and case.fitting is None
    assert case.problem.material.kind == "stable-neo-hookean"
