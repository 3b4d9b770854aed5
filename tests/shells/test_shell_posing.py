"""Shells in full solves: the fast solver, Newton's method, guesses, and what must be held."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from snapspace import (
    ARAP,
    HandleBox,
    Handles,
    PosingProblem,
    ShellMesh,
    SolverOptions,
    StableNeoHookean,
    StVK,
    sample,
    solve_snapshots,
)
from snapspace import _core as core
from snapspace.mesh import mass_norms
from snapspace.problem.handle_response import HandleResponse

from .sheets import sheet
from .strips import strip, strip_problem

FloatArray = NDArray[np.float64]


@pytest.fixture(scope="module")
def problem() -> PosingProblem:
    return strip_problem()


def tight(solver: str) -> SolverOptions:
    tolerance = {"fast": 1e-12, "newton": 1e-13}[solver]
    return SolverOptions(solver=solver, tolerance=tolerance, max_iterations=4000)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", [StVK, StableNeoHookean])
def test_both_solvers_end_where_no_force_is_left(kind: type[StVK | StableNeoHookean]) -> None:
    mesh = strip()
    mu = np.linspace(0.5, 2.0, len(mesh.triangles))
    problem = strip_problem(mesh, material=kind(lam=1.5 * mu, mu=mu))
    samples = sample(problem.domain, 3, seed=2)
    found = {
        name: solve_snapshots(problem, samples, options=tight(name), threads=1)
        for name in ("fast", "newton")
    }
    assert found["fast"].converged.all() and found["newton"].converged.all()
    for w, fast, newton in zip(samples, found["fast"].shapes, found["newton"].shapes, strict=True):
        value, gradient = problem.value_and_gradient(newton, w)
        elastic = problem.energy.value_and_gradient(newton)[1]
        assert np.linalg.norm(gradient) < 1e-5 * np.linalg.norm(elastic)
        assert problem.value_and_gradient(fast, w)[0] == pytest.approx(value, rel=1e-8)
        np.testing.assert_allclose(fast, newton, atol=1e-4 * np.abs(newton - problem.base).max())


def test_samples_are_bitwise_the_same_for_any_number_of_threads(problem: PosingProblem) -> None:
    samples = sample(problem.domain, 9, seed=1)
    one, two = (solve_snapshots(problem, samples, threads=threads).shapes for threads in (1, 2))
    np.testing.assert_array_equal(one, two)


def test_single_and_double_precision_agree(problem: PosingProblem) -> None:
    samples = sample(problem.domain, 4, seed=3)
    shapes = [
        solve_snapshots(
            problem, samples, options=SolverOptions(precision=precision, tolerance=1e-6)
        ).displacements.array()
        for precision in ("single", "double")
    ]
    norms = mass_norms(problem.mass(), shapes[1])
    assert (mass_norms(problem.mass(), shapes[0] - shapes[1]) < 2e-2 * norms).all()


def test_a_rigid_motion_of_all_handles_is_guessed_as_such() -> None:
    """Turned by half a turn: triangles and hinges take the rotation of their linear response."""
    mesh = strip()
    problem = strip_problem(mesh)
    axes = np.eye(3)
    spins = [np.cross(a, mesh.vertices[problem.pinned]).reshape(-1) for a in axes]
    response = core.LinearResponse(problem.system, np.array(spins))
    vector = np.pi * np.array([0.6, 0.0, 0.8])
    turn = Rotation.from_rotvec(vector).as_matrix()
    wanted = mesh.vertices @ turn.T + [1.0, -2.0, 0.5] - mesh.vertices
    pinned = wanted[problem.pinned].reshape(1, -1)
    found = response.warped(problem.system, vector[None], pinned).reshape(-1, 3)
    assert np.abs(found - wanted).max() < 5e-3 * np.abs(wanted).max()


def test_guesses_are_of_second_order(problem: PosingProblem) -> None:
    direction = sample(problem.domain, 1, seed=5)[0]
    errors = []
    for step in (0.2, 0.1):
        w = (step * direction)[None]
        exact = solve_snapshots(problem, w, options=tight("newton")).displacements.array()
        guess = HandleResponse(problem).guesses(problem, w)
        errors.append(mass_norms(problem.mass(), guess - exact)[0])
        assert errors[-1] < 0.3 * mass_norms(problem.mass(), exact)[0]
    assert np.log2(errors[0] / errors[1]) > 1.7


def test_a_strip_between_parallel_clamps_sags_like_a_beam() -> None:
    """The tip of a cantilever, moved by d, has the energy 3 D w / length^3 d^2 / 2 of a beam.

    Its end may turn: it is held by one row of vertices near a line, whose spring resists no torque.
    A wide plate's ends would curl; a Poisson ratio of the membrane of zero leaves a beam.
    """
    length, thickness = 2.0, 0.02
    mesh = sheet(60, 6, size=(length, 0.3), thickness=thickness, alternating=True)
    x = mesh.vertices[:, 0]
    problem = PosingProblem(
        mesh,
        Handles([x < 0.05, x > length - 1e-9]),
        domain=HandleBox(translation=0.01, angle=0.0),
        material=StVK(lam=0.0, mu=1.0),
    )
    small = 1e-3 * length
    w = np.array([0, 0, small, 0, 0, 0])
    found = solve_snapshots(problem, w[None], options=tight("newton"))
    rigidity, free = 2.0 * thickness**3 / 12, length - x[x < 0.05].max()
    beam = 3 * rigidity * 0.3 / free**3 * small**2 / 2
    # the sheet's hinges resist bending along the strip by 0.88 of a plate's, docs/shells.md
    assert found.reports[0].value == pytest.approx(beam, rel=0.2)


def test_every_component_must_be_held() -> None:
    one = sheet(4, 4)
    both = ShellMesh(
        np.vstack([one.vertices, one.vertices + np.array([0, 0, 1.0])]),
        np.vstack([one.triangles, one.triangles + len(one.vertices)]),
        thickness=0.05,
    )
    left = both.vertices[:, 0] < 0.5
    domain = HandleBox(translation=0.1, angle=0.1)
    handles = Handles([left & (both.vertices[:, 2] < 0.5), ~left & (both.vertices[:, 2] < 0.5)])
    message = "component 1 of 2, that of vertex 25, is not held: 0 of its vertices are in handles"
    with pytest.raises(ValueError, match=message):
        PosingProblem(both, handles, domain=domain)
    held = PosingProblem(both, Handles([left, ~left]), domain=domain)
    assert held.material == ARAP(radius=0.02), "surfaces are as rigid as possible by default"


def test_a_single_row_of_vertices_holds_no_sheet() -> None:
    mesh = sheet(4, 4)
    row = np.flatnonzero(mesh.vertices[:, 0] == 0)
    with pytest.raises(ValueError, match="lie on one line"):
        PosingProblem(
            mesh, Handles([row[:2], row[2:]]), domain=HandleBox(translation=0.1, angle=0.1)
        )


def test_a_problem_of_a_shell_is_pickled_and_has_its_own_fingerprint() -> None:
    problem = strip_problem()
    again = pickle.loads(pickle.dumps(problem))
    assert again.fingerprint == problem.fingerprint
    assert strip_problem(strip(thickness=0.02)).fingerprint != problem.fingerprint
