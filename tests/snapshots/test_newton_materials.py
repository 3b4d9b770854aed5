"""Newton's method on every material: each projection ends where the fast solver ends."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import MATERIALS, Material, PosingProblem, SolverOptions, StVK, solve_snapshots
from snapspace import _core as core

from .bars import parameters, posing_bar, tight

FloatArray = NDArray[np.float64]
PROJECTIONS = [core.Projection.clamp, core.Projection.absolute, core.Projection.stretches]
SAMPLES = 3

every_kind = pytest.mark.parametrize("kind", MATERIALS.values(), ids=lambda kind: kind.kind)


def material_bar(kind: type[Material], *, varied: bool = False) -> PosingProblem:
    """A bar of one material, uniform or with random stiffness per tet, in ratios up to 1 : 10."""
    if not varied:
        return posing_bar(material=kind.from_lame(lam=1.5, mu=0.7))
    tets = len(posing_bar().mesh.tets)
    mu = np.exp(np.random.default_rng(1).uniform(np.log(0.3), np.log(3.0), tets))
    return posing_bar(material=kind.from_lame(lam=2.0 * mu, mu=mu))


def solved(
    problem: PosingProblem,
    projection: core.Projection | None,
    *,
    inputs: FloatArray | None = None,
    tolerance: float = 1e-13,
) -> core.Batch:
    """Solves from rest, by Newton's method with a projection or by the fast solver."""
    if inputs is None:
        inputs = problem.inputs(parameters(problem, SAMPLES))
    starts = np.zeros((SAMPLES, problem.base.size))
    options: dict[str, Any] = {"tolerance": tolerance, "max_iterations": 1000, "threads": 1}
    options["control"] = core.SolveControl()
    if projection is None:
        return problem.system.solve_fast(inputs, starts, **options)
    return problem.system.solve_newton(
        inputs, starts, projection=projection, threshold=0.65, **options
    )


@pytest.mark.parametrize("varied", [False, True], ids=["uniform", "per tet"])
@every_kind
def test_every_projection_ends_where_the_fast_solver_does(
    kind: type[Material], varied: bool
) -> None:
    problem = material_bar(kind, varied=varied)
    fast = solved(problem, None)
    scale = np.abs(fast.shapes).max()
    for projection in PROJECTIONS:
        newton = solved(problem, projection)
        for a, b in zip(newton.reports, fast.reports, strict=True):
            assert a.status == b.status == core.SolveStatus.converged
            assert a.inverted_tets == b.inverted_tets == 0
            assert a.value == pytest.approx(b.value, rel=1e-11)
            assert 0 < a.iterations < min(12, b.iterations), projection
        np.testing.assert_allclose(newton.shapes, fast.shapes, rtol=0, atol=1e-6 * scale)


@every_kind
def test_no_force_is_left(kind: type[Material]) -> None:
    """The problem's gradient is assembled in NumPy, in the order of the mesh."""
    problem = material_bar(kind, varied=True)
    samples = parameters(problem, SAMPLES)
    found = solve_snapshots(problem, samples, options=tight("newton"), threads=1)
    assert found.converged.all()
    for w, x, report in zip(samples, found.shapes, found.reports, strict=True):
        value, gradient = problem.value_and_gradient(x, w)
        _, elastic = problem.energy.value_and_gradient(x)
        assert np.linalg.norm(gradient) < 1e-6 * np.linalg.norm(elastic)
        assert report.value == pytest.approx(value, rel=1e-12)


@every_kind
def test_small_motions_take_few_steps_with_every_projection(kind: type[Material]) -> None:
    """Near rest little is projected, and the method is nearly Newton's own."""
    problem = material_bar(kind)
    inputs = problem.inputs(0.02 * parameters(problem, SAMPLES))
    for projection in PROJECTIONS:
        batch = solved(problem, projection, inputs=inputs, tolerance=1e-10)
        assert all(r.status == core.SolveStatus.converged for r in batch.reports)
        assert max(report.iterations for report in batch.reports) <= 6


@every_kind
def test_the_default_projection_is_that_of_the_material(kind: type[Material]) -> None:
    problem = material_bar(kind)
    usual = SolverOptions(solver="newton").resolved(problem).projection
    assert usual == problem.solving.projection
    assert usual == "stretches" or kind is not StVK
    for projection in ("stretches", "clamp", "absolute"):
        options = SolverOptions(solver="newton", tolerance=1e-13, projection=projection)  # type: ignore[arg-type]
        assert options.resolved(problem).projection == projection
        assert solve_snapshots(problem, parameters(problem, 1), options=options).converged.all()


def test_an_unknown_projection_is_refused() -> None:
    with pytest.raises(ValueError, match="unknown projection 'none'; known are stretches, clamp"):
        SolverOptions(solver="newton", projection="none")  # type: ignore[arg-type]
