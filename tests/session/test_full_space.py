"""In a subspace that holds every shape, the reduced solve is the full one."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import (
    HandleBox,
    Handles,
    PosingProblem,
    SolverOptions,
    StVK,
    reduce,
    solve_snapshots,
)
from snapspace.generators import bar

from ..shapes import random_subspace


@pytest.mark.parametrize("solver", ["newton", "fast"])
def test_all_directions_together_give_the_full_solution(solver: str) -> None:
    mesh = bar(4, 1, 1)  # 20 vertices
    foot, head = (np.flatnonzero(mesh.vertices[:, 0] == x) for x in (0.0, 4.0))
    problem = PosingProblem(
        mesh,
        Handles([foot, head], names=["foot", "head"]),
        domain=HandleBox(translation=0.5, angle=0.5),
        material=StVK(),
        stiffness=100.0,
    )
    w = np.array([[0.3, 0.2, -0.4, 0.3, -0.2, 0.4], [-0.1, 0.3, 0.4, -0.5, 0.1, 0.2]])
    options = SolverOptions(solver=solver, tolerance=1e-13, max_iterations=5000)  # type: ignore[arg-type]
    full = solve_snapshots(problem, w, options=options, threads=1)
    assert full.converged.all()

    model = reduce(problem, random_subspace(mesh, 60), energy="exact", threads=1)
    session = model.session(tolerance=1e-14)
    for parameters, shape, report in zip(w, full.shapes, full.reports, strict=True):
        session.reset()
        frame = session.pose(parameters)
        assert frame.converged
        assert frame.value == pytest.approx(report.value, rel=1e-9)
        assert session.vertices.reshape(-1) == pytest.approx(shape, abs=1e-5)
