"""Guesses: warped linear responses, and their corrections by finished samples."""

from __future__ import annotations

import gc
import weakref
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from snapspace import HandleBox, Handles, PosingProblem, SolverOptions, StVK, solve_snapshots
from snapspace import _core as core
from snapspace.displacements import DisplacementRows
from snapspace.generators import bar, creature
from snapspace.mesh import mass_norms
from snapspace.snapshots.guesses import GUESSED, Guesses

from ..shapes import interpolation_problem
from .bars import parameters, posing_bar
from .creatures import posing_creature

FloatArray = NDArray[np.float64]


@pytest.fixture(scope="module")
def problem() -> PosingProblem:
    return posing_bar(bound=0.7)


def rotation_inputs(problem: PosingProblem, axis: FloatArray) -> FloatArray:
    """Inputs of the pinned vertices for a small rotation of everything about an axis."""
    return np.cross(axis, problem.mesh.vertices[problem.pinned]).reshape(-1)


def solutions(problem: PosingProblem, samples: FloatArray) -> FloatArray:
    options = SolverOptions(solver="newton", tolerance=1e-12)
    return solve_snapshots(problem, samples, options=options).displacements.array()


def errors(problem: PosingProblem, found: FloatArray, exact: FloatArray) -> FloatArray:
    mass = problem.mass()
    return np.asarray(mass_norms(mass, found - exact) / mass_norms(mass, exact))


@pytest.mark.parametrize("angle", [0.1, 1.0, np.pi, 6.0, 12.0])
def test_a_rigid_motion_of_all_handles_stays_rigid(problem: PosingProblem, angle: float) -> None:
    """Its linear response is the spin field, whose gradient is the same skew matrix everywhere."""
    axes = np.eye(3)
    response = core.LinearResponse(
        problem.system, np.array([rotation_inputs(problem, a) for a in axes])
    )
    vector = angle * np.array([0.6, 0.0, 0.8])
    vertices = problem.mesh.vertices
    rotation = Rotation.from_rotvec(vector).as_matrix()
    wanted = vertices @ rotation.T + [1.0, -2.0, 0.5] - vertices
    found = response.warped(problem.system, vector[None], wanted[problem.pinned].reshape(1, -1))
    # responses are solved to a thousandth of the angle
    assert np.abs(found[0] - wanted.reshape(-1)).max() < 1e-3 * angle * problem.mesh.diagonal


def test_responses_solve_the_problem_linearised_at_rest(problem: PosingProblem) -> None:
    """They agree with a direct solver's to a hundredth of the energy."""
    inputs = np.array([rotation_inputs(problem, axis) for axis in np.eye(3)])
    inputs[:, 54:] = 0.0  # the tip is held
    held = np.zeros(problem.base.size)
    forces = np.zeros((3, problem.base.size))
    for axis in range(3):
        held[3 * problem.pinned + axis] = 2.0 * problem.pin_weights
        forces[:, 3 * problem.pinned + axis] = 2.0 * problem.pin_weights * inputs[:, axis::3]
    hessian = problem.energy.hessian(problem.base).toarray() + np.diag(held)
    exact = np.linalg.solve(hessian, forces.T).T
    # for small motions, rotations vanish, and a warp is the Poisson problem of the response
    response = core.LinearResponse(problem.system, inputs)
    small = 1e-3
    found = response.warped(problem.system, small * np.eye(3), small * inputs) / small
    gap = np.einsum("ij,ij->i", (found - exact) @ hessian, found - exact)
    elastic = problem.energy.hessian(problem.base).toarray()
    energy = np.einsum("ij,ij->i", exact @ elastic, exact)
    assert (gap < 1e-2 * energy).all()


def test_guesses_are_exact_to_first_order(problem: PosingProblem) -> None:
    """Their error is of second order, above the tolerance of responses."""
    samples = parameters(problem, 4)
    misses = []
    for share in (0.05, 0.4, 0.8):
        exact = solutions(problem, share * samples)
        misses.append(np.median(errors(problem, problem.guesses(share * samples), exact)))
    assert misses[0] < 0.02
    assert misses[1] < 0.6 * misses[2]


def test_guesses_have_nearly_the_least_energy(problem: PosingProblem) -> None:
    samples = parameters(problem, 8)
    least = solutions(problem, samples)
    guesses = problem.guesses(samples)
    for w, guess, shape in zip(samples, guesses, least, strict=True):
        value = problem.value_and_gradient(problem.base + guess, w)[0]
        lowest = problem.value_and_gradient(problem.base + shape, w)[0]
        assert lowest <= value < 2.0 * lowest
        assert value < 0.05 * problem.value_and_gradient(problem.base, w)[0]


def test_a_guess_does_not_depend_on_the_other_samples() -> None:
    problem = posing_creature(5000)
    samples = parameters(problem, 21)
    together = problem.guesses(samples)
    for k in (0, 8, 20):
        np.testing.assert_array_equal(problem.guesses(samples[k : k + 1])[0], together[k])
    again = PosingProblem(
        problem.mesh,
        problem.handles,
        domain=problem.domain,
        stiffness=problem.stiffness,
        material=problem.material,
    )
    np.testing.assert_array_equal(again.guesses(samples), together)


def test_several_handles_and_one_that_is_never_sampled() -> None:
    mesh = bar(12, 2, 2)
    x = mesh.vertices[:, 0]
    handles = Handles([x < 0.4, abs(x - 2.0) < 0.2, x > 3.6], names=["foot", "waist", "tip"])
    bounds = np.array([[0.0] * 3, [0.4] * 3])
    domain = HandleBox(translation=bounds, angle=bounds, moving=2)
    problem = PosingProblem(mesh, handles, domain=domain, material=StVK())
    samples = parameters(problem, 6)
    guesses = problem.guesses(samples)
    assert np.median(errors(problem, guesses, solutions(problem, samples))) < 0.1
    still = guesses.reshape(6, -1, 3)[:, handles["waist"].vertices]
    assert np.abs(still).max() < 1e-2 * np.abs(guesses).max()


