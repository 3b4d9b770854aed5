"""Samples of every material, also with soft and stiff parts, by both solvers."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

from snapspace import (
    MATERIALS,
    Material,
    PosingProblem,
    SolverOptions,
    StableNeoHookean,
    StVK,
    solve_snapshots,
)
from snapspace.mesh import mass_norms
from snapspace.snapshots import run_key, solver_key

from .bars import assert_same_bits, parameters, posing_bar

KINDS = sorted(set(MATERIALS) - {"symmetric-dirichlet"})


def graded(kind: type[Material], problem: PosingProblem) -> PosingProblem:
    """The bar, four times as stiff at one end as at the other."""
    x = problem.mesh.vertices[problem.mesh.tets].mean(axis=1)[:, 0]
    moduli = {name: 1.0 + 3.0 * x / x.max() for name in kind.names()}
    return posing_bar(material=kind(**moduli))


@pytest.mark.parametrize("parts", [False, True], ids=["uniform", "graded"])
@pytest.mark.parametrize("kind", KINDS)
def test_both_solvers_find_the_same_minimum(kind: str, parts: bool) -> None:
    problem = posing_bar(material=MATERIALS[kind]())
    if parts:
        problem = graded(MATERIALS[kind], problem)
    samples = parameters(problem, 5)
    shapes = []
    for solver in ("fast", "newton"):
        options = SolverOptions(solver=solver, tolerance=1e-13)  # type: ignore[arg-type]
        solved = solve_snapshots(problem, samples, options=options, threads=1)
        assert solved.converged.all(), solved.summary()
        for w, report, shape in zip(samples, solved.reports, solved.shapes, strict=True):
            value, gradient = problem.value_and_gradient(shape, w)
            assert report.value == pytest.approx(value, rel=1e-9)
            assert np.abs(gradient).max() < 1e-3 * problem.pin_weights.max()
        shapes.append(solved.displacements.array())
    size = mass_norms(problem.mass(), shapes[0])
    assert (mass_norms(problem.mass(), shapes[0] - shapes[1]) < 1e-4 * size).all()


@pytest.mark.parametrize("projection", ["stretches", "clamp", "absolute"])
def test_projections_change_the_path_and_not_the_minimum(projection: str) -> None:
    problem = posing_bar(material=StVK())
    samples = parameters(problem, 4)
    options = SolverOptions(solver="newton", tolerance=1e-13, projection=projection)  # type: ignore[arg-type]
    solved = solve_snapshots(problem, samples, options=options, threads=1)
    fast = solve_snapshots(problem, samples, options=SolverOptions(tolerance=1e-13), threads=1)
    assert solved.converged.all()
    values = [[report.value for report in one.reports] for one in (solved, fast)]
    assert values[0] == pytest.approx(values[1], rel=1e-9)


def test_workers_know_moduli_of_single_tets(processes: ProcessPoolExecutor) -> None:
    problem = graded(StableNeoHookean, posing_bar())
    samples = parameters(problem, 20)
    here = solve_snapshots(problem, samples, threads=1)
    assert_same_bits(here, solve_snapshots(problem, samples, executor=processes))


def test_another_material_does_not_resume_from_a_checkpoint() -> None:
    """Even one with the same moduli does not, because keys contain the whole material."""
    options = SolverOptions(tolerance=1e-6)
    keys = set()
    for material in (StVK(), StableNeoHookean(), StVK(mu=np.ones(192)), StVK(lam=1.0000001)):
        problem = posing_bar(material=material)
        keys.add(run_key(problem, parameters(problem, 3), solver_key(options, problem)))
    assert len(keys) == 4
