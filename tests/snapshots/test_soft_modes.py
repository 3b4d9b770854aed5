"""Soft modes: the lowest of the Hessian at rest relative to the factor, and their gain."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigh

from snapspace import (
    HandleBox,
    Handles,
    PosingProblem,
    Snapshots,
    SolverOptions,
    TetMesh,
    sample,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.mesh import mass_norms

from .bars import posing_bar
from .creatures import posing_creature
from .effort import evaluations

FloatArray = NDArray[np.float64]

#: The core's factor of eigenvalues, because solutions are stiffer than the rest shape.
STIFFENING = 40.0


@pytest.fixture(scope="module")
def small() -> PosingProblem:
    return posing_bar(8, 3, 3)


@pytest.fixture(scope="module")
def matrices(small: PosingProblem) -> tuple[FloatArray, FloatArray]:
    """Hessian at rest and scalar matrix, dense, computed independently of the core."""
    size = small.base.size
    inverse = np.array([small.system.precondition(unit) for unit in np.eye(size)])
    handles = np.zeros(size)
    for axis in range(3):
        handles[3 * small.pinned + axis] = 2.0 * small.pin_weights
    return small.energy.hessian(small.base).toarray() + np.diag(handles), np.linalg.inv(inverse)


def test_modes_are_the_lowest_of_the_rest_hessian(
    small: PosingProblem, matrices: tuple[FloatArray, FloatArray]
) -> None:
    hessian, scalar = matrices
    exact = eigh(hessian, scalar, eigvals_only=True)[:8]
    found = small.solving.soft_modes()
    modes = found.modes(small.system)
    values = np.diag(modes @ hessian @ modes.T)
    # Ritz values bound eigenvalues from above (Courant-Fischer); 1e-3 is for single precision
    assert (np.sort(values) >= exact * (1 - 1e-3)).all()
    assert values.sum() <= 1.1 * exact.sum()
    np.testing.assert_allclose(1 / (STIFFENING * np.array(found.weights)), values, rtol=1e-3)


def test_modes_are_orthonormal_with_the_scalar_matrix(
    small: PosingProblem, matrices: tuple[FloatArray, FloatArray]
) -> None:
    modes = small.solving.soft_modes().modes(small.system)
    np.testing.assert_allclose(modes @ matrices[1] @ modes.T, np.eye(8), atol=1e-3)


def test_modes_are_the_same_every_time(small: PosingProblem) -> None:
    again, found = core.SoftModes(small.system), small.solving.soft_modes()
    np.testing.assert_array_equal(again.modes(small.system), found.modes(small.system))
    assert again.weights == found.weights


def test_the_minimum_does_not_depend_on_the_seed() -> None:
    problem = posing_creature(5000)
    samples = 0.3 * sample(problem.domain, 6, method="sobol", seed=1)
    shapes = [
        solve_snapshots(
            problem,
            samples,
            options=SolverOptions(tolerance=1e-11, precision="double", soft_modes=soft),
        ).shapes
        for soft in (True, False)
    ]
    displacements = np.linalg.norm(shapes[0] - problem.base, axis=1)
    misses = np.linalg.norm(shapes[0] - shapes[1], axis=1) / displacements
    assert np.median(misses) < 1e-3, misses


def test_fewer_evaluations_leave_smaller_errors() -> None:
    problem = posing_creature(8000)
    samples = sample(problem.domain, 24, method="sobol", seed=2)
    mass = problem.mass()

    def solved(**options: Any) -> Snapshots:
        return solve_snapshots(problem, samples, options=SolverOptions(block=24, **options))

    # only samples with the same minimum from both can be compared
    limits = [solved(tolerance=1e-10, soft_modes=soft).shapes for soft in (True, False)]
    same = mass_norms(mass, limits[0] - limits[1]) < 1e-3 * np.sqrt(problem.mesh.volume)
    assert same.sum() > 12

    def error(snapshots: Snapshots) -> float:
        misses = mass_norms(mass, snapshots.shapes - limits[0])
        return float(np.median(misses[same]))

    soft, plain = solved(), solved(soft_modes=False)
    assert evaluations(soft) < 0.8 * evaluations(plain)
    assert error(soft) < error(plain)


def test_a_mesh_with_fewer_unknowns_than_a_block_has_no_modes() -> None:
    mesh = TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
    handles = Handles([[0, 1, 2], [3]])
    problem = PosingProblem(mesh, handles, domain=HandleBox(translation=0.1, angle=0.1))
    assert problem.solving.soft_modes().weights == [0.0] * 8
    assert solve_snapshots(problem, sample(problem.domain, 3)).converged.all()


def test_modes_of_another_mesh_are_refused(small: PosingProblem) -> None:
    other = posing_creature(5000)
    with pytest.raises(ValueError, match="the modes belong to another system"):
        other.system.solve_fast(
            np.zeros((1, other.system.input_size)),
            np.zeros((1, other.base.size)),
            tolerance=1e-5,
            max_iterations=1,
            threads=1,
            control=core.SolveControl(),
            modes=small.solving.soft_modes(),
        )


def test_without_modes_settling_is_a_fifth(small: PosingProblem) -> None:
    softened = SolverOptions().resolved(small)
    plain = SolverOptions(soft_modes=False).resolved(small)
    assert softened.modes_of(small) is not None
    assert plain.modes_of(small) is None
    assert plain.settling == pytest.approx(softened.settling / 5)
    assert SolverOptions(solver="newton").resolved(small).modes_of(small) is None