def test_a_cycle_gives_nearly_the_same_guesses() -> None:
    """Four cycles replace an inverse in the warp; responses converge with either."""
    mesh = creature(110_000)
    x = mesh.vertices[:, 0]
    handles = Handles([x < np.quantile(x, 0.1), x > np.quantile(x, 0.9)])
    domain = HandleBox(translation=0.1, angle=0.5)
    problem = PosingProblem(mesh, handles, domain=domain, material=StVK())
    samples = parameters(problem, 4)
    inputs = problem.inputs(samples)
    elastic = mesh.vertices, mesh.tets, problem.material.core
    assert problem.system.inverse == core.InverseKind.cycle
    factor = core.PosingSystem(
        *elastic, problem.pinned, problem.pin_weights, inverse=core.InverseKind.factor
    )
    guesses = problem.guesses(samples)
    twin = PosingProblem(mesh, handles, domain=problem.domain)
    twin.system = factor
    exact = twin.guesses(samples)
    assert inputs.shape[1] == factor.input_size
    assert errors(problem, guesses, exact).max() < 0.05


def test_a_problem_that_has_guessed_leaves_the_memory_at_once() -> None:
    """Its responses hold no reference to it, which would last until garbage collection."""
    problem = posing_bar()
    problem.guesses(parameters(problem, 2))
    reference = weakref.ref(problem)
    gc.disable()
    try:
        del problem
        assert reference() is None
    finally:
        gc.enable()


def test_samples_take_fewer_evaluations_from_guesses() -> None:
    """The gain is largest for loose solves, as those of a first model."""
    problem = posing_creature(5000)
    samples = parameters(problem, 12)
    options: dict[str, Any] = {
        "tolerance": 1e-2,
        "max_iterations": 1000,
        "threads": 1,
        "control": core.SolveControl(),
    }
    inputs, guesses = problem.inputs(samples), problem.guesses(samples)
    batches = [
        problem.system.solve_fast(inputs, starts, **options)
        for starts in (guesses, np.zeros_like(guesses))
    ]
    values = [np.mean([report.value for report in batch.reports]) for batch in batches]
    counts = [sum(report.evaluations for report in batch.reports) for batch in batches]
    assert counts[0] < 0.8 * counts[1]
    assert values[0] < 1.02 * values[1]


class TestCorrected:
    """Guesses plus their interpolated errors at finished samples."""

    def test_a_corrected_guess_is_the_sample_at_a_sample(self, problem: PosingProblem) -> None:
        samples = parameters(problem, 8)
        rows = DisplacementRows(solutions(problem, samples), problem.base.size)
        starts = Guesses(problem, samples).corrected([2, 5], range(8), rows)
        assert starts is not None
        np.testing.assert_allclose(starts, rows.array()[[2, 5]], atol=1e-9)

    def test_a_corrected_guess_is_nearer_than_the_guess(self, problem: PosingProblem) -> None:
        samples = 0.5 * parameters(problem, 26)
        exact = solutions(problem, samples)
        rows = DisplacementRows(exact[:20], problem.base.size)
        starts = Guesses(problem, samples).corrected(range(20, 26), range(20), rows)
        assert starts is not None
        missed = errors(problem, problem.guesses(samples[20:]), exact[20:])
        assert np.median(errors(problem, starts, exact[20:])) < 0.8 * np.median(missed)

    def test_the_rest_shape_corrects_nothing(self, problem: PosingProblem) -> None:
        samples = np.vstack([np.zeros(6), parameters(problem, 3)])
        rest = DisplacementRows(np.zeros((1, problem.base.size)), problem.base.size)
        starts = Guesses(problem, samples).corrected([1, 2, 3], [0], rest)
        np.testing.assert_array_equal(starts, problem.guesses(samples[1:]))

    def test_many_samples_need_no_guesses(self, problem: PosingProblem) -> None:
        count = GUESSED * 6
        samples = parameters(problem, count + 1)
        rows = DisplacementRows(np.zeros((count, problem.base.size)), problem.base.size)
        guesses = Guesses(problem, samples)
        assert guesses.corrected([count], range(count), rows) is None
        fewer = guesses.corrected([count], range(count - 1), rows[: count - 1])
        assert fewer is not None

    def test_blends_have_no_guesses(self) -> None:
        problem = interpolation_problem()
        weights = np.full((1, problem.parameter_count), 1.0 / problem.parameter_count)
        rows = DisplacementRows(np.zeros((1, problem.base.size)), problem.base.size)
        assert Guesses(problem, weights).corrected([0], [0], rows) is None


def test_wrong_sizes_are_refused(problem: PosingProblem) -> None:
    inputs = problem.inputs(parameters(problem, 2))
    with pytest.raises(ValueError, match="inputs must be"):
        core.LinearResponse(problem.system, inputs[:, 1:])
    with pytest.raises(ValueError, match="at least one input is needed"):
        core.LinearResponse(problem.system, inputs[:0])
    response = core.LinearResponse(problem.system, inputs)
    with pytest.raises(ValueError, match="coordinates must be"):
        response.warped(problem.system, np.zeros((2, 3)), inputs)
    with pytest.raises(ValueError, match="inputs must be"):
        response.warped(problem.system, np.zeros((1, 2)), inputs)
    with pytest.raises(ValueError, match="belong to another system"):
        response.warped(posing_bar(5).system, np.zeros((2, 2)), inputs)
