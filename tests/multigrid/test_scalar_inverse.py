"""Factor or cycle: which one a problem chooses, and that solutions do not depend on it."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import (
    InterpolationProblem,
    Poses,
    PosingProblem,
    SolverOptions,
    sample,
    solve_snapshots,
)
from snapspace._core import InverseKind, PosingSystem, SolveControl

from ..snapshots.creatures import posing_creature
from .solids import solid_cube


@pytest.fixture(scope="module")
def solid() -> PosingProblem:
    return solid_cube()


def test_small_bodies_have_a_factor() -> None:
    assert posing_creature(5000).system.inverse == InverseKind.factor


def test_large_solid_bodies_have_a_cycle(solid: PosingProblem) -> None:
    """The tets are well shaped. The factor has more than 140 entries per column, so its two solves
    would take 280 multiplications per vertex; a cycle takes a few dozen."""
    assert solid.system.inverse == InverseKind.cycle
    assert solid.system.inverse_products < 60 * len(solid.mesh.vertices)


def test_flat_tets_get_a_factor() -> None:
    flat = solid_cube(flat=0.05)
    assert flat.system.inverse == InverseKind.factor
    assert flat.system.inverse_products > 200 * len(flat.mesh.vertices)


def test_both_lead_to_the_same_shapes() -> None:
    """The approximate inverse changes the solver's path, not its solution."""
    problem = posing_creature(8000)
    samples = sample(problem.domain, 3, seed=2)
    shapes = []
    for kind in (InverseKind.factor, InverseKind.cycle):
        system = PosingSystem(
            problem.mesh.vertices,
            problem.mesh.tets,
            problem.material.core,
            problem.pinned,
            problem.pin_weights,
            inverse=kind,
        )
        assert system.inverse == kind
        assert (system.lowest_eigenvalue is None) == (kind == InverseKind.factor)
        batch = system.solve_fast(
            problem.inputs(0.3 * samples),
            np.zeros((3, 3 * len(problem.mesh.vertices))),
            tolerance=1e-11,
            max_iterations=2000,
            threads=2,
            control=SolveControl(),
        )
        assert all(report.status.name == "converged" for report in batch.reports)
        shapes.append(batch.shapes)
    np.testing.assert_allclose(shapes[1], shapes[0], rtol=0, atol=1e-3 * np.abs(shapes[0]).max())


def test_samples_end_where_the_gradient_vanishes(solid: PosingProblem) -> None:
    """The cycle and its soft modes take few evaluations."""
    samples = sample(solid.domain, 2, seed=1)
    tight = solve_snapshots(solid, samples, options=SolverOptions(tolerance=1e-9))
    assert tight.converged.all()
    for u, inputs in zip(tight.displacements.array(), solid.inputs(samples), strict=True):
        _, before = solid.system.value_and_gradient(np.zeros_like(u), inputs)
        _, after = solid.system.value_and_gradient(u, inputs)
        assert np.linalg.norm(after) < 1e-3 * np.linalg.norm(before)
    settled = solve_snapshots(solid, samples)
    assert max(report.evaluations for report in settled.reports) < 80


def test_blends_of_large_solid_bodies_have_a_cycle(solid: PosingProblem) -> None:
    """The system of the poses and the one adapted near a blend lead to the same minimum."""
    mesh = solid.mesh
    x = mesh.vertices[:, 0] / np.ptp(mesh.vertices[:, 0])
    bent = mesh.vertices + np.outer(0.2 * x**2, [0.0, 0.0, 1.0])
    problem = InterpolationProblem(Poses(np.stack([mesh.vertices, bent]), mesh.tets))
    weights = np.array([[0.5, 0.5]])
    start = (problem.tau - problem.base)[None]
    energies = []
    for system in (problem.system, problem.solving.system_near(start[0])):
        assert system.inverse == InverseKind.cycle
        batch = system.solve_fast(
            weights, start, tolerance=1e-7, max_iterations=500, threads=2, control=SolveControl()
        )
        assert batch.reports[0].status.name == "converged"
        energies.append(batch.reports[0].value)
    assert energies[0] == pytest.approx(energies[1], rel=1e-4)
