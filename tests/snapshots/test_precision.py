"""Single precision: the shapes of double precision to less than the tolerance."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace import (
    HandleBox,
    Handles,
    PosingProblem,
    Snapshots,
    SolverOptions,
    StVK,
    TetMesh,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.mesh import mass_norms
from snapspace.snapshots.solver_options import SINGLE_TOLERANCE, Precision

from ..shapes import irregular_bar, slender_problem
from .bars import assert_same_bits, parameters, posing_bar

FloatArray = NDArray[np.float64]


def solved(
    problem: PosingProblem, samples: FloatArray, precision: Precision, **options: Any
) -> Snapshots:
    """Solves from the rest shape: other starts would bring in the precision of other samples.

    It uses no soft modes, whose longer steps separate two runs sooner; they have their own test.
    """
    given = {"block": len(samples), "precision": precision, "tolerance": 1e-5, "soft_modes": False}
    options = {**given, **options}
    return solve_snapshots(problem, samples, options=SolverOptions(**options), threads=1)


def distances(a: Snapshots, b: Snapshots) -> FloatArray:
    """Distances of shapes in the M-norm, relative to the displacements, (k,)."""
    mass, rest = a.problem.mass(), a.problem.base
    norms: FloatArray = mass_norms(mass, a.shapes - b.shapes) / mass_norms(mass, b.shapes - rest)
    return norms


def values(snapshots: Snapshots) -> FloatArray:
    return np.array([report.value for report in snapshots.reports])


def assert_single_is_good_enough(
    problem: PosingProblem, samples: FloatArray, *, share: float = 1.0
) -> None:
    """Shapes differ by a hundredth of the tolerance's error, F by a tenth; paths are the same.

    The bound on shapes holds for a share of the samples.
    """
    single, double = (solved(problem, samples, p) for p in ("single", "double"))  # type: ignore[arg-type]
    limit = solved(problem, samples, "double", tolerance=1e-12)
    assert single.converged.all() and double.converged.all() and limit.converged.all()
    left = distances(double, limit)
    assert np.quantile(distances(single, double), share) < 0.01 * left.mean()
    assert np.abs(values(single) / values(double) - 1.0).max() < 1e-6
    for ours, theirs in zip(single.reports, double.reports, strict=True):
        assert abs(ours.iterations - theirs.iterations) <= 1


# a nearly undecided line search separates one sample of the second on some processors
@pytest.mark.parametrize(("bound", "share"), [(0.05, 1.0), (0.25, 0.9), (0.7, 1.0)])
def test_bars(bound: float, share: float) -> None:
    problem = posing_bar(bound=bound)
    assert_single_is_good_enough(problem, parameters(problem, 16), share=share)


def test_with_soft_modes() -> None:
    """Both keep them in single precision, and both end in the same shapes."""
    problem = posing_bar()
    samples = parameters(problem, 16)
    single, double = (solved(problem, samples, p, soft_modes=True) for p in ("single", "double"))  # type: ignore[arg-type]
    limit = solved(problem, samples, "double", tolerance=1e-12)
    assert single.converged.all() and double.converged.all()
    assert distances(single, double).max() < 0.1 * distances(double, limit).mean()
    assert np.abs(values(single) / values(double) - 1.0).max() < 1e-6


# softer handles than 10 hardly hold the shape: rounding decides line searches, and shapes differ by
# the error that the tolerance allows
@pytest.mark.parametrize("stiffness", [10.0, 1e6])
def test_soft_and_hard_handles(stiffness: float) -> None:
    problem = posing_bar(stiffness=stiffness)
    assert_single_is_good_enough(problem, parameters(problem, 8))


def bar_with_a_flat_tet(height: float) -> PosingProblem:
    """A bar with one corner of a tet pressed to a share of its height over the opposite face."""
    mesh = irregular_bar(8, 2, 2)
    vertices, (corner, *face) = mesh.vertices.copy(), np.roll(mesh.tets[60], -1)
    a, b, c = vertices[face]
    normal = np.cross(b - a, c - a) / np.linalg.norm(np.cross(b - a, c - a))
    vertices[corner] -= (1.0 - height) * ((vertices[corner] - a) @ normal) * normal
    x, flat = vertices[:, 0], TetMesh(vertices, mesh.tets)
    assert flat.volumes.min() < 3.0 * height * np.median(flat.volumes)
    domain = HandleBox(translation=0.7, angle=0.7)
    return PosingProblem(flat, Handles([x < 0.6, x > 3.4]), domain=domain, material=StVK())


@pytest.mark.parametrize("height", [1e-2, 1e-4, 1e-5])
def test_slivers(height: float) -> None:
    """Edge vectors of a flat tet keep their digits, but the inverse of their matrix is large."""
    problem = bar_with_a_flat_tet(height)
    # a nearly undecided line search separates one sample in twelve, in any precision
    assert_single_is_good_enough(problem, parameters(problem, 12), share=0.9)


def test_samples_that_rounding_stops_continue_in_double_precision() -> None:
    """They converge after about as many evaluations, at the same values, on any number of threads.

    Along soft modes gradients are noise in single precision, and the core ends some of the samples
    as failed line searches.
    """
    problem = slender_problem()
    samples = parameters(problem, 16)
    single, double, again = (
        solve_snapshots(
            problem,
            samples,
            options=SolverOptions(tolerance=1e-6, precision=precision),
            threads=threads,
        )
        for precision, threads in (("single", 2), ("double", 2), ("single", 1))  # type: ignore[arg-type]
    )
    batch = problem.system.solve_fast(
        problem.inputs(samples),
        problem.guesses(samples),
        tolerance=1e-6,
        max_iterations=1000,
        threads=2,
        control=core.SolveControl(),
        single=True,
        modes=problem.solving.soft_modes(),
    )
    statuses = [report.status.name for report in batch.reports]
    assert {"converged", "line_search_failed"} == set(statuses)
    assert single.converged.all() and double.converged.all()
    mean = [np.mean([r.evaluations for r in run.reports]) for run in (single, double)]
    assert mean[0] < 1.5 * mean[1]
    assert np.abs(values(single) / values(double) - 1.0).max() < 1e-3
    assert_same_bits(single, again)


@pytest.mark.parametrize("size", [1e-3, 1e-7, 1e-10])
def test_tiny_motions(size: float) -> None:
    """Displacements count from rest, so they keep all digits however small they are.

    Strains below 1e-12 are zero in either precision.
    """
    problem = posing_bar()
    single, double = (
        solved(problem, size * parameters(problem, 8), p) for p in ("single", "double")
    )  # type: ignore[arg-type]
    assert single.converged.all()
    rows = [run.displacements.array() for run in (single, double)]
    assert np.abs(rows[0] - rows[1]).max() < 1e-6 * np.abs(rows[1]).max()
    assert [r.iterations for r in single.reports] == [r.iterations for r in double.reports]


@pytest.mark.parametrize("size", [1e-18, 1e-25, 1e-42, 1e-310])
def test_motions_that_single_precision_does_not_see(size: float) -> None:
    """No shape has any energy, and the solution is the guess, which is as small as the motions."""
    problem = posing_bar()
    samples = size * parameters(problem, 4)
    single = solved(problem, samples, "single")
    assert single.converged.all()
    assert max(report.iterations for report in single.reports) == 0
    found = single.displacements.array()
    np.testing.assert_array_equal(found, problem.guesses(samples))
    assert np.abs(found).max() <= 3.0 * np.abs(problem.inputs(samples)).max()


def bar_in_unit(scale: float) -> PosingProblem:
    here = posing_bar()
    return PosingProblem(
        TetMesh(scale * here.mesh.vertices, here.mesh.tets),
        here.handles,
        domain=here.domain,
        material=here.material,
        stiffness=here.stiffness / scale**2,
    )


@pytest.mark.parametrize("scale", [1e-12, 1e-11, 1e-8, 1e-3, 1e6, 1e12])
def test_units_do_not_matter_or_are_reported(scale: float) -> None:
    """A copy in other units has the same solutions. Volumes beyond the range must not be silent."""
    here, there = posing_bar(), bar_in_unit(scale)
    samples = parameters(here, 8)
    factors = np.array([scale, scale, scale, 1.0, 1.0, 1.0])
    expected = solved(here, samples, "double", tolerance=1e-12)
    options = SolverOptions(block=8)  # the precision is the library's choice
    found = solve_snapshots(there, samples * factors, options=options, threads=1)
    excess = values(found) / scale**3 / values(expected) - 1.0
    assert np.abs(excess[found.converged]).max(initial=0.0) < 1e-4
    away = np.abs(found.shapes / scale - expected.shapes).max(axis=1)
    assert away[found.converged].max(initial=0.0) < 2e-3


@pytest.mark.parametrize("scale", [1e-13, 1e-11, 1e13])
def test_the_first_gradient_and_the_guesses_are_in_range_in_any_unit(scale: float) -> None:
    """In single precision, guesses were once not finite, and the first slope was zero."""
    here, there = posing_bar(), bar_in_unit(scale)
    samples = parameters(here, 4)
    units = np.array([scale, scale, scale, 1.0, 1.0, 1.0])
    assert np.isfinite(there.guesses(samples * units)).all()
    expected = solve_snapshots(here, samples, threads=1)
    found = solve_snapshots(there, samples * units, threads=1)
    assert found.converged.all()
    assert min(report.iterations for report in found.reports) > 0
    assert np.abs(found.shapes / scale - expected.shapes).max() < 2e-3


def test_the_default_is_single_where_it_resolves_the_tolerance() -> None:
    problem = posing_bar()
    loose, tight, newton = (
        SolverOptions(**options).resolved(problem)
        for options in (
            {"tolerance": SINGLE_TOLERANCE},
            {"tolerance": np.nextafter(SINGLE_TOLERANCE, 0.0)},
            {"solver": "newton"},
        )
    )
    assert (loose.single, tight.single, newton.single) == (True, False, False)
