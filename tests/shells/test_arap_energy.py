"""As-rigid-as-possible surfaces: derivatives, invariances, libigl's energy and minimisers."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from snapspace import ARAP, ElasticEnergy, PosingProblem, ShellMesh, SolverOptions, solve_snapshots

from ..shapes import irregular_bar
from ..taylor import gradient_order, value_order
from .libigl_arap import libigl_energy, libigl_shape
from .sheets import bumpy, equilateral, irregular, rolled, sphere
from .strips import strip, strip_problem

FloatArray = NDArray[np.float64]
State = tuple[ShellMesh, FloatArray, float]

BALL, SQUARE = sphere(1), irregular(12, thickness=0.3)
FAN = ShellMesh([[0, 0, 0], [1, 0, 0], [0.3, 1.1, 0]], [[0, 1, 2]], thickness=0.1)
STATES: dict[str, tuple[ShellMesh, FloatArray]] = {
    "small": (BALL, bumpy(BALL, 0.01)),
    "large": (BALL, bumpy(BALL, 0.15)),
    "flat": (SQUARE, 1.1 * SQUARE.vertices.reshape(-1)),
    "rolled": (SQUARE, rolled(SQUARE.vertices, 3.0, 0.4).reshape(-1)),
    "bumpy sheet": (SQUARE, bumpy(SQUARE, 0.1)),
    "triangle": (FAN, bumpy(FAN, 0.2)),
}


@pytest.fixture(params=[0.0, 0.2], ids=["rings", "radius"], scope="module")
def radius(request: pytest.FixtureRequest) -> float:
    """The radius of the stars: zero for one-rings, or a fifth of the diagonal."""
    return float(request.param)


@pytest.fixture(params=STATES, scope="module")
def state(request: pytest.FixtureRequest, radius: float) -> State:
    return *STATES[request.param], radius


def energy_of(mesh: ShellMesh, radius: float) -> ElasticEnergy:
    """The energy, with moduli that differ from triangle to triangle."""
    mu = np.linspace(0.5, 2.0, len(mesh.triangles))
    return ElasticEnergy(mesh, ARAP(mu=mu, radius=radius))


def test_value_and_gradient_and_hessian_are_consistent(state: State) -> None:
    mesh, x, radius = state
    direction = 0.02 * np.random.default_rng(4).normal(size=x.size)
    energy = energy_of(mesh, radius)
    assert value_order(energy, x, direction) == pytest.approx(2, abs=0.1)
    assert gradient_order(energy, x, direction) == pytest.approx(2, abs=0.15)


def test_the_assembled_hessian_is_the_matrix_of_the_products(state: State) -> None:
    mesh, x, radius = state
    energy, d = energy_of(mesh, radius), np.random.default_rng(5).normal(size=x.size)
    assembled = energy.hessian(x).toarray()
    scale = np.abs(assembled).max()
    np.testing.assert_allclose(energy.hessian_product(x, d), assembled @ d, atol=1e-11 * scale)
    np.testing.assert_allclose(assembled, assembled.T, rtol=0, atol=1e-13 * scale)


@pytest.mark.parametrize("projection", ["clamp", "absolute"])
def test_projected_hessians_are_semidefinite(state: State, projection: str) -> None:
    mesh, x, radius = state
    energy = energy_of(mesh, radius)
    whole, projected = energy.hessian(x), energy.projected_hessian(x, projection=projection)
    least, largest = np.linalg.eigvalsh(projected.toarray())[[0, -1]]
    assert least >= -1e-10 * largest
    assert np.linalg.eigvalsh((projected - whole).toarray())[0] >= -1e-10 * largest


def test_rigid_motions_change_nothing_and_the_rest_shape_has_no_energy(state: State) -> None:
    mesh, x, radius = state
    energy = energy_of(mesh, radius)
    turn = Rotation.from_rotvec([1.0, -2.0, 0.5]).as_matrix()
    value, gradient = energy.value_and_gradient(x)
    moved = x.reshape(-1, 3) @ turn.T + [3.0, -1.0, 2.0]
    again, turned = energy.value_and_gradient(moved)
    assert again == pytest.approx(value, rel=1e-12)
    scale = np.abs(gradient).max()
    expected = gradient.reshape(-1, 3) @ turn.T
    np.testing.assert_allclose(turned.reshape(-1, 3), expected, atol=1e-11 * scale)
    for rest in (mesh.vertices, mesh.vertices @ turn.T):
        zero, force = energy.value_and_gradient(rest)
        assert zero < 1e-26 * mesh.volume
        assert np.abs(force).max() < 1e-12


@pytest.mark.parametrize("name", STATES)
def test_with_rings_it_has_the_energy_of_libigl(name: str) -> None:
    mesh, x = STATES[name]
    ours = ElasticEnergy(mesh, ARAP(mu=1.7, radius=0.0)).value(x)
    assert ours == pytest.approx(1.7 * float(mesh.thickness) * libigl_energy(mesh, x), rel=1e-11)


def test_lanes_in_both_precisions_have_the_same_energy(state: State) -> None:
    mesh, x, radius = state
    core = energy_of(mesh, radius).core
    moved = np.stack([x, 1.01 * x]) - mesh.vertices.reshape(-1)
    wanted = [core.value_and_gradient(u) for u in moved]
    scale = max(np.abs(gradient).max() for _, gradient in wanted)
    for single, digits in ((False, 1e-12), (True, 3e-5)):
        values, gradients = core.lane_values_and_gradients(moved, single=single)
        for k, (value, gradient) in enumerate(wanted):
            assert values[k] == pytest.approx(value, rel=100 * digits)
            np.testing.assert_allclose(gradients[k], gradient, atol=digits * scale)


def test_stars_and_their_remainder_are_the_energy_and_neither_is_negative(state: State) -> None:
    mesh, x, radius = state
    energy = energy_of(mesh, radius)
    assert energy.stars is not None
    u = x - mesh.vertices.reshape(-1)
    stresses, parts = energy.core.tet_stresses(u)
    rest, slopes = energy.stars.remainder_at(u[None])
    assert (parts >= 0).all()
    value, gradient = energy.value_and_gradient(x)
    assert parts.sum() + rest[0] == pytest.approx(value, rel=1e-11)
    every = np.arange(len(energy.stars))
    unit = energy.stars.gradients(np.eye(x.size), every).reshape(-1, x.size)
    forces = unit.T @ stresses.reshape(-1) + slopes[0]
    np.testing.assert_allclose(forces, gradient, atol=1e-6 * np.abs(gradient).max())
    form = energy.stars.remainder(np.eye(x.size))
    assert np.linalg.eigvalsh(form)[0] > -1e-12 * energy.core.scalar_diagonal().max()


def test_an_affine_map_leaves_no_remainder(radius: float) -> None:
    energy = energy_of(BALL, radius)
    assert energy.stars is not None
    linear = np.random.default_rng(3).normal(size=(3, 3))
    moved = BALL.vertices @ linear.T
    remainder, _ = energy.stars.remainder_at(moved.reshape(1, -1))
    assert abs(remainder[0]) < 1e-12 * energy.value(moved)


def test_a_stretched_sheet_has_the_energy_of_its_density() -> None:
    mesh = irregular(20, thickness=0.2)
    x = mesh.vertices * [1.3, 0.8, 1.0]
    area = mesh.areas.sum()
    assert ElasticEnergy(mesh, ARAP(mu=2.0)).value(x) == pytest.approx(
        2.0 * 0.2 * area * (0.3**2 + 0.2**2), rel=1e-12
    )


def test_with_rings_bending_resists_by_the_width_of_the_triangles() -> None:
    """Equilateral triangles of side a, in any direction: 3/16 mu t a^2 curvature^2 per area."""
    ratios = []
    for n in (24, 48):
        mesh = equilateral(n, n, thickness=0.01)
        curvature, side = 0.5, 1.0 / n
        energy = ElasticEnergy(mesh, ARAP(radius=0.0))
        value = energy.value(rolled(mesh.vertices, curvature, 0.3))
        ratios.append(value / (0.01 * mesh.areas.sum() * side**2 * curvature**2))
    assert ratios[1] == pytest.approx(3 / 16, rel=0.03)
    assert abs(ratios[1] - 3 / 16) < 0.6 * abs(ratios[0] - 3 / 16)


def test_the_fast_solver_ends_where_newton_does(radius: float) -> None:
    problem = strip_problem(material=ARAP(radius=radius))
    parameters = np.array([[0.1, -0.2, 0.1, 0.3, 0.2, -0.4]])
    shapes = [
        solve_snapshots(problem, parameters, options=options, threads=1).shapes[0]
        for options in (
            SolverOptions(solver="fast", tolerance=1e-12, max_iterations=4000),
            SolverOptions(solver="newton", tolerance=1e-13),
        )
    ]
    moved = np.abs(shapes[1] - problem.base).max()
    np.testing.assert_allclose(shapes[0], shapes[1], atol=1e-4 * moved)
    gradient = problem.value_and_gradient(shapes[1], parameters[0])[1]
    elastic = problem.energy.value_and_gradient(shapes[1])[1]
    assert np.linalg.norm(gradient) < 1e-5 * np.linalg.norm(elastic)


@pytest.mark.parametrize("mesh", [strip(), strip(24, 6)])
def test_with_rings_the_solution_is_the_minimiser_of_libigl(mesh: ShellMesh) -> None:
    """The same handles, nearly rigid here, and 2000 of libigl's local-global iterations."""
    rings = ARAP(radius=0.0)
    soft = strip_problem(mesh, material=rings)
    problem = PosingProblem(
        mesh, soft.handles, domain=soft.domain, material=rings, stiffness=1e4 * soft.stiffness
    )
    w = np.array([0.1, -0.1, 0.2, 0.2, 0.4, -0.2])
    options = SolverOptions(solver="newton", tolerance=1e-14)
    ours = solve_snapshots(problem, w[None], options=options).shapes[0]
    pinned = problem.pinned
    theirs = libigl_shape(mesh, pinned, ours.reshape(-1, 3)[pinned], iterations=2000)
    energy = problem.energy
    assert energy.value(ours) <= energy.value(theirs) * (1 + 1e-9)
    assert energy.value(ours) == pytest.approx(energy.value(theirs), rel=1e-4)
    moved = np.abs(ours - problem.base).max()
    np.testing.assert_allclose(ours.reshape(-1, 3), theirs, atol=3e-3 * moved)


@pytest.mark.parametrize("kind", ["tets", "stars"])
def test_stresses_of_some_elements_are_theirs_among_all(kind: str) -> None:
    rng = np.random.default_rng(4)
    tets = irregular_bar()
    energy = (ElasticEnergy(tets, ARAP()) if kind == "tets" else energy_of(BALL, 0.2)).core
    u = 0.1 * rng.normal(size=3 * len(tets.vertices if kind == "tets" else BALL.vertices))
    P, psi = energy.tet_stresses(u)
    which = np.array([3, 0, 3], np.int32)
    some, energies = energy.some_tet_stresses(u, which)
    np.testing.assert_array_equal(some, P[which])
    np.testing.assert_array_equal(energies, psi[which])
    with pytest.raises(ValueError, match="an element is not in the mesh"):
        energy.some_tet_stresses(u, np.array([len(P)], np.int32))
